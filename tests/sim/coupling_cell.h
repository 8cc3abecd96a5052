#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "proto/spec/scene_spec.h"

/// Cells of the comparison between the default (law `replica`, coupling `esc`) and the couplings of shared haptic
/// environments: 2 to 8 hands over a one-way delay, in whole sessions.
namespace tandem::test {

/// One way to couple hands.
struct Contender {
  std::string_view name;
  LawKind law;
  HandCouplingKind coupling;
};
inline constexpr Contender kDefault{"replica + esc", LawKind::kReplica, HandCouplingKind::kEsc};
inline constexpr Contender kPeer{"pd + pd_peer", LawKind::kPd, HandCouplingKind::kPdPeer};
inline constexpr Contender kAverage{"pd + average_position", LawKind::kPd, HandCouplingKind::kAveragePosition};

/// Motion of hand 0, which has all authority, except in kKick.
enum class Motion : std::uint8_t {
  kCircle,  ///< 50 mm radius, 0.5 Hz; the other hands are relaxed
  kReach,   ///< 40 mm there and back, 0.5 s each, with rests; the other hands are relaxed
  kPress,   ///< onto bone (20 kN/m), then still; the other hands are relaxed
  kKick,    ///< 30 mm there and back; soft hands share the tool equally, then all rest
};

/// Numbers of one session. NaN where a motion does not give them.
struct CellValues {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double tracking = kNone;   ///< leader to tool, RMS [m]: kCircle, kReach
  double following = kNone;  ///< other hands to the leader, RMS, mean over the hands [m]: kCircle, kReach
  double drag = kNone;       ///< force on the leader in free motion, RMS [N]: kCircle, kReach
  /// Part of the force on the leader that the bone exerts on the tool, over the leader's depth [N/m]: kPress.
  double stiffness = kNone;
  double unrest = kNone;   ///< force above 1 Hz on the worst relaxed hand while the leader holds still [N RMS]: kPress
  double shaking = kNone;  ///< force above 1 Hz on the worst hand, from 3 s after the kick on [N RMS]: kKick
  double engaged = kNone;  ///< share of the time in which the leader was engaged [0, 1]
  static constexpr double kShakingMax = 0.3;  ///< [N]
  /// The hands oscillate although no hand moves by itself, or an oscillation has released a hand: kKick.
  [[nodiscard]] bool unstable() const noexcept { return shaking > kShakingMax || engaged < 0.999; }
};

/// Runs one session with hands drawn from the seed.
/// @param hands  2 to 8  @param delay_ms  one way
[[nodiscard]] CellValues run_cell(const Contender& contender, std::size_t hands, double delay_ms, Motion motion,
                                  std::uint64_t seed);

/// Means over seeds and motions of one cell.
struct Cell {
  double tracking = 0, following = 0, drag = 0, stiffness = 0, unrest = 0;  ///< as in CellValues
  double unstable = 0;                                                      ///< share of the seeds [0, 1]
};
[[nodiscard]] Cell average_cell(const Contender& contender, std::size_t hands, double delay_ms, std::uint64_t seeds);

/// A quantity of a cell that the default is judged by.
struct Measure {
  std::string_view name, unit;
  double Cell::* value;
  double scale;       ///< to the unit
  double tolerance;   ///< difference that counts as none
  bool more = false;  ///< more is better
};
inline constexpr std::array<Measure, 6> kMeasures{{
    {"tracking", "mm", &Cell::tracking, 1e3, 1e-4},
    {"following", "mm", &Cell::following, 1e3, 1e-4},
    {"drag", "N", &Cell::drag, 1, 0.01},
    {"stiffness", "N/m", &Cell::stiffness, 1, 1, true},
    {"unrest", "N", &Cell::unrest, 1, 0.02},
    {"unstable", "%", &Cell::unstable, 100, 0},
}};
/// Returns whether `own` is worse than `other` by more than a tenth.
[[nodiscard]] bool loses(const Measure& measure, const Cell& own, const Cell& other);

/// Runs kKick with a given stiffness of each spring and law `raw`, whose gains no delay changes.
[[nodiscard]] CellValues run_raw_peers(std::size_t hands, double delay_ms, double k, std::uint64_t seed);

}  // namespace tandem::test
