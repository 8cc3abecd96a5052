#include <algorithm>
#include <cmath>

#include "netsim/score/part_scores.h"
#include "netsim/score/transparency.h"

/// Metrics of tracking, sharing, passivity and link.
namespace tandem::netsim::score {
namespace {

constexpr double kRest = 0.5;                               // [s] at rest before drift counts
constexpr double kAroundChange = 0.050;                     // [s] before and after a change of authority
constexpr double kDepthSpan = 0.0005;                       // [m] smallest range of depths for a stiffness
constexpr std::size_t kDepthSamples = 50;                   // fewest samples for a stiffness
constexpr std::size_t kCoarseStride = 16, kFineStride = 4;  // of samples in the search for the delay
constexpr double kCoarseLag = 0.010;                        // [s]

/// RMS distance between the hand and the tool `lag` elements later, over elements of the part.
double rms_at_lag(const PartInput& in, std::size_t lag, std::size_t stride) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k + lag < in.grid.size(); k += stride) {
    if (!in.part.has(k) || in.grid.tick(k + lag) - in.grid.tick(k) != lag) continue;
    const LessonTriple d = minus(in.seat.x_raw[k], in.tool.x[k + lag]);
    const double square = dot(d, d);
    if (!std::isfinite(square)) continue;
    sum += square;
    count += 1;
  }
  return count > 0 ? std::sqrt(sum / count) : kUnknown;
}

void score_delay(const PartInput& in, MetricValues& values) {
  const double direct = rms_at_lag(in, 0, 1);
  of(values, Metric::kTracking) = direct;
  if (!std::isfinite(direct)) return;
  const auto coarse = std::max<std::size_t>(1, static_cast<std::size_t>(kCoarseLag * in.grid.rate()));
  const auto most = static_cast<std::size_t>(in.options.lag_max_s * in.grid.rate());
  double least = rms_at_lag(in, 0, kCoarseStride);
  std::size_t best = 0;
  for (std::size_t lag = coarse; lag <= most; lag += coarse)
    if (const double rms = rms_at_lag(in, lag, kCoarseStride); rms < least) least = rms, best = lag;
  const std::size_t around = best;
  least = rms_at_lag(in, best, kFineStride);
  for (std::size_t lag = around > coarse ? around - coarse : 0; lag <= std::min(around + coarse, most); ++lag)
    if (const double rms = rms_at_lag(in, lag, kFineStride); rms < least) least = rms, best = lag;
  least = rms_at_lag(in, best, 1);
  if (!(least < direct)) least = direct, best = 0;
  of(values, Metric::kTrackingNoDelay) = least;
  of(values, Metric::kTrackingDelay) = static_cast<double>(best) / in.grid.rate();
}

/// Line of the force over the depth of the hand beyond the surface, by least squares.
double stiffness(const PartInput& in) {
  const auto axis = static_cast<std::size_t>(in.tool.surface.axis);
  const double sign = in.tool.surface.from_below ? 1 : -1;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, low = INFINITY, high = -INFINITY;
  for (std::size_t k = 0; k < in.grid.size(); ++k) {
    if (!in.part.has(k) || in.tool.contact[k] == 0) continue;
    const double depth = sign * (in.seat.x[k][axis] - in.tool.surface.at), force = -sign * in.seat.f[k][axis];
    if (!(depth > 0) || !std::isfinite(force)) continue;
    n += 1;
    sx += depth, sy += force, sxx += depth * depth, sxy += depth * force;
    low = std::min(low, depth);
    high = std::max(high, depth);
  }
  if (n < kDepthSamples || !(high - low >= kDepthSpan)) return kUnknown;
  return (sxy - sx * sy / n) / (sxx - sx * sx / n);
}

double drift(const PartInput& in) {
  const auto rest = static_cast<std::size_t>(kRest * in.grid.rate());
  double sum = 0, count = 0;
  for (const Stretch& s :
       in.grid.runs([&](std::size_t k) { return in.part.has(k) && in.seat.speed[k] < in.options.speed_min; }))
    for (std::size_t k = s.begin + rest; k < s.end; ++k) {
      const double d = distance(in.seat.x_raw[k], in.tool.x[k]);
      if (!std::isfinite(d)) continue;
      sum += d;
      count += 1;
    }
  return count > 0 ? sum / count : kUnknown;
}

double joint_error(const PartInput& in) {
  if (in.seat.q.empty() || in.tool.q.empty()) return kUnknown;
  const SceneSpec& scene = in.lesson.scene;
  const std::size_t joints = scene.seats[in.seat.seat].device.model == DeviceModel::kLinear ? 1 : 3;
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < in.grid.size(); ++k) {
    if (!in.part.has(k)) continue;
    double square = 0;
    for (std::size_t j = 0; j < joints; ++j)
      square += (in.seat.q[k][j] - in.tool.q[k][j]) * (in.seat.q[k][j] - in.tool.q[k][j]);
    if (!std::isfinite(square)) continue;
    sum += square;
    count += 1;
  }
  return count > 0 ? std::sqrt(sum / count) : kUnknown;
}

}  // namespace

void score_tracking(const PartInput& in, MetricValues& values) {
  score_delay(in, values);
  of(values, Metric::kJointTracking) = joint_error(in);
  of(values, Metric::kDrift) = drift(in);
  double sum = 0, count = 0, peak = 0;
  for (std::size_t k = 0; k < in.grid.size(); ++k) {
    if (!in.part.has(k) || in.tool.contact[k] == 0 || !known(in.seat.f_raw[k])) continue;
    const LessonTriple d = minus(in.seat.f_raw[k], in.tool.f_env[k]);
    sum += dot(d, d);
    count += 1;
    peak = std::max(peak, in.tool.force[k]);
  }
  if (!(count > 0)) return;
  of(values, Metric::kReflectionError) = std::sqrt(sum / count);
  of(values, Metric::kReflectionErrorShare) = std::sqrt(sum / count) / peak;
  if (in.tool.has_surface) of(values, Metric::kRenderedStiffness) = stiffness(in);
  of(values, Metric::kTransparency) = impedance_ratio(in);
}

void score_sharing(const PartInput& in, MetricValues& values) {
  const LessonGrid& grid = in.grid;
  double n = 0, alpha = 0, contact = 0, alpha_contact = 0, path = 0, impulse = 0, forces = 0;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const double a = in.seat.alpha[k];
    if (!in.part.has(k) || !std::isfinite(a)) continue;
    n += 1;
    alpha += a;
    if (in.tool.contact[k] != 0) contact += 1, alpha_contact += a;
    if (std::isfinite(in.tool.force[k])) forces += 1, impulse += a * in.tool.force[k];
    const bool next = k + 1 < grid.size() && in.part.has(k + 1) && grid.tick(k + 1) - grid.tick(k) == 1;
    if (next && known(in.seat.x[k]) && known(in.seat.x[k + 1])) path += a * distance(in.seat.x[k], in.seat.x[k + 1]);
  }
  if (n > 0) {
    of(values, Metric::kAuthorityShare) = alpha / n;
    of(values, Metric::kWeightedTime) = alpha / grid.rate();
    of(values, Metric::kWeightedPath) = path;
  }
  if (contact > 0) of(values, Metric::kAuthorityShareContact) = alpha_contact / contact;
  if (forces > 0) of(values, Metric::kWeightedImpulse) = impulse / grid.rate();
  if (in.lesson.scene.seats[in.seat.seat].role == Role::kInstructor && n > 0) {
    double count = 0, time = 0;
    for (const Intervention& i : in.interventions)
      if (i.seat == in.seat.seat && in.part.has(i.begin)) count += 1, time += i.to_s - i.from_s;
    of(values, Metric::kInterventions) = count;
    of(values, Metric::kInterventionTime) = time;
  }
  const auto around = static_cast<std::size_t>(kAroundChange * grid.rate());
  for (const Stretch& change : in.tool.changes) {
    if (!in.part.has(change.begin)) continue;
    const std::size_t from = change.begin > around ? change.begin - around : 0;
    const std::size_t to = std::min(change.end + around, grid.size());
    for (std::size_t k = from; k + 1 < to; ++k) {
      if (grid.tick(k + 1) - grid.tick(k) != 1 || !known(in.seat.f_raw[k]) || !known(in.seat.f_raw[k + 1])) continue;
      double& jump = of(values, Metric::kHandoverJump);
      double& rate = of(values, Metric::kHandoverRate);
      jump = std::fmax(jump, distance(in.seat.f_raw[k], in.seat.f_raw[k + 1]));
      rate = std::fmax(rate, distance(in.seat.f[k], in.seat.f[k + 1]) * grid.rate());
    }
  }
}

void score_passivity(const PartInput& in, MetricValues& values) {
  const LessonSeat& seat = in.lesson.seats[in.seat.seat];
  double n = 0, active = 0, energy = 0;
  for (std::size_t k = 0; k < in.grid.size(); ++k) {
    if (!in.part.has(k) || !in.grid.has_row(k)) continue;
    const std::size_t r = in.grid.row(k);
    if (!seat.margin_min_j.empty())
      of(values, Metric::kPassivityMargin) = std::fmin(of(values, Metric::kPassivityMargin), seat.margin_min_j[r]);
    if (seat.dissipated_j.empty() || r == 0) continue;
    const double added = seat.dissipated_j[r] - seat.dissipated_j[r - 1];
    if (!std::isfinite(added)) continue;
    n += 1;
    active += added > 0 ? 1 : 0;
    energy += std::max(0.0, added);
  }
  if (!(n > 0)) return;
  of(values, Metric::kControllerShare) = active / n;
  of(values, Metric::kDissipated) = energy;
}

namespace {

/// Value below which a share of the values lies, by the nearest rank.
double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return kUnknown;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::ranges::nth_element(values, at);
  return *at;
}

double mean_of(double sum, double count) { return count > 0 ? sum / count : kUnknown; }

}  // namespace

void score_link(const PartInput& in, MetricValues& values) {
  std::vector<double> trips_s;
  double up = 0, ups = 0, down = 0, downs = 0, gate = 0, late = 0;
  double gap_up = kUnknown, gap_down = kUnknown, age = kUnknown;
  bool any = false;
  // Counters of a recording that begins in the midst of its session have counted before.
  const bool from_begin = in.grid.tick(0) < in.lesson.scene.tick_hz;
  const LessonLink* before = nullptr;
  std::size_t at = 0;
  for (const LessonLink& link : in.lesson.links) {
    if (link.seat != in.seat.seat) continue;
    while (at + 1 < in.grid.size() && in.grid.tick(at + 1) <= link.tick) ++at;
    if (in.part.has(at)) {
      any = true;
      if (std::isfinite(link.rtt_p50_ms)) trips_s.push_back(link.rtt_p50_ms / 1e3);
      if (std::isfinite(link.loss_up_percent)) up += link.loss_up_percent / 100, ups += 1;
      if (std::isfinite(link.loss_down_percent)) down += link.loss_down_percent / 100, downs += 1;
      gap_up = std::fmax(gap_up, link.gap_up_ms / 1e3);
      gap_down = std::fmax(gap_down, link.gap_down_ms / 1e3);
      age = std::fmax(age, link.age_p99_ms / 1e3);
      const auto since = [&](std::uint32_t LessonLink::* counter) {
        const std::uint32_t earlier = before != nullptr ? before->*counter : from_begin ? 0 : link.*counter;
        return link.*counter >= earlier ? link.*counter - earlier
                                        : link.*counter;  // a new program of the seat counts from 0
      };
      gate += since(&LessonLink::gate_trips);
      late += since(&LessonLink::late_ticks);
    }
    before = &link;
  }
  if (!any) return;
  of(values, Metric::kRoundTrip50) = percentile(trips_s, 0.5);
  of(values, Metric::kRoundTrip95) = percentile(trips_s, 0.95);
  of(values, Metric::kRoundTrip99) = percentile(trips_s, 0.99);
  of(values, Metric::kLossUp) = mean_of(up, ups);
  of(values, Metric::kLossDown) = mean_of(down, downs);
  of(values, Metric::kGapUp) = gap_up;
  of(values, Metric::kGapDown) = gap_down;
  of(values, Metric::kAge99) = age;
  of(values, Metric::kGateTrips) = gate;
  of(values, Metric::kLateTicks) = late;
}

}  // namespace tandem::netsim::score
