#include "netsim/demo/comparison.h"

#include <cmath>
#include <functional>

#include "netsim/demo/comparison_notes.h"
#include "netsim/demo/plot_axes.h"
#include "netsim/plot/ticks.h"

namespace tandem::netsim::demo {

using namespace plot;

namespace {

constexpr Limit kNothing{};
constexpr double kAlignedFrom = 13;  // [s], when the trainee has aligned
Limit at_least(double v) { return {.least = v, .most = std::numeric_limits<double>::infinity()}; }
constexpr Limit at_most(double v) { return {-std::numeric_limits<double>::infinity(), v}; }

using Runs = std::array<const RunResult*, kSettings>;  // of one task; null: missing run
using Reading = std::function<double(const RunResult&)>;
using Limits = std::array<Limit, kSettings>;

/// Returns a number of one seat in one phase, or of the whole run if `phase` is empty.
Reading of_seat(const std::string& phase, bool trainer, double SeatNumbers::* number, double scale) {
  return [=](const RunResult& run) {
    if (phase.empty()) return scale * ((trainer ? run.report.trainer : run.report.trainee).*number);
    const PhaseNumbers* p = run.report.phase(phase);
    return p == nullptr ? kUnknown : scale * ((trainer ? p->trainer : p->trainee).*number);
  };
}
Reading of_joint(const std::string& phase, std::size_t joint) {
  return [=](const RunResult& run) {
    const PhaseNumbers* p = run.report.phase(phase);
    return p == nullptr ? kUnknown : kMilli * p->trainer.joint_rad[joint];
  };
}
Reading of_trace(double TraceNumbers::* number, double scale = 1) {
  return [=](const RunResult& run) { return scale * (run.trace.*number); };
}
Reading of_report(double ReportNumbers::* number, double scale = 1) {
  return [=](const RunResult& run) { return scale * (run.report.*number); };
}

/// Builds the rows of one task and collects footnotes, each text once.
class Builder {
 public:
  Builder(Comparison& out, const Runs& runs) : out_(&out), runs_(runs) {}

  void section(std::string title) { out_->sections.push_back({std::move(title), {}}); }

  struct Wanted {
    std::string label = {}, unit = {};
    double paper = kUnknown;
    int paper_decimals = 1;
    int decimals = 2;
    Limits limits{};
    std::vector<std::string> notes{};
    std::string lacks{};  ///< disturbance that the model lacks; reported if the run with the paper's gains is below
                          ///< half of the paper's number
  };
  void row(const Wanted& wanted, const Reading& read) {
    Row row{wanted.label,
            wanted.unit,
            std::isfinite(wanted.paper) ? number_text(wanted.paper, wanted.paper_decimals) : "",
            "",
            {}};
    for (const std::string& text : wanted.notes) row.notes += letter_of(text);
    for (std::size_t s = 0; s < kSettings; ++s) {
      const double value = runs_[s] == nullptr ? kUnknown : read(*runs_[s]);
      row.cells[s] = cell_of(value, wanted.decimals, wanted.limits[s]);
      out_->missed += row.cells[s].mark == Mark::kMissed ? 1 : 0;
      if (s == 0 && !wanted.lacks.empty() && value < 0.5 * wanted.paper)
        row.notes +=
            letter_of("Our reproduction is below half of the paper’s number: the model lacks " + wanted.lacks + ".");
    }
    out_->sections.back().rows.push_back(std::move(row));
  }
  [[nodiscard]] double value(Setting setting, const Reading& read) const {
    const RunResult* run = runs_[static_cast<std::size_t>(setting)];
    return run == nullptr ? kUnknown : read(*run);
  }

 private:
  std::string letter_of(const std::string& text) {
    std::size_t k = 0;
    while (k < out_->footnotes.size() && out_->footnotes[k] != text) ++k;
    if (k == out_->footnotes.size()) out_->footnotes.push_back(text);
    return {static_cast<char>('a' + k)};
  }

  Comparison* out_;
  Runs runs_;
};

/// Returns the limit of the leader's RMS on the bad network; none if a run is missing.
Limit delayed_limit(const Builder& b, const std::string& phase, bool trainer) {
  const double still = b.value(Setting::kDefaults, of_seat(phase, trainer, &SeatNumbers::tracking_m, kMilli));
  const double lag = b.value(Setting::kBadNetwork, of_seat(phase, trainer, &SeatNumbers::transport_lag_m, kMilli));
  const double limit = 1.25 * (still + lag);
  return std::isfinite(limit) ? at_most(limit) : kNothing;
}

void motion_phase(Builder& b, const std::string& phase, bool trainer_leads, bool paper) {
  b.row({.label = "leader–tool position RMS",
         .unit = "mm",
         .paper = paper ? 8.2 : kUnknown,
         .limits = {at_most(16.4), at_most(2), delayed_limit(b, phase, trainer_leads)},
         .notes = {notes::kDistance, notes::kDelayed},
         .lacks = notes::kLacksArms},
        of_seat(phase, trainer_leads, &SeatNumbers::tracking_m, kMilli));
  b.row({.label = "follower–tool position RMS",
         .unit = "mm",
         .paper = paper ? 6.0 : kUnknown,
         .limits = {at_most(12), at_most(2), kNothing},
         .lacks = notes::kLacksArms},
        of_seat(phase, !trainer_leads, &SeatNumbers::tracking_m, kMilli));
}

void free_motion(Comparison& out, const Runs& runs) {
  Builder b(out, runs);
  b.section("FREE MOTION, demonstration (α = 1, 1–11.5 s): the trainer leads");
  motion_phase(b, "demonstration", true, true);
  const std::array<double, 3> paper{17, 55, kUnknown};
  for (std::size_t j = 0; j < 3; ++j) {
    b.row({.label = "joint " + std::to_string(j + 1) + " RMS, leader–slave",
           .unit = "10⁻³ rad",
           .paper = paper[j],
           .paper_decimals = 0,
           .decimals = 1,
           .limits = {kNothing, j < 2 ? at_most(10) : kNothing, kNothing},
           .notes = {notes::kJoints},
           .lacks = notes::kLacksJoints},
          of_joint("demonstration", j));
  }
  b.section("FREE MOTION, evaluation (α = 0, 12–18 s): the trainee leads");
  motion_phase(b, "evaluation", false, false);
  b.section("FREE MOTION, whole run");
  b.row({.label = "trainer–tool position RMS", .unit = "mm"}, of_seat("", true, &SeatNumbers::tracking_m, kMilli));
  b.row({.label = "trainee–tool position RMS", .unit = "mm"}, of_seat("", false, &SeatNumbers::tracking_m, kMilli));
  b.row({.label = "trainer–tool, constant lag taken out", .unit = "mm"},
        of_seat("", true, &SeatNumbers::lag_removed_m, kMilli));
  b.row({.label = "largest force step as α moves",
         .unit = "N/ms",
         .limits = {kNothing, at_most(0.2), at_most(0.2)},
         .notes = {notes::kAlphaStep}},
        of_trace(&TraceNumbers::force_step_n));
  b.row({.label = "top speed of a hand", .unit = "m/s"}, of_report(&ReportNumbers::speed_peak_m_s));
}

/// Returns the phases of the contact experiment in which forces are judged.
std::vector<PhaseNumbers> judged_phases(const Runs& runs) {
  std::vector<PhaseNumbers> judged;
  for (const RunResult* run : runs) {
    if (run == nullptr || !judged.empty()) continue;
    for (const PhaseNumbers& p : run->report.phases)
      if (std::isfinite(p.trainer.force_error_n)) judged.push_back(p);
  }
  return judged;
}

/// Returns, for example, " Defaults: one spring of 400 N/m lies between the hand and its copy of the tool, ...".
std::string springs_text(const Runs& runs) {
  for (const RunResult* run : runs) {
    if (run == nullptr || run->plan->setting == Setting::kSeed || !std::isfinite(run->springs.series())) continue;
    const Springs& s = run->springs;
    if (std::isinf(s.channel) && std::isinf(s.slave))
      return " Defaults: one spring of " + number_text(s.device, 0) +
             " N/m, the most that a Touch allows at 1 kHz, lies between the hand and its own copy of the tool, at any "
             "delay; the block "
             "of 20 kN/m behind it leaves " +
             number_text(1 / (1 / s.device + 1 / 20000.0), 0) + " N/m.";
    return " Defaults: " + number_text(s.device, 0) + ", " + number_text(s.channel, 0) + " and " +
           number_text(s.slave, 0) + " N/m in series are " + number_text(s.series(), 0) +
           " N/m; two Touch allow at most 200 N/m at 1 kHz; with delay the channel’s spring softens.";
  }
  return "";
}

void forces_along_x(Builder& b, const Runs& runs) {
  b.section("CONTACT with the bone-like block, along x");
  b.row({.label = "rendered stiffness at the working pose",
         .unit = "N/m",
         .paper = 250,
         .paper_decimals = 0,
         .decimals = 1,
         .limits = {Limit{245, 255}, at_least(360), at_least(360)},
         .notes = {notes::kStiffness + springs_text(runs)}},
        of_trace(&TraceNumbers::stiffness_n_m));
  b.row({.label = "held force / depth, 8–11.5 s",
         .unit = "N/m",
         .paper = 250,
         .paper_decimals = 0,
         .decimals = 1,
         .notes = {notes::kHeld}},
        of_trace(&TraceNumbers::stiffness_held_n_m));
  b.row({.label = "force error RMS, leader",
         .unit = "N",
         .paper = 0.35,
         .paper_decimals = 2,
         .decimals = 3,
         .limits = {kNothing, at_most(0.05), at_most(0.05)},
         .notes = {notes::kAlongX},
         .lacks = notes::kLacksMotors},
        of_trace(&TraceNumbers::force_x_leader_n));
  b.row({.label = "  of the peak force", .unit = "%", .paper = 3.5}, of_trace(&TraceNumbers::force_x_leader_percent));
  b.row({.label = "force error RMS, follower",
         .unit = "N",
         .paper = 0.20,
         .paper_decimals = 2,
         .decimals = 3,
         .limits = {kNothing, at_most(0.05), at_most(0.05)},
         .lacks = notes::kLacksMotors},
        of_trace(&TraceNumbers::force_x_follower_n));
  b.row({.label = "  of the peak force", .unit = "%", .paper = 2.0}, of_trace(&TraceNumbers::force_x_follower_percent));
  b.row({.label = "follower aligned with leader, RMS",
         .unit = "mm",
         .paper = 2.0,
         .limits = {kNothing, at_most(0.5), kNothing},
         .notes = {notes::kAligned},
         .lacks = notes::kLacksPerson},
        of_trace(&TraceNumbers::aligned_x_m, kMilli));
}

void contact(Comparison& out, const Runs& runs) {
  Builder b(out, runs);
  forces_along_x(b, runs);
  b.section("CONTACT, per phase, all axes, RMS");
  const auto error_of = [](const std::string& phase, bool trainer) -> Reading {
    const Reading delivered = of_seat(phase, trainer, &SeatNumbers::force_error_n, 1);
    const Reading commanded = of_seat(phase, trainer, &SeatNumbers::force_error_commanded_n, 1);
    return [=](const RunResult& run) { return (run.plan->setting == Setting::kSeed ? commanded : delivered)(run); };
  };
  b.row({.label = "trainer–tool, demonstration", .unit = "mm", .notes = {notes::kApart}},
        of_seat("demonstration", true, &SeatNumbers::tracking_m, kMilli));
  b.row({.label = "trainee–tool, demonstration", .unit = "mm"},
        of_seat("demonstration", false, &SeatNumbers::tracking_m, kMilli));
  for (const PhaseNumbers& phase : judged_phases(runs)) {
    b.row({.label = "leader force error, " + phase.name,
           .unit = "N",
           .decimals = 3,
           .limits = {kNothing, at_most(0.05), kNothing},
           .notes = {notes::kAllAxes}},
          error_of(phase.name, true));
    // Before the trainee has aligned, the trainee's hand presses on nothing.
    if (phase.from_s < kAlignedFrom) continue;
    b.row({.label = "follower force error, " + phase.name,
           .unit = "N",
           .decimals = 3,
           .limits = {kNothing, at_most(0.05), kNothing}},
          error_of(phase.name, false));
  }
  b.row({.label = "force of the block on the tool", .unit = "N"}, of_report(&ReportNumbers::contact_force_n));
}

/// Adds rows about the network and the machine; they are not judged.
void circumstances(Comparison& out, const Runs& runs, const std::string& task) {
  Builder b(out, runs);
  b.section(task + ", network and machine");
  b.row({.label = "round trip, median", .unit = "ms", .decimals = 1},
        [](const RunResult& r) { return r.report.trainer_link.rtt_p50_ms; });
  b.row({.label = "round trip, 99 %", .unit = "ms", .decimals = 1},
        [](const RunResult& r) { return r.report.trainer_link.rtt_p99_ms; });
  b.row({.label = "datagrams lost, up and down", .unit = "%"}, [](const RunResult& r) {
    return (r.report.trainer_link.loss_up_percent + r.report.trainer_link.loss_down_percent +
            r.report.trainee_link.loss_up_percent + r.report.trainee_link.loss_down_percent) /
           4;
  });
  b.row({.label = "gate trips, both hands", .unit = "", .decimals = 0}, of_report(&ReportNumbers::gate_trips));
  b.row({.label = "ticks more than 1 ms late", .unit = "", .decimals = 0, .notes = {notes::kMachine}},
        of_report(&ReportNumbers::late_ticks));
  b.row({.label = "broken invariants (promised ones)",
         .unit = "",
         .decimals = 0,
         .limits = {at_most(0), at_most(0), at_most(0)}},
        [](const RunResult& r) {
          double broken = 0;
          for (const ViolationNumbers& v : r.report.violations) broken += v.expected ? 0 : 1;
          return broken;
        });
}

/// Returns three significant digits without zeros at the end of the decimals: 2, 16.4, 0.2.
std::string short_text(double value) {
  std::string text = significant_text(value, 3);
  if (text.find('.') == std::string::npos) return text;
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

Cell cell_of(double value, int decimals, const Limit& limit) {
  Cell cell{number_text(value, decimals), "", Mark::kNone};
  if (!limit.asked() || !std::isfinite(value)) return cell;
  if (std::isfinite(limit.least) && !std::isfinite(limit.most)) {
    cell.limit = "≥ " + short_text(limit.least);
  } else if (std::isfinite(limit.least)) {
    const double middle = (limit.least + limit.most) / 2;
    cell.limit = short_text(middle) + " ± " + short_text(100 * (limit.most - middle) / middle) + " %";
  } else {
    cell.limit = "≤ " + short_text(limit.most);
  }
  cell.mark = value >= limit.least && value <= limit.most ? Mark::kMet : Mark::kMissed;
  return cell;
}

Comparison compare(std::span<const RunResult> runs) {
  Comparison out;
  for (const Task task : {Task::kFreeMotion, Task::kContact}) {
    Runs of_task{};
    bool any = false;
    for (const RunResult& run : runs)
      if (run.plan->task == task) {
        of_task[static_cast<std::size_t>(run.plan->setting)] = &run;
        any = true;
      }
    if (!any) continue;
    task == Task::kFreeMotion ? free_motion(out, of_task) : contact(out, of_task);
    circumstances(out, of_task, task == Task::kFreeMotion ? "FREE MOTION" : "CONTACT");
  }
  return out;
}

}  // namespace tandem::netsim::demo
