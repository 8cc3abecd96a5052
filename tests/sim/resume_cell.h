#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "proto/spec/scene_spec.h"

/// Forces on two hands, and their distances to the tool, after the server of a session was restarted. A move to another
/// server is the same for hands: a new session from a checkpoint, and a new connection.
namespace tandem::test {

/// Motion of the leading hand. It goes on while the server is away. The following hand is relaxed.
enum class Moving : std::uint8_t {
  kCircle,   ///< 50 mm at 0.5 Hz
  kReaches,  ///< 100 mm to and fro, 0.7 s each, 0.5 s of rest between them
  kRests,    ///< no motion
};
inline constexpr std::array<const char*, 3> kMovingNames{"circle", "reaches", "rests"};

/// Values of one hand in the 5 s from its engagement on.
struct ResumedHand {
  double since = 0;      ///< when it was engaged [s]
  double begin = 0;      ///< distance to the tool then [m]
  double first = 0;      ///< force in the first tick [N]
  double force = 0;      ///< largest force [N]
  double force_rms = 0;  ///< in the first 2 s [N]
  double step = 0;       ///< largest change of force within 1 ms [N]
  double distance = 0;   ///< largest distance to the tool [m]
  double after_2 = 0;    ///< largest distance from 2 s on [m]
  double after_4 = 0;    ///< largest distance from 4 s on [m]
  double back = 0;       ///< time after which the distance stays within 5 mm [s]
};
/// Values of one session.
struct Resumed {
  std::array<ResumedHand, 2> hands;  ///< leading hand, following hand
  double tool_speed = 0;             ///< largest speed of the tool from the first engagement on [m/s]
};

/// A run with a restart. Hands, time of the restart (6 to 8 s) and its length (1 to 1.5 s) are drawn from the seed.
struct ResumeCase {
  LawKind law = LawKind::kReplica;
  Moving moving = Moving::kCircle;
  double one_way_ms = 0.3;  ///< constant delay of each direction
  std::uint64_t seed = 1;
};
/// @throws std::runtime_error if a session does not run, or an invariant is broken
[[nodiscard]] Resumed resumed(const ResumeCase& run);
/// Returns the values of the same session without the restart, at the times of `other`.
[[nodiscard]] Resumed undisturbed(const ResumeCase& run, const Resumed& other);

}  // namespace tandem::test
