#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>

#include "common/trust/io/server_trust.h"
#include "common/trust/limiter.h"
#include "common/trust/link_context.h"
#include "proto/control_messages.h"

namespace tandem::server {

/// Somebody who asks to join: his workstation is enrolled (as of this very moment) and has proven its key.
struct JoinRequest {
  control::Hello hello;
  std::uint32_t version = 0;   ///< of the protocol: the highest that both know
  WorkstationRow workstation;
  trust::Source source;
  std::string address;         ///< for logs
};

using Admission = std::variant<control::Welcome, control::Refused>;

/// Who decides about sessions and seats. All calls come from the control plane's thread; none may block. Answers may be given at once or
/// later, from any thread, once, and not after the control plane's io_context is gone.
/// Tickets: `ServerTrust::redeem` and `refusal_of`, from the control plane's thread, as late as possible: a ticket that was redeemed is used, until
/// `ServerTrust::give_back` says that nothing came of it.
class Admissions {
 public:
  virtual ~Admissions() = default;

  /// Finds session and seat and judges the credential. For a Welcome the seat is held from now on.
  virtual void admit(const JoinRequest& request, std::function<void(Admission)> answer) = 0;
  /// Just before a Welcome is sent: the secrets of the seat's datagrams. From now on datagrams under them may come.
  virtual void seated(const JoinRequest& request, const control::Welcome& welcome, const Secret<trust::kExportSize>& secrets) = 0;
  /// A Welcome that could not be sent any more: the seat is free again.
  virtual void abandoned(const control::Welcome& welcome) = 0;

  [[nodiscard]] virtual control::SessionList list(const WorkstationRow& workstation) = 0;

  /// Stop, pause, resume, authority, drain, by somebody who was welcomed on this connection. Answer: Done, AuthorityAnswer or Refused.
  virtual void command(const control::Welcome& standing, const WorkstationRow& workstation, const control::Body& command,
                       std::function<void(control::Body)> answer) = 0;
  /// Whether a Welcome is still in force: the seat was not given to another connection or taken away, the session is not over. Afterwards the
  /// connection is as good as one that never joined.
  [[nodiscard]] virtual bool holds(const control::Welcome& standing) const = 0;
  /// The control connection of somebody who was welcomed is over. His seat lives on by its datagrams.
  /// @param in_vain  whatever he ordered was refused, but looks: he may have mistaken a word or his role
  virtual void left(const control::Welcome& standing, bool in_vain) = 0;
};

/// What a person is told of a ticket that was refused.
[[nodiscard]] inline control::Refused refusal_of(const trust::ServerTrust::TicketTrouble& trouble) {
  if (trouble.fault) return {control::Reason::kTicket, trouble.text, 0};
  return {control::Reason::kTrouble, "the server cannot write down that a ticket is used, so it lets nobody in by one; the ticket stays good. Ask who looks after the server: its log says more", 0};
}

}  // namespace tandem::server
