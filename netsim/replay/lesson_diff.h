#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "proto/spec/lesson.h"

namespace tandem::netsim {

/// Largest difference that is allowed on a channel.
struct DiffLimit {
  /// `/tool/measured_cp`; or its last part, `measured_cp`, for all seats and tools; `/session/rows`: rows that only one
  /// recording has.
  std::string channel;
  double most = 0;  ///< absolute, in the channel's unit (SI; energies in nJ or J as their name says)
};
/// Parses `CHANNEL=VALUE`. Error: the text and what it must be.
[[nodiscard]] std::expected<DiffLimit, std::string> parse_diff_limit(std::string_view text);

/// How far two recordings are apart on one channel.
struct ChannelDifference {
  std::string channel;
  std::string field;       ///< with the largest difference
  double largest = 0;      ///< absolute; infinite if only one of the two is a number
  std::uint32_t tick = 0;  ///< session tick of the largest difference
  double a = 0, b = 0;     ///< the two values there
  std::uint64_t rows = 0;  ///< rows that differ in any bit
  double limit = 0;
  [[nodiscard]] bool beyond() const noexcept { return !(largest <= limit); }
};

struct LessonDiff {
  std::uint64_t rows = 0;                   ///< ticks that both have
  std::uint64_t only_a = 0, only_b = 0;     ///< ticks that one has
  std::vector<ChannelDifference> channels;  ///< those that differ, in the order of the scene
  [[nodiscard]] bool within() const noexcept;
};

/// Compares two recordings tick by tick.
/// @return why they cannot be compared: other seats or tools, or a limit for a channel that they do not have
[[nodiscard]] std::expected<LessonDiff, std::string> diff_lessons(const Lesson& a, const Lesson& b,
                                                                  const std::vector<DiffLimit>& limits);

}  // namespace tandem::netsim
