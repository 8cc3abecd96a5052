#include "client/app/server_connection.h"

#include <poll.h>

#include <algorithm>

#include "client/app/server_addresses.h"
#include "common/auth/service_pin.h"
#include "common/base/command_hints.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "common/io/signals.h"

namespace tandem::client {
namespace {

using rpc::ErrorCode;
using Kind = auth::ClientError::Kind;
using std::chrono::milliseconds;

constexpr int kRetryMs = 100;                        // pause between attempts, for a server that is about to start
constexpr milliseconds kTryMin{100}, kTryMax{1500};  // for one of several addresses

/// Consoles and link tests have no seat.
JoinError interrupted(const JoinOptions& options) {
  return {true, "ended by " + std::string(io::pending_signal()) +
                    (options.seat.empty() ? " before the server answered" : " before it had a seat")};
}

/// The server still answers: only its session ends. It may begin another one.
std::string session_over_text(const rpc::ErrorReply& reply, const JoinOptions& options) {
  return "refused: " + reply.text +
         ", and takes no participants any more. Ask its operator whether another one begins; " +
         with_options("`tandem-client sessions` lists the open ones", "tandem-client sessions",
                      " --server " + io::to_text(options.server) + state_option(options.state));
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

std::expected<void, auth::ClientError> ServerConnection::connect_once(const io::SocketAddress& at,
                                                                      const auth::ClientTls::IdentityCallback& judge,
                                                                      Duration timeout) {
  keys_->set_address(io::to_text(at));
  auto client = auth::ControlClient::connect(
      at, judge, std::max(milliseconds(1), std::chrono::duration_cast<milliseconds>(timeout)), options_.signals);
  if (!client) return std::unexpected(std::move(client.error()));
  client_.emplace(std::move(*client));
  address_ = at;
  return {};
}

std::expected<void, JoinError> ServerConnection::connect() {
  if (auto keys = select_keys(); !keys) return keys;
  hops_ = 0;
  // A drain ends the server to which it goes, so that it goes only to those that the user named.
  ServerAddresses addresses = addresses_to_try(options_, options_.drains ? std::vector<ServerRow>{} : keys_->known());
  const bool several = addresses.size() > 1;
  const Duration each =
      several ? std::clamp(options_.timeout / static_cast<int>(addresses.size()), Duration{kTryMin}, Duration{kTryMax})
              : options_.timeout;
  const Time until = until_ = io::monotonic_now() + options_.timeout;
  std::vector<auth::ClientError> failures;
  while (true) {
    addresses.begin(each, until);
    bool again = false;
    for (std::size_t i = 0; addresses.has(i); ++i) {
      const Duration left = std::min(each, std::max(Duration{kTryMin}, Duration{until - io::monotonic_now()}));
      auto connected = connect_once(
          addresses[i], [this](const auth::PresentedKey& server) { return (*keys_)(server); },
          several ? left : Duration{until - io::monotonic_now()});
      if (connected) return {};
      failures.resize(std::max(failures.size(), i + 1));
      failures[i] = std::move(connected.error());
      if (failures[i].kind == Kind::kInterrupted) return std::unexpected(interrupted(options_));
      again = again || may_pass(failures[i]);
    }
    if (addresses.interrupted()) return std::unexpected(interrupted(options_));
    again = again || addresses.pending();
    if (!again || io::monotonic_now() + milliseconds(kRetryMs) >= until) break;
    pollfd signals{options_.signals, POLLIN, 0};
    if (poll(&signals, 1, kRetryMs) > 0) return std::unexpected(interrupted(options_));
  }
  std::string unresolved = addresses.unresolved();
  if (!options_.unresolved.empty()) unresolved = options_.unresolved + (unresolved.empty() ? "" : "; ") + unresolved;
  if (failures.size() == 1) {
    JoinError one = to_join_error(failures[0], addresses[0]);
    if (!unresolved.empty()) one.reason += "; " + unresolved;
    return std::unexpected(std::move(one));
  }
  std::string all =
      format("none of %zu addresses has a server that this client can use (tried for %g s):", failures.size(),
             seconds(options_.timeout));
  for (std::size_t i = 0; i < failures.size(); ++i)
    all += "\n  " + io::to_text(addresses[i]) + ": " + complete_commands(failures[i].text, options_);
  if (!unresolved.empty()) all += "\n  " + unresolved;
  return join_failure(std::move(all));
}

std::expected<void, ResumeError> ServerConnection::connect_to(const ResumeState& own, const io::SocketAddress& at) {
  if (!keys_) {
    if (own.local) {
      keys_.emplace(io::to_text(at), std::nullopt, auth::runtime_path());
    } else if (auto keys = select_keys(); !keys) {
      return std::unexpected(ResumeError{.kind = ResumeError::Kind::kAgain, .reason = keys.error().reason});
    }
  }
  const auto judge = [&](const auth::PresentedKey& shown) -> std::expected<const auth::Identity*, std::string> {
    auto identity = (*keys_)(shown);
    const bool same = own.local || static_cast<const auth::KeyFingerprint&>(shown) == own.server ||
                      (own.service && keys_->service() && auth::same_service(*keys_->service(), *own.service));
    if (!same) {
      if (!own.service)
        return std::unexpected(io::to_text(at) + " shows another key than the server that gave this seat");
      // The service may have changed its key more than once since the seat was taken; its statements prove each change.
      if (const auto member = auth::accept_member(shown.credential, *own.service, shown, auth::wall_seconds()); !member)
        return std::unexpected(io::to_text(at) + ": " + member.error());
    }
    if (identity && own.local && local() == nullptr)
      return std::unexpected(std::string("this server is not the one that gave this seat"));
    return identity;
  };
  until_ = io::monotonic_now() + options_.timeout;
  if (auto connected = connect_once(at, judge, options_.timeout); !connected)
    return std::unexpected(ResumeError{
        .kind =
            connected.error().kind == Kind::kInterrupted ? ResumeError::Kind::kInterrupted : ResumeError::Kind::kAgain,
        .reason = connected.error().text,
        .distrust = connected.error().kind == Kind::kRefusedKey ? complete_commands(connected.error().text, options_)
                                                                : std::string{}});
  return {};
}

std::expected<void, JoinError> ServerConnection::follow(const rpc::Elsewhere& to, std::uint64_t seen) {
  const std::string from = "the server at " + io::to_text(address_) + " sends this client to " + to.address;
  if (++hops_ > kHopsMax)
    return join_failure(from + ", the " + std::to_string(hops_) +
                        "th server: those of the service disagree about the session; try again in a moment");
  if (to.revision < std::max(seen, revision_))
    return join_failure(from +
                        format(" for revision %llu of the session, and %llu is known: that server had it earlier; "
                               "try again in a moment",
                               static_cast<unsigned long long>(to.revision),
                               static_cast<unsigned long long>(std::max(seen, revision_))));
  if (!keys_->service())
    return join_failure(from +
                        ", but this workstation has no key of its service: enrol it again at one of its servers");
  const auth::KeyFingerprint key{to.key};
  if (const auto member = auth::accept_sent_member(to.voucher, *keys_->service(), key, auth::wall_seconds()); !member)
    return join_failure(from + ": " + member.error());
  ServerAddresses addresses{options_};
  addresses.add(to.address);
  const auto time_left = [this] { return answer_time(io::monotonic_now(), until_, options_.timeout); };
  addresses.begin(time_left());
  if (!addresses.has(0) && !addresses.interrupted() && !addresses.pending())
    return join_failure(from + ", a name without address; check the DNS server");
  revision_ = to.revision;
  const auto judge = [&](const auth::PresentedKey& shown) -> std::expected<const auth::Identity*, std::string> {
    if (static_cast<const auth::KeyFingerprint&>(shown) != key)
      return std::unexpected(to.address + " shows another key than the one that its service vouches for");
    return (*keys_)(shown);
  };
  std::string why = addresses.unresolved();
  for (std::size_t i = 0; addresses.has(i); ++i) {
    const auto connected = connect_once(addresses[i], judge, time_left());
    if (connected) return {};
    if (connected.error().kind == Kind::kInterrupted) return std::unexpected(interrupted(options_));
    why += (why.empty() ? "" : "; ") + connected.error().text;
  }
  if (addresses.interrupted()) return std::unexpected(interrupted(options_));
  keys_->set_address(io::to_text(address_));  // of the connection that stays
  --hops_;
  return std::unexpected(JoinError{.reason = from + ": " + why, .owner_unreachable = true});
}

void ServerConnection::remember(const std::vector<std::string>& members) const {
  if (const std::string problem = keys_->store_service(members); !problem.empty())
    io::log(io::Level::kWarn, "the servers of this service cannot be stored for later joins: " + problem);
}

std::expected<rpc::Body, JoinError> ServerConnection::ask(const rpc::Body& request) {
  auto reply = client_->ask(
      request, std::chrono::ceil<milliseconds>(answer_time(io::monotonic_now(), until_, options_.timeout)));
  if (!reply) return std::unexpected(to_join_error(reply.error(), address_));
  until_ = io::monotonic_now() + options_.timeout;
  return std::move(*reply);
}

std::string ServerConnection::start_command() const {
  const std::string server = io::to_text(options_.server);
  return options_.server.loopback()
             ? "a server in another terminal first: `tandem-server run free_motion --listen " + server + "`"
             : "tandem-server on that computer first";
}

JoinError ServerConnection::to_join_error(const auth::ClientError& error, const io::SocketAddress& at) const {
  if (error.kind == Kind::kInterrupted) return interrupted(options_);
  const std::string server = io::to_text(at), timeout = format("%g s", seconds(options_.timeout));
  if (error.kind == Kind::kUnreachable)
    return {.reason = "no server at " + server + ": nothing listens there (tried for " + timeout + "). Start " +
                      start_command() + ", and use the address it prints as `listening on`",
            .absent = error.absent};
  if (error.kind == Kind::kStream && error.end == auth::StreamErrorCode::kDeadline)
    return {.reason = "no answer from " + server + " within " + timeout +
                      "; check that a tandem-server of this version listens there, and that the network (or "
                      "tandem-netsim proxy) is up"};
  if (error.kind == Kind::kStream && error.end == auth::StreamErrorCode::kClosed)
    return {.reason = error.text + ", again and again for " + timeout +
                      ": too many clients join from this address, or the program at " + server +
                      " is not tandem-server"};
  return {.reason = complete_commands(error.text, options_)};
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
      return session_over_text(reply, options_);
    default:
      return "refused: " + reply.text;
  }
}

}  // namespace tandem::client
