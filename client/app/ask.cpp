#include "client/app/ask.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "client/device_facts.h"
#include "client/seat.h"
#include "common/base/printed_command.h"
#include "common/io/clock.h"
#include "common/io/signals.h"
#include "common/trust/enrolment.h"
#include "common/trust/io/control_client.h"
#include "common/trust/io/key_choice.h"
#include "common/trust/ticket.h"

namespace tandem::client {
namespace {

using control::Reason;
using Fault = trust::ClientFault;

constexpr int kAgainMs = 100;  // a server that is about to start

std::string waited(Duration patience) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", seconds(patience));
  return text;
}

std::string refusal(const control::Refused& refused, const Asking& asking) {
  switch (refused.reason) {
    case Reason::kNoSeat:
      return asking.console ? "refused: " + refused.text : "--seat " + asking.seat + ": " + refused.text;
    case Reason::kSeatTaken:
      return "--seat " + asking.seat + ": " + refused.text + "; take another seat, or wait until it is free (2 s after its owner fell silent)";
    case Reason::kDeviceUnfit:
      return "the device does not fit this scene: " + refused.text;
    case Reason::kSessionOver:
      return refused.text + "; start the server again";
    default:
      return "refused: " + refused.text;
  }
}

/// One attempt to get a seat, over one connection.
class Joining {
 public:
  explicit Joining(const Asking& asking) : asking_(asking) {}

  std::expected<GivenSeat, NotSeated> join() {
    const auto in = get_in();
    if (!in) return std::unexpected(in.error());
    return take(in->welcome, in->hello);
  }

  std::expected<Console, NotSeated> stand() {
    const auto in = get_in();
    if (!in) return std::unexpected(in.error());
    return Console{in->welcome, std::make_shared<trust::ControlClient>(std::move(*client_))};
  }

  std::expected<GivenSeat, NotBack> come_back(const OwnSeat& own, const std::function<bool()>& wanted) {
    if (auto keys = choose_keys(own.local); !keys) return std::unexpected(again(keys.error().reason));
    NotBack last;
    for (const Secret<32>& secret : own.secrets) {
      if (auto connected = connect_to(own); !connected) return std::unexpected(connected.error());
      if (!wanted()) return std::unexpected(NotBack{NotBack::Kind::kNotNeeded, {}, {}});
      control::Hello hello = who_asks();
      hello.session = own.session;
      hello.credential = control::ResumeCredential{secret};
      const auto answer = ask(hello);
      if (!answer) return std::unexpected(NotBack{answer.error().interrupted ? NotBack::Kind::kInterrupted : NotBack::Kind::kAgain, answer.error().reason, {}});
      const auto* refused = std::get_if<control::Refused>(&*answer);
      if (refused == nullptr) return take_back(*answer, hello, own);
      last = judged(*refused);
      if (refused->reason != Reason::kResume) break;
    }
    return std::unexpected(std::move(last));
  }

  std::expected<control::SessionList, NotSeated> list() {
    if (auto keys = choose_keys(); !keys) return std::unexpected(keys.error());
    if (auto connected = connect(); !connected) return std::unexpected(connected.error());
    return ask_list();
  }

 private:
  struct In {
    control::Hello hello;
    control::Welcome welcome;
  };
  /// From choosing keys to the server's yes.
  std::expected<In, NotSeated> get_in() {
    if (auto keys = choose_keys(); !keys) return std::unexpected(keys.error());
    if (auto connected = connect(); !connected) return std::unexpected(connected.error());
    auto hello = make_hello();
    if (!hello) return std::unexpected(hello.error());
    const auto answer = ask(*hello);
    if (!answer) return std::unexpected(answer.error());
    if (const auto* refused = std::get_if<control::Refused>(&*answer)) return fail(refusal(*refused, asking_));
    const auto* welcome = std::get_if<control::Welcome>(&*answer);
    if (welcome == nullptr) return fail("the server answered something else; is it of the same release?");
    return In{std::move(*hello), *welcome};
  }

  static std::unexpected<NotSeated> fail(std::string reason) { return std::unexpected(NotSeated{false, std::move(reason)}); }

  static NotSeated interrupted() { return {true, "ended by " + std::string(io::signal_that_came()) + " before it had a seat"}; }
  NotSeated not_seated(const Fault& fault) const {
    if (fault.kind == Fault::Kind::kInterrupted) return interrupted();
    const std::string server = io::to_text(asking_.server);
    if (fault.kind == Fault::Kind::kUnreachable)
      return {false, "no server at " + server + ": nothing listens there (asked for " + waited(asking_.patience) +
                         "). Start " + start_command() + ", and use the address it prints as `listening on`"};
    if (fault.kind == Fault::Kind::kStream && fault.end == trust::StreamEnd::kDeadline)
      return {false, "no answer from " + server + " within " + waited(asking_.patience) +
                         ": is a tandem-server listening there, of this version, and is the network (or tandem-netsim proxy) between up?"};
    if (fault.kind == Fault::Kind::kStream && fault.end == trust::StreamEnd::kClosed)
      return {false, fault.text + ", again and again for " + waited(asking_.patience) + ": too many try to join from this address, or what listens at " + server + " is no tandem-server"};
    return {false, complete_commands(fault.text, asking_)};
  }

  /// A server where this client looked for one: here, or on another computer.
  [[nodiscard]] std::string start_command() const {
    const std::string server = io::to_text(asking_.server);
    return asking_.server.loopback() ? "a server in another terminal first: `tandem-server run free_motion --listen " + server + "`" : "tandem-server on that computer first";
  }

  static NotBack again(std::string reason) { return {NotBack::Kind::kAgain, std::move(reason), {}}; }

  static NotBack judged(const control::Refused& refused) {
    switch (refused.reason) {
      case Reason::kSeatTaken:
      case Reason::kDraining:
      case Reason::kTrouble:
        return again(refused.text);
      case Reason::kFull:
      case Reason::kBlocked:
      case Reason::kTooFast:
        return {NotBack::Kind::kAgain, refused.text, std::chrono::seconds(refused.retry_after_s)};
      default:
        return {NotBack::Kind::kGone, refused.text, {}};
    }
  }

  /// Only what this seat was had from: a server of the same key; where that was made on the spot, one whose key the same user laid down.
  std::expected<void, NotBack> connect_to(const OwnSeat& own) {
    const auto judge = [&](const trust::Pin& pin) -> std::expected<const trust::Identity*, std::string> {
      if (!own.local && pin != own.server) return std::unexpected(io::to_text(asking_.server) + " shows another key than the server that gave this seat");
      auto identity = (*keys_)(pin);
      if (identity && own.local && keys_->local() == nullptr) return std::unexpected(std::string("this server is not the one that gave this seat"));
      return identity;
    };
    auto client = trust::ControlClient::connect(asking_.server, judge, std::chrono::duration_cast<std::chrono::milliseconds>(asking_.patience), asking_.signals);
    if (!client) return std::unexpected(NotBack{client.error().kind == Fault::Kind::kInterrupted ? NotBack::Kind::kInterrupted : NotBack::Kind::kAgain, client.error().text, {}});
    client_.emplace(std::move(*client));
    return {};
  }

  std::expected<GivenSeat, NotBack> take_back(const control::Body& answer, const control::Hello& hello, const OwnSeat& own) {
    const auto* welcome = std::get_if<control::Welcome>(&answer);
    if (welcome == nullptr) return std::unexpected(again("the server answered something else; is it of the same release?"));
    if (welcome->epoch < own.epoch)
      return std::unexpected(again("an older server answers (epoch " + std::to_string(welcome->epoch) + ", this seat's was " + std::to_string(own.epoch) + ")"));
    auto given = take(*welcome, hello);
    if (!given) return std::unexpected(again(given.error().reason));
    if (!same(given->setup, own.setup)) return std::unexpected(NotBack{NotBack::Kind::kGone, "the server came back with another scene or other limits", {}});
    return std::move(*given);
  }

  static bool same(const SeatSetup& a, const SeatSetup& b) {
    std::array<char, wire::kSetupMax> first{}, second{};
    const std::size_t size = encode_seat_setup(a, first);
    return size == encode_seat_setup(b, second) && first == second;
  }

  /// @param local  only what servers of this user on this computer laid down
  std::expected<void, NotSeated> choose_keys(bool local = false) {
    if (local) {
      keys_.emplace(io::to_text(asking_.server), std::nullopt, trust::runtime_path());
      return {};
    }
    const auto path = trust::client_state_path(asking_.state);
    std::optional<trust::ClientTrust> enrolled;  // without a home there is no folder: then only what this computer's server laid down
    if (path) {
      auto own = trust::ClientTrust::open(*path);
      if (!own) return fail(own.error());
      enrolled = std::move(*own);
    } else if (!asking_.state.empty()) {
      return fail("--state: " + path.error());
    }
    keys_.emplace(io::to_text(asking_.server), std::move(enrolled), trust::runtime_path());
    return {};
  }

  std::expected<void, NotSeated> connect() {
    const Time until = io::monotonic_now() + asking_.patience;
    while (true) {
      const auto left = std::max(Duration{std::chrono::milliseconds(1)}, Duration{until - io::monotonic_now()});
      auto client = trust::ControlClient::connect(
          asking_.server, [this](const trust::Pin& pin) { return (*keys_)(pin); }, std::chrono::duration_cast<std::chrono::milliseconds>(left), asking_.signals);
      if (client) {
        client_.emplace(std::move(*client));
        return {};
      }
      // Not there yet, or too busy to let more people in: it closed the door on a stranger without a word.
      const Fault& fault = client.error();
      const bool busy = fault.kind == Fault::Kind::kStream && (fault.end == trust::StreamEnd::kClosed || fault.end == trust::StreamEnd::kHandshake);
      const bool later = (busy || fault.kind == Fault::Kind::kUnreachable) && io::monotonic_now() + std::chrono::milliseconds(kAgainMs) < until;
      if (!later) return std::unexpected(not_seated(client.error()));
      pollfd signals{asking_.signals, POLLIN, 0};
      if (poll(&signals, 1, kAgainMs) > 0) return std::unexpected(interrupted());
    }
  }

  std::expected<control::Body, NotSeated> ask(const control::Body& question) {
    auto answer = client_->ask(question, std::chrono::duration_cast<std::chrono::milliseconds>(asking_.patience));
    if (!answer) return std::unexpected(not_seated(answer.error()));
    return std::move(*answer);
  }

  [[nodiscard]] control::Hello who_asks() const {
    control::Hello hello;
    hello.seat = asking_.seat;
    hello.visit = asking_.seat.empty() && !asking_.console;
    if (!asking_.console) hello.device = device_facts(asking_.caps);
    hello.has_aes = link::fastest_cipher() == link::Cipher::kAes256Gcm;
    const auto cid = trust::random_bytes<std::array<std::byte, 4>>();
    for (std::size_t i = 0; i < 4; ++i) hello.client_cid |= std::to_integer<std::uint32_t>(cid[i]) << (8 * i);
    hello.client_cid |= 1;
    return hello;
  }

  std::expected<control::Hello, NotSeated> make_hello() {
    control::Hello hello = who_asks();
    const auto code = trust::canonical_session_code(asking_.session);
    trust::Id16 id;
    const bool is_id = trust::from_hex(asking_.session, id), by_name = !asking_.session.empty() && !is_id && !code;
    if (is_id) hello.session = id;
    if (!is_id && code) hello.session = *code;
    if (!asking_.ticket.empty()) {
      const auto ticket = trust::ticket_from_text(asking_.ticket);
      if (!ticket) return fail("--ticket: " + ticket.error());
      hello.credential = control::TicketCredential{{ticket->begin(), ticket->end()}};
      if (asking_.session.empty()) {
        hello.session = trust::session_named_in(*ticket);
      } else if (by_name) {  // the server says whether the ticket is for it
        const auto found = find_session(id, is_id, code);
        if (!found) return std::unexpected(found.error());
        hello.session = found->id;
      }
      return hello;
    }
    if (by_name || (keys_->local() && !hello.visit)) {
      const auto found = find_session(id, is_id, code);
      if (!found) return std::unexpected(found.error());
      hello.session = found->id;
      if (keys_->local() && !hello.visit) {
        auto own = write_ticket(*found);
        if (!own) return std::unexpected(own.error());
        hello.credential = std::move(*own);
        return hello;
      }
    }
    if (code && !hello.visit) hello.credential = control::CodeCredential{*code};
    return hello;
  }

  std::expected<control::SessionList, NotSeated> ask_list() {
    auto answer = ask(control::SessionListRequest{});
    if (!answer) return std::unexpected(answer.error());
    if (const auto* refused = std::get_if<control::Refused>(&*answer)) return fail(refusal(*refused, asking_));
    auto* list = std::get_if<control::SessionList>(&*answer);
    if (list == nullptr) return fail("the server answered something else; is it of the same release?");
    return std::move(*list);
  }

  std::expected<control::ListedSession, NotSeated> find_session(const trust::Id16& id, bool is_id, const std::optional<std::string>& code) {
    const auto list = ask_list();
    if (!list) return std::unexpected(list.error());
    std::string names;
    const control::ListedSession* found = nullptr;
    for (const control::ListedSession& s : list->sessions) {
      names += (names.empty() ? "" : ", ") + s.name;
      const bool only = (code || asking_.session.empty()) && list->sessions.size() == 1;
      if (s.name == asking_.session || (is_id ? s.id == id : only)) found = &s;
    }
    if (found != nullptr) return *found;
    if (list->sessions.empty()) return fail("no session is open at " + io::to_text(asking_.server) + "; start " + start_command());
    return fail(asking_.session.empty() ? "several sessions are open there: " + names + "; say which with --session"
                                        : "--session " + asking_.session + ": no such session there; open: " + names);
  }

  /// On the server's own computer, as its own user: the right it would write out anyway.
  std::expected<control::Credential, NotSeated> write_ticket(const control::ListedSession& session) {
    const auto seat = std::ranges::find(session.seats, asking_.seat, &control::ListedSeat::name);
    if (seat == session.seats.end() && !asking_.console) {
      std::string names;
      for (const control::ListedSeat& s : session.seats) names += " " + s.name;
      return fail("--seat " + asking_.seat + ": no seat of this name; seats:" + names);
    }
    trust::Ticket ticket;
    trust::fill_random(ticket.ticket_id);
    ticket.session_id = session.id;
    ticket.seat = asking_.seat;
    ticket.role = asking_.console ? *asking_.console : seat->role;
    ticket.workstation = keys_->local()->workstation.pin();
    ticket.not_before = trust::wall_seconds() - 1;
    ticket.not_after = ticket.not_before + 60;
    const auto bytes = trust::sign_ticket(ticket, keys_->local()->ticket_key);
    if (!bytes) return fail("a ticket cannot be made: " + bytes.error());
    return control::TicketCredential{{bytes->begin(), bytes->end()}};
  }

  std::expected<GivenSeat, NotSeated> take(const control::Welcome& welcome, const control::Hello& hello) {
    GivenSeat given;
    const auto text = std::span{reinterpret_cast<const char*>(welcome.setup.data()), welcome.setup.size()};
    auto setup = decode_seat_setup(text);
    if (!setup)
      return fail("the server sent a setup this client cannot accept: " + (setup.error().empty() ? std::string() : setup.error().front().message));
    const auto secrets = client_->export_secrets({welcome.session_id, welcome.epoch, welcome.server_cid, welcome.role, welcome.seat});
    if (!secrets) return fail(secrets.error());
    given.setup = std::move(*setup);
    given.welcome = welcome;
    given.udp = asking_.server;
    given.server = client_->server();
    given.local = keys_->local() != nullptr;
    given.link.outgoing = link::Direction::kToServer;
    given.link.own_cid = hello.client_cid;
    given.link.peer_cid = welcome.server_cid;
    given.link.tick = from_seconds(1.0 / given.setup.tick_hz);
    const bool aes = welcome.cipher == control::Cipher::kAes256Gcm;
    given.link.secrets = link::secrets_from_exporter(secrets->bytes, aes ? link::Cipher::kAes256Gcm : link::Cipher::kChaCha20Poly1305);
    if (!hello.visit) given.connection = std::make_shared<trust::ControlClient>(std::move(*client_));
    return given;
  }

  const Asking& asking_;
  std::optional<trust::KeyChoice> keys_;
  std::optional<trust::ControlClient> client_;
};

}  // namespace

std::string complete_commands(std::string text, const Asking& asking, const std::string& session, bool by_ticket) {
  const std::string state = state_option_of(asking.state);
  const std::string reach = " --server " + io::to_text(asking.server) + (session.empty() ? "" : " --session " + session) + state;
  text = with_options(std::move(text), "tandem-client control", reach + (by_ticket ? " --ticket-file FILE" : ""));
  return with_options(std::move(text), "tandem-client enroll", state);
}

std::expected<GivenSeat, NotSeated> ask_for_seat(const Asking& asking) { return Joining{asking}.join(); }

std::expected<Console, NotSeated> ask_for_console(const Asking& asking) { return Joining{asking}.stand(); }

std::expected<GivenSeat, NotBack> ask_for_own_seat(const Asking& asking, const OwnSeat& own, const std::function<bool()>& wanted) {
  return Joining{asking}.come_back(own, wanted);
}

std::expected<control::SessionList, NotSeated> ask_for_sessions(const Asking& asking) { return Joining{asking}.list(); }

void give_back(const io::UdpSocket& socket, const GivenSeat& given, const hal::DeviceCaps& caps) {
  const Time now = io::monotonic_now();
  Seat seat{given.setup, caps, given.link};
  seat.leave();
  [[maybe_unused]] const hal::Command nothing = seat.on_servo(now, hal::State{});
  std::array<std::byte, link::kDatagramMax> buffer;
  while (const auto size = seat.poll_transmit(now, buffer)) ::send(socket.fd.get(), buffer.data(), *size, MSG_NOSIGNAL);
}

}  // namespace tandem::client
