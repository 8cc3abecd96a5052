#include "client/app/join_client.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <utility>

#include "client/app/drain_target.h"
#include "client/app/join_hello.h"
#include "client/app/server_addresses.h"
#include "client/app/server_connection.h"
#include "client/seat/seat.h"
#include "common/base/command_hints.h"
#include "common/io/clock.h"
#include "proto/rpc/session_pages.h"
#include "proto/text/scene_bytes.h"

namespace tandem::client {
namespace {

constexpr int kOwnerRetryMs = 300;
constexpr Duration kComingMax = std::chrono::seconds(4);      // at one server: it may be cut off from the directory
constexpr Duration kMemberTimeout = std::chrono::seconds(1);  // for one of several servers of a service

struct Accepted {
  rpc::Hello hello;
  rpc::Welcome welcome;
};
/// Whether another server is about to serve the session: it says so, or the one that had it does not answer.
bool is_coming(const std::expected<rpc::Body, JoinError>& reply) {
  if (!reply) return reply.error().owner_unreachable;
  const auto* rejected = std::get_if<rpc::ErrorReply>(&*reply);
  return rejected != nullptr && rejected->code == rpc::ErrorCode::kNotNow;
}
/// Waits before the next request for such a session. A server of this version has waited itself before it answered.
/// @param asked  time of the last request  @return false: a signal
bool wait_for_owner(const JoinOptions& options, Time asked) {
  const auto waited = std::chrono::duration_cast<std::chrono::milliseconds>(io::monotonic_now() - asked).count();
  pollfd signals{options.signals, POLLIN, 0};
  return ::poll(&signals, 1, std::max(0, kOwnerRetryMs - static_cast<int>(waited))) <= 0;
}

/// Asks for the session at its owner, to which the servers of the service send this client. While a server is about to
/// serve it, the same connection asks again: a new one each time would soon exceed what a server accepts from an
/// address.
/// @param seen    as `ServerConnection::follow`
/// @param until   end of the waiting
/// @param wanted  whether to go on waiting
/// @return `is_coming` if the time is over, or the server has closed the connection; Elsewhere to a join for a drain
std::expected<rpc::Body, JoinError> ask_owner(ServerConnection& server, const rpc::Hello& hello, std::uint64_t seen,
                                              Time until, const std::function<bool()>& wanted) {
  std::optional<std::expected<rpc::Body, JoinError>> coming;
  while (true) {
    const Time asked = io::monotonic_now();
    auto reply = server.ask(hello);
    if (!reply && coming && !reply.error().interrupted) return std::move(*coming);
    const auto* elsewhere = reply ? std::get_if<rpc::Elsewhere>(&*reply) : nullptr;
    if (elsewhere != nullptr && server.options().drains) return reply;
    if (elsewhere != nullptr) {
      auto followed = server.follow(*elsewhere, seen);
      if (followed) {
        coming.reset();
        continue;
      }
      reply = std::unexpected(std::move(followed.error()));
    }
    if (!is_coming(reply) || io::monotonic_now() >= until || !wanted() || !wait_for_owner(server.options(), asked))
      return reply;
    coming = std::move(reply);
  }
}

/// The control connection of a console that was accepted.
Console console_of(ServerConnection& server, const Accepted& accepted) {
  const bool service = server.service().has_value();
  return {accepted.welcome, server.release(), server.workstation(), service, server.address()};
}

/// Why a join for a drain ends at a server that sends it to another one.
std::string drain_elsewhere(ServerConnection& server, const rpc::Elsewhere& to) {
  DrainTarget target{"", to.address, true, {io::to_text(server.address())}};
  const auto list = rpc::all_sessions([&](const rpc::Body& page) { return server.request<rpc::SessionList>(page); },
                                      server.service().has_value());
  if (list)
    for (const rpc::ListedSession& s : list->sessions)
      if (s.name == to.session) target.name = s.server;
  return drain_problem(server.options(), target, to.session);
}

/// Connects, sends the join request and returns it with the server's Welcome. Follows the servers of a service to the
/// owner of the session, and waits for it up to the timeout.
std::expected<Accepted, JoinError> request_join(ServerConnection& server) {
  const Time until = io::monotonic_now() + server.options().timeout;
  if (auto connected = server.connect(); !connected) return std::unexpected(connected.error());
  server.remember({});
  if (server.options().drains)
    if (auto problem =
            drain_problem(server.options(), {"", io::to_text(server.address()), server.service().has_value()}, "");
        !problem.empty())
      return join_failure(std::move(problem));
  auto hello = make_hello(server);
  if (!hello) return std::unexpected(hello.error());
  while (true) {
    auto reply = ask_owner(server, *hello, 0, until, [] { return true; });
    if (is_coming(reply) && io::monotonic_now() < until) {
      if (auto connected = server.connect(); !connected) return std::unexpected(connected.error());
      continue;
    }
    if (!reply) return std::unexpected(reply.error());
    if (const auto* elsewhere = std::get_if<rpc::Elsewhere>(&*reply))
      return join_failure(drain_elsewhere(server, *elsewhere));
    auto welcome = server.expect<rpc::Welcome>(std::move(*reply));
    if (!welcome) return std::unexpected(welcome.error());
    server.remember(welcome->members);
    return Accepted{std::move(*hello), std::move(*welcome)};
  }
}

/// The client's end of the datagrams, with the secrets that both ends export from the connection.
std::expected<transport::SecureChannel::Params, JoinError> channel_params(ServerConnection& server,
                                                                          const rpc::Welcome& welcome,
                                                                          const rpc::Hello& hello, double tick_hz) {
  const auto secrets = server.client().export_secrets(
      {welcome.session_id, welcome.epoch, welcome.server_cid, welcome.role, welcome.seat});
  if (!secrets) return join_failure(secrets.error());
  const transport::Cipher cipher =
      welcome.cipher == rpc::Cipher::kAes256Gcm ? transport::Cipher::kAes256Gcm : transport::Cipher::kChaCha20Poly1305;
  return transport::SecureChannel::Params{.outgoing = transport::Direction::kToServer,
                                          .own_cid = hello.client_cid,
                                          .peer_cid = welcome.server_cid,
                                          .tick = from_seconds(1.0 / tick_hz),
                                          .secrets = transport::secrets_from_exporter(secrets->bytes, cipher)};
}

std::span<const char> setup_of(const rpc::Welcome& welcome) {
  return {reinterpret_cast<const char*>(welcome.setup.data()), welcome.setup.size()};
}

std::expected<JoinedSeat, JoinError> make_seat(ServerConnection& server, const rpc::Welcome& welcome,
                                               const rpc::Hello& hello) {
  auto setup = decode_seat_setup(setup_of(welcome));
  if (!setup)
    return join_failure("the server sent a setup this client cannot accept: " +
                        (setup.error().empty() ? std::string() : setup.error().front().message));
  const auto link = channel_params(server, welcome, hello, setup->tick_hz);
  if (!link) return std::unexpected(link.error());
  JoinedSeat seat{.setup = std::move(*setup),
                  .link = *link,
                  .udp = server.address(),
                  .welcome = welcome,
                  .server = server.client().server(),
                  .service = server.service(),
                  .local = server.local() != nullptr};
  if (!hello.link_test) seat.connection = server.release();
  return seat;
}

ResumeError retry_error(std::string reason) { return {.kind = ResumeError::Kind::kAgain, .reason = std::move(reason)}; }

ResumeError to_resume_error(const rpc::ErrorReply& reply) {
  switch (reply.code) {
    case rpc::ErrorCode::kSeatTaken:
    case rpc::ErrorCode::kDraining:
    case rpc::ErrorCode::kInternal:
      return retry_error(reply.text);
    case rpc::ErrorCode::kNotNow:
      return {.kind = ResumeError::Kind::kAgain,
              .reason = reply.text,
              .wait = std::chrono::milliseconds(kOwnerRetryMs),
              .coming = true};
    case rpc::ErrorCode::kFull:
    case rpc::ErrorCode::kBlocked:
    case rpc::ErrorCode::kTooFast:
      return {
          .kind = ResumeError::Kind::kAgain, .reason = reply.text, .wait = std::chrono::seconds(reply.retry_after_s)};
    default:
      return {.kind = ResumeError::Kind::kGone, .reason = reply.text};
  }
}

bool same_setup(const SeatSetup& a, const SeatSetup& b) {
  std::array<char, wire::kSetupMax> first{}, second{};
  const std::size_t size = encode_seat_setup(a, first);
  return size == encode_seat_setup(b, second) && first == second;
}

std::expected<JoinedSeat, ResumeError> accept_resume(ServerConnection& server, const rpc::Body& reply,
                                                     const rpc::Hello& hello, const ResumeState& own) {
  const auto* welcome = std::get_if<rpc::Welcome>(&reply);
  if (welcome == nullptr) return std::unexpected(retry_error(ServerConnection::kUnexpectedReply));
  if (welcome->epoch < own.epoch)
    return std::unexpected(retry_error("an older server answers (epoch " + std::to_string(welcome->epoch) +
                                       ", this seat's was " + std::to_string(own.epoch) + ")"));
  auto given = make_seat(server, *welcome, hello);
  if (!given) return std::unexpected(retry_error(given.error().reason));
  if (!same_setup(given->setup, own.setup))
    return std::unexpected(ResumeError{.kind = ResumeError::Kind::kGone,
                                       .reason = "the server returned with another scene or other limits"});
  return std::move(*given);
}

}  // namespace

std::string complete_commands(std::string text, const JoinOptions& options, const std::string& session,
                              bool by_ticket) {
  const std::string state = state_option(options.state);
  const std::string reach =
      " --server " + io::to_text(options.server) + (session.empty() ? "" : " --session " + session) + state;
  text = with_options(std::move(text), "tandem-client control", reach + (by_ticket ? " --ticket-file FILE" : ""));
  return with_options(std::move(text), "tandem-client enroll", state);
}

std::expected<JoinedSeat, JoinError> join_seat(const JoinOptions& options) {
  ServerConnection server{options};
  auto accepted = request_join(server);
  if (!accepted) return std::unexpected(accepted.error());
  return make_seat(server, accepted->welcome, accepted->hello);
}

std::expected<Console, JoinError> join_console(const JoinOptions& options) {
  ServerConnection server{options};
  auto accepted = request_join(server);
  if (!accepted) return std::unexpected(accepted.error());
  return console_of(server, *accepted);
}

std::expected<JoinedWatcher, JoinError> join_watcher(const JoinOptions& options) {
  ServerConnection server{options};
  auto accepted = request_join(server);
  if (!accepted) return std::unexpected(accepted.error());
  auto scene = decode_scene(setup_of(accepted->welcome), accepted->welcome.session_name);
  if (!scene)
    return join_failure("the server sent a scene this client cannot accept: " +
                        (scene.error().empty() ? std::string() : scene.error().front().message));
  const auto link = channel_params(server, accepted->welcome, accepted->hello, scene->tick_hz);
  if (!link) return std::unexpected(link.error());
  const io::SocketAddress udp = server.address();
  return JoinedWatcher{std::move(*scene), *link, udp, console_of(server, *accepted)};
}

namespace {

/// The failure of a resume at a server that was reached.
std::unexpected<ResumeError> failed_at_server(ResumeError why, SeatAnswer heard) {
  why.heard = heard;
  why.answer = why.reason;
  return std::unexpected(std::move(why));
}

/// Tries to resume a seat at one address.
std::expected<JoinedSeat, ResumeError> resume_at(const io::SocketAddress& at, const JoinOptions& options,
                                                 const ResumeState& own, const std::function<bool()>& wanted) {
  ServerConnection server{options};
  ResumeError last;
  SeatAnswer heard = SeatAnswer::kOther;
  for (const Secret<32>& secret : own.secrets) {
    if (auto connected = server.connect_to(own, at); !connected) return std::unexpected(connected.error());
    if (!wanted()) return std::unexpected(ResumeError{.kind = ResumeError::Kind::kNotNeeded, .reason = {}});
    rpc::Hello hello = base_hello(options);
    hello.session = own.session;
    hello.credential = rpc::ResumeCredential{secret};
    const auto reply = ask_owner(server, hello, own.epoch, io::monotonic_now() + kComingMax, wanted);
    if (!reply)
      return failed_at_server(
          {.kind = reply.error().interrupted ? ResumeError::Kind::kInterrupted : ResumeError::Kind::kAgain,
           .reason = reply.error().reason},
          SeatAnswer::kOther);
    const auto* rejected = std::get_if<rpc::ErrorReply>(&*reply);
    if (rejected == nullptr) {
      auto given = accept_resume(server, *reply, hello, own);
      if (!given) return failed_at_server(std::move(given.error()), SeatAnswer::kOther);
      server.remember(given->welcome.members);
      return given;
    }
    last = to_resume_error(*rejected);
    last.answered = at;
    // A server of a service that does not know the session may have an old copy of the directory: others decide, and
    // `MissingSession`.
    if (own.service && rejected->code == rpc::ErrorCode::kNoSession) {
      last.kind = ResumeError::Kind::kAgain;
      heard = SeatAnswer::kMissing;
    }
    if (rejected->code != rpc::ErrorCode::kResume) break;
  }
  return failed_at_server(std::move(last), heard);
}

/// Addresses at which the seat may be resumed, the likeliest first.
ServerAddresses resume_addresses(const JoinOptions& options, const ResumeState& own) {
  JoinOptions ordered = options;
  ordered.alternatives.insert(ordered.alternatives.begin(), options.server);
  if (own.last) ordered.server = *own.last;
  if (own.first) {
    ordered.alternatives.insert(ordered.alternatives.begin(), ordered.server);
    ordered.server = *own.first;
  }
  auto list = addresses_to_try(ordered, {});
  for (const std::string& member : own.members) list.add(member);
  return list;
}

}  // namespace

std::expected<JoinedSeat, ResumeError> resume_seat(const JoinOptions& options, const ResumeState& own,
                                                   const std::function<bool()>& wanted) {
  ServerAddresses addresses = resume_addresses(options, own);
  JoinOptions asking = options;
  if (addresses.size() > 1) asking.timeout = std::min(options.timeout, kMemberTimeout);
  std::optional<ResumeError> all;
  addresses.begin(asking.timeout);
  for (std::size_t i = 0; addresses.has(i); ++i) {
    auto given = resume_at(addresses[i], asking, own, wanted);
    if (given || given.error().kind != ResumeError::Kind::kAgain) return given;
    ResumeError& failed = given.error();
    if (!all) {
      all = std::move(failed);
    } else {
      all->reason += "; " + failed.reason;
      all->wait = failed.coming ? failed.wait : std::min(all->wait, failed.wait);
      if (failed.coming || !all->answered) all->answered = failed.answered;
      all->coming = failed.coming;
      if (all->distrust.empty()) all->distrust = failed.distrust;
      if (failed.heard > all->heard) {
        all->heard = failed.heard;
        all->answer = failed.answer;
      }
    }
    if (all->coming) break;
  }
  return std::unexpected(std::move(*all));
}

std::string moved_text(const rpc::Elsewhere& to) {
  return "session " + to.session + " has moved to the server " + to.address + " of this service";
}

std::expected<rpc::SessionList, JoinError> list_sessions(const JoinOptions& options) {
  ServerConnection server{options};
  if (auto connected = server.connect(); !connected) return std::unexpected(connected.error());
  server.remember({});
  return rpc::all_sessions([&](const rpc::Body& page) { return server.request<rpc::SessionList>(page); },
                           server.service().has_value());
}

void release_seat(const io::UdpSocket& socket, const JoinedSeat& given, const hal::DeviceCaps& caps) {
  const Time now = io::monotonic_now();
  Seat seat{given.setup, caps, given.link};
  seat.leave();
  [[maybe_unused]] const hal::Command nothing = seat.on_servo(now, hal::State{});
  std::array<std::byte, transport::kDatagramMax> buffer;
  while (const auto size = seat.poll_transmit(now, buffer)) ::send(socket.fd.get(), buffer.data(), *size, MSG_NOSIGNAL);
}

}  // namespace tandem::client
