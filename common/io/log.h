#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// Logging of all programs. Only log.cpp includes spdlog.
namespace tandem::io {

enum class Level : std::uint8_t { kInfo, kWarn, kError };

/// Makes the default logger write to standard error, with the program's name before each line: standard output is for
/// results. For non-real-time threads only, because spdlog takes a lock.
void log_to_stderr(const char* program);

/// Logs a line for users.
void log(Level level, const std::string& text);

/// Switches to one JSON object per line on standard error, for a journal. Members: `ts` (UTC), `mono` [s of
/// CLOCK_MONOTONIC], `level`, `event`, and where known `session`, `seat`, `cid`, `tick`, `text`. A separate thread
/// writes; if it cannot keep up, the oldest lines are dropped and counted. Plain text lines get the event `message`.
/// @param least  lowest level that is logged
void log_as_json(Level least);
/// Returns whether `log_as_json` is active.
[[nodiscard]] bool logs_json() noexcept;
/// Returns the number of dropped lines so far.
[[nodiscard]] std::uint64_t log_dropped();
/// Waits until all lines are written, and ends the thread. Call before the program ends.
void stop_log();

/// Structured log event. It must not contain secrets or names of users.
struct LogEvent {
  std::string event;  ///< one word
  std::string session{}, seat{};
  std::optional<std::uint32_t> cid{};
  std::optional<std::uint64_t> tick{};
  std::string text{};  ///< for users
};
/// Logs an event; has an effect only after `log_as_json`, because terminals show other messages.
void log_event(Level level, const LogEvent& happening);

}  // namespace tandem::io
