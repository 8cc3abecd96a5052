#include "netsim/profiles/app/capacity_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "common/base/format.h"
#include "netsim/profiles/app/network_options.h"
#include "netsim/profiles/capacity_csv.h"

namespace tandem::netsim {
namespace {

constexpr const char* kForms =
    "one whole millisecond per line and opportunity to send 1500 bytes (mahimahi), or the table "
    "direction[up|down],t_ms[ms],opportunities[count]";

bool is_table(std::string_view text) { return text.find(',') != std::string_view::npos; }

std::string contents(const CapacityTrace& trace) {
  std::uint64_t opportunities = 0;
  for (const CapacityTrace::Entry& entry : trace.entries) opportunities += entry.opportunities;
  const double length_s = seconds(trace.period);
  return format("%.2f Mbit/s over %.1f s", static_cast<double>(opportunities) * 1500 * 8 / length_s / 1e6, length_s);
}

}  // namespace

bool looks_like_capacity(std::string_view text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  if (is_table(line)) return line.find("opportunities") != std::string_view::npos;
  return !line.empty() && std::ranges::all_of(line, [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::expected<CapacityFile, std::string> parse_capacity_file(std::string_view text, const std::string& path) {
  auto link = parse_capacity(text, path);
  if (!link) return std::unexpected(lines_of(link.error()));
  std::string words = "recorded capacity " + path;
  if (is_table(text)) {
    words += " (table), up " + contents(*link->up.rate.trace) + ", down " + contents(*link->down.rate.trace);
  } else {
    words += " (mahimahi), each direction " + contents(*link->up.rate.trace);
  }
  return CapacityFile{std::move(*link), words + ", then from the start again"};
}

std::expected<CapacityFile, std::string> read_capacity_file(const std::string& path) {
  const auto text = read_network_file(path);
  if (!text) return std::unexpected(text.error());
  return parse_capacity_file(*text, path);
}

std::expected<std::string, std::string> complete_capacity(Profile& profile, const std::string& profile_file,
                                                          const std::string& given) {
  if (!profile.capacity_file) return std::string{};
  std::filesystem::path path = given;
  if (given.empty()) {
    if (profile.capacity_file->empty()) {
      return std::unexpected("profile " + profile.name +
                             " plays the recorded capacity of a link, and the recording is not part of this program: "
                             "name it with --capacity FILE, or in a profile of your own with rate { capacity { file: "
                             "\"...\" } }; " +
                             kForms);
    }
    path = *profile.capacity_file;
    if (path.is_relative()) path = std::filesystem::path(profile_file).parent_path() / path;
  }
  auto recorded = read_capacity_file(path.string());
  if (!recorded) {
    const std::string where = given.empty() ? "profile " + profile.name + ", capacity { file }: " : "--capacity: ";
    return std::unexpected(where + recorded.error());
  }
  supply_capacity(profile.link, recorded->link);
  return std::move(recorded->description);
}

}  // namespace tandem::netsim
