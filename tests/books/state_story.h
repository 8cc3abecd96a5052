#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "common/trust/enrolment.h"
#include "common/trust/ticket.h"
#include "tests/trust/support.h"

namespace tandem::test {

/// What somebody was told about one order.
enum class Told : unsigned char {
  kNothing,   ///< not asked, or the process ended before it answered
  kYes,
  kNo,
};

/// A server's life in a state folder, a session's in its checkpoint, a workstation's in its own folder: what each was told. Plain data in memory that outlives the process that tells.
struct Story {
  static constexpr std::size_t kTickets = 4, kLines = 12;
  /// Of these the ticket's use is taken back.
  static constexpr std::size_t kGivenBack = 1;
  Told serving{}, code{}, enrolled{}, given_back{}, revoked{}, kept{}, workstation{}, remembered{};
  std::array<Told, kTickets> ticket{}, again{};  ///< `again`: asked once more after a refusal that was the server's own trouble
  std::array<Told, kLines> line{};
};

/// Makes what the story begins with: `folder`/server with the workstation `w0` in its book.
void prepare(const std::string& folder);
/// The parts of the story. Each goes on after every refusal.
void live_server(const std::string& folder, Story& story);
void live_session(const std::string& folder, Story& story);
void live_workstation(const std::string& folder, Story& story);
/// A first start: `init` in `folder`/fresh. @return whether it said yes
[[nodiscard]] bool first_start(const std::string& folder);

[[nodiscard]] trust::Ticket story_ticket(std::size_t number);
[[nodiscard]] trust::TicketUse story_use(const trust::Ticket& ticket);
[[nodiscard]] trust::EnrolmentCode story_code();
[[nodiscard]] trust::Pin story_pin(unsigned workstation);
/// What audit line number `number` says.
[[nodiscard]] std::string story_line(std::size_t number);

}  // namespace tandem::test
