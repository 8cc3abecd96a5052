#pragma once

#include <optional>
#include <string>

#include "client/app/client_status.h"
#include "proto/control_messages.h"

namespace tandem::client {

/// Who gives what to whom, from which part to which, when it begins and how long it takes, or that it was called off; empty: nothing.
/// `trainer gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 1.0 s`
/// @param words  what the server said last over the control connection; nothing: it was not heard there
[[nodiscard]] std::string handover_text(const ClientStatus& status, const SeatSetup& setup, const std::optional<control::Status>& words);
/// The same for a narrow screen, without names: `more weight in 50 ms`.
[[nodiscard]] std::string handover_brief(const ClientStatus& status);

/// Lasting lines about hand-overs, at most one a second. Changes that follow each other faster, such as a key that repeats, are told as one:
/// from the part before the first of them to the part after the last.
class HandoverNotes {
 public:
  static constexpr double kBetween = 1;  ///< [s]

  /// Call often. @param now_s  any clock [s]  @return the line that is due; empty: none is
  [[nodiscard]] std::string say(double now_s, const ClientStatus& status, const SeatSetup& setup, const std::optional<control::Status>& words);

 private:
  std::optional<ClientStatus> untold_;
  std::optional<double> told_at_s_;
  std::uint32_t seen_ = 0;
};

}  // namespace tandem::client
