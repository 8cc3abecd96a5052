#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "proto/control_messages.h"

namespace tandem::client {

/// What a person wants of a session, as typed after `control` or on a line of its console.
struct Wish {
  enum class What : std::uint8_t { kStatus, kStop, kPause, kResume, kAuthority, kRemove, kDrain, kHelp, kQuit };
  What what = What::kStatus;
  std::string why;                    ///< kStop, kPause, kRemove
  std::optional<std::uint32_t> stop;  ///< kResume; nothing: the one there is when it is asked
  std::vector<std::pair<std::string, double>> weights;  ///< kAuthority: by seat; who is not named gets 0
  std::string tool;                   ///< kAuthority; empty: the only one
  std::optional<std::uint32_t> version;  ///< kAuthority: that it replaces; nothing: the one there is when it is asked
  std::string seat;                   ///< kRemove
  std::uint32_t grace_s = 0;          ///< kDrain
};

/// @return the wish, or what is wrong with the words and what they should be
[[nodiscard]] std::expected<Wish, std::string> understand(std::span<const std::string> words);
/// Every order with its words, one per line.
[[nodiscard]] const char* control_words_help() noexcept;
/// The least role that may have it: who writes his own ticket, on the server's own computer, asks for this one.
[[nodiscard]] AccessRole role_for(Wish::What what) noexcept;

/// The frame of a weight wish against how the session stands now. @return or what is wrong: a seat or tool there is not, weights that
/// are not together 1
[[nodiscard]] std::expected<control::SetAuthority, std::string> authority_frame(const Wish& wish, const control::Status& status);

/// `trainer 0.50, trainee 0.50`; only who has some, or everybody.
[[nodiscard]] std::string weights_text(const control::Status& status, std::span<const double> alpha);
/// Whether the session is paused or stopped.
[[nodiscard]] bool is_stopped(const control::Status& status) noexcept;
/// Who stopped it, why, and who may end it, one line: `STOPPED by desk (operator): fire drill. Who may end it: ...`. Words of others are
/// shown as `printable` does.  @pre is_stopped(status)
[[nodiscard]] std::string stop_text(const control::Status& status);
/// `DRAINING: 27 s left, 2 sessions, 3 people on their seats`
[[nodiscard]] std::string drain_text(const control::StatusDrain& drain);
/// What somebody who looked before should be told now, line by line: resumes and removals and by whom, a new stop, how far a drain is (each ten
/// seconds, and each of the last five). Empty: nothing.
[[nodiscard]] std::string news_text(const control::Status& before, const control::Status& now);
/// How a session stands, for people: one line, then one per seat and per tool.
[[nodiscard]] std::string status_text(const control::Status& status);
/// `{"session", "id", "phase", "time_s", "stops", "authority_version", "draining", "seats": [{"name", "role", "taken", "heard"}],
/// "tools": [{"name", "alpha": {SEAT: WEIGHT}}], "stop": null or {"number", "kind", "seat", "workstation", "role", "why", "ago_s", "ends",
/// "yours"}, "drain": null or {"left_s", "sessions", "people"}, "held": null or why no tool moves}`
[[nodiscard]] std::string status_json(const control::Status& status);

}  // namespace tandem::client
