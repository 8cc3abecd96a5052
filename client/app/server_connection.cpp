#include "client/app/server_connection.h"

#include <poll.h>

#include <algorithm>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/signals.h"

namespace tandem::client {
namespace {

using rpc::ErrorCode;
using Kind = auth::ClientError::Kind;
using std::chrono::milliseconds;

constexpr int kRetryMs = 100;  // pause between attempts, for a server that is about to start

/// Consoles and link tests have no seat.
JoinError interrupted(const JoinOptions& options) {
  return {true, "ended by " + std::string(io::pending_signal()) +
                    (options.seat.empty() ? " before the server answered" : " before it had a seat")};
}

/// True if the server is not started yet, or too busy: it then closes the connection of an unknown client without a
/// reply.
bool may_pass(const auth::ClientError& error) {
  return error.kind == Kind::kUnreachable ||
         (error.kind == Kind::kStream &&
          (error.end == auth::StreamErrorCode::kClosed || error.end == auth::StreamErrorCode::kHandshake));
}

}  // namespace

std::expected<void, JoinError> ServerConnection::select_keys() {
  const auto path = auth::client_state_path(options_.state);
  std::optional<auth::ClientKeystore> enrolled;  // without a home directory only the runtime directory remains
  if (path) {
    auto own = auth::ClientKeystore::open(*path);
    if (!own) return join_failure(own.error());
    enrolled = std::move(*own);
  } else if (!options_.state.empty()) {
    return join_failure("--state: " + path.error());
  }
  keys_.emplace(io::to_text(options_.server), std::move(enrolled), auth::runtime_path());
  return {};
}

std::expected<void, JoinError> ServerConnection::connect() {
  if (auto keys = select_keys(); !keys) return keys;
  const Time until = io::monotonic_now() + options_.timeout;
  while (true) {
    const auto left = std::max(Duration{milliseconds(1)}, Duration{until - io::monotonic_now()});
    auto client = auth::ControlClient::connect(
        options_.server, [this](const auth::KeyFingerprint& fingerprint) { return (*keys_)(fingerprint); },
        std::chrono::duration_cast<milliseconds>(left), options_.signals);
    if (client) {
      client_.emplace(std::move(*client));
      return {};
    }
    if (!may_pass(client.error()) || io::monotonic_now() + milliseconds(kRetryMs) >= until)
      return std::unexpected(to_join_error(client.error()));
    pollfd signals{options_.signals, POLLIN, 0};
    if (poll(&signals, 1, kRetryMs) > 0) return std::unexpected(interrupted(options_));
  }
}

std::expected<void, ResumeError> ServerConnection::connect_to(const ResumeState& own) {
  if (!keys_) {
    if (own.local) {
      keys_.emplace(io::to_text(options_.server), std::nullopt, auth::runtime_path());
    } else if (auto keys = select_keys(); !keys) {
      return std::unexpected(ResumeError{ResumeError::Kind::kAgain, keys.error().reason, {}});
    }
  }
  const auto judge = [&](const auth::KeyFingerprint& fingerprint) -> std::expected<const auth::Identity*, std::string> {
    if (!own.local && fingerprint != own.server)
      return std::unexpected(io::to_text(options_.server) + " shows another key than the server that gave this seat");
    auto identity = (*keys_)(fingerprint);
    if (identity && own.local && local() == nullptr)
      return std::unexpected(std::string("this server is not the one that gave this seat"));
    return identity;
  };
  auto client = auth::ControlClient::connect(
      options_.server, judge, std::chrono::duration_cast<milliseconds>(options_.timeout), options_.signals);
  if (!client)
    return std::unexpected(ResumeError{
        client.error().kind == Kind::kInterrupted ? ResumeError::Kind::kInterrupted : ResumeError::Kind::kAgain,
        client.error().text,
        {}});
  client_.emplace(std::move(*client));
  return {};
}

std::expected<rpc::Body, JoinError> ServerConnection::ask(const rpc::Body& request) {
  auto reply = client_->ask(request, std::chrono::duration_cast<milliseconds>(options_.timeout));
  if (!reply) return std::unexpected(to_join_error(reply.error()));
  return std::move(*reply);
}

std::string ServerConnection::start_command() const {
  const std::string server = io::to_text(options_.server);
  return options_.server.loopback()
             ? "a server in another terminal first: `tandem-server run free_motion --listen " + server + "`"
             : "tandem-server on that computer first";
}

JoinError ServerConnection::to_join_error(const auth::ClientError& error) const {
  if (error.kind == Kind::kInterrupted) return interrupted(options_);
  const std::string server = io::to_text(options_.server), timeout = format("%g s", seconds(options_.timeout));
  if (error.kind == Kind::kUnreachable)
    return {false, "no server at " + server + ": nothing listens there (tried for " + timeout + "). Start " +
                       start_command() + ", and use the address it prints as `listening on`"};
  if (error.kind == Kind::kStream && error.end == auth::StreamErrorCode::kDeadline)
    return {false, "no answer from " + server + " within " + timeout +
                       "; check that a tandem-server of this version listens there, and that the network (or "
                       "tandem-netsim proxy) is up"};
  if (error.kind == Kind::kStream && error.end == auth::StreamErrorCode::kClosed)
    return {false, error.text + ", again and again for " + timeout +
                       ": too many clients join from this address, or the program at " + server +
                       " is not tandem-server"};
  return {false, complete_commands(error.text, options_)};
}

std::string ServerConnection::rejection_text(const rpc::ErrorReply& reply) const {
  switch (reply.code) {
    case ErrorCode::kNoSeat:
      return options_.console ? "refused: " + reply.text : "--seat " + options_.seat + ": " + reply.text;
    case ErrorCode::kSeatTaken:
      return (options_.seat.empty() ? "refused: " : "--seat " + options_.seat + ": ") + reply.text +
             "; take another seat, or wait until it is free (2 s after its owner fell silent)";
    case ErrorCode::kDeviceUnfit:
      return "the device does not fit this scene: " + reply.text;
    case ErrorCode::kSessionOver:
      return reply.text + "; start the server again";
    default:
      return "refused: " + reply.text;
  }
}

}  // namespace tandem::client
