#include "client/app/join_client.h"

#include <array>
#include <utility>

#include "client/app/join_hello.h"
#include "client/app/server_connection.h"
#include "client/seat/seat.h"
#include "common/base/command_hints.h"
#include "common/io/clock.h"
#include "proto/rpc/session_pages.h"
#include "proto/text/scene_bytes.h"

namespace tandem::client {
namespace {

struct Accepted {
  rpc::Hello hello;
  rpc::Welcome welcome;
};
/// Connects, sends the join request and returns it with the server's Welcome.
std::expected<Accepted, JoinError> request_join(ServerConnection& server) {
  if (auto connected = server.connect(); !connected) return std::unexpected(connected.error());
  auto hello = make_hello(server);
  if (!hello) return std::unexpected(hello.error());
  auto welcome = server.request<rpc::Welcome>(*hello);
  if (!welcome) return std::unexpected(welcome.error());
  return Accepted{std::move(*hello), std::move(*welcome)};
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
                  .udp = server.options().server,
                  .welcome = welcome,
                  .server = server.client().server(),
                  .local = server.local() != nullptr};
  if (!hello.link_test) seat.connection = server.release();
  return seat;
}

ResumeError retry_error(std::string reason) { return {ResumeError::Kind::kAgain, std::move(reason), {}}; }

ResumeError to_resume_error(const rpc::ErrorReply& reply) {
  switch (reply.code) {
    case rpc::ErrorCode::kSeatTaken:
    case rpc::ErrorCode::kDraining:
    case rpc::ErrorCode::kInternal:
      return retry_error(reply.text);
    case rpc::ErrorCode::kFull:
    case rpc::ErrorCode::kBlocked:
    case rpc::ErrorCode::kTooFast:
      return {ResumeError::Kind::kAgain, reply.text, std::chrono::seconds(reply.retry_after_s)};
    default:
      return {ResumeError::Kind::kGone, reply.text, {}};
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
    return std::unexpected(
        ResumeError{ResumeError::Kind::kGone, "the server returned with another scene or other limits", {}});
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
  return Console{accepted->welcome, server.release(), server.workstation()};
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
  return JoinedWatcher{
      std::move(*scene), *link, options.server, {accepted->welcome, server.release(), server.workstation()}};
}

std::expected<JoinedSeat, ResumeError> resume_seat(const JoinOptions& options, const ResumeState& own,
                                                   const std::function<bool()>& wanted) {
  ServerConnection server{options};
  ResumeError last;
  for (const Secret<32>& secret : own.secrets) {
    if (auto connected = server.connect_to(own); !connected) return std::unexpected(connected.error());
    if (!wanted()) return std::unexpected(ResumeError{ResumeError::Kind::kNotNeeded, {}, {}});
    rpc::Hello hello = base_hello(options);
    hello.session = own.session;
    hello.credential = rpc::ResumeCredential{secret};
    const auto reply = server.ask(hello);
    if (!reply)
      return std::unexpected(
          ResumeError{reply.error().interrupted ? ResumeError::Kind::kInterrupted : ResumeError::Kind::kAgain,
                      reply.error().reason,
                      {}});
    const auto* rejected = std::get_if<rpc::ErrorReply>(&*reply);
    if (rejected == nullptr) return accept_resume(server, *reply, hello, own);
    last = to_resume_error(*rejected);
    if (rejected->code != rpc::ErrorCode::kResume) break;
  }
  return std::unexpected(std::move(last));
}

std::expected<rpc::SessionList, JoinError> list_sessions(const JoinOptions& options) {
  ServerConnection server{options};
  if (auto connected = server.connect(); !connected) return std::unexpected(connected.error());
  return rpc::all_sessions([&](const rpc::Body& page) { return server.request<rpc::SessionList>(page); });
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
