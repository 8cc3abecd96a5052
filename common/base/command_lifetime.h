#pragma once

#include <algorithm>

#include "common/base/time.h"

namespace tandem {

/// Command lifetime: how long a motor may act on one command. kCommandFade is the time in which the effort then fades
/// to zero.
///
/// A command is renewed once per tick, so its lifetime counts ticks: one command survives two missed ticks at any rate.
/// The minimum prevents isolated late wake-ups of a fast servo from removing the force. The maximum is the safety
/// bound: three ticks of the slowest permitted session (100 Hz, proto/schema/scene.proto). No command acts longer than
/// that, for any lifetime it contains.
inline constexpr int kCommandTicks = 3;
/// Shortest lifetime of a command.
inline constexpr Duration kCommandLifetimeMin = std::chrono::milliseconds(5);
/// Longest lifetime of a command.
inline constexpr Duration kCommandLifetimeMax = std::chrono::milliseconds(30);
/// Time from the last effort to zero after the lifetime.
inline constexpr Duration kCommandFade = std::chrono::milliseconds(20);

/// @param tick  time between two commands, positive  @return 5 ms at 600 Hz and above, 15 ms at 200 Hz, 30 ms at 100 Hz
[[nodiscard]] constexpr Duration command_lifetime(Duration tick) noexcept {
  return std::clamp<Duration>(kCommandTicks * tick, kCommandLifetimeMin, kCommandLifetimeMax);
}

}  // namespace tandem
