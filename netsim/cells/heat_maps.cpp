#include <algorithm>
#include <cmath>
#include <span>

#include "common/base/format.h"
#include "netsim/cells/comparison_page.h"

/// Tables with coloured squares.
namespace tandem::netsim {
namespace {

constexpr int kLevels = 10;
constexpr double kSpanMax = 1e4;  // largest ratio of the ends of a scale of colours

/// Range of the medians of a number over all cells of a comparison: equal colours mean equal values in all its maps.
struct Scale {
  double lo = INFINITY, hi = 0;
  bool logarithmic = true, least_is_worst = false;

  /// Returns the level of a value, 0 good to kLevels - 1 bad.
  [[nodiscard]] int level(double value) const {
    if (!(hi > lo)) return 0;
    const double share =
        logarithmic ? std::log(std::max(value, lo) / lo) / std::log(hi / lo) : (value - lo) / (hi - lo);
    const int up = std::clamp(static_cast<int>(share * kLevels), 0, kLevels - 1);
    return least_is_worst ? kLevels - 1 - up : up;
  }
};

Scale scale_of(const ComparisonResult& c, const CellNumberRow& row) {
  Scale scale{.logarithmic = row.logarithmic, .least_is_worst = row.least_is_worst};
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    const double value = c.of(i, row.number).median;
    if (!(value > 0)) continue;
    scale.lo = std::min(scale.lo, value);
    scale.hi = std::max(scale.hi, value);
  }
  if (!row.logarithmic) return {.lo = 0, .hi = 1, .logarithmic = false, .least_is_worst = row.least_is_worst};
  scale.lo = std::max(scale.lo, scale.hi / kSpanMax);
  return scale;
}

std::string square(const ComparisonResult& c, std::size_t index, const CellNumberRow& row, const Scale& scale) {
  const CellResult::Summary sum = c.of(index, row.number);
  const std::string number = std::to_string(c.cells[index].number);
  if (std::isnan(sum.median)) return "<td title=\"cell " + number + "\">–</td>";
  std::string title = "cell " + number;
  if (row.number != CellNumber::kUnstable)
    title += ", worst " + report_text(row, sum.worst) +
             format(" (seed %llu)", static_cast<unsigned long long>(sum.worst_seed));
  return format("<td class=h%d title=\"", scale.level(sum.median)) + title + "\">" + report_text(row, sum.median) +
         (c.results[index]->sound() ? "" : "!") + "</td>";
}

}  // namespace

std::string heat_style() {
  std::string css =
      "table.heat { width: auto; } table.heat td { text-align: right; color: var(--fg); }\n"
      "table.heat th { text-align: left; font-weight: 400; } table.heat thead th { text-align: right; }\n";
  for (int level = 1; level < kLevels; ++level)
    css += format("td.h%d { background: rgb(213 94 0 / .%02d); }\n", level, 6 * level + 2);
  return css;
}

std::string heat_maps(const ComparisonResult& c, std::size_t grid) {
  const CellGridSpec& spec = c.spec.grids[grid];
  std::vector<std::size_t> own;  // innermost is the delay: the cells of a row are neighbours
  for (std::size_t i = 0; i < c.cells.size(); ++i)
    if (c.cells[i].grid == grid) own.push_back(i);
  std::string html;
  for (const CellNumberRow& row : kCellNumbers) {
    const Scale scale = scale_of(c, row);
    std::string rows;
    for (std::size_t at = 0; at < own.size(); at += spec.delays_ms.size()) {
      const auto line = std::span(own).subspan(at, spec.delays_ms.size());
      if (std::ranges::all_of(line, [&](std::size_t i) { return std::isnan(c.of(i, row.number).median); })) continue;
      rows += "<tr><th>" +
              plot::escaped(law_text(c.cells[line.front()]) + ", " + condition_text(c.cells[line.front()])) + "</th>";
      for (const std::size_t i : line) rows += square(c, i, row, scale);
      rows += "</tr>\n";
    }
    if (rows.empty()) continue;
    std::string head = "<tr><th>delay each way [ms]</th>";
    for (const auto& delay : spec.delays_ms) head += format("<th>%.9g</th>", delay.value);
    html += std::string("<details") + (row.number == CellNumber::kTracking ? " open" : "") + "><summary>" +
            std::string(row.title) + " [" + std::string(row.unit) +
            "]</summary>\n<div class=\"scroll\"><table class=\"heat\"><thead>" + head + "</tr></thead><tbody>\n" +
            rows + "</tbody></table></div></details>\n";
  }
  return html;
}

}  // namespace tandem::netsim
