#include "server/app/control/control_connection.h"

#include <algorithm>
#include <asio/dispatch.hpp>
#include <utility>

#include "common/base/command_hints.h"
#include "proto/rpc/older_peers.h"
#include "proto/rpc/rpc_codec.h"
#include "server/policy/roles.h"

namespace tandem::server {
namespace {

using auth::StreamErrorCode;
using rpc::ErrorCode;
using rpc::Kind;

constexpr std::string_view kUnknown =
    "this workstation is not enrolled here, or was revoked; ask its administrator for `tandem-server enroll NAME "
    "--address HOST:PORT` and run the command that it prints. If it is enrolled with another folder of keys, name that "
    "with --state";

/// Longest wait of a request for a session that a server is about to serve, and time between two looks. A client may
/// wait only 0.5 s for its answer. The same for a workstation that another server has just enrolled: its enrolment
/// arrives within two looks of RegistryMirror, 0.2 s.
constexpr auto kComingWait = std::chrono::milliseconds(400), kComingLook = std::chrono::milliseconds(100);

std::uint32_t whole_seconds(Duration d) noexcept {
  return static_cast<std::uint32_t>(std::clamp(seconds(d) + 1.0, 1.0, 86400.0));
}

}  // namespace

ControlConnection::ControlConnection(ControlServices& services, auth::PendingSlots::Id id, asio::ip::tcp::socket socket,
                                     const auth::Origin& origin, std::string address, OnConnectionChange on_change)
    : services_(services),
      id_(id),
      stream_(auth::ControlStream::make(std::move(socket), services.tls, auth::ControlStream::Side::kServer)),
      origin_(origin),
      source_(auth::Source::of(origin)),
      address_(std::move(address)),
      on_change_(std::move(on_change)),
      look_again_(services.context) {}

void ControlConnection::record(ControlEvent event, std::string detail) const {
  services_.events.record(event, address_, workstation_ ? workstation_->name : "", std::move(detail),
                          welcome_ ? welcome_->person : "");
}

void ControlConnection::start(std::chrono::milliseconds deadline) {
  set_deadline(deadline);
  stream_->allow_input(services_.limits.input_before_auth);
  stream_->handshake([self = shared_from_this()](auth::ControlStream::Peer peer) {
    if (!peer) return self->on_stream_fault(peer.error());
    if (self->finished_) return;
    self->pin_ = *peer;
    // An unknown workstation may enrol. Until then its connection competes with all other unknown ones.
    if (const auto row = self->services_.trust.registry().find(self->pin_); row && *row) self->on_key_proved();
    self->read_next();
  });
}

void ControlConnection::stop() { finish(); }

void ControlConnection::close(ControlEvent why) {
  if (finished_) return;
  record(why);
  finish();
}

void ControlConnection::on_key_proved() {
  if (std::exchange(proved_, true)) return;
  on_change_(*this, ConnectionChange::kKeyProved);
}

void ControlConnection::read_next() {
  if (finished_) return;
  const std::size_t frame_max =
      pending_ ? std::min(services_.limits.input_before_auth, rpc::kFrameMax) : rpc::kFrameMax;
  const auto frame_deadline =
      pending_ ? auth::ControlStream::Duration::zero() : auth::ControlStream::Duration(services_.limits.frame_deadline);
  stream_->read(frame_max, frame_deadline, [self = shared_from_this()](auth::ControlStream::Bytes bytes) {
    if (!bytes) return self->on_stream_fault(bytes.error());
    self->on_frame(std::move(*bytes));
  });
}

void ControlConnection::on_frame(SecretBuffer bytes) {
  if (finished_) return;
  services_.slots.set_busy(id_, true, services_.now());
  const auto raw = std::as_const(bytes).bytes();
  // The role is checked before the payload is parsed.
  const auto head = rpc::peek(raw);
  request_ = head ? head->request : 0;
  if (!head || !is_client_message(head->kind)) {
    record(ControlEvent::kBadFrame);
    const bool version = !head && head.error() == rpc::FrameError::kVersion;
    return refuse(version ? ErrorCode::kVersion : ErrorCode::kBadFrame,
                  version
                      ? "this server supports version 1 of Tandem's control frames; use a client of the same release"
                      : "the server cannot parse this message",
                  true);
  }
  auto row = services_.trust.registry().find(pin_);
  if (!row) {
    services_.events.record(ControlEvent::kTrouble, address_, "", row.error());
    return refuse(ErrorCode::kInternal,
                  "the server cannot read its registry of workstations, so it rejects all joins; its log has the cause",
                  true);
  }
  workstation_ = std::move(*row);
  if (!workstation_ && head->kind != Kind::kEnroll) {
    if (await_enrolment(bytes)) return;
    record(ControlEvent::kNotEnrolled, pin_.hex());
    return refuse(ErrorCode::kNotEnrolled, std::string(kUnknown), true);
  }
  const Time now = services_.now();
  if (!rates_.take(head->kind, now)) {
    record(ControlEvent::kCommandTooFast);
    return refuse(ErrorCode::kTooFast, "too many requests; send them more slowly", pending_, 1);
  }
  const auto role = welcome_ ? std::optional(welcome_->role) : std::nullopt;
  const bool seatless = welcome_ && welcome_->seat.empty();
  if (seatless ? !allowed_without_seat(*role, head->kind) : !allowed(role, head->kind)) {
    std::string why = seatless ? forbidden_text_without_seat(*role, head->kind) : forbidden_text(role, head->kind);
    record(ControlEvent::kForbidden, forbidden_events_.take(now) ? why : "");
    return refuse(ErrorCode::kNotAllowed, std::move(why), pending_);
  }
  auto frame = rpc::decode(raw);
  if (!frame) {
    record(ControlEvent::kBadFrame);
    return refuse(ErrorCode::kBadFrame, std::string(rpc::to_text(frame.error())), true);
  }
  if (const auto* enrol = std::get_if<rpc::Enroll>(&frame->body)) return on_enrol(*enrol);
  if (auto* hello = std::get_if<rpc::Hello>(&frame->body)) return on_hello(std::move(*hello));
  if (const auto* ping = std::get_if<rpc::Ping>(&frame->body)) return answer(rpc::Pong{ping->nonce});
  if (const auto* page = std::get_if<rpc::SessionListRequest>(&frame->body)) {
    rpc::SessionList list = services_.join_handler.list(*page);
    accepted();
    return answer(std::move(list));
  }
  on_command(std::move(frame->body));
}

// An unknown peer keeps its place among the pending connections no longer than a silent one may. Only the lookup by its
// key is repeated; its payload is not parsed.
bool ControlConnection::await_enrolment(SecretBuffer& bytes) {
  const Time now = services_.now();
  if (!enrolment_until_) enrolment_until_ = now + kComingWait;
  if (!pending_ || now >= *enrolment_until_ || !services_.join_handler.learns_enrolments()) return false;
  look_again_.expires_after(kComingLook);
  look_again_.async_wait([weak = weak_from_this(), bytes = std::move(bytes)](const asio::error_code& stopped) mutable {
    if (const auto self = weak.lock(); self && !stopped && !self->finished_) self->on_frame(std::move(bytes));
  });
  return true;
}

/// A connection that waits for a request receives an unsolicited error reply. One that is being answered is closed
/// without.
void ControlConnection::disconnect_if_revoked() {
  if (finished_ || !workstation_) return;
  const auto row = services_.trust.registry().find(pin_);
  if (!row || *row) return;  // an unreadable registry closes no connection
  record(ControlEvent::kNotEnrolled, "revoked: its connection is closed");
  if (writing_) return finish();
  request_ = 0;
  refuse(ErrorCode::kNotEnrolled, std::string(kUnknown), true);
}

bool ControlConnection::reply_if_blocked(Duration left) {
  if (left <= Duration::zero()) return false;
  record(ControlEvent::kBlocked);
  const std::uint32_t wait = whole_seconds(left);
  refuse(ErrorCode::kBlocked,
         "too many wrong codes came from this workstation or address; wait " + std::to_string(wait) +
             " s, or join by a ticket",
         true, wait);
  return true;
}

void ControlConnection::on_enrol(const rpc::Enroll& enrol) {
  if (reply_if_blocked(services_.attempts.blocked_for(source_, enrolled_key(), services_.now()))) return;
  const auto row = services_.trust.registry().enroll(enrol.code, pin_, services_.clocks.wall());
  if (row) {
    services_.events.record(ControlEvent::kEnrolled, address_, row->name, pin_.hex());
    accepted();
    return answer(
        rpc::EnrollAck{row->name, enrol.service ? services_.join_handler.members() : std::vector<std::string>{}});
  }
  if (!row.error().fault) {
    services_.events.record(ControlEvent::kTrouble, address_, "", row.error().text);
    return refuse(ErrorCode::kInternal, "the server cannot write its registry of workstations; its log has the cause",
                  true);
  }
  services_.events.record(ControlEvent::kCodeRefused, address_, "", row.error().text);
  const auto fault = *row.error().fault;
  if (fault == auth::EnrollError::kUnknownCode)
    services_.attempts.record_failure(source_, enrolled_key(), services_.now());
  refuse(fault == auth::EnrollError::kBookFull ? ErrorCode::kFull : ErrorCode::kCode, row.error().text, true);
}

void ControlConnection::on_hello(rpc::Hello hello) {
  std::uint32_t version = 0;  // the newest in common
  for (const std::uint32_t offered : hello.versions)
    if (offered >= rpc::kProtocolVersionMin && offered <= rpc::kProtocolVersion) version = offered;
  if (version == 0)
    return refuse(ErrorCode::kVersion,
                  "this server supports versions " + std::to_string(rpc::kProtocolVersionMin) + " to " +
                      std::to_string(rpc::kProtocolVersion) + " of the protocol, this client none of them (" +
                      std::to_string(hello.versions.front()) + " to " + std::to_string(hello.versions.back()) +
                      "); install the same release on both",
                  true);
  // Only codes can be guessed, so a block of the source or the key applies to them only. A resume secret is checked
  // against the key only: if it names its session by the code, it costs the key's own attempts.
  const bool by_resume = std::holds_alternative<rpc::ResumeCredential>(hello.credential);
  const bool by_code = std::holds_alternative<std::string>(hello.session) ||
                       std::holds_alternative<rpc::CodeCredential>(hello.credential);
  const Time now = services_.now();
  if (by_code && reply_if_blocked(by_resume ? services_.attempts.blocked_for(pin_, now)
                                            : services_.attempts.blocked_for(source_, pin_, now)))
    return;
  if (!services_.slots.may_join(by_resume)) {
    const std::string full = "all " + std::to_string(services_.limits.connections) +
                             " control connections of this server are in use by joined clients; try again later";
    record(ControlEvent::kRefused, full);
    return refuse(ErrorCode::kFull, full, true, 5);
  }
  const auto request = std::make_shared<JoinRequest>(JoinRequest{std::move(hello), *workstation_, address_, version});
  if (!pending_) set_deadline(services_.limits.frame_deadline);
  admit(request, now + kComingWait);
}

// All clients of a lost server come at once, often from one address. If each of them connected again until the session
// is served, they would exceed the limit of connections per address.
void ControlConnection::admit(const std::shared_ptr<JoinRequest>& request, Time until) {
  if (services_.now() < until && services_.join_handler.is_coming(request->hello.session))
    return look_again(request, until);
  // The reply may come from another thread, or after this connection has ended.
  services_.join_handler.admit(*request, [weak = weak_from_this(), request, until, &context = services_.context,
                                          &admissions = services_.join_handler](JoinReply admission) {
    asio::dispatch(context, [weak, request, until, &admissions, admission = std::move(admission)]() mutable {
      if (const auto self = weak.lock(); self && !self->finished_)
        return self->on_join_reply(request, std::move(admission), until);
      if (const auto* welcome = std::get_if<rpc::Welcome>(&admission)) admissions.on_join_failed(*welcome);
    });
  });
}

void ControlConnection::look_again(const std::shared_ptr<JoinRequest>& request, Time until) {
  look_again_.expires_after(kComingLook);
  look_again_.async_wait([weak = weak_from_this(), request, until](const asio::error_code& stopped) {
    if (const auto self = weak.lock(); self && !stopped && !self->finished_) self->admit(request, until);
  });
}

void ControlConnection::on_join_reply(const std::shared_ptr<JoinRequest>& request, JoinReply admission, Time until) {
  if (auto* refused = std::get_if<rpc::ErrorReply>(&admission)) {
    if (refused->code == ErrorCode::kCode) services_.attempts.record_failure(source_, pin_, services_.now());
    record(ControlEvent::kRefused, refused->text);
    const bool last = refused->code != ErrorCode::kNotNow;  // the client may ask again over this connection
    return answer(std::move(*refused), last);
  }
  if (auto* elsewhere = std::get_if<rpc::Elsewhere>(&admission)) {
    // A client that is back from there did not reach that server: perhaps another one is about to serve the session.
    if (sent_to_ == *elsewhere && services_.now() < until) return look_again(request, until);
    sent_to_ = *elsewhere;
    record(ControlEvent::kElsewhere, elsewhere->session + " at " + elsewhere->address);
    return answer(std::move(*elsewhere));
  }
  rpc::Welcome& welcome = std::get<rpc::Welcome>(admission);
  welcome.version = request->version;
  if (request->version >= rpc::kVersionOfServices) welcome.members = services_.join_handler.members();
  const auto secrets =
      stream_->export_secrets({welcome.session_id, welcome.epoch, welcome.server_cid, welcome.role, welcome.seat});
  if (!secrets) {
    record(ControlEvent::kTrouble, secrets.error());
    services_.join_handler.on_join_failed(welcome);
    return refuse(ErrorCode::kInternal, "the server could not create this connection's keys; its log has the cause",
                  true);
  }
  services_.join_handler.on_joined(*request, welcome, *secrets);
  welcome_ = welcome;
  record(ControlEvent::kWelcomed, welcome.seat);
  accepted();
  on_change_(*this, ConnectionChange::kJoined);
  answer(std::move(welcome));
}

void ControlConnection::on_command(rpc::Body command) {
  record(ControlEvent::kCommand);
  set_deadline(services_.limits.frame_deadline);
  services_.join_handler.command(*welcome_, *workstation_, std::move(command),
                                 [weak = weak_from_this(), &context = services_.context](rpc::Body body) {
                                   asio::dispatch(context, [weak, body = std::move(body)]() mutable {
                                     const auto self = weak.lock();
                                     if (!self || self->finished_) return;
                                     self->acted_ = self->acted_ || !(std::holds_alternative<rpc::ErrorReply>(body) ||
                                                                      std::holds_alternative<rpc::Status>(body));
                                     self->answer(std::move(body));
                                   });
                                 });
}

void ControlConnection::set_deadline(std::chrono::milliseconds time) {
  stream_->set_deadline(time, [weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->on_stream_fault({StreamErrorCode::kDeadline, "no answer in time"});
  });
}

void ControlConnection::accepted() {
  if (!pending_) return;
  pending_ = false;
  stream_->clear_deadline();
  stream_->allow_input(auth::ByteLimitedSocket::kUnlimited);
  on_key_proved();
}

void ControlConnection::refuse(ErrorCode reason, std::string text, bool last, std::uint32_t retry_after_s) {
  answer(rpc::ErrorReply{reason, std::move(text), retry_after_s}, last);
}

void ControlConnection::answer(rpc::Body body, bool last) {
  if (finished_ || writing_) return;  // the last reply is being written already
  // Unknown peers get no information about this computer.
  if (auto* const refused = std::get_if<rpc::ErrorReply>(&body);
      refused != nullptr && workstation_ && services_.trust.on_disk()) {
    std::string text = with_options(refused->text, "tandem-server", {"ticket", "enroll", "revoke"},
                                    auth::server_state_option(services_.trust.folder()->path()));
    if (text.size() <= rpc::kTextMax) refused->text = std::move(text);
  }
  if (!stream_->peer_knows_held()) rpc::write_for_older_peer(body);
  refused_ = refused_ || (welcome_ && std::holds_alternative<rpc::ErrorReply>(body));
  auto frame = rpc::encode({request_, std::move(body)});
  if (!frame) {  // the server's own error: the reply exceeds the limits
    record(ControlEvent::kTrouble, "an answer could not be written");
    return finish();
  }
  // A client that does not read its reply is disconnected.
  if (!pending_) set_deadline(services_.limits.answer_deadline);
  writing_ = true;
  stream_->write(std::move(*frame), [self = shared_from_this(), last](std::expected<void, auth::StreamError> written) {
    self->writing_ = false;
    if (!written) return self->on_stream_fault(written.error());
    if (!self->pending_) self->stream_->clear_deadline();
    if (last) return self->finish();
    self->services_.slots.set_busy(self->id_, false, self->services_.now());
    self->read_next();
  });
}

void ControlConnection::on_stream_fault(const auth::StreamError& fault) {
  if (finished_) return;
  switch (fault.end) {
    case StreamErrorCode::kDeadline:
      record(ControlEvent::kDeadline);
      break;
    case StreamErrorCode::kTooMuch:
      record(ControlEvent::kTooMuchInput);
      break;
    case StreamErrorCode::kLength:
      record(ControlEvent::kBadFrame, fault.text);
      return refuse(ErrorCode::kBadFrame, fault.text, true);
    case StreamErrorCode::kHandshake:
      record(ControlEvent::kHandshakeFailed, fault.text);
      break;
    case StreamErrorCode::kClosed:
    case StreamErrorCode::kStopped:
    case StreamErrorCode::kNetwork:
      break;
  }
  finish();
}

void ControlConnection::finish() {
  if (finished_) return;
  finished_ = true;
  const auto self = shared_from_this();
  look_again_.cancel();
  stream_->close();
  if (welcome_) services_.join_handler.on_disconnected(*welcome_, refused_ && !acted_);
  on_change_(*this, ConnectionChange::kEnded);
}

}  // namespace tandem::server
