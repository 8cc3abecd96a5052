#include "client/app/join_client.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "client/seat/device_facts.h"
#include "client/seat/seat.h"
#include "common/auth/enrolment.h"
#include "common/auth/io/control_client.h"
#include "common/auth/io/identity_selector.h"
#include "common/auth/ticket.h"
#include "common/base/command_hints.h"
#include "common/io/clock.h"
#include "common/io/signals.h"

namespace tandem::client {
namespace {

using rpc::ErrorCode;
using Fault = auth::ClientError;

constexpr int kAgainMs = 100;  // pause between attempts, for a server that is about to start

std::string timeout_text(Duration patience) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", seconds(patience));
  return text;
}

std::string refusal(const rpc::ErrorReply& refused, const JoinOptions& asking) {
  switch (refused.code) {
    case ErrorCode::kNoSeat:
      return asking.console ? "refused: " + refused.text : "--seat " + asking.seat + ": " + refused.text;
    case ErrorCode::kSeatTaken:
      return "--seat " + asking.seat + ": " + refused.text +
             "; take another seat, or wait until it is free (2 s after its owner fell silent)";
    case ErrorCode::kDeviceUnfit:
      return "the device does not fit this scene: " + refused.text;
    case ErrorCode::kSessionOver:
      return refused.text + "; start the server again";
    default:
      return "refused: " + refused.text;
  }
}

/// One request to a server: join, resume or session list.
class JoinAttempt {
 public:
  explicit JoinAttempt(const JoinOptions& asking) : options_(asking) {}

  std::expected<JoinedSeat, JoinError> join() {
    const auto in = request_join();
    if (!in) return std::unexpected(in.error());
    return make_seat(in->welcome, in->hello);
  }

  std::expected<Console, JoinError> join_console() {
    const auto in = request_join();
    if (!in) return std::unexpected(in.error());
    return Console{in->welcome, std::make_shared<auth::ControlClient>(std::move(*client_))};
  }

  std::expected<JoinedSeat, ResumeError> resume(const ResumeState& own, const std::function<bool()>& wanted) {
    if (auto keys = choose_identity(own.local); !keys) return std::unexpected(retry_error(keys.error().reason));
    ResumeError last;
    for (const Secret<32>& secret : own.secrets) {
      if (auto connected = connect_to(own); !connected) return std::unexpected(connected.error());
      if (!wanted()) return std::unexpected(ResumeError{ResumeError::Kind::kNotNeeded, {}, {}});
      rpc::Hello hello = base_hello();
      hello.session = own.session;
      hello.credential = rpc::ResumeCredential{secret};
      const auto answer = ask(hello);
      if (!answer)
        return std::unexpected(
            ResumeError{answer.error().interrupted ? ResumeError::Kind::kInterrupted : ResumeError::Kind::kAgain,
                        answer.error().reason,
                        {}});
      const auto* refused = std::get_if<rpc::ErrorReply>(&*answer);
      if (refused == nullptr) return accept_resume(*answer, hello, own);
      last = to_resume_error(*refused);
      if (refused->code != ErrorCode::kResume) break;
    }
    return std::unexpected(std::move(last));
  }

  std::expected<rpc::SessionList, JoinError> list() {
    if (auto keys = choose_identity(); !keys) return std::unexpected(keys.error());
    if (auto connected = connect(); !connected) return std::unexpected(connected.error());
    return request_list();
  }

 private:
  struct Accepted {
    rpc::Hello hello;
    rpc::Welcome welcome;
  };
  /// Chooses the keys, connects, sends the join request and returns the server's Welcome.
  std::expected<Accepted, JoinError> request_join() {
    if (auto keys = choose_identity(); !keys) return std::unexpected(keys.error());
    if (auto connected = connect(); !connected) return std::unexpected(connected.error());
    auto hello = make_hello();
    if (!hello) return std::unexpected(hello.error());
    const auto answer = ask(*hello);
    if (!answer) return std::unexpected(answer.error());
    if (const auto* refused = std::get_if<rpc::ErrorReply>(&*answer)) return fail(refusal(*refused, options_));
    const auto* welcome = std::get_if<rpc::Welcome>(&*answer);
    if (welcome == nullptr) return fail("unexpected reply from the server; use the same release on both");
    return Accepted{std::move(*hello), *welcome};
  }

  static std::unexpected<JoinError> fail(std::string reason) {
    return std::unexpected(JoinError{false, std::move(reason)});
  }

  static JoinError interrupted() {
    return {true, "ended by " + std::string(io::pending_signal()) + " before it had a seat"};
  }
  JoinError to_join_error(const Fault& fault) const {
    if (fault.kind == Fault::Kind::kInterrupted) return interrupted();
    const std::string server = io::to_text(options_.server);
    if (fault.kind == Fault::Kind::kUnreachable)
      return {false, "no server at " + server + ": nothing listens there (tried for " + timeout_text(options_.timeout) +
                         "). Start " + start_command() + ", and use the address it prints as `listening on`"};
    if (fault.kind == Fault::Kind::kStream && fault.end == auth::StreamErrorCode::kDeadline)
      return {false, "no answer from " + server + " within " + timeout_text(options_.timeout) +
                         "; check that a tandem-server of this version listens there, and that the network (or "
                         "tandem-netsim proxy) is up"};
    if (fault.kind == Fault::Kind::kStream && fault.end == auth::StreamErrorCode::kClosed)
      return {false, fault.text + ", again and again for " + timeout_text(options_.timeout) +
                         ": too many clients join from this address, or the program at " + server +
                         " is not tandem-server"};
    return {false, complete_commands(fault.text, options_)};
  }

  /// Returns the instruction that starts a server at the address of the options.
  [[nodiscard]] std::string start_command() const {
    const std::string server = io::to_text(options_.server);
    return options_.server.loopback()
               ? "a server in another terminal first: `tandem-server run free_motion --listen " + server + "`"
               : "tandem-server on that computer first";
  }

  static ResumeError retry_error(std::string reason) { return {ResumeError::Kind::kAgain, std::move(reason), {}}; }

  static ResumeError to_resume_error(const rpc::ErrorReply& refused) {
    switch (refused.code) {
      case ErrorCode::kSeatTaken:
      case ErrorCode::kDraining:
      case ErrorCode::kInternal:
        return retry_error(refused.text);
      case ErrorCode::kFull:
      case ErrorCode::kBlocked:
      case ErrorCode::kTooFast:
        return {ResumeError::Kind::kAgain, refused.text, std::chrono::seconds(refused.retry_after_s)};
      default:
        return {ResumeError::Kind::kGone, refused.text, {}};
    }
  }

  /// Connects only to the server that gave this seat: a server with the same key. If that key was ephemeral, the
  /// server's key must be in this user's runtime directory.
  std::expected<void, ResumeError> connect_to(const ResumeState& own) {
    const auto judge =
        [&](const auth::KeyFingerprint& fingerprint) -> std::expected<const auth::Identity*, std::string> {
      if (!own.local && fingerprint != own.server)
        return std::unexpected(io::to_text(options_.server) + " shows another key than the server that gave this seat");
      auto identity = (*keys_)(fingerprint);
      if (identity && own.local && keys_->local() == nullptr)
        return std::unexpected(std::string("this server is not the one that gave this seat"));
      return identity;
    };
    auto client = auth::ControlClient::connect(options_.server, judge,
                                               std::chrono::duration_cast<std::chrono::milliseconds>(options_.timeout),
                                               options_.signals);
    if (!client)
      return std::unexpected(ResumeError{client.error().kind == Fault::Kind::kInterrupted
                                             ? ResumeError::Kind::kInterrupted
                                             : ResumeError::Kind::kAgain,
                                         client.error().text,
                                         {}});
    client_.emplace(std::move(*client));
    return {};
  }

  std::expected<JoinedSeat, ResumeError> accept_resume(const rpc::Body& answer, const rpc::Hello& hello,
                                                       const ResumeState& own) {
    const auto* welcome = std::get_if<rpc::Welcome>(&answer);
    if (welcome == nullptr)
      return std::unexpected(retry_error("unexpected reply from the server; use the same release on both"));
    if (welcome->epoch < own.epoch)
      return std::unexpected(retry_error("an older server answers (epoch " + std::to_string(welcome->epoch) +
                                         ", this seat's was " + std::to_string(own.epoch) + ")"));
    auto given = make_seat(*welcome, hello);
    if (!given) return std::unexpected(retry_error(given.error().reason));
    if (!same_setup(given->setup, own.setup))
      return std::unexpected(
          ResumeError{ResumeError::Kind::kGone, "the server returned with another scene or other limits", {}});
    return std::move(*given);
  }

  static bool same_setup(const SeatSetup& a, const SeatSetup& b) {
    std::array<char, wire::kSetupMax> first{}, second{};
    const std::size_t size = encode_seat_setup(a, first);
    return size == encode_seat_setup(b, second) && first == second;
  }

  /// @param local  true: accept only server keys in this user's runtime directory
  std::expected<void, JoinError> choose_identity(bool local = false) {
    if (local) {
      keys_.emplace(io::to_text(options_.server), std::nullopt, auth::runtime_path());
      return {};
    }
    const auto path = auth::client_state_path(options_.state);
    std::optional<auth::ClientKeystore> enrolled;  // without a home directory only the runtime directory remains
    if (path) {
      auto own = auth::ClientKeystore::open(*path);
      if (!own) return fail(own.error());
      enrolled = std::move(*own);
    } else if (!options_.state.empty()) {
      return fail("--state: " + path.error());
    }
    keys_.emplace(io::to_text(options_.server), std::move(enrolled), auth::runtime_path());
    return {};
  }

  std::expected<void, JoinError> connect() {
    const Time until = io::monotonic_now() + options_.timeout;
    while (true) {
      const auto left = std::max(Duration{std::chrono::milliseconds(1)}, Duration{until - io::monotonic_now()});
      auto client = auth::ControlClient::connect(
          options_.server, [this](const auth::KeyFingerprint& fingerprint) { return (*keys_)(fingerprint); },
          std::chrono::duration_cast<std::chrono::milliseconds>(left), options_.signals);
      if (client) {
        client_.emplace(std::move(*client));
        return {};
      }
      // The server is not started yet, or it is too busy and closed the connection of an unknown client without a
      // reply.
      const Fault& fault = client.error();
      const bool busy = fault.kind == Fault::Kind::kStream &&
                        (fault.end == auth::StreamErrorCode::kClosed || fault.end == auth::StreamErrorCode::kHandshake);
      const bool later = (busy || fault.kind == Fault::Kind::kUnreachable) &&
                         io::monotonic_now() + std::chrono::milliseconds(kAgainMs) < until;
      if (!later) return std::unexpected(to_join_error(client.error()));
      pollfd signals{options_.signals, POLLIN, 0};
      if (poll(&signals, 1, kAgainMs) > 0) return std::unexpected(interrupted());
    }
  }

  std::expected<rpc::Body, JoinError> ask(const rpc::Body& question) {
    auto answer = client_->ask(question, std::chrono::duration_cast<std::chrono::milliseconds>(options_.timeout));
    if (!answer) return std::unexpected(to_join_error(answer.error()));
    return std::move(*answer);
  }

  [[nodiscard]] rpc::Hello base_hello() const {
    rpc::Hello hello;
    hello.seat = options_.seat;
    hello.link_test = options_.seat.empty() && !options_.console;
    if (!options_.console) hello.device = device_facts(options_.caps);
    hello.has_aes = transport::fastest_cipher() == transport::Cipher::kAes256Gcm;
    const auto cid = auth::random_bytes<std::array<std::byte, 4>>();
    for (std::size_t i = 0; i < 4; ++i) hello.client_cid |= std::to_integer<std::uint32_t>(cid[i]) << (8 * i);
    hello.client_cid |= 1;
    return hello;
  }

  std::expected<rpc::Hello, JoinError> make_hello() {
    rpc::Hello hello = base_hello();
    const auto code = auth::canonical_session_code(options_.session);
    auth::Id16 id;
    const bool is_id = auth::from_hex(options_.session, id), by_name = !options_.session.empty() && !is_id && !code;
    if (is_id) hello.session = id;
    if (!is_id && code) hello.session = *code;
    if (!options_.ticket.empty()) {
      const auto ticket = auth::ticket_from_text(options_.ticket);
      if (!ticket) return fail("--ticket: " + ticket.error());
      hello.credential = rpc::TicketCredential{{ticket->begin(), ticket->end()}};
      if (options_.session.empty()) {
        hello.session = auth::claimed_session(*ticket);
      } else if (by_name) {  // the server checks that the ticket is for this session
        const auto found = find_session(id, is_id, code);
        if (!found) return std::unexpected(found.error());
        hello.session = found->id;
      }
      return hello;
    }
    if (by_name || (keys_->local() && !hello.link_test)) {
      const auto found = find_session(id, is_id, code);
      if (!found) return std::unexpected(found.error());
      hello.session = found->id;
      if (keys_->local() && !hello.link_test) {
        auto own = issue_local_ticket(*found);
        if (!own) return std::unexpected(own.error());
        hello.credential = std::move(*own);
        return hello;
      }
    }
    if (code && !hello.link_test) hello.credential = rpc::CodeCredential{*code};
    return hello;
  }

  std::expected<rpc::SessionList, JoinError> request_list() {
    auto answer = ask(rpc::SessionListRequest{});
    if (!answer) return std::unexpected(answer.error());
    if (const auto* refused = std::get_if<rpc::ErrorReply>(&*answer)) return fail(refusal(*refused, options_));
    auto* list = std::get_if<rpc::SessionList>(&*answer);
    if (list == nullptr) return fail("unexpected reply from the server; use the same release on both");
    return std::move(*list);
  }

  std::expected<rpc::ListedSession, JoinError> find_session(const auth::Id16& id, bool is_id,
                                                            const std::optional<std::string>& code) {
    const auto list = request_list();
    if (!list) return std::unexpected(list.error());
    std::string names;
    const rpc::ListedSession* found = nullptr;
    for (const rpc::ListedSession& s : list->sessions) {
      names += (names.empty() ? "" : ", ") + s.name;
      const bool only = (code || options_.session.empty()) && list->sessions.size() == 1;
      if (s.name == options_.session || (is_id ? s.id == id : only)) found = &s;
    }
    if (found != nullptr) return *found;
    if (list->sessions.empty())
      return fail("no session is open at " + io::to_text(options_.server) + "; start " + start_command());
    return fail(options_.session.empty() ? "several sessions are open there: " + names + "; say which with --session"
                                         : "--session " + options_.session + ": no such session there; open: " + names);
  }

  /// Signs a ticket with the server's ticket key, which only the server's own user on the same computer can read.
  std::expected<rpc::Credential, JoinError> issue_local_ticket(const rpc::ListedSession& session) {
    const auto seat = std::ranges::find(session.seats, options_.seat, &rpc::ListedSeat::name);
    if (seat == session.seats.end() && !options_.console) {
      std::string names;
      for (const rpc::ListedSeat& s : session.seats) names += " " + s.name;
      return fail("--seat " + options_.seat + ": no seat of this name; seats:" + names);
    }
    auth::Ticket ticket;
    auth::fill_random(ticket.ticket_id);
    ticket.session_id = session.id;
    ticket.seat = options_.seat;
    ticket.role = options_.console ? *options_.console : seat->role;
    ticket.workstation = keys_->local()->workstation.fingerprint();
    ticket.not_before = auth::wall_seconds() - 1;
    ticket.not_after = ticket.not_before + 60;
    const auto bytes = auth::sign_ticket(ticket, keys_->local()->ticket_key);
    if (!bytes) return fail("a ticket cannot be made: " + bytes.error());
    return rpc::TicketCredential{{bytes->begin(), bytes->end()}};
  }

  std::expected<JoinedSeat, JoinError> make_seat(const rpc::Welcome& welcome, const rpc::Hello& hello) {
    JoinedSeat given;
    const auto text = std::span{reinterpret_cast<const char*>(welcome.setup.data()), welcome.setup.size()};
    auto setup = decode_seat_setup(text);
    if (!setup)
      return fail("the server sent a setup this client cannot accept: " +
                  (setup.error().empty() ? std::string() : setup.error().front().message));
    const auto secrets =
        client_->export_secrets({welcome.session_id, welcome.epoch, welcome.server_cid, welcome.role, welcome.seat});
    if (!secrets) return fail(secrets.error());
    given.setup = std::move(*setup);
    given.welcome = welcome;
    given.udp = options_.server;
    given.server = client_->server();
    given.local = keys_->local() != nullptr;
    given.link.outgoing = transport::Direction::kToServer;
    given.link.own_cid = hello.client_cid;
    given.link.peer_cid = welcome.server_cid;
    given.link.tick = from_seconds(1.0 / given.setup.tick_hz);
    const bool aes = welcome.cipher == rpc::Cipher::kAes256Gcm;
    given.link.secrets = transport::secrets_from_exporter(
        secrets->bytes, aes ? transport::Cipher::kAes256Gcm : transport::Cipher::kChaCha20Poly1305);
    if (!hello.link_test) given.connection = std::make_shared<auth::ControlClient>(std::move(*client_));
    return given;
  }

  const JoinOptions& options_;
  std::optional<auth::IdentitySelector> keys_;
  std::optional<auth::ControlClient> client_;
};

}  // namespace

std::string complete_commands(std::string text, const JoinOptions& asking, const std::string& session, bool by_ticket) {
  const std::string state = state_option(asking.state);
  const std::string reach =
      " --server " + io::to_text(asking.server) + (session.empty() ? "" : " --session " + session) + state;
  text = with_options(std::move(text), "tandem-client control", reach + (by_ticket ? " --ticket-file FILE" : ""));
  return with_options(std::move(text), "tandem-client enroll", state);
}

std::expected<JoinedSeat, JoinError> join_seat(const JoinOptions& asking) { return JoinAttempt{asking}.join(); }

std::expected<Console, JoinError> join_console(const JoinOptions& asking) { return JoinAttempt{asking}.join_console(); }

std::expected<JoinedSeat, ResumeError> resume_seat(const JoinOptions& asking, const ResumeState& own,
                                                   const std::function<bool()>& wanted) {
  return JoinAttempt{asking}.resume(own, wanted);
}

std::expected<rpc::SessionList, JoinError> list_sessions(const JoinOptions& asking) {
  return JoinAttempt{asking}.list();
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
