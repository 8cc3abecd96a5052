#pragma once

#include <expected>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "server/app/control/join_handler.h"
#include "server/app/control/session_commands.h"
#include "server/app/control/session_redirect.h"
#include "server/app/control/session_registry.h"
#include "server/app/control/ticket_redemption.h"
#include "server/policy/admission_control.h"
#include "server/policy/new_client_load.h"

namespace tandem::server {

/// Decides joins of seats, consoles and link tests, and passes the commands of joined connections on. All members run
/// on the control plane's thread. The state of seats and slots is queried from the shard; that reply comes later.
class SessionJoins final : public JoinHandler {
 public:
  /// @param trust       redeems tickets
  /// @param limits      load of a shard above which its sessions reject new joins
  /// @param on_message  receives failures of the server itself, one line each, for its operator
  SessionJoins(SessionRegistry& registry, SessionCommands& commands, auth::ServerKeystore& trust,
               const LoadLimits& limits = {}, std::function<void(const std::string&)> on_message = {});

  /// As `SessionRedirect::set_locator`.
  void set_locator(SessionLocator* locator, std::string name) { redirect_.set_locator(locator, std::move(name)); }
  /// As `TicketRedemption::set_uses`.
  void set_ticket_uses(TicketUses* uses) { tickets_.set_uses(uses); }
  /// Makes the tickets of a session's consoles valid again, because another server is about to serve the session. The
  /// consoles lose their connections here.
  void release_consoles(SessionEntry& entry);
  void admit(const JoinRequest& request, std::function<void(JoinReply)> answer) override;
  void on_joined(const JoinRequest& request, const rpc::Welcome& welcome,
                 const Secret<auth::kExportSize>& secrets) override;
  void on_join_failed(const rpc::Welcome& welcome) override;
  [[nodiscard]] bool is_coming(const rpc::SessionChoice& session) override { return redirect_.is_coming(session); }
  [[nodiscard]] bool learns_enrolments() const override { return redirect_.learns_enrolments(); }
  [[nodiscard]] rpc::SessionList list(const rpc::SessionListRequest& request) override {
    return redirect_.list(request);
  }
  [[nodiscard]] std::vector<std::string> members() const override { return redirect_.members(); }
  void command(const rpc::Welcome& joined, const WorkstationRow& workstation, rpc::Body command,
               std::function<void(rpc::Body)> answer) override;
  [[nodiscard]] bool is_current(const rpc::Welcome& joined) const override;
  void on_disconnected(const rpc::Welcome& joined, bool in_vain) override;

 private:
  void join_console(SessionEntry& entry, const JoinRequest& request, std::function<void(JoinReply)> answer);
  /// Redeems the ticket of a console, or finds the right of one that comes back. @param place  in its connection id
  [[nodiscard]] JoinReply admit_console(SessionEntry& entry, const JoinRequest& request, std::uint8_t place);
  void join_link_test(SessionEntry& entry, const JoinRequest& request, std::function<void(JoinReply)> answer);
  void join_seat(SessionEntry& entry, const JoinRequest& request, std::function<void(JoinReply)> answer);
  /// Decides after the session has reported the state of the seat. A ticket is redeemed last, because it is then used.
  [[nodiscard]] JoinReply decide_seat(SessionEntry& entry, const JoinRequest& request, const ShardRequest& asked);
  /// Which of the seat's resume secrets the client showed. @return nullopt: it showed another credential
  [[nodiscard]] std::optional<SeatReservation::ResumeMatch> resume_match(const SeatReservation& seat,
                                                                         const JoinRequest& request) const;
  /// Error reply for a seat that another client has. A client whose ticket was used waits for the seat in vain.
  [[nodiscard]] rpc::ErrorReply taken_or_used(const SessionEntry& entry, const JoinRequest& request,
                                              std::size_t seat) const;
  /// Returns the reply to a join as it is sent if the session may have been given up to another server meanwhile: the
  /// client asks there, with the same credential.
  [[nodiscard]] std::function<void(JoinReply)> unless_given_up(const rpc::Id& session, const rpc::Credential& by,
                                                               std::function<void(JoinReply)> answer);
  /// A Welcome is not sent: its seat is free and its ticket valid again, also if the session is not here any more.
  void take_back(const rpc::Welcome& welcome, const rpc::Credential& by);
  void stop_watching(SessionEntry& entry, const rpc::Welcome& joined);
  /// Error reply if the shard or the machine is too busy for a new join; nullopt if not.
  [[nodiscard]] std::optional<rpc::ErrorReply> overload_reply(const SessionEntry& entry);

  SessionRegistry& registry_;
  SessionCommands& commands_;
  SessionRedirect redirect_{registry_};
  auth::ServerKeystore& trust_;
  TicketRedemption tickets_;
  LoadLimits limits_;
  std::map<const Shard*, NewClientLoad> new_clients_;  ///< at most one entry per shard
};

}  // namespace tandem::server
