#pragma once

#include <array>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "netsim/feel/probe_scene.h"

/// Probes measure how a session feels by moving simulated hands in prescribed ways. A probe consists of one or a few
/// short runs of the simulation.
namespace tandem::netsim {

enum class Probe : std::uint8_t {
  kPress,     ///< slow press on bone and tissue, then a constant press
  kFree,      ///< free motion: circles, a step, recordings; the other hand is relaxed
  kGain,      ///< small circles from 0.25 to 10 Hz
  kRest,      ///< hands that are kicked and then rest
  kRelease,   ///< frictionless devices whose hand is taken away while a force pulls the handle against a spring
  kHandOver,  ///< authority changes while both hands press
  kShare,     ///< two hands that share a tool; one of them is kicked
  kFollow,    ///< a relaxed hand beside the hand that leads it
};
/// Frequencies of Probe::kGain [Hz].
inline constexpr std::array<double, 10> kGainHz{0.25, 0.5, 1, 2, 3, 4, 5, 6, 8, 10};
/// Authority of the kicked hand in Probe::kShare.
inline constexpr std::array<double, 5> kShares{0.02, 0.1, 0.5, 0.9, 0.98};
/// Spring stiffnesses of Probe::kRelease [N/m].
inline constexpr std::array<double, 5> kReleaseK{100, 300, 1000, 5000, 20'000};

/// Effect of network and motors during the working time, summed over runs.
struct Exposure {
  double s = 0, engaged_s = 0, held_s = 0, saturated_s = 0;  ///< [s]: all, engaged, tool braked, motor saturated
  double trips = 0;                                          ///< of the leader's gate
  double error_square = 0;                                   ///< (commanded - delivered)^2 [N^2 s]
  /// Scenes with `send`: datagrams of all hands to and from the server, and ticks in which each could have sent one.
  double sent_up = 0, sent_down = 0, send_ticks = 0;

  void add(const Exposure& other) noexcept;
};
/// Returns the exposure of hand 0 from session time `from` [s] on.
[[nodiscard]] Exposure exposure_of(const FeelTrace& trace, double from);

/// Numbers by key (netsim/feel/feel_keys.h), SI units. A number that does not exist is NaN.
using FeelValues = std::map<std::string, double>;

struct ProbeResult {
  FeelValues values;
  Exposure exposure;
  double lived_s = 0;                                           ///< session time of all runs [s]
  double one_way_s = std::numeric_limits<double>::quiet_NaN();  ///< network delay of the leader in the first run [s]
  std::string trouble;  ///< failure of the first run that did not work; its numbers are NaN
};

/// The single probes.
[[nodiscard]] ProbeResult probe_press(const FeelSetup& setup, std::uint64_t seed);
[[nodiscard]] ProbeResult probe_free(const FeelSetup& setup, std::uint64_t seed);
[[nodiscard]] ProbeResult probe_gain(const FeelSetup& setup, std::uint64_t seed);
[[nodiscard]] ProbeResult probe_rest(const FeelSetup& setup, std::uint64_t seed);
[[nodiscard]] ProbeResult probe_release(const FeelSetup& setup, std::uint64_t seed);
[[nodiscard]] ProbeResult probe_handover(const FeelSetup& setup, std::uint64_t seed);
[[nodiscard]] ProbeResult probe_share(const FeelSetup& setup, std::uint64_t seed);
[[nodiscard]] ProbeResult probe_follow(const FeelSetup& setup, std::uint64_t seed);

struct ProbeName {
  Probe probe;
  std::string_view name;
  ProbeResult (*run)(const FeelSetup& setup, std::uint64_t seed);
};
inline constexpr std::array<ProbeName, 8> kProbes{{
    {Probe::kPress, "press", probe_press},
    {Probe::kFree, "free", probe_free},
    {Probe::kGain, "gain", probe_gain},
    {Probe::kRest, "rest", probe_rest},
    {Probe::kRelease, "release", probe_release},
    {Probe::kHandOver, "handover", probe_handover},
    {Probe::kShare, "share", probe_share},
    {Probe::kFollow, "follow", probe_follow},
}};
/// Returns the row of a probe in kProbes.
[[nodiscard]] const ProbeName& row_of(Probe probe);

[[nodiscard]] inline ProbeResult run_probe(Probe probe, const FeelSetup& setup, std::uint64_t seed) {
  return row_of(probe).run(setup, seed);
}

/// Runs one part of a probe; adds its time and its trouble to `result`.
[[nodiscard]] FeelTrace run_part(const FeelSetup& setup, const ProbeRun& run, std::uint64_t seed, ProbeResult& result);
/// Impedance of an ideal user who guides a tool firmly; HandModel::kRecorded. [N/m, N s/m, kg]
inline constexpr double kFirmK = 1000, kFirmB = 10, kFirmM = 0.1;
/// Returns that user's hand with the impedance of `hand`.
[[nodiscard]] inline HandSpec firm(const DrawnHand& hand, HandModel model = HandModel::kRecorded) {
  return hand.with_impedance(model, kFirmK, kFirmB, kFirmM);
}
/// Returns the hand of a user who follows without effort.
[[nodiscard]] inline HandSpec relaxed(const DrawnHand& hand) {
  return hand.with_impedance(HandModel::kRelaxed, 0, 2, 0.1);
}

/// Path of a press along x on a wall at 0: the hand starts kPressFront in front of it, touches it at kPressTouch, and
/// is `depth` behind its surface from `pressed` on [m, s].
inline constexpr double kPressFront = 0.010, kPressTouch = 2;
[[nodiscard]] IntendedPath press_path(double depth, double pressed);

/// Returns the depth of that press [m]: as deep as this coupling and these motors can render without saturation, 3 to
/// 20 mm.
[[nodiscard]] double press_depth(const FeelSetup& setup);
/// Means while hand 0 holds still in contact.
struct HeldPress {
  double felt = 0, difference = 0;  ///< force on the hand, and the tool's force minus felt [N]
  double stiffness = 0;             ///< force on the hand over its depth [N/m]
};
/// Returns the means of the rows with session times in [from, to); NaN without rows.
[[nodiscard]] HeldPress held_press(const FeelTrace& trace, double from, double to);

/// Limit cycles of hands at rest: the force above kCycleBand [Hz] from kCycleFrom to kCycleEnd [s], after a kick.
inline constexpr double kCycleFrom = 7.5, kCycleEnd = 12.5, kCycleBand = 1;
/// Path of a kick along x: 30 mm within 0.3 s, and back from kKickBack [s] on.
inline constexpr double kKickBack = 2;
[[nodiscard]] hal::Vec3 kick_path(double t);
/// Returns the RMS force on a hand of the trace in a limit cycle [N], in [from, to) of the session time [s].
[[nodiscard]] double limit_cycle(const FeelTrace& trace, const FeelTrace::Hand& hand, double from = kCycleFrom,
                                 double to = kCycleEnd);

}  // namespace tandem::netsim
