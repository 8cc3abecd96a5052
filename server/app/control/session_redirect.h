#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "server/app/control/session_locator.h"
#include "server/app/control/session_registry.h"

namespace tandem::server {

/// Reply to a request for a session that a server of the service is about to serve.
[[nodiscard]] rpc::ErrorReply being_taken_over();

/// Answers requests for sessions that other servers of the service own. Without a locator it answers none: the server
/// belongs to no service. Control plane's thread.
class SessionRedirect {
 public:
  using Reply = std::variant<rpc::Elsewhere, rpc::ErrorReply>;

  explicit SessionRedirect(SessionRegistry& registry) : registry_(registry) {}

  /// @param locator  must outlive this object; null: none
  /// @param name     of this server in its service
  void set_locator(SessionLocator* locator, std::string name) {
    locator_ = locator;
    name_ = std::move(name);
  }

  /// Returns the reply to a request that names a session which this server does not serve.
  /// @param understands  the client follows an Elsewhere; others get its address in the text of an error
  /// @return nullopt: this server decides alone
  [[nodiscard]] std::optional<Reply> find(const rpc::SessionChoice& choice, bool understands);
  /// Whether a server of the service, perhaps this one, is about to serve the session.
  [[nodiscard]] bool is_coming(const rpc::SessionChoice& choice);
  /// Whether this server belongs to a service whose directory answers, through which enrolments arrive.
  [[nodiscard]] bool learns_enrolments() const { return locator_ != nullptr && locator_->fresh(); }
  /// The reply to a join by a choice that names no session of this server (`own`), with the sessions of the service in
  /// its text. A wrong code counts as an attempt also at a server without a session.
  [[nodiscard]] rpc::ErrorReply refusal(const rpc::SessionChoice& choice, const rpc::ErrorReply& own) const;
  /// The reply to a join while this server drains.
  [[nodiscard]] rpc::ErrorReply draining() const;
  /// One page of the sessions. @param request  with `service`: those of this server first, then all others by name
  [[nodiscard]] rpc::SessionList list(const rpc::SessionListRequest& request) const;
  /// Addresses of servers of the service, at most kMembersMax; empty: it has none.
  [[nodiscard]] std::vector<std::string> members() const;

 private:
  [[nodiscard]] bool is_served_here(const rpc::SessionChoice& choice);
  [[nodiscard]] std::optional<Reply> only_session(bool understands);
  [[nodiscard]] std::optional<Reply> located(const rpc::SessionChoice& choice, bool understands);
  [[nodiscard]] std::vector<SessionLocator::Elsewhere> others() const;

  SessionRegistry& registry_;
  SessionLocator* locator_ = nullptr;
  std::string name_;
};

}  // namespace tandem::server
