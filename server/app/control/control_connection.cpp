#include "server/app/control/control_connection.h"

#include <algorithm>
#include <asio/dispatch.hpp>
#include <utility>

#include "common/base/command_hints.h"
#include "proto/rpc/rpc_codec.h"
#include "server/policy/roles.h"

namespace tandem::server {
namespace {

using auth::StreamErrorCode;
using rpc::ErrorCode;
using rpc::Kind;

constexpr std::string_view kUnknown =
    "this workstation is not enrolled here, or was revoked; ask its administrator for `tandem-server enroll NAME` and "
    "run the command that it prints";

std::uint32_t whole_seconds(Duration d) noexcept {
  return static_cast<std::uint32_t>(std::clamp(seconds(d) + 1.0, 1.0, 86400.0));
}

}  // namespace

ControlConnection::ControlConnection(ControlPlane& plane, auth::PendingSlots::Id id, asio::ip::tcp::socket socket,
                                     const auth::Origin& origin, const auth::Source& source, std::string address)
    : plane_(plane),
      id_(id),
      stream_(auth::ControlStream::make(std::move(socket), plane.tls_, auth::ControlStream::Side::kServer)),
      origin_(origin),
      source_(source),
      address_(std::move(address)),
      commands_(rpc::RateLimits{}.commands_per_s, rpc::RateLimits{}.commands_burst),
      stops_(commands_),
      authority_(rpc::RateLimits{}.authority_per_s, rpc::RateLimits{}.authority_burst) {}

void ControlConnection::start(std::chrono::milliseconds deadline) {
  set_deadline(deadline);
  stream_->allow_input(plane_.limits_.input_before_auth);
  stream_->handshake([self = shared_from_this()](auth::ControlStream::Peer peer) {
    if (!peer) return self->on_stream_fault(peer.error());
    if (self->finished_) return;
    self->pin_ = *peer;
    // An unknown workstation may enrol. Until then its connection competes with all other unknown ones.
    if (const auto row = self->plane_.trust_.find(self->pin_); row && *row) self->on_key_proved();
    self->read_next();
  });
}

void ControlConnection::stop() { finish(); }

void ControlConnection::close(ControlEvent why) {
  if (finished_) return;
  plane_.record_event(why, address_, workstation_ ? workstation_->name : "");
  finish();
}

void ControlConnection::on_key_proved() {
  if (std::exchange(proved_, true)) return;
  plane_.on_key_proved(*this);
}

void ControlConnection::read_next() {
  if (finished_) return;
  const std::size_t frame_max = pending_ ? std::min(plane_.limits_.input_before_auth, rpc::kFrameMax) : rpc::kFrameMax;
  const auto frame_deadline =
      pending_ ? auth::ControlStream::Duration::zero() : auth::ControlStream::Duration(plane_.limits_.frame_deadline);
  stream_->read(frame_max, frame_deadline, [self = shared_from_this()](auth::ControlStream::Bytes bytes) {
    if (!bytes) return self->on_stream_fault(bytes.error());
    self->on_frame(std::move(*bytes));
  });
}

void ControlConnection::on_frame(SecretBuffer bytes) {
  if (finished_) return;
  plane_.set_busy(*this, true);
  const auto raw = std::as_const(bytes).bytes();
  // The role is checked before the payload is parsed.
  const auto head = rpc::peek(raw);
  request_ = head ? head->request : 0;
  if (!head || !is_client_message(head->kind)) {
    plane_.record_event(ControlEvent::kBadFrame, address_);
    const bool version = !head && head.error() == rpc::FrameError::kVersion;
    return refuse(version ? ErrorCode::kVersion : ErrorCode::kBadFrame,
                  version
                      ? "this server supports version 1 of Tandem's control frames; use a client of the same release"
                      : "the server cannot parse this message",
                  true);
  }
  auto row = plane_.trust_.find(pin_);
  if (!row) {
    plane_.record_event(ControlEvent::kTrouble, address_, "", row.error());
    return refuse(ErrorCode::kInternal,
                  "the server cannot read its registry of workstations, so it rejects all joins; its log has the cause",
                  true);
  }
  workstation_ = std::move(*row);
  if (!workstation_ && head->kind != Kind::kEnroll) {
    plane_.record_event(ControlEvent::kNotEnrolled, address_, "", pin_.hex());
    return refuse(ErrorCode::kNotEnrolled, std::string(kUnknown), true);
  }
  const Time now = plane_.clocks_.monotonic();
  if (!bucket_of(head->kind).take(now)) {
    plane_.record_event(ControlEvent::kCommandTooFast, address_, workstation_ ? workstation_->name : "");
    return refuse(ErrorCode::kTooFast, "too many requests; send them more slowly", pending_, 1);
  }
  const auto role = welcome_ ? std::optional(welcome_->role) : std::nullopt;
  if (!allowed(role, head->kind)) {
    std::string why = forbidden_text(role, head->kind);
    plane_.record_event(ControlEvent::kForbidden, address_, workstation_ ? workstation_->name : "",
                        forbidden_events_.take(now) ? why : "");
    return refuse(ErrorCode::kNotAllowed, std::move(why), pending_);
  }
  auto frame = rpc::decode(raw);
  if (!frame) {
    plane_.record_event(ControlEvent::kBadFrame, address_, workstation_ ? workstation_->name : "");
    return refuse(ErrorCode::kBadFrame, std::string(rpc::to_text(frame.error())), true);
  }
  if (const auto* enrol = std::get_if<rpc::Enroll>(&frame->body)) return on_enrol(*enrol);
  if (auto* hello = std::get_if<rpc::Hello>(&frame->body)) return on_hello(std::move(*hello));
  if (const auto* ping = std::get_if<rpc::Ping>(&frame->body)) return answer(rpc::Pong{ping->nonce});
  if (std::holds_alternative<rpc::SessionListRequest>(frame->body)) {
    rpc::SessionList list = plane_.join_handler_.list(*workstation_);
    accepted();
    return answer(std::move(list));
  }
  on_command(std::move(frame->body));
}

auth::TokenBucket& ControlConnection::bucket_of(Kind kind) noexcept {
  if (kind == Kind::kSetAuthority) return authority_;
  return kind == Kind::kStopSession || kind == Kind::kPauseSession ? stops_ : commands_;
}

/// A connection that waits for a request receives an unsolicited error reply. One that is being answered is closed
/// without.
void ControlConnection::disconnect_if_revoked() {
  if (finished_ || !workstation_) return;
  const auto row = plane_.trust_.find(pin_);
  if (!row || *row) return;  // an unreadable registry closes no connection
  plane_.record_event(ControlEvent::kNotEnrolled, address_, workstation_->name, "revoked: its connection is closed");
  if (writing_) return finish();
  request_ = 0;
  refuse(ErrorCode::kNotEnrolled, std::string(kUnknown), true);
}

bool ControlConnection::reply_if_blocked(Duration left) {
  if (left <= Duration::zero()) return false;
  plane_.record_event(ControlEvent::kBlocked, address_, workstation_ ? workstation_->name : "");
  const std::uint32_t wait = whole_seconds(left);
  refuse(ErrorCode::kBlocked,
         "too many wrong codes came from this workstation or address; wait " + std::to_string(wait) +
             " s, or join by a ticket",
         true, wait);
  return true;
}

void ControlConnection::on_enrol(const rpc::Enroll& enrol) {
  if (reply_if_blocked(plane_.attempts_.blocked_for(source_, enrolled_key(), plane_.clocks_.monotonic()))) return;
  const auto row = plane_.trust_.enroll(enrol.code, pin_, plane_.clocks_.wall());
  if (row) {
    plane_.record_event(ControlEvent::kEnrolled, address_, row->name, pin_.hex());
    accepted();
    return answer(rpc::EnrollAck{row->name});
  }
  if (!row.error().fault) {
    plane_.record_event(ControlEvent::kTrouble, address_, "", row.error().text);
    return refuse(ErrorCode::kInternal, "the server cannot write its registry of workstations; its log has the cause",
                  true);
  }
  plane_.record_event(ControlEvent::kCodeRefused, address_, "", row.error().text);
  const auto fault = *row.error().fault;
  if (fault == auth::EnrollError::kUnknownCode)
    plane_.attempts_.record_failure(source_, enrolled_key(), plane_.clocks_.monotonic());
  refuse(fault == auth::EnrollError::kBookFull ? ErrorCode::kFull : ErrorCode::kCode, row.error().text, true);
}

void ControlConnection::on_hello(rpc::Hello hello) {
  const auto common = std::ranges::find_if(hello.versions, [](std::uint32_t v) { return v == rpc::kProtocolVersion; });
  if (common == hello.versions.end())
    return refuse(ErrorCode::kVersion,
                  "this server supports version " + std::to_string(rpc::kProtocolVersion) +
                      " of the protocol, this client supports none of it; install the same release on both",
                  true);
  // Only codes can be guessed, so a block of the source or the key applies to them only. A resume secret is checked
  // against the key only: if it names its session by the code, it costs the key's own attempts.
  const bool by_resume = std::holds_alternative<rpc::ResumeCredential>(hello.credential);
  const bool by_code = std::holds_alternative<std::string>(hello.session) ||
                       std::holds_alternative<rpc::CodeCredential>(hello.credential);
  const Time now = plane_.clocks_.monotonic();
  if (by_code && reply_if_blocked(by_resume ? plane_.attempts_.blocked_for(pin_, now)
                                            : plane_.attempts_.blocked_for(source_, pin_, now)))
    return;
  if (!plane_.places_.may_join(by_resume)) {
    const std::string full = "all " + std::to_string(plane_.limits_.connections) +
                             " control connections of this server are in use by joined clients; try again later";
    plane_.record_event(ControlEvent::kRefused, address_, workstation_->name, full);
    return refuse(ErrorCode::kFull, full, true, 5);
  }
  const auto request =
      std::make_shared<JoinRequest>(JoinRequest{std::move(hello), *common, *workstation_, source_, address_});
  if (!pending_) set_deadline(plane_.limits_.frame_deadline);
  // The reply may come from another thread, or after this connection has ended.
  plane_.join_handler_.admit(*request, [weak = weak_from_this(), request, &context = plane_.context_,
                                        &admissions = plane_.join_handler_](JoinReply admission) {
    asio::dispatch(context, [weak, request, &admissions, admission = std::move(admission)]() mutable {
      if (const auto self = weak.lock(); self && !self->finished_)
        return self->on_join_reply(request, std::move(admission));
      if (const auto* welcome = std::get_if<rpc::Welcome>(&admission)) admissions.on_join_failed(*welcome);
    });
  });
}

void ControlConnection::on_join_reply(const std::shared_ptr<JoinRequest>& request, JoinReply admission) {
  if (auto* refused = std::get_if<rpc::ErrorReply>(&admission)) {
    if (refused->code == ErrorCode::kCode) plane_.attempts_.record_failure(source_, pin_, plane_.clocks_.monotonic());
    plane_.record_event(ControlEvent::kRefused, address_, request->workstation.name, refused->text);
    return answer(std::move(*refused), true);
  }
  rpc::Welcome& welcome = std::get<rpc::Welcome>(admission);
  const auto secrets =
      stream_->export_secrets({welcome.session_id, welcome.epoch, welcome.server_cid, welcome.role, welcome.seat});
  if (!secrets) {
    plane_.record_event(ControlEvent::kTrouble, address_, request->workstation.name, secrets.error());
    plane_.join_handler_.on_join_failed(welcome);
    return refuse(ErrorCode::kInternal, "the server could not create this connection's keys; its log has the cause",
                  true);
  }
  plane_.join_handler_.on_joined(*request, welcome, *secrets);
  plane_.record_event(ControlEvent::kWelcomed, address_, request->workstation.name, welcome.seat);
  welcome_ = welcome;
  accepted();
  plane_.on_joined(*this, welcome);
  answer(std::move(welcome));
}

void ControlConnection::on_command(rpc::Body command) {
  plane_.record_event(ControlEvent::kCommand, address_, workstation_->name);
  set_deadline(plane_.limits_.frame_deadline);
  plane_.join_handler_.command(*welcome_, *workstation_, std::move(command),
                               [weak = weak_from_this(), &context = plane_.context_](rpc::Body body) {
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
      refused != nullptr && workstation_ && plane_.trust_.on_disk()) {
    std::string text = with_options(refused->text, "tandem-server", {"ticket", "enroll", "revoke"},
                                    auth::server_state_option(plane_.trust_.folder()->path()));
    if (text.size() <= rpc::kTextMax) refused->text = std::move(text);
  }
  refused_ = refused_ || (welcome_ && std::holds_alternative<rpc::ErrorReply>(body));
  auto frame = rpc::encode({request_, std::move(body)});
  if (!frame) {  // the server's own error: the reply exceeds the limits
    plane_.record_event(ControlEvent::kTrouble, address_, workstation_ ? workstation_->name : "",
                        "an answer could not be written");
    return finish();
  }
  // A client that does not read its reply is disconnected.
  if (!pending_) set_deadline(plane_.limits_.answer_deadline);
  writing_ = true;
  stream_->write(std::move(*frame), [self = shared_from_this(), last](std::expected<void, auth::StreamError> written) {
    self->writing_ = false;
    if (!written) return self->on_stream_fault(written.error());
    if (!self->pending_) self->stream_->clear_deadline();
    if (last) return self->finish();
    self->plane_.set_busy(*self, false);
    self->read_next();
  });
}

void ControlConnection::on_stream_fault(const auth::StreamError& fault) {
  if (finished_) return;
  switch (fault.end) {
    case StreamErrorCode::kDeadline:
      plane_.record_event(ControlEvent::kDeadline, address_, workstation_ ? workstation_->name : "");
      break;
    case StreamErrorCode::kTooMuch:
      plane_.record_event(ControlEvent::kTooMuchInput, address_);
      break;
    case StreamErrorCode::kLength:
      plane_.record_event(ControlEvent::kBadFrame, address_, workstation_ ? workstation_->name : "", fault.text);
      return refuse(ErrorCode::kBadFrame, fault.text, true);
    case StreamErrorCode::kHandshake:
      plane_.record_event(ControlEvent::kHandshakeFailed, address_, "", fault.text);
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
  stream_->close();
  if (welcome_) plane_.join_handler_.on_disconnected(*welcome_, refused_ && !acted_);
  plane_.on_ended(*self);
}

}  // namespace tandem::server
