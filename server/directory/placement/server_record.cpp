#include "server/directory/placement/server_record.h"

#include <charconv>
#include <cmath>
#include <set>

#include "common/base/format.h"

namespace tandem::directory {

namespace {

bool read_number(std::string_view text, double& into) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), into);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(into) && into >= 0;
}

bool read_number(std::string_view text, std::int64_t& into) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), into);
  return error == std::errc{} && end == text.data() + text.size() && into >= 0;
}

}  // namespace

std::string to_text(const ServerRecord& record) {
  return format(
      "address %s\nkey %s\nvoucher %s\nversion %s\nzone %s\ncapacity %.4f\nused %.4f\ndrains %d\nexpected "
      "%.4f\nepoch_base "
      "%lld\n",
      record.address.c_str(), record.key.c_str(), record.voucher.c_str(), record.version.c_str(), record.zone.c_str(),
      record.capacity, record.used, record.drains ? 1 : 0, record.expected, static_cast<long long>(record.epoch_base));
}

std::optional<ServerRecord> parse_server_record(std::string_view text) {
  if (text.size() > kServerRecordMax) return std::nullopt;
  ServerRecord record;
  std::set<std::string_view> seen;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::size_t space = line.find(' ');
    if (space == std::string_view::npos) continue;
    const std::string_view name = line.substr(0, space), value = line.substr(space + 1);
    if (!seen.insert(name).second) return std::nullopt;
    if (name == "address") record.address = value;
    if (name == "key") record.key = value;
    if (name == "voucher") record.voucher = value;
    if (name == "version") record.version = value;
    if (name == "zone") record.zone = value;
    if (name == "capacity" && !read_number(value, record.capacity)) return std::nullopt;
    if (name == "used" && !read_number(value, record.used)) return std::nullopt;
    if (name == "expected" && !read_number(value, record.expected)) return std::nullopt;
    if (name == "epoch_base" && !read_number(value, record.epoch_base)) return std::nullopt;
    if (name == "drains") record.drains = value == "1";
  }
  for (const char* needed : {"address", "key", "version", "capacity", "used"})
    if (!seen.contains(needed)) return std::nullopt;
  if (!seen.contains("expected")) record.expected = record.used;
  return record;
}

}  // namespace tandem::directory
