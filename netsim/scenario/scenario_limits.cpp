#include "netsim/scenario/scenario_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "netsim/feel/observed_feel.h"

namespace tandem::netsim {
namespace {

using server::RunReport;
using server::SeatMetrics;
using server::SeatReport;
using server::ToolReport;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A metric of the whole run or of one phase.
struct PhaseMetric {
  std::string_view name;
  bool needs_contact;
  double (*of)(const SeatMetrics&);
};
constexpr std::array<PhaseMetric, 10> kPhaseMetrics{{
    {"tracking_rms_m", false, [](const SeatMetrics& m) { return m.tracking_rms_m; }},
    {"tracking_rms_lag_removed_m", false, [](const SeatMetrics& m) { return m.tracking_rms_lag_removed_m; }},
    {"transport_lag_rms_m", false, [](const SeatMetrics& m) { return m.transport_lag_rms_m; }},
    {"joint_rms_rad", false,
     [](const SeatMetrics& m) {
       double worst = m.joint_rms_rad.empty() ? kNaN : 0;
       for (const double q : m.joint_rms_rad) worst = std::isnan(q) ? kNaN : std::max(worst, q);
       return worst;
     }},
    {"force_error_rms_n", true, [](const SeatMetrics& m) { return m.force_error_rms_n; }},
    {"force_error_commanded_rms_n", true, [](const SeatMetrics& m) { return m.force_error_commanded_rms_n; }},
    {"force_error_percent", true, [](const SeatMetrics& m) { return m.force_error_percent; }},
    {"effort_peak_n", false, [](const SeatMetrics& m) { return m.effort_peak_n; }},
    {"speed_peak_m_s", false, [](const SeatMetrics& m) { return m.speed_peak_m_s; }},
    {"leader_offset_rms_m", false, [](const SeatMetrics& m) { return m.leader_offset_rms_m; }},
}};

struct SeatMetric {
  std::string_view name;
  double (*of)(const SeatReport&);
};
constexpr std::array<SeatMetric, 13> kSeatMetrics{{
    {"alpha_mean", [](const SeatReport& s) { return s.alpha_mean; }},
    {"gate_trips", [](const SeatReport& s) { return static_cast<double>(s.gate_trips); }},
    {"engaged_at_end", [](const SeatReport& s) { return s.last.engaged ? 1.0 : 0.0; }},
    {"refused_j", [](const SeatReport& s) { return s.last.refused_j; }},
    {"margin_min_j", [](const SeatReport& s) { return s.last.margin_min_j; }},
    {"rtt_p50_ms", [](const SeatReport& s) { return s.link.rtt_p50_ms; }},
    {"rtt_p99_ms", [](const SeatReport& s) { return s.link.rtt_p99_ms; }},
    {"up_loss_percent", [](const SeatReport& s) { return s.link.up.loss_percent; }},
    {"up_longest_gap_ms", [](const SeatReport& s) { return s.link.up.longest_gap_ms; }},
    {"up_age_p99_ms", [](const SeatReport& s) { return s.link.up.age_p99_ms; }},
    {"down_loss_percent", [](const SeatReport& s) { return s.link.down.loss_percent; }},
    {"down_longest_gap_ms", [](const SeatReport& s) { return s.link.down.longest_gap_ms; }},
    {"down_age_p99_ms", [](const SeatReport& s) { return s.link.down.age_p99_ms; }},
}};

struct ToolMetric {
  std::string_view name;
  double (*of)(const ToolReport&);
};
constexpr std::array<ToolMetric, 3> kToolMetrics{{
    {"contact_force_rms_n", [](const ToolReport& t) { return t.contact_force_rms_n; }},
    {"penetration_max_m", [](const ToolReport& t) { return t.penetration_max_m; }},
    {"held_s", [](const ToolReport& t) { return t.held_s; }},
}};

template <typename Table>
auto find(const Table& table, std::string_view name) {
  const auto it = std::ranges::find_if(table, [&](const auto& m) { return m.name == name; });
  return it == table.end() ? nullptr : &*it;
}

}  // namespace

std::optional<MetricTraits> known_metric(Limit::Of of, std::string_view metric) {
  switch (of) {
    case Limit::Of::kSeat:
      if (const auto* m = find(kPhaseMetrics, metric)) return MetricTraits{true, m->needs_contact};
      if (find(kSeatMetrics, metric) != nullptr) return MetricTraits{};
      break;
    case Limit::Of::kTool:
      if (find(kToolMetrics, metric) != nullptr) return MetricTraits{};
      break;
    case Limit::Of::kSession:
      if (metric == "duration_s") return MetricTraits{};
      break;
    case Limit::Of::kFeel:
      if (std::ranges::find(ObservedFeel::keys(), metric) != ObservedFeel::keys().end()) return MetricTraits{};
  }
  return {};
}

double value_of(const Limit& limit, const RunReport& report) {
  switch (limit.of) {
    case Limit::Of::kSeat:
      if (limit.index >= report.seats.size()) return kNaN;
      if (const auto* m = find(kSeatMetrics, limit.metric)) return m->of(report.seats[limit.index]);
      if (const auto* m = find(kPhaseMetrics, limit.metric)) {
        if (!limit.phase) return m->of(report.seats[limit.index].metrics);
        if (*limit.phase < report.phases.size()) return m->of(report.phases[*limit.phase].seats[limit.index]);
      }
      return kNaN;
    case Limit::Of::kTool:
      if (const auto* m = find(kToolMetrics, limit.metric); m != nullptr && limit.index < report.tools.size())
        return m->of(report.tools[limit.index]);
      return kNaN;
    case Limit::Of::kSession:
      return report.duration_s;
    case Limit::Of::kFeel:
      for (const auto& [key, value] : report.feel)
        if (key == limit.metric) return value;
  }
  return kNaN;
}

double slack(const Limit& limit, double value) noexcept {
  if (std::isnan(value)) return -std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  if (limit.max) least = std::min(least, *limit.max - value);
  if (limit.min) least = std::min(least, value - *limit.min);
  return least;
}

bool holds(const Limit& limit, double value) noexcept {
  return !std::isnan(value) && (!limit.max || value <= *limit.max) && (!limit.min || value >= *limit.min);
}

double margin_percent(const Limit& limit, double value) noexcept {
  const double least = slack(limit, value);
  const double end = limit.max && *limit.max - value == least ? *limit.max : limit.min.value_or(0);
  return end == 0 || !std::isfinite(least) ? kNaN : 100 * least / std::abs(end);
}

std::string short_number(double value) {
  if (std::isnan(value)) return "none";
  std::array<char, 32> text;
  const bool large = std::abs(value) >= 1e5 && std::abs(value) < 1e15;
  std::snprintf(text.data(), text.size(), large ? "%.0f" : "%.5g", value);
  return text.data();
}

std::string range_text(const Limit& limit) {
  const std::string unit = limit.unit.empty() ? "" : " " + limit.unit;
  if (limit.min && limit.max && *limit.min == *limit.max) return "exactly " + short_number(*limit.min) + unit;
  if (limit.min && limit.max) return short_number(*limit.min) + " to " + short_number(*limit.max) + unit;
  if (limit.min) return "at least " + short_number(*limit.min) + unit;
  return "at most " + short_number(limit.max.value_or(0)) + unit;
}

}  // namespace tandem::netsim
