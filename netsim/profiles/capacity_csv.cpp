#include "netsim/profiles/capacity_csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <string>

#include "common/base/csv.h"
#include "netsim/profiles/table_errors.h"

namespace tandem::netsim {
namespace {

constexpr std::int64_t kMsMax = 10'000'000'000;
using Traces = std::array<std::shared_ptr<CapacityTrace>, kDirections>;

void read_table(const CsvTable& table, Traces& traces, TableErrors& mistakes) {
  const auto direction = table.find("direction"), time = table.find("t_ms"), count = table.find("opportunities");
  if (!direction || !time || !count) {
    return mistakes.add("needs the columns direction[...], t_ms[...] and opportunities[...]");
  }
  if (const std::string& unit = table.columns()[*time].unit; unit != "ms" && !unit.starts_with("ms "))
    return mistakes.add(1, *time + 1, "t_ms", "[" + unit + "]", "its unit must be [ms]; convert the column");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto whole = [&](std::size_t column, double lo, double hi) -> std::int64_t {
      const auto value = table.number(row, column);
      if (value && *value >= lo && *value <= hi && *value == std::floor(*value))
        return static_cast<std::int64_t>(*value);
      mistakes.add(table, row, column, "must be a whole number in range");
      return -1;
    };
    const std::string_view name = table.cell(row, *direction);
    if (name != "up" && name != "down") mistakes.add(table, row, *direction, "must be up or down");
    const std::int64_t ms = whole(*time, 0, static_cast<double>(kMsMax));
    const std::int64_t opportunities = whole(*count, 1, 1e6);
    if (ms < 0 || opportunities < 0) continue;
    auto& entries = traces[name == "down" ? 1 : 0]->entries;
    if (!entries.empty() && ms <= entries.back().ms) mistakes.add(table, row, *time, "time does not go on");
    entries.push_back({ms, static_cast<std::uint64_t>(opportunities)});
  }
}

void read_lines(std::string_view text, CapacityTrace& trace, TableErrors& mistakes) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    std::string_view cell = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (cell.ends_with('\r')) cell.remove_suffix(1);
    std::int64_t ms = -1;
    const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), ms);
    if (error != std::errc{} || stop != cell.data() + cell.size() || ms < 0 || ms > kMsMax) {
      mistakes.add(line, 1, "t_ms", cell, "must be a whole number of milliseconds");
    } else if (!trace.entries.empty() && ms < trace.entries.back().ms) {
      mistakes.add(line, 1, "t_ms", cell, "time goes back");
    } else if (!trace.entries.empty() && ms == trace.entries.back().ms) {
      ++trace.entries.back().opportunities;
    } else {
      trace.entries.push_back({ms, 1});
    }
  }
}

}  // namespace

std::expected<LinkSpec, InputErrors> parse_capacity(std::string_view text, std::string_view file_name) {
  TableErrors mistakes{file_name};
  Traces traces{std::make_shared<CapacityTrace>(), std::make_shared<CapacityTrace>()};
  if (text.find(',') != std::string_view::npos) {
    const auto table = CsvTable::parse(text);
    if (table) {
      read_table(*table, traces, mistakes);
    } else {
      mistakes.add(table.error());
    }
  } else {
    read_lines(text, *traces[0], mistakes);
    traces[1] = traces[0];
  }
  LinkSpec link;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    auto& trace = traces[static_cast<std::size_t>(direction)];
    if (trace->entries.empty()) {
      if (mistakes.empty()) mistakes.add(std::string("holds no opportunity ") + name(direction));
      break;
    }
    trace->period = std::chrono::milliseconds(trace->entries.back().ms + 1);
    link[direction].rate.trace = trace;
  }
  if (!mistakes.empty()) return mistakes.take();
  return link;
}

}  // namespace tandem::netsim
