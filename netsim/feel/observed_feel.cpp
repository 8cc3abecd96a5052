#include "netsim/feel/observed_feel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "netsim/feel/meters.h"

namespace tandem::netsim {
namespace {

constexpr double kRowHz = 100;
constexpr std::size_t kRowsMax = 240'000;
constexpr double kBegin = 1;  // [s] of session time
constexpr double kAlone = 0.99, kSaturated = 0.99;
constexpr double kAfterHandOver = 0.5;                                          // [s]
constexpr double kContactForceMin = 0.05, kSpringLow = 0.2, kSpringHigh = 0.9;  // [N, N, share of the motor's]
constexpr double kDepthMin = 1e-3;                      // [m] smallest change of depth of a press
constexpr double kSpeedMin = 0.02;                      // [m/s]
constexpr double kGainHand = 0.2e-3;                    // [m] RMS of the hand in a line of the spectrum
constexpr std::size_t kGainRows = 400;                  // 4 s: lines of 0.25 Hz
constexpr std::size_t kGainLines = 40;                  // up to 10 Hz
constexpr std::size_t kBoxRows = 100, kRestRows = 200;  // 1 s, 2 s
constexpr double kBoxMin = 0.01, kRestMax = 0.002;      // [m]
constexpr std::array<std::string_view, 12> kKeys{
    "stiffness_felt_n_m", "drag_n",        "gain_max",   "overshoot",       "limit_cycle_n", "handover_bump_n",
    "handover_step_n_ms", "engaged_share", "held_share", "saturated_share", "trips_per_min", "delivered_error_n"};

hal::Vec3 vector_of(const server::Triple& v) { return {v[0], v[1], v[2]}; }

struct Box {
  hal::Vec3 low, high;
  explicit Box(Series points) : low(points[0]), high(points[0]) {
    for (const hal::Vec3& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  [[nodiscard]] double extent() const { return (high - low).maxCoeff(); }
  /// Returns the distance of a point from the box; 0 inside.
  [[nodiscard]] double beyond(const hal::Vec3& p) const { return (low - p).cwiseMax(p - high).cwiseMax(0.0).norm(); }
};

bool all(const std::vector<char>& flags, std::size_t first, std::size_t count) {
  return std::all_of(flags.begin() + static_cast<std::ptrdiff_t>(first),
                     flags.begin() + static_cast<std::ptrdiff_t>(first + count), [](char c) { return c != 0; });
}

/// Keeps the worse of two numbers, ignoring NaN in `worst`. @param least  a smaller number is worse
void worsen(double& worst, double value, bool least = false) {
  if (std::isnan(worst) || (least ? value < worst : value > worst)) worst = value;
}

}  // namespace

std::span<const std::string_view> ObservedFeel::keys() { return kKeys; }

ObservedFeel::ObservedFeel(const SceneSpec& scene)
    : tick_hz_(scene.tick_hz),
      every_(std::max(1u, static_cast<std::uint32_t>(std::llround(scene.tick_hz / kRowHz)))),
      rows_max_(kRowsMax / std::max<std::size_t>(1, scene.masters())),
      seats_(scene.masters()),
      held_(scene.tools.size()) {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    while (seats_[i].tool + 1 < scene.tools.size() && scene.follow[i][seats_[i].tool] <= 0) ++seats_[i].tool;
    seats_[i].force_max =
        std::min(scene.seats[i].device.force_peak, scene.gate.force_max * share_of_force(scene.seats[i].role));
  }
}

void ObservedFeel::observe_transfer(Seat& seat, const server::SeatRecord& record, const hal::Vec3& f,
                                    std::uint32_t tick) {
  const bool changes = seat.alpha >= 0 && record.alpha != seat.alpha;
  seat.alpha = record.alpha;
  if (!record.engaged) seat.hand_over_until = 0;
  if (changes && record.engaged) {
    if (tick >= seat.hand_over_until) seat.f_hand_over = seat.f_before;
    seat.hand_over_until = tick + static_cast<std::uint32_t>(kAfterHandOver * tick_hz_);
  }
  if (tick < seat.hand_over_until) {
    seat.handed_over = true;
    seat.bump = std::max(seat.bump, (f - seat.f_hand_over).norm());
    seat.step = std::max(seat.step, (f - seat.f_before).norm() * tick_hz_ * 1e-3);
  }
  seat.f_before = f;
}

void ObservedFeel::add(const server::TickRecord& record) {
  if (!record.running || record.tick < kBegin * tick_hz_) return;
  ++ticks_;
  for (std::size_t j = 0; j < held_.size(); ++j) held_[j] += record.tools[j].held ? 1 : 0;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    Seat& seat = seats_[i];
    const server::SeatRecord& s = record.seats[i];
    const hal::Vec3 f = vector_of(s.f_out);
    seat.engaged_ticks += s.engaged ? 1 : 0;
    seat.saturated_ticks += f.norm() >= kSaturated * seat.force_max ? 1 : 0;
    seat.error_square += (vector_of(s.f_cmd) - f).squaredNorm();
    observe_transfer(seat, s, f, record.tick);
    if (record.tick % every_ != 0 || seat.x.size() >= rows_max_) continue;
    const server::ToolRecord& tool = record.tools[seat.tool];
    seat.x.push_back(vector_of(s.x));
    seat.tool_x.push_back(vector_of(tool.x));
    seat.f.push_back(f);
    seat.f_env.push_back(vector_of(tool.f_env));
    seat.engaged.push_back(s.engaged ? 1 : 0);
    seat.alone.push_back(s.engaged && s.alpha >= kAlone ? 1 : 0);
  }
}

double ObservedFeel::stiffness(const Seat& seat) const {
  // A hand may press on both sides of each axis. The result is that of the side with most rows.
  std::array<std::vector<double>, 6> depth, force;
  for (std::size_t r = 0; r < seat.x.size(); ++r) {
    Eigen::Index axis = 0;
    if (seat.alone[r] == 0 || seat.f_env[r].cwiseAbs().maxCoeff(&axis) < kContactForceMin) continue;
    const double side = seat.f_env[r][axis] > 0 ? 1 : -1;
    const auto place = static_cast<std::size_t>(2 * axis + (side > 0 ? 1 : 0));
    depth[place].push_back(-side * seat.x[r][axis]);
    force[place].push_back(side * seat.f[r][axis]);
  }
  const auto most = static_cast<std::size_t>(
      std::ranges::max_element(depth, {}, [](const auto& d) { return d.size(); }) - depth.begin());
  if (depth[most].empty()) return kNaN;
  const auto [least, deepest] = std::ranges::minmax(depth[most]);
  return deepest - least < kDepthMin ? kNaN : slope(depth[most], force[most], kSpringLow, kSpringHigh * seat.force_max);
}

double ObservedFeel::drag(const Seat& seat) const {
  std::vector<hal::Vec3> forces;
  for (std::size_t r = 1; r < seat.x.size(); ++r)
    if (seat.alone[r] != 0 && seat.alone[r - 1] != 0 && seat.f_env[r].norm() == 0 &&
        (seat.x[r] - seat.x[r - 1]).norm() * tick_hz_ / every_ > kSpeedMin)
      forces.push_back(seat.f[r]);
  return rms(forces);
}

double ObservedFeel::gain(const Seat& seat) const {
  std::array<std::complex<double>, kGainRows> turns;
  for (std::size_t k = 0; k < kGainRows; ++k)
    turns[k] = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(kGainRows));
  std::array<double, kGainLines> hand{}, tool{};
  std::size_t parts = 0;
  for (std::size_t first = 0; first + kGainRows <= seat.x.size(); first += kGainRows / 2) {
    const auto touches = [](const hal::Vec3& f) { return f.norm() > 0; };
    const auto from = seat.f_env.begin() + static_cast<std::ptrdiff_t>(first);
    if (!all(seat.alone, first, kGainRows) || std::any_of(from, from + static_cast<std::ptrdiff_t>(kGainRows), touches))
      continue;
    ++parts;
    for (std::size_t line = 0; line < kGainLines; ++line)
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        std::complex<double> x = 0, y = 0;
        for (std::size_t k = 0; k < kGainRows; ++k) {
          const std::complex<double> w =
              (1 - turns[k].real()) * turns[k * (line + 1) % kGainRows] / static_cast<double>(kGainRows);
          x += w * (seat.x[first + k][axis] - seat.x[first][axis]);
          y += w * (seat.tool_x[first + k][axis] - seat.tool_x[first][axis]);
        }
        hand[line] += 2 * std::norm(x);  // mean square of this line
        tool[line] += 2 * std::norm(y);
      }
  }
  double most = kNaN;
  for (std::size_t line = 1; line < kGainLines; ++line)
    if (parts > 0 && hand[line] > kGainHand * kGainHand * static_cast<double>(parts))
      worsen(most, std::sqrt(tool[line] / hand[line]));
  return most;
}

double ObservedFeel::overshoot(const Seat& seat) const {
  double most = kNaN;
  for (std::size_t end = kBoxRows; end <= seat.x.size(); ++end) {
    const std::size_t first = end - kBoxRows;
    if (seat.f_env[end - 1].norm() > 0 || !all(seat.alone, first, kBoxRows)) continue;
    const Box box{Series{seat.x}.subspan(first, kBoxRows)};
    if (box.extent() >= kBoxMin) worsen(most, box.beyond(seat.tool_x[end - 1]) / box.extent());
  }
  return most;
}

double ObservedFeel::limit_cycle(const Seat& seat) const {
  double most = kNaN;
  for (std::size_t first = 0; first + kRestRows <= seat.x.size(); first += kRestRows / 2) {
    if (!all(seat.engaged, first, kRestRows) || Box{Series{seat.x}.subspan(first, kRestRows)}.extent() > kRestMax)
      continue;
    worsen(most, rms_above(Series{seat.f}.subspan(first, kRestRows), 1, tick_hz_ / every_));
  }
  return most;
}

std::vector<std::pair<std::string, double>> ObservedFeel::values(std::span<const std::uint32_t> trips) const {
  std::array<double, kKeys.size()> worst;
  worst.fill(kNaN);
  const auto ticks = static_cast<double>(ticks_);
  for (std::size_t i = 0; i < seats_.size() && ticks_ > 0; ++i) {
    const Seat& seat = seats_[i];
    worsen(worst[0], stiffness(seat), true);
    worsen(worst[1], drag(seat));
    worsen(worst[2], gain(seat));
    worsen(worst[3], overshoot(seat));
    worsen(worst[4], limit_cycle(seat));
    if (seat.handed_over) {
      worsen(worst[5], seat.bump);
      worsen(worst[6], seat.step);
    }
    worsen(worst[7], static_cast<double>(seat.engaged_ticks) / ticks, true);
    worsen(worst[9], static_cast<double>(seat.saturated_ticks) / ticks);
    if (i < trips.size()) worsen(worst[10], 60 * trips[i] * tick_hz_ / ticks);
    worsen(worst[11], std::sqrt(seat.error_square / ticks));
  }
  for (std::size_t j = 0; j < held_.size() && ticks_ > 0; ++j) worsen(worst[8], static_cast<double>(held_[j]) / ticks);
  std::vector<std::pair<std::string, double>> out;
  for (std::size_t k = 0; k < kKeys.size(); ++k) out.emplace_back(kKeys[k], worst[k]);
  return out;
}

}  // namespace tandem::netsim
