#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "common/auth/enrolment.h"
#include "common/auth/ticket.h"
#include "tests/common/auth/support.h"

namespace tandem::test {

/// The answer to one command.
enum class Told : unsigned char {
  kNothing,  ///< not requested, or the process ended before it answered
  kYes,
  kNo,
};

/// The answers to one scripted run of a server in its state directory, a session in its checkpoint, and a workstation
/// in its own folder. Plain data in shared memory that outlives the writing process.
struct Story {
  static constexpr std::size_t kTickets = 4, kLines = 12;
  /// The ticket with this index is restored after its use.
  static constexpr std::size_t kGivenBack = 1;
  Told serving{}, code{}, enrolled{}, given_back{}, revoked{}, kept{}, workstation{}, remembered{};
  std::array<Told, kTickets> ticket{}, again{};  ///< `again`: second request after an internal error of the server
  std::array<Told, kLines> line{};
};

/// Creates the start of the story: `folder`/server with the workstation `w0` in its registry.
void prepare(const std::string& folder);
/// The parts of the story. Each continues after every error.
void live_server(const std::string& folder, Story& story);
void live_session(const std::string& folder, Story& story);
void live_workstation(const std::string& folder, Story& story);
/// A first start: `init` in `folder`/fresh. @return whether it reported success
[[nodiscard]] bool first_start(const std::string& folder);

[[nodiscard]] auth::Ticket story_ticket(std::size_t number);
[[nodiscard]] auth::TicketUse story_use(const auth::Ticket& ticket);
[[nodiscard]] auth::EnrolmentCode story_code();
[[nodiscard]] auth::KeyFingerprint story_pin(unsigned workstation);
/// Returns the text of audit line `number`.
[[nodiscard]] std::string story_line(std::size_t number);

}  // namespace tandem::test
