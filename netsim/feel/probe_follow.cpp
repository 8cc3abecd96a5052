#include <cmath>
#include <limits>
#include <numbers>

#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

/// Following: distance of a relaxed hand from the hand that leads it. The leader moves 30 mm within 0.5 s and holds
/// still; moves slowly on a circle; and presses on bone. The measurement begins 2 s after the motion. It compares means
/// over one second; `follower_wander_m` reports the rest, which comes from tremor and noise across the network.
namespace tandem::netsim {
namespace {

constexpr double kMoveAt = 3, kMoveFor = 0.5, kAway = 0.03;  // [s, s, m]
constexpr double kJudged = kMoveAt + kMoveFor + 2;           // [s]
constexpr double kStillEnd = kJudged + 3;                    // [s]
constexpr double kSlowHz = 0.1, kSlowRadius = 0.02;          // [Hz, m]: 13 mm/s
constexpr double kSlowEnd = kJudged + 1 / kSlowHz;           // [s]
constexpr double kFrom = -0.01, kDeep = 0.01;                // [m] before and behind the surface
constexpr double kMean = 1;                                  // [s]

struct Beside {
  double offset = 0, wander = 0;  ///< RMS of the mean over a second, and of the rest [m]
};

/// Returns the distance of hand 1 from hand 0.
Beside beside(const FeelTrace& trace, double from, double to) {
  const Series leader = trace.part(trace.hands[0].x, from, to), follower = trace.part(trace.hands[1].x, from, to);
  const auto length = static_cast<std::size_t>(std::llround(kMean * trace.tick_hz));
  if (leader.size() < length)
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  double square = 0, rest = 0;
  std::size_t parts = 0;
  for (std::size_t begin = 0; begin + length <= leader.size(); begin += length, ++parts) {
    const Series led = follower.subspan(begin, length), leads = leader.subspan(begin, length);
    const hal::Vec3 middle = mean(led) - mean(leads);
    square += middle.squaredNorm();
    const double all = rms_difference(led, leads);
    rest += std::max(0.0, all * all - middle.squaredNorm());
  }
  return {std::sqrt(square / static_cast<double>(parts)), std::sqrt(rest / static_cast<double>(parts))};
}

}  // namespace

ProbeResult probe_follow(const FeelSetup& setup, std::uint64_t seed) {
  ProbeResult result;
  const DrawnHand leader{setup.hands, seed, 0}, follower{setup.hands, seed, 1};
  const auto go = [&](const IntendedPath& path, double length, const EnvironmentSpec& environment = {},
                      double start = 0) {
    const ProbeRun run{.length = length,
                       .start_x = start,
                       .hands = {{firm(leader), leader.move(path, length)}, {relaxed(follower)}},
                       .environment = environment};
    return run_part(setup, run, seed, result);
  };
  const auto away = [](double t) { return hal::sim::min_jerk((t - kMoveAt) / kMoveFor).value; };
  const Beside still = beside(go([&](double t) { return hal::Vec3(kAway * away(t), 0, -kAway * away(t)); }, kStillEnd),
                              kJudged, kStillEnd);
  const Beside slow = beside(go(
                                 [&](double t) {
                                   const double turn = 2 * std::numbers::pi * kSlowHz * std::max(0.0, t - kMoveAt),
                                                r = kSlowRadius * away(t);
                                   return hal::Vec3(r * std::cos(turn), 0, r * std::sin(turn));
                                 },
                                 kSlowEnd),
                             kJudged, kSlowEnd);
  const Beside contact = beside(go([&](double t) { return hal::Vec3(kFrom + (kDeep - kFrom) * away(t), 0, 0); },
                                   kStillEnd, wall_of(kBone), kFrom),
                                kJudged, kStillEnd);
  result.values["follower_offset_m"] = std::max(still.offset, slow.offset);
  result.values["follower_offset_still_m"] = still.offset;
  result.values["follower_offset_slow_m"] = slow.offset;
  result.values["follower_wander_m"] = still.wander;
  result.values["follower_offset_contact_m"] = contact.offset;
  return result;
}

}  // namespace tandem::netsim
