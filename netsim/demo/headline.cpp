#include "netsim/demo/headline.h"

#include <algorithm>
#include <cmath>

#include "netsim/plot/ticks.h"

namespace tandem::netsim::demo {
namespace {

constexpr double kPaperTracking = 8.2, kPaperForce = 0.35;  ///< [mm], [N] [Licona et al. 2019, section 5]

const RunResult* find(std::span<const RunResult> runs, Task task, Setting setting) {
  const auto found = std::ranges::find_if(
      runs, [&](const RunResult& run) { return run.plan->task == task && run.plan->setting == setting; });
  return found == runs.end() ? nullptr : &*found;
}

double tracking_mm(const RunResult& run) {
  const PhaseNumbers* phase = run.report.phase("demonstration");
  return phase == nullptr ? kUnknown : 1e3 * phase->trainer.tracking_m;
}
double force_error_n(const RunResult& run) { return run.trace.force_x_leader_n; }

/// Adds the number of the defaults, or of the bad network if only that run exists.
void add(std::vector<KeyNumber>& numbers, std::span<const RunResult> runs, Task task, double (*read)(const RunResult&),
         double paper, const char* unit, const char* what) {
  const RunResult* defaults = find(runs, task, Setting::kDefaults);
  const RunResult* bad = find(runs, task, Setting::kBadNetwork);
  const RunResult* shown = defaults != nullptr ? defaults : bad;
  if (shown == nullptr || !std::isfinite(read(*shown))) return;
  const auto text = [&](double value) { return plot::significant_text(value, 2) + " " + unit; };
  std::string beside = "paper " + text(paper);
  if (defaults != nullptr && bad != nullptr && std::isfinite(read(*bad)))
    beside += "; on the bad network " + text(read(*bad));
  if (defaults == nullptr) beside += "; on the bad network";
  numbers.push_back({text(read(*shown)), what, beside});
}

}  // namespace

std::string_view name_of(Setting setting) noexcept {
  constexpr std::array<std::string_view, kSettings> kNames{"the paper’s gains", "defaults", "bad network"};
  return kNames[static_cast<std::size_t>(setting)];
}

Disturbance disturbance_of(std::span<const RunResult> runs) {
  constexpr double kTickHz = 1000, kLoops = 3;  // the loops of the server and of two clients
  const auto known = [](double value) { return std::isfinite(value) ? value : 0; };
  Disturbance all;
  for (const RunResult& run : runs) {
    all.gate_trips += known(run.report.gate_trips);
    all.late_ticks += known(run.report.late_ticks);
    all.ticks += kLoops * kTickHz * known(run.report.duration_s);
  }
  return all;
}

std::string disturbance_text(const Disturbance& disturbance) {
  if (!disturbance.found()) return {};
  const auto count = [](double n, const std::string& one) {
    return plot::number_text(n, 0) + " " + one + (n == 1 ? "" : "s");
  };
  std::string text =
      "DISTURBED: " + count(disturbance.gate_trips, "gate trip") + ", " + count(disturbance.late_ticks, "late tick");
  if (disturbance.ticks > 0)
    text += " of " + plot::number_text(disturbance.ticks, 0) + " (" +
            (disturbance.late_ticks > 0 ? plot::significant_text(100 * disturbance.late_ticks / disturbance.ticks, 2)
                                        : "0") +
            " %; undisturbed: at most " +
            plot::number_text(std::floor(Disturbance::kLateShareMax * disturbance.ticks), 0) + ")";
  text += disturbance.heavy()
              ? ". The machine was too busy, so the numbers judge the machine rather than Tandem."
              : ". Late ticks make errors larger, and these are few: kept limits hold, but a missed limit "
                "can be due to the machine.";
  return text + " Repeat the demo on an idle machine, or use --quick, whose virtual time has no late ticks.";
}

Headline headline_of(std::span<const RunResult> runs, const Comparison& comparison) {
  const Disturbance disturbance = disturbance_of(runs);
  Headline headline{.sentence = {}, .disturbed = disturbance_text(disturbance), .missed = {}, .numbers = {}};
  std::size_t asked = 0;
  for (const Section& section : comparison.sections)
    for (const Row& row : section.rows)
      for (std::size_t s = 0; s < kSettings; ++s) {
        const Cell& cell = row.cells[s];
        if (cell.mark == Mark::kNone) continue;
        ++asked;
        if (cell.mark == Mark::kMissed)
          headline.missed.push_back(row.label + ", " + std::string(name_of(static_cast<Setting>(s))) + ": " +
                                    cell.value + " " + row.unit + ", asked " + cell.limit);
      }
  const bool network =
      std::ranges::any_of(runs, [](const RunResult& run) { return run.plan->setting == Setting::kBadNetwork; });
  headline.sentence = std::string("Two people held one tool") + (network ? ", also over a bad network" : "") + ". ";
  if (asked == 0) {
    headline.sentence += "Nothing was asked of these runs.";
  } else if (headline.missed.empty()) {
    headline.sentence += "All " + std::to_string(asked) + " limits were kept";
    headline.sentence +=
        disturbance.heavy() ? ", but the runs were disturbed too much for that to prove anything." : ".";
  } else {
    headline.sentence += std::to_string(headline.missed.size()) + " of " + std::to_string(asked) + " limits " +
                         (headline.missed.size() == 1 ? "was" : "were") + " missed.";
  }
  add(headline.numbers, runs, Task::kFreeMotion, tracking_mm, kPaperTracking, "mm",
      "between the leader’s hand and the tool in free motion (RMS)");
  add(headline.numbers, runs, Task::kContact, force_error_n, kPaperForce, "N",
      "between the force at the wall and the force the leader feels (RMS)");
  return headline;
}

}  // namespace tandem::netsim::demo
