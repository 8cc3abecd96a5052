#include "netsim/score/quality.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"

namespace tandem::netsim::score {
namespace {

constexpr std::uint8_t kReleasing = 4, kLatched = 5, kFault = 6;  // wire::GateState
constexpr double kClipTolerance = 1e-6;                           // [N]

/// Counts ticks of a part without a new sample, and the longest time between two new ones. Ticks before the seat's
/// first sample and after its last one do not count: the participant was not there.
void count_gaps(const PartInput& in, Quality& quality) {
  const LessonGrid& grid = in.grid;
  const LessonSeat& seat = in.lesson.seats[in.seat.seat];
  quality.freshness_known = !seat.fresh.empty();
  const auto has_sample = [&](std::size_t k) {
    return grid.has_row(k) && !seat.x.empty() && known(seat.x[grid.row(k)]);
  };
  std::size_t begin = 0, end = grid.size();
  while (begin < end && !has_sample(begin)) ++begin;
  while (end > begin && !has_sample(end - 1)) --end;
  double expected = 0, missing = 0, gap = 1, since = 1;
  for (std::size_t k = begin; k < end; ++k) {
    if (!in.part.has(k)) {
      since = 1;
      continue;
    }
    if (k > begin && in.part.has(k - 1)) {
      // Rows between two elements are those of a stop. Ticks without rows between two stretches are missing.
      const bool stopped = grid.row(k) > grid.row(k - 1) + 1;
      const double absent = stopped ? 0 : static_cast<double>(grid.tick(k) - grid.tick(k - 1) - 1);
      expected += absent;
      missing += absent;
      since = stopped ? 1 : since + absent;
    }
    const bool fresh = has_sample(k) && (seat.fresh.empty() || seat.fresh[grid.row(k)] != 0);
    expected += 1;
    missing += fresh ? 0 : 1;
    gap = std::max(gap, since);
    since = fresh ? 1 : since + 1;
  }
  quality.expected_s = expected * grid.dt();
  quality.missing_share = expected > 0 ? missing / expected : 0;
  quality.longest_gap_s = std::max(gap, since - 1) * grid.dt();
}

/// Looks at the gate, at the force limit and at the energy account. A gate also releases the hand where that is
/// requested: at a leave, a stop, a pause. Its state does not say which; the client's counter of losses does, and it
/// decides where the lesson has it.
void look_at_gate(const PartInput& in, Quality& quality) {
  const LessonSeat& seat = in.lesson.seats[in.seat.seat];
  const double limit = force_limit_of(in.lesson.scene, in.seat.seat);
  quality.gate_known = !seat.gate.empty();
  const bool losses_counted =
      std::ranges::any_of(in.lesson.links, [&](const LessonLink& link) { return link.seat == in.seat.seat; });
  double rows = 0, clipped = 0;
  std::uint8_t before = 0;
  for (std::size_t k = 0; k < in.grid.size(); ++k) {
    if (!in.grid.has_row(k)) continue;
    const std::size_t r = in.grid.row(k);
    if (quality.gate_known) {
      const std::uint8_t gate = seat.gate[r];
      const auto tripped = [&](std::uint8_t g) {
        return losses_counted ? g == kFault : g == kReleasing || g == kLatched || g == kFault;
      };
      quality.gate_trips += in.part.has(k) && tripped(gate) && !tripped(before) ? 1 : 0;
      before = gate;
    }
    if (!in.part.has(k)) continue;
    rows += 1;
    if (!seat.f_cmd.empty() && length(seat.f_cmd[r]) > limit + kClipTolerance) clipped += 1;
    if (!seat.margin_min_j.empty()) quality.margin_min_j = std::fmin(quality.margin_min_j, seat.margin_min_j[r]);
  }
  quality.clipped_share = rows > 0 ? clipped / rows : 0;
}

void add_doubts(const ScoreOptions& options, double force_limit, Quality& q) {
  using enum MetricGroup;
  const std::vector<MetricGroup> measured{kMotion, kForce, kContact, kTracking, kSharing};
  const auto add = [&](bool withheld, std::vector<MetricGroup> groups, std::string reason) {
    q.doubts.push_back({withheld ? Trust::kWithheld : Trust::kFlagged, std::move(groups), std::move(reason)});
  };
  if (q.missing_share > options.missing_flagged)
    add(q.missing_share > options.missing_withheld, measured,
        format(
            "%.3g %% of the samples are missing (limit %g %%)", 100 * q.missing_share,
            100 * (q.missing_share > options.missing_withheld ? options.missing_withheld : options.missing_flagged)));
  if (q.longest_gap_s > options.gap_flagged_s * (1 + 1e-9))
    add(q.longest_gap_s > options.gap_withheld_s, measured,
        format("the longest gap between two samples is %.4g ms (limit %g ms)", 1e3 * q.longest_gap_s,
               1e3 * (q.longest_gap_s > options.gap_withheld_s ? options.gap_withheld_s : options.gap_flagged_s)));
  if (q.gate_trips > 0)
    add(false, {kForce, kContact, kTracking, kSharing},
        format("the force gate released the hand %u time%s", q.gate_trips, q.gate_trips == 1 ? "" : "s"));
  if (q.clipped_share > 0)
    add(false, {kForce, kTracking},
        format("the force limit of %.3g N cut the force in %.2g %% of the ticks", force_limit, 100 * q.clipped_share));
  if (q.margin_min_j < 0)
    add(false, {kForce, kContact, kTracking, kPassivity},
        format("the energy account was overdrawn by %.3g mJ", -1e3 * q.margin_min_j));
}

}  // namespace

std::string_view to_text(Trust trust) noexcept {
  constexpr std::string_view kNames[] = {"good", "flagged", "withheld", "absent"};
  return kNames[static_cast<std::size_t>(trust)];
}

double force_limit_of(const SceneSpec& scene, std::size_t seat) noexcept {
  const SeatSpec& spec = scene.seats[seat];
  return share_of_force(spec.role) * std::min(scene.gate.force_max, spec.device.force_peak);
}

Quality quality_of(const PartInput& in, double losses) {
  Quality quality;
  count_gaps(in, quality);
  look_at_gate(in, quality);
  if (std::isfinite(losses)) {
    quality.gate_known = true;
    quality.gate_trips += static_cast<std::uint32_t>(losses);
  }
  add_doubts(in.options, force_limit_of(in.lesson.scene, in.seat.seat), quality);
  return quality;
}

MetricTrust trust_in(const Quality& quality, Metric metric, double value) {
  if (!std::isfinite(value)) return {Trust::kAbsent, "the lesson has no data for it"};
  const MetricGroup group = row_of(metric).group;
  MetricTrust out;
  if (metric == Metric::kTime || group == MetricGroup::kLink) return out;
  for (const Doubt& doubt : quality.doubts) {
    if (std::ranges::find(doubt.groups, group) == doubt.groups.end()) continue;
    out.trust = std::max(out.trust, doubt.trust);
    out.reason += (out.reason.empty() ? "" : "; ") + doubt.reason;
  }
  return out;
}

}  // namespace tandem::netsim::score
