#pragma once

#include <algorithm>
#include <chrono>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "client/app/join_client.h"
#include "common/auth/io/control_client.h"
#include "common/auth/io/identity_selector.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

[[nodiscard]] inline std::unexpected<JoinError> join_failure(std::string reason) {
  return std::unexpected(JoinError{.reason = std::move(reason)});
}

/// Control connection from a client to the server of its options, before it becomes that of a seat or console: keys,
/// connect, requests. A server that does not answer is waited for at most for the timeout of the options, from the
/// begin of the connect or from its last answer on. Errors name cause and remedy.
class ServerConnection {
 public:
  /// @param options  must outlive this object
  explicit ServerConnection(const JoinOptions& options) : options_(options) {}

  /// Selects the keys and connects to the first of the addresses that answers (client/app/server_addresses.h). Repeats
  /// until the timeout while no server is started yet, or all are too busy.
  [[nodiscard]] std::expected<void, JoinError> connect();
  /// Connects once, only to the server that gave the seat `own`, which has the same key, or to one of its service. If
  /// that key was ephemeral, the server's key must be in this user's runtime directory.
  /// @param at  address to connect to
  [[nodiscard]] std::expected<void, ResumeError> connect_to(const ResumeState& own, const io::SocketAddress& at);
  /// Connects to the server to which the connected one sends this client, at most kHopsMax times. The server that is
  /// left must have vouched for a key of the known service, and the new one must show that key.
  /// @param seen  largest revision of the session's ownership so far; smaller ones are rejected
  [[nodiscard]] std::expected<void, JoinError> follow(const rpc::Elsewhere& to, std::uint64_t seen = 0);

  // @pre connected
  /// Sends a request and returns the reply, which may be an ErrorReply.
  [[nodiscard]] std::expected<rpc::Body, JoinError> ask(const rpc::Body& request);
  /// Sends a request and returns the reply of type `Reply`. Error also for an ErrorReply.
  template <class Reply>
  [[nodiscard]] std::expected<Reply, JoinError> request(const rpc::Body& body) {
    auto reply = ask(body);
    if (!reply) return std::unexpected(reply.error());
    return expect<Reply>(std::move(*reply));
  }
  /// Returns a reply of type `Reply`. Error for any other, such as an ErrorReply.
  template <class Reply>
  [[nodiscard]] std::expected<Reply, JoinError> expect(rpc::Body reply) const {
    if (const auto* rejected = std::get_if<rpc::ErrorReply>(&reply))
      return std::unexpected(JoinError{.reason = rejection_text(*rejected), .refused = rejected->code});
    if (auto* expected = std::get_if<Reply>(&reply)) return std::move(*expected);
    return join_failure(kUnexpectedReply);
  }
  [[nodiscard]] auth::ControlClient& client() noexcept { return *client_; }
  /// Returns the connection for the time after the join. Call once.
  [[nodiscard]] std::shared_ptr<auth::ControlClient> release() {
    return std::make_shared<auth::ControlClient>(std::move(*client_));
  }

  [[nodiscard]] const JoinOptions& options() const noexcept { return options_; }
  /// Address of the connected server.
  [[nodiscard]] const io::SocketAddress& address() const noexcept { return address_; }
  /// Service of the connected server; nullopt: it belongs to none that this workstation knows.
  [[nodiscard]] const std::optional<ServicePin>& service() const noexcept { return keys_->service(); }
  /// Stores the service of the connected server for later connections; logs a failure.
  void remember(const std::vector<std::string>& members) const;
  /// Keys of the server from this user's runtime directory; null: the server is known by enrolment.
  [[nodiscard]] const auth::LocalKeys* local() const noexcept { return keys_->local(); }
  /// Key of this workstation that the server knows. @pre connected
  [[nodiscard]] const auth::KeyFingerprint& workstation() const noexcept { return keys_->selected(); }
  /// Returns the instruction that starts a server at the address of the options.
  [[nodiscard]] std::string start_command() const;

  /// Time to wait for an answer: connect and reply together take at most the timeout, and 1 s more for a server that
  /// has accepted late. @param until  begin of the connect, or the last answer, and the timeout
  [[nodiscard]] static Duration answer_time(Time now, Time until, Duration timeout) noexcept {
    return std::max(std::min(timeout, Duration{std::chrono::seconds(1)}), until - now);
  }

  static constexpr int kHopsMax = 4;
  static constexpr const char* kUnexpectedReply = "unexpected reply from the server; use the same release on both";

 private:
  [[nodiscard]] std::expected<void, JoinError> select_keys();
  [[nodiscard]] std::expected<void, auth::ClientError> connect_once(const io::SocketAddress& at,
                                                                    const auth::ClientTls::IdentityCallback& judge,
                                                                    Duration timeout);
  [[nodiscard]] JoinError to_join_error(const auth::ClientError& error, const io::SocketAddress& at) const;
  [[nodiscard]] std::string rejection_text(const rpc::ErrorReply& reply) const;

  const JoinOptions& options_;
  io::SocketAddress address_ = options_.server;
  int hops_ = 0;
  Time until_{};                ///< end of the wait for the next answer
  std::uint64_t revision_ = 0;  ///< largest that a server has named
  std::optional<auth::IdentitySelector> keys_;
  std::optional<auth::ControlClient> client_;
};

}  // namespace tandem::client
