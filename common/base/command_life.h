#pragma once

#include <algorithm>

#include "common/base/time.h"

namespace tandem {

/// How long a motor may act on one command, and how long its effort then takes to fade to zero.
///
/// A command is renewed once per tick, so its life counts ticks: one command survives two missed ticks at any rate. The floor
/// keeps isolated late wake-ups of a fast servo from taking the force away. The ceiling is the safety bound: three ticks of the
/// slowest session there is (100 Hz, proto/scene.proto). No command acts longer than that, whatever its sender writes into it.
inline constexpr int kCommandTicks = 3;
inline constexpr Duration kCommandLifeMin = std::chrono::milliseconds(5);
inline constexpr Duration kCommandLifeMax = std::chrono::milliseconds(30);
inline constexpr Duration kCommandFade = std::chrono::milliseconds(20);

/// @param tick  between two commands, positive  @return 5 ms at 600 Hz and above, 15 ms at 200 Hz, 30 ms at 100 Hz
[[nodiscard]] constexpr Duration command_life(Duration tick) noexcept {
  return std::clamp<Duration>(kCommandTicks * tick, kCommandLifeMin, kCommandLifeMax);
}

}  // namespace tandem
