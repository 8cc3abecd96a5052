#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tandem::io {

/// Makes the default logger write to standard error, each line beginning with the program's name: standard output
/// belongs to results. For ordinary threads only; spdlog takes a lock.
void log_to_stderr(const char* program);

enum class Level : std::uint8_t { kInfo, kWarn, kError };

/// From now on one JSON object per line on standard error, for a journal: `ts` (UTC), `mono` [s of CLOCK_MONOTONIC], `level`, `event`, and
/// what is known of `session`, `seat`, `cid`, `tick`, `text`. A thread of its own writes; when it cannot keep up the oldest lines go and
/// are counted. What was logged by text only has the event `message`.
/// @param least  this level and graver
void log_as_json(Level least);
/// Whether that is so.
[[nodiscard]] bool logs_json() noexcept;
/// Lines that were dropped so far.
[[nodiscard]] std::uint64_t log_dropped();
/// Waits until everything is written, and ends the thread. Before the program ends.
void end_log();

/// Something that happened. No secrets, no names of people.
struct Happening {
  std::string event;                   ///< one word
  std::string session{}, seat{};
  std::optional<std::uint32_t> cid{};
  std::optional<std::uint64_t> tick{};
  std::string text{};                  ///< for a person
};
/// Only with `log_as_json`: people at a terminal are told otherwise.
void tell(Level level, const Happening& happening);

}  // namespace tandem::io
