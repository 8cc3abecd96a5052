#include <algorithm>
#include <cmath>
#include <limits>

#include "server/report/report.h"

/// Metrics of seats, and the samples that they use.
namespace tandem::server {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLagMax = 2.0;  // [s] longest lag in the search
// [s] range around a dropped tick that it affects, by catching up and by the age of samples
constexpr double kSlipReach = 0.15;

double distance2(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = static_cast<double>(a[k]) - static_cast<double>(b[k]);
    sum += d * d;
  }
  return sum;
}

double norm(const std::array<float, 3>& v) { return std::sqrt(distance2(v, {})); }

/// Root mean square of the added values; NaN if there are none.
class Rms {
 public:
  void add(double square) {
    sum_ += square;
    ++n_;
  }
  [[nodiscard]] double value() const { return n_ == 0 ? kNaN : std::sqrt(sum_ / static_cast<double>(n_)); }

 private:
  double sum_ = 0;
  std::uint64_t n_ = 0;
};

}  // namespace

/// Slots within the windows are 1 and all others 0; with `outside` the reverse. Windows are half-open.
std::vector<char> ReportBuilder::slots_within(const std::vector<Window>& windows, bool outside,
                                              std::size_t slots) const {
  std::vector<char> use(slots, outside ? 1 : 0);
  for (const Window& w : windows) {
    const auto slot = [&](double at) {
      return static_cast<std::size_t>(
          std::max(0.0, std::min(std::ceil(at * rate() - 1e-6), static_cast<double>(slots))));
    };
    for (std::size_t k = slot(w.from); k < slot(w.to); ++k) use[k] = outside ? 0 : 1;
  }
  return use;
}

std::vector<char> ReportBuilder::usable_slots(const SeatAndSlave& pair, const std::vector<Window>& of,
                                              bool outside) const {
  const std::size_t n = std::min(pair.seat->size(), pair.slave->size());
  std::vector<Window> pushes;
  for (const SeatSpec& s : scene_->seats)
    for (const Deviation& d : s.hand.deviations) pushes.push_back({d.at, d.at + d.length});
  std::vector<char> use = slots_within(of, outside, n);
  const std::vector<char> undisturbed = slots_within(pushes, true, n);
  for (std::size_t k = 0; k < n; ++k)
    use[k] = static_cast<char>(use[k] != 0 && undisturbed[k] != 0 && (*pair.seat)[k].usable && (*pair.slave)[k].usable);
  return use;
}

SeatMetrics ReportBuilder::compute_metrics(const SeatAndSlave& pair, const ReportInterval& part) const {
  const Track& s = *pair.seat;
  const Track& t = *pair.slave;
  const std::vector<char> use = usable_slots(pair, part.windows, part.outside);
  const std::size_t n = use.size();
  SeatMetrics m;
  m.judged_s = static_cast<double>(std::ranges::count(use, 1)) / rate();

  const auto rms_at_lag = [&](std::size_t lag, std::size_t stride) {
    Rms rms;
    for (std::size_t k = 0; k + lag < n; k += stride)
      if (use[k]) rms.add(distance2(s[k].x, t[k + lag].x));
    return rms.value();
  };
  m.tracking_rms_m = rms_at_lag(0, 1);
  const auto coarse = std::max<std::size_t>(1, static_cast<std::size_t>(0.010 * rate()));
  std::size_t best = 0;
  double least = m.tracking_rms_m;
  const auto try_lag = [&](std::size_t lag, std::size_t stride) {
    if (const double r = rms_at_lag(lag, stride); r < least) {
      least = r;
      best = lag;
    }
  };
  for (std::size_t lag = coarse; lag <= static_cast<std::size_t>(kLagMax * rate()) && lag < n; lag += coarse)
    try_lag(lag, 4);
  const std::size_t around = best;
  least = rms_at_lag(around, 1);
  for (std::size_t lag = around > coarse ? around - coarse : 0; lag <= around + coarse && lag < n; ++lag)
    try_lag(lag, 1);
  m.tracking_rms_lag_removed_m = least;

  const auto delay = static_cast<std::size_t>(std::llround(pair.one_way_s * rate()));
  Rms transport;
  std::array<Rms, 3> joints;
  for (std::size_t k = 0; k < n; ++k) {
    if (!use[k]) continue;
    if (k >= delay) transport.add(distance2(s[k].x, s[k - delay].x));
    for (std::size_t c = 0; c < 3; ++c) {
      const double e = static_cast<double>(s[k].q[c]) - static_cast<double>(t[k].q[c]);
      joints[c].add(e * e);
    }
  }
  m.transport_lag_rms_m = transport.value();
  const std::size_t count = scene_->seats.front().device.model == DeviceModel::kLinear ? 1 : 3;
  for (std::size_t c = 0; c < count; ++c) m.joint_rms_rad.push_back(pair.has_joints ? joints[c].value() : kNaN);
  m.leader_offset_rms_m = leader_offset_rms(pair, use);
  find_peaks(pair, part, m);
  compute_force_errors(pair, part, m);
  return m;
}

/// RMS distance from the leading hand, over the evaluated samples.
double ReportBuilder::leader_offset_rms(const SeatAndSlave& pair, const std::vector<char>& use) const {
  Rms beside;
  const Track& own = *pair.seat;
  for (std::size_t k = 0; k < use.size(); ++k) {
    const std::size_t leader = own[k].leader;
    if (use[k] == 0 || leader == 0 || leader > pair.all.size()) continue;
    const Track& other = pair.all[leader - 1];
    if (k < other.size() && other[k].usable) beside.add(distance2(own[k].x, other[k].x));
  }
  return beside.value();
}

/// Largest force and speed, including samples excluded from the other metrics.
void ReportBuilder::find_peaks(const SeatAndSlave& pair, const ReportInterval& part, SeatMetrics& m) const {
  const Track& s = *pair.seat;
  const std::size_t n = std::min(s.size(), pair.slave->size());
  const std::vector<char> looked_at =
      part.all_peaks ? std::vector<char>(n, 1) : slots_within(part.windows, part.outside, n);
  const auto span = std::max<std::size_t>(1, static_cast<std::size_t>(kSpeedSpan * rate()));
  const auto reach = static_cast<std::size_t>(kSlipReach * scene_->tick_hz);
  const auto slipped_near = [&](std::size_t tick) {
    return std::ranges::any_of(slips_, [&](std::size_t slip) { return tick + reach >= slip && tick <= slip + reach; });
  };
  // Sessions that nothing records have some 60 samples per second. A difference of neighbours is then the mean speed
  // between them, which the fastest hand does not exceed.
  const std::size_t longest = sparse() ? std::max(span, static_cast<std::size_t>(kSpeedSpanMax * rate())) : span;
  if (sparse()) m.speed_peak_m_s = kNaN;
  for (std::size_t k = 0; k < n; ++k) {
    if (looked_at[k] == 0 || !s[k].known) continue;
    m.effort_peak_n = std::max(m.effort_peak_n, norm(s[k].f));
    std::size_t back = span;
    while (back < longest && k >= back && !s[k - back].known) ++back;
    // Differences across a gap in the samples, or where session time did not advance, give no valid speed.
    if (k < back || !s[k - back].known || slipped_near(k * stride_)) continue;
    const double speed = std::sqrt(distance2(s[k].x, s[k - back].x)) * rate() / static_cast<double>(back);
    m.speed_peak_m_s = std::fmax(m.speed_peak_m_s, speed);  // also of NaN
  }
}

void ReportBuilder::compute_force_errors(const SeatAndSlave& pair, const ReportInterval& part, SeatMetrics& m) const {
  const Track& s = *pair.seat;
  const Track& t = *pair.slave;
  Rms error, commanded;
  double peak = 0;  // percentages always refer to the peak of the run
  const std::size_t n = std::min(s.size(), t.size());
  for (std::size_t k = 0; k < n; ++k) peak = std::max(peak, norm(scene_->commanded_force ? t[k].f_cmd : t[k].f));
  if (!part.contact.empty()) {
    const std::vector<char> touching = usable_slots(pair, part.contact, false);
    for (std::size_t k = 0; k < n; ++k) {
      if (!touching[k]) continue;
      const std::array<float, 3> felt{pair.answer * s[k].f[0], pair.answer * s[k].f[1], pair.answer * s[k].f[2]};
      const std::array<float, 3> asked{pair.answer * s[k].f_cmd[0], pair.answer * s[k].f_cmd[1],
                                       pair.answer * s[k].f_cmd[2]};
      error.add(distance2(felt, t[k].f));
      // The slave would have pressed with its commanded force; the environment reacts with the opposite force.
      const std::array<float, 3> wanted{-t[k].f_cmd[0], -t[k].f_cmd[1], -t[k].f_cmd[2]};
      commanded.add(distance2(asked, wanted));
    }
  }
  m.force_error_rms_n = error.value();
  m.force_error_commanded_rms_n = commanded.value();
  const double judged = scene_->commanded_force ? m.force_error_commanded_rms_n : m.force_error_rms_n;
  m.force_error_percent = peak > 0 ? 100 * judged / peak : kNaN;
}

}  // namespace tandem::server
