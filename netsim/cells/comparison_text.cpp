#include <algorithm>
#include <cmath>

#include "common/base/format.h"
#include "netsim/cells/comparison_result.h"

/// A comparison as text and CSV.
namespace tandem::netsim {
namespace {

constexpr std::size_t kExceptionsShown = 10;

/// Sums over the cells of one law and coupling.
struct LawSum {
  std::string law;
  std::size_t cells = 0, unsound = 0;
  double unstable = 0;  ///< share of the seeds, summed over cells
};

std::vector<LawSum> sums_of(const ComparisonResult& c) {
  std::vector<LawSum> sums;
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    if (!c.results[i]) continue;
    const std::string law = law_text(c.cells[i]);
    auto sum = std::ranges::find(sums, law, &LawSum::law);
    if (sum == sums.end()) sum = sums.insert(sums.end(), {.law = law});
    ++sum->cells;
    sum->unsound += c.results[i]->sound() ? 0 : 1;
    const double unstable = c.of(i, CellNumber::kUnstable).median;
    sum->unstable += std::isnan(unstable) ? 0 : unstable;
  }
  return sums;
}

std::string csv_number(double v) { return std::isfinite(v) ? format("%.9g", v) : std::string(); }

/// Returns `trouble` and the invariants that some run broke, without repetition.
std::string flaws_of(const CellResult& result) {
  std::vector<std::string> flaws;
  const auto add = [&](const std::string& flaw) {
    if (!flaw.empty() && std::ranges::find(flaws, flaw) == flaws.end()) flaws.push_back(flaw);
  };
  for (const CellRun& run : result.runs) {
    for (const std::string& invariant : run.broken) add("invariant " + invariant + " broken");
    add(run.trouble);
  }
  std::string text;
  for (const std::string& flaw : flaws) text += (text.empty() ? "" : "; ") + flaw;
  return text;
}

}  // namespace

std::string comparison_text(const ComparisonResult& c) {
  std::string out = c.spec.name + ": " + std::to_string(c.finished()) + " of " + std::to_string(c.cells.size()) +
                    " cells, each with " + std::to_string(c.spec.seeds) +
                    (c.spec.seeds == 1 ? " seed\n\n" : " seeds\n\n");
  out += format("  %-34s %7s %12s %10s\n", "law, coupling", "cells", "unstable", "unsound");
  for (const LawSum& sum : sums_of(c))
    out += format("  %-34s %7zu %10.1f %% %10zu\n", sum.law.c_str(), sum.cells,
                  100 * sum.unstable / static_cast<double>(sum.cells), sum.unsound);
  out += "\nunstable: share of all seeds; unsound: a session did not run, or broke what its law promises\n";
  for (const DefaultVerdict& verdict : judge_default(c)) {
    if (verdict.compared == 0) continue;
    const CellNumberRow& row = row_of(verdict.number);
    out += format("\n%s: the default is best or within 10 %% in %zu of %zu conditions\n",
                  std::string(row.title).c_str(), verdict.compared - verdict.exceptions.size(), verdict.compared);
    std::size_t shown = 0;
    for (const DefaultVerdict::Exception& e : verdict.exceptions) {
      if (++shown > kExceptionsShown) continue;
      const Cell& own = c.cells[e.own];
      out += format("  %s, %.9g ms: %s %s, %s has %s\n", condition_text(own).c_str(), own.delay_ms,
                    report_text(row, e.own_value).c_str(), std::string(row.unit).c_str(),
                    law_text(c.cells[e.best]).c_str(), report_text(row, e.best_value).c_str());
    }
    if (shown > kExceptionsShown) out += format("  and %zu more; --html lists all\n", shown - kExceptionsShown);
  }
  return out;
}

std::string cell_text(const ComparisonResult& c, std::size_t index) {
  const Cell& cell = c.cells[index];
  std::string out = format("%s, cell %zu: ", c.spec.name.c_str(), cell.number) + law_text(cell) + ", " +
                    condition_text(cell) +
                    format(", %.9g ms each way, %u seeds\n\n", cell.delay_ms, static_cast<unsigned>(c.spec.seeds)) +
                    format("  %-22s %10s %10s\n", "", "median", "worst");
  for (const CellNumberRow& row : kCellNumbers) {
    const CellResult::Summary sum = c.of(index, row.number);
    if (std::isnan(sum.median)) continue;
    out +=
        format("  %-22s %10s %10s %-4s", std::string(row.title).c_str(), report_text(row, sum.median).c_str(),
               report_text(row, sum.worst).c_str(), std::string(row.unit).c_str()) +
        (row.number == CellNumber::kUnstable ? ""
                                             : format("  seed %llu", static_cast<unsigned long long>(sum.worst_seed))) +
        "\n";
  }
  if (c.results[index] && !c.results[index]->sound()) out += "\n" + flaws_of(*c.results[index]) + "\n";
  return out;
}

std::string comparison_csv(const ComparisonResult& c) {
  std::string out = "cell[1],grid,law,coupling,hands[1],delay[ms],jitter[ms],loss[%],outage[ms],task,alpha,seeds[1]";
  for (const CellNumberRow& row : kCellNumbers) {
    const std::string key{row.key}, unit = "[" + std::string(row.si_unit) + "]";
    out += row.number == CellNumber::kUnstable
               ? "," + key + unit
               : "," + key + "_median" + unit + "," + key + "_worst" + unit + "," + key + "_worst_seed[1]";
  }
  out += ",sound[1],command\n";
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    if (!c.results[i]) continue;
    const Cell& cell = c.cells[i];
    out += std::to_string(cell.number) + "," + c.spec.grids[cell.grid].name + "," + std::string(law_name_of(cell)) +
           "," + std::string(coupling_name_of(cell)) + "," + std::to_string(cell.hands) +
           format(",%.9g,%.9g,%.9g,%.9g,", cell.delay_ms, cell.jitter_ms, cell.loss_percent, cell.outage_ms) +
           std::string(to_text(cell.task)) + "," + std::string(to_text(cell.alpha)) + "," +
           std::to_string(c.spec.seeds);
    for (const CellNumberRow& row : kCellNumbers) {
      const CellResult::Summary sum = c.of(i, row.number);
      out += "," + csv_number(sum.median);
      if (row.number == CellNumber::kUnstable) continue;
      out += "," + csv_number(sum.worst) + "," + (std::isnan(sum.worst) ? "" : std::to_string(sum.worst_seed));
    }
    out += std::string(",") + (c.results[i]->sound() ? "1" : "0") + "," + repeat_command(c.typed, cell.number) + "\n";
  }
  return out;
}

}  // namespace tandem::netsim
