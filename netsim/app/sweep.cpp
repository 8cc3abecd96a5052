#include "netsim/app/sweep.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "common/base/format.h"
#include "common/base/milliseconds.h"
#include "common/base/suggestions.h"
#include "common/base/unit_suffix.h"

namespace tandem::netsim {
namespace {

using State = SeedOutcome::State;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Metrics for suggestions; known_metric decides.
const std::vector<std::string> kMetrics{"tracking_rms_m",      "tracking_rms_lag_removed_m",
                                        "transport_lag_rms_m", "joint_rms_rad",
                                        "force_error_rms_n",   "force_error_percent",
                                        "effort_peak_n",       "speed_peak_m_s",
                                        "leader_offset_rms_m", "gate_trips",
                                        "engaged_at_end",      "refused_j",
                                        "margin_min_j",        "rtt_p50_ms",
                                        "rtt_p99_ms",          "contact_force_rms_n",
                                        "penetration_max_m",   "held_s"};

/// Returns whether the smallest value of this metric is the worst.
bool least_is_worst(std::string_view metric) { return metric == "margin_min_j" || metric == "engaged_at_end"; }

std::string unit_of(std::string_view metric) {
  for (const auto& [end, unit] : {std::pair{"_percent", "%"},
                                  {"_m_s", "m/s"},
                                  {"_rad", "rad"},
                                  {"_ms", "ms"},
                                  {"_m", "m"},
                                  {"_n", "N"},
                                  {"_j", "J"},
                                  {"_s", "s"}})
    if (metric.ends_with(end)) return unit;
  return "1";
}

/// Returns the value of the worst seat or tool of one seed; NaN if one of them has no number.
double value_of_seed(const SeedOutcome& outcome, bool least) {
  double worst = kNaN;
  for (const double value : outcome.values) {
    if (std::isnan(value)) return kNaN;
    if (std::isnan(worst) || (least ? value < worst : value > worst)) worst = value;
  }
  return worst;
}

SweepPoint judged(SweepPoint point, const ScenarioResult& r, bool least) {
  std::vector<double> values;
  point.worst = kNaN;
  for (const SeedOutcome& s : r.seeds) {
    point.complete = point.complete && s.state != State::kNotRun;
    point.trouble = point.trouble || s.state == State::kTrouble || s.state == State::kCrash;
    point.broken = point.broken || std::ranges::any_of(s.violations, [](const auto& v) { return !v.expected; });
    const double value = value_of_seed(s, least);
    if (s.state == State::kNotRun || std::isnan(value)) continue;
    values.push_back(value);
    if (!std::isnan(point.worst) && (least ? value >= point.worst : value <= point.worst)) continue;
    point.worst = value;
    point.worst_seed = s.seed;
  }
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  point.median = values.empty()           ? kNaN
                 : values.size() % 2 == 1 ? values[half]
                                          : 0.5 * (values[half - 1] + values[half]);
  return point;
}

/// Returns whether the map shows millimetres.
bool in_mm(const std::string& unit) { return unit == "m"; }

std::string cell(const SweepPoint& p, bool mm) {
  std::string text = p.complete && std::isfinite(p.worst) ? format("%.4g", p.worst * (mm ? 1e3 : 1))
                                                          : std::string(p.complete ? "none" : "-");
  if (p.trouble) text = "T";
  return text + (p.broken ? "!" : " ");
}

}  // namespace

std::string Sweep::unit() const { return unit_of(spec.metric); }

double Sweep::value_of(const SeedOutcome& outcome) const { return value_of_seed(outcome, least_is_worst(spec.metric)); }

std::string Sweep::replay(const SweepPoint& p, std::uint64_t seed) const {
  return format("tandem-netsim run %s --delay %g --jitter %g --loss %g --seed %llu%s%s --trace out.csv",
                spec.scene_name.c_str(), p.delay_ms, p.jitter_ms, p.loss_percent, static_cast<unsigned long long>(seed),
                spec.options.empty() ? "" : " ", spec.options.c_str());
}

bool Sweep::good() const noexcept {
  return std::ranges::all_of(points, [](const SweepPoint& p) { return p.complete && !p.broken && !p.trouble; });
}

std::expected<std::vector<double>, std::string> parse_axis(std::string_view text, double lo, double hi,
                                                           std::string_view unit) {
  const std::string allowed = "must be numbers in [" + short_number(lo) + ", " + short_number(hi) + "] " +
                              std::string(unit) + " with commas between, such as 0,5,20";
  std::vector<double> values;
  const auto wrong = [&](std::string_view word, const std::string& why) {
    return std::unexpected("\"" + std::string(word.substr(0, 40)) + "\" " + why + ": " + allowed);
  };
  for (;;) {
    const auto comma = text.find(',');
    const std::string_view word = text.substr(0, comma);
    double value = 0;
    const std::string_view bare = strip_unit(word, unit);
    const auto [end, error] = std::from_chars(bare.data(), bare.data() + bare.size(), value);
    if (error != std::errc{} || end != bare.data() + bare.size() || !std::isfinite(value))
      return wrong(word, "is not a number");
    if (value < lo || value > hi) return wrong(word, "is out of range");
    if (std::ranges::find(values, value) != values.end()) return wrong(word, "is there twice");
    values.push_back(value);
    if (values.size() > kSweepAxisMax)
      return wrong(word, "is one too many: at most " + std::to_string(kSweepAxisMax) + " values");
    if (comma == std::string_view::npos) return values;
    text.remove_prefix(comma + 1);
  }
}

std::expected<Limit::Of, std::string> sweep_metric(std::string_view metric) {
  for (const Limit::Of of : {Limit::Of::kSeat, Limit::Of::kTool})
    if (known_metric(of, metric)) return of;
  return std::unexpected("\"" + std::string(metric) + "\" is no number of a report; " + suggest(metric, kMetrics));
}

Sweep run_sweep(SweepSpec spec, const TestOptions& options) {
  Sweep sweep;
  sweep.of = sweep_metric(spec.metric).value_or(Limit::Of::kSeat);
  const bool seats = sweep.of == Limit::Of::kSeat;
  Scenario base;
  base.scene = spec.scene_name;
  base.setup.scene = spec.scene;
  const std::size_t count = seats ? spec.scene.masters() : spec.scene.tools.size();
  for (std::size_t i = 0; i < count; ++i)
    base.limits.push_back({.of = sweep.of,
                           .index = i,
                           .phase = {},
                           .metric = spec.metric,
                           .subject = seats ? spec.scene.seats[i].name : spec.scene.tools[i].name,
                           .unit = unit_of(spec.metric),
                           .min = {},
                           .max = {}});
  std::vector<Scenario> scenarios;
  std::vector<SweepPoint> grid;
  for (const double jitter : spec.jitters_ms)
    for (const double delay : spec.delays_ms)
      for (const double loss : spec.losses_percent) {
        grid.push_back({.delay_ms = delay, .jitter_ms = jitter, .loss_percent = loss});
        base.setup.network = link_from({.delay = from_milliseconds(delay),
                                        .jitter = from_milliseconds(jitter),
                                        .loss = loss / 100,
                                        .duplicate = 0,
                                        .reorder = 0,
                                        .outages = {}});
        scenarios.push_back(base);
      }
  sweep.runs = run_tests(std::move(scenarios), options);
  for (std::size_t i = 0; i < grid.size(); ++i)
    sweep.points.push_back(judged(grid[i], sweep.runs.scenarios[i], least_is_worst(spec.metric)));
  sweep.spec = std::move(spec);
  return sweep;
}

std::string sweep_map(const Sweep& sweep) {
  const SweepSpec& spec = sweep.spec;
  const std::string unit = sweep.unit();
  const bool mm = in_mm(unit);
  const std::size_t seeds = sweep.runs.scenarios.empty() ? 0 : sweep.runs.scenarios.front().seeds.size();
  std::string out = spec.scene_name + ": worst " + spec.metric + " of any " +
                    (sweep.of == Limit::Of::kSeat ? "seat" : "tool") + " [" + (mm ? "mm" : unit) + "], " +
                    std::to_string(seeds) + (seeds == 1 ? " seed" : " seeds") +
                    " per point\n! an invariant is broken, T could not run, none: no such number, - not run\n";
  std::size_t at = 0;
  for (const double jitter : spec.jitters_ms) {
    out += "\n";
    if (spec.jitters_ms.size() > 1 || jitter > 0) out += "jitter 0 to " + short_number(jitter) + " ms\n";
    out += "  delay [ms]  loss";
    for (const double loss : spec.losses_percent) out += format("%9s %%", short_number(loss).c_str());
    out += "\n";
    for (const double delay : spec.delays_ms) {
      out += format("  %10s      ", short_number(delay).c_str());
      for (std::size_t k = 0; k < spec.losses_percent.size(); ++k)
        out += format("%11s", cell(sweep.points[at++], mm).c_str());
      while (out.back() == ' ') out.pop_back();
      out += "\n";
    }
  }
  const auto alike = [](const ScenarioResult& r) {
    return !r.seeds.front().trace_hash.empty() && std::ranges::all_of(r.seeds, [&](const SeedOutcome& s) {
      return s.trace_hash == r.seeds.front().trace_hash;
    });
  };
  if (seeds > 1 && std::ranges::all_of(sweep.runs.scenarios, alike))
    out += "\nnote: the seeds are identical: nothing here is random, so all " + std::to_string(seeds) +
           " of each point gave the same run\n";
  std::size_t shown = 0;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const ScenarioResult& r = sweep.runs.scenarios[i];
    for (const SeedOutcome& s : r.seeds) {
      const auto broken = std::ranges::find_if(s.violations, [](const auto& v) { return !v.expected; });
      if (broken == s.violations.end() && s.trouble.empty()) continue;
      if (++shown > 5) continue;
      out += "\n" +
             (s.trouble.empty()
                  ? "invariant " + broken->invariant + " broken" + (broken->seat.empty() ? "" : " at " + broken->seat)
                  : s.trouble) +
             "\n  replay: " + sweep.replay(sweep.points[i], s.seed) + "\n";
    }
  }
  if (shown > 5) out += "\nand " + std::to_string(shown - 5) + " more seeds; --json names all of them\n";
  return out;
}

std::string sweep_csv(const Sweep& sweep) {
  const std::string unit = sweep.unit();
  std::string out =
      "delay[ms],jitter[ms],loss[%],worst[" + unit + "],median[" + unit + "],worst_seed[1],broken[1],trouble[1]\n";
  for (const SweepPoint& p : sweep.points) {
    const auto value = [](double v) { return std::isfinite(v) ? format("%.9g", v) : std::string(); };
    out += format("%.9g,%.9g,%.9g,", p.delay_ms, p.jitter_ms, p.loss_percent) + value(p.worst) + "," + value(p.median) +
           "," + (std::isfinite(p.worst) ? std::to_string(p.worst_seed) : "") + "," + (p.broken ? "1" : "0") + "," +
           (p.trouble ? "1" : "0") + "\n";
  }
  return out;
}

}  // namespace tandem::netsim
