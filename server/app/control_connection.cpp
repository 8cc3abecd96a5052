#include "server/app/control_connection.h"

#include <algorithm>
#include <asio/dispatch.hpp>
#include <utility>

#include "common/base/printed_command.h"
#include "proto/control_codec.h"
#include "server/roles.h"

namespace tandem::server {
namespace {

using control::Kind;
using control::Reason;
using trust::StreamEnd;

constexpr std::string_view kUnknown = "this workstation is not enrolled here, or was revoked; ask for `tandem-server enroll NAME` and type what it prints";

std::uint32_t whole_seconds(Duration d) noexcept { return static_cast<std::uint32_t>(std::clamp(seconds(d) + 1.0, 1.0, 86400.0)); }

}  // namespace

ControlConnection::ControlConnection(ControlPlane& plane, trust::PendingPlaces::Id id, asio::ip::tcp::socket socket, const trust::Origin& origin,
                                     const trust::Source& source, std::string address)
    : plane_(plane),
      id_(id),
      stream_(trust::ControlStream::make(std::move(socket), plane.tls_, trust::ControlStream::Side::kServer)),
      origin_(origin),
      source_(source),
      address_(std::move(address)),
      commands_(control::RateLimits{}.commands_per_s, control::RateLimits{}.commands_burst),
      stops_(commands_),
      authority_(control::RateLimits{}.authority_per_s, control::RateLimits{}.authority_burst) {}

void ControlConnection::start(std::chrono::milliseconds deadline) {
  must_be_over_in(deadline);
  stream_->allow_input(plane_.limits_.input_before_auth);
  stream_->handshake([self = shared_from_this()](trust::ControlStream::Peer peer) {
    if (!peer) return self->over(peer.error());
    if (self->finished_) return;
    self->pin_ = *peer;
    // A stranger may enrol, but competes with all others who are not known yet until then.
    if (const auto row = self->plane_.trust_.find(self->pin_); row && *row) self->proved();
    self->read_next();
  });
}

void ControlConnection::stop() { finish(); }

void ControlConnection::close(ControlEvent why) {
  if (finished_) return;
  plane_.note(why, address_, workstation_ ? workstation_->name : "");
  finish();
}

void ControlConnection::proved() {
  if (std::exchange(proved_, true)) return;
  plane_.proved(*this);
}

void ControlConnection::read_next() {
  if (finished_) return;
  const std::size_t frame_max = pending_ ? std::min(plane_.limits_.input_before_auth, control::kFrameMax) : control::kFrameMax;
  const auto frame_deadline = pending_ ? trust::ControlStream::Duration::zero() : trust::ControlStream::Duration(plane_.limits_.frame_deadline);
  stream_->read(frame_max, frame_deadline, [self = shared_from_this()](trust::ControlStream::Bytes bytes) {
    if (!bytes) return self->over(bytes.error());
    self->took(std::move(*bytes));
  });
}

void ControlConnection::took(SecretBuffer bytes) {
  if (finished_) return;
  plane_.busy(*this, true);
  const auto raw = std::as_const(bytes).bytes();
  // Who may say what is decided before a payload is parsed.
  const auto head = control::peek(raw);
  request_ = head ? head->request : 0;
  if (!head || !said_by_clients(head->kind)) {
    plane_.note(ControlEvent::kBadFrame, address_);
    const bool version = !head && head.error() == control::FrameError::kVersion;
    return refuse(version ? Reason::kVersion : Reason::kBadFrame,
                  version ? "this server speaks version 1 of Tandem's control frames; use a client of the same release" : "the server does not understand this",
                  true);
  }
  auto row = plane_.trust_.find(pin_);
  if (!row) {
    plane_.note(ControlEvent::kTrouble, address_, "", row.error());
    return refuse(Reason::kTrouble, "the server cannot read its book of workstations, so it lets nobody in; its log says more", true);
  }
  workstation_ = std::move(*row);
  if (!workstation_ && head->kind != Kind::kEnrol) {
    plane_.note(ControlEvent::kNotEnrolled, address_, "", pin_.hex());
    return refuse(Reason::kNotEnrolled, std::string(kUnknown), true);
  }
  const Time now = plane_.clocks_.monotonic();
  if (!bucket_of(head->kind).take(now)) {
    plane_.note(ControlEvent::kCommandTooFast, address_, workstation_ ? workstation_->name : "");
    return refuse(Reason::kTooFast, "too many requests; ask more slowly", pending_, 1);
  }
  const auto role = standing_ ? std::optional(standing_->role) : std::nullopt;
  if (!allowed(role, head->kind)) {
    std::string why = why_not(role, head->kind);
    plane_.note(ControlEvent::kForbidden, address_, workstation_ ? workstation_->name : "", complaints_.take(now) ? why : "");
    return refuse(Reason::kNotAllowed, std::move(why), pending_);
  }
  auto frame = control::decode(raw);
  if (!frame) {
    plane_.note(ControlEvent::kBadFrame, address_, workstation_ ? workstation_->name : "");
    return refuse(Reason::kBadFrame, std::string(control::to_text(frame.error())), true);
  }
  if (const auto* enrol = std::get_if<control::Enrol>(&frame->body)) return on_enrol(*enrol);
  if (auto* hello = std::get_if<control::Hello>(&frame->body)) return on_hello(std::move(*hello));
  if (const auto* ping = std::get_if<control::Ping>(&frame->body)) return answer(control::Pong{ping->nonce});
  if (std::holds_alternative<control::SessionListRequest>(frame->body)) {
    control::SessionList list = plane_.admissions_.list(*workstation_);
    accepted();
    return answer(std::move(list));
  }
  on_command(frame->body);
}

trust::TokenBucket& ControlConnection::bucket_of(Kind kind) noexcept {
  if (kind == Kind::kSetAuthority) return authority_;
  return kind == Kind::kStopSession || kind == Kind::kPauseSession ? stops_ : commands_;
}

/// Who waits for our next word gets it as an answer to nothing; who is being answered just now hears no more.
void ControlConnection::look_for_revocation() {
  if (finished_ || !workstation_) return;
  const auto row = plane_.trust_.find(pin_);
  if (!row || *row) return;  // a book that cannot be read ends nobody's connection
  plane_.note(ControlEvent::kNotEnrolled, address_, workstation_->name, "revoked: its connection is closed");
  if (writing_) return finish();
  request_ = 0;
  refuse(Reason::kNotEnrolled, std::string(kUnknown), true);
}

bool ControlConnection::blocked(Duration left) {
  if (left <= Duration::zero()) return false;
  plane_.note(ControlEvent::kBlocked, address_, workstation_ ? workstation_->name : "");
  const std::uint32_t wait = whole_seconds(left);
  refuse(Reason::kBlocked, "too many wrong codes came from this workstation or address; wait " + std::to_string(wait) + " s, or join by a ticket", true, wait);
  return true;
}

void ControlConnection::on_enrol(const control::Enrol& enrol) {
  if (blocked(plane_.attempts_.blocked_for(source_, enrolled_key(), plane_.clocks_.monotonic()))) return;
  const auto row = plane_.trust_.enrol(enrol.code, pin_, plane_.clocks_.wall());
  if (row) {
    plane_.note(ControlEvent::kEnrolled, address_, row->name, pin_.hex());
    accepted();
    return answer(control::EnrolAck{row->name});
  }
  if (!row.error().fault) {
    plane_.note(ControlEvent::kTrouble, address_, "", row.error().text);
    return refuse(Reason::kTrouble, "the server cannot write its book of workstations; its log says more", true);
  }
  plane_.note(ControlEvent::kCodeRefused, address_, "", row.error().text);
  const auto fault = *row.error().fault;
  if (fault == trust::EnrolFault::kUnknownCode) plane_.attempts_.wrong(source_, enrolled_key(), plane_.clocks_.monotonic());
  refuse(fault == trust::EnrolFault::kBookFull ? Reason::kFull : Reason::kCode, row.error().text, true);
}

void ControlConnection::on_hello(control::Hello hello) {
  const auto common = std::ranges::find_if(hello.versions, [](std::uint32_t v) { return v == control::kProtocolVersion; });
  if (common == hello.versions.end())
    return refuse(Reason::kVersion,
                  "this server speaks version " + std::to_string(control::kProtocolVersion) +
                      " of the protocol, this client none of it; install the same release on both",
                  true);
  // Only codes can be guessed, so only they wait for a block to be over: of the source or of the key. A resume secret waits for no source: its
  // session may be named by the code, which costs the key's own attempts.
  const bool by_resume = std::holds_alternative<control::ResumeCredential>(hello.credential);
  const bool by_code = std::holds_alternative<std::string>(hello.session) || std::holds_alternative<control::CodeCredential>(hello.credential);
  const Time now = plane_.clocks_.monotonic();
  if (by_code && blocked(by_resume ? plane_.attempts_.blocked_for(pin_, now) : plane_.attempts_.blocked_for(source_, pin_, now))) return;
  if (!plane_.places_.may_join(by_resume)) {
    const std::string full = "all " + std::to_string(plane_.limits_.connections) + " places of this server's control connections are taken by those who joined; try again later";
    plane_.note(ControlEvent::kRefused, address_, workstation_->name, full);
    return refuse(Reason::kFull, full, true, 5);
  }
  const auto request = std::make_shared<JoinRequest>(JoinRequest{std::move(hello), *common, *workstation_, source_, address_});
  if (!pending_) must_be_over_in(plane_.limits_.frame_deadline);
  // The answer may come from another thread, and after this connection has ended.
  plane_.admissions_.admit(*request, [weak = weak_from_this(), request, &context = plane_.context_, &admissions = plane_.admissions_](Admission admission) {
    asio::dispatch(context, [weak, request, &admissions, admission = std::move(admission)]() mutable {
      if (const auto self = weak.lock(); self && !self->finished_) return self->admitted(request, std::move(admission));
      if (const auto* welcome = std::get_if<control::Welcome>(&admission)) admissions.abandoned(*welcome);
    });
  });
}

void ControlConnection::admitted(const std::shared_ptr<JoinRequest>& request, Admission admission) {
  if (auto* refused = std::get_if<control::Refused>(&admission)) {
    if (refused->reason == Reason::kCode) plane_.attempts_.wrong(source_, pin_, plane_.clocks_.monotonic());
    plane_.note(ControlEvent::kRefused, address_, request->workstation.name, refused->text);
    return answer(std::move(*refused), true);
  }
  control::Welcome& welcome = std::get<control::Welcome>(admission);
  const auto secrets = stream_->export_secrets({welcome.session_id, welcome.epoch, welcome.server_cid, welcome.role, welcome.seat});
  if (!secrets) {
    plane_.note(ControlEvent::kTrouble, address_, request->workstation.name, secrets.error());
    plane_.admissions_.abandoned(welcome);
    return refuse(Reason::kTrouble, "the server could not make this connection's keys; its log says more", true);
  }
  plane_.admissions_.seated(*request, welcome, *secrets);
  plane_.note(ControlEvent::kWelcomed, address_, request->workstation.name, welcome.seat);
  standing_ = welcome;
  accepted();
  plane_.joined(*this, welcome);
  answer(std::move(welcome));
}

void ControlConnection::on_command(const control::Body& command) {
  plane_.note(ControlEvent::kCommand, address_, workstation_->name);
  must_be_over_in(plane_.limits_.frame_deadline);
  plane_.admissions_.command(*standing_, *workstation_, command, [weak = weak_from_this(), &context = plane_.context_](control::Body body) {
    asio::dispatch(context, [weak, body = std::move(body)]() mutable {
      const auto self = weak.lock();
      if (!self || self->finished_) return;
      self->acted_ = self->acted_ || !(std::holds_alternative<control::Refused>(body) || std::holds_alternative<control::Status>(body));
      self->answer(std::move(body));
    });
  });
}

void ControlConnection::must_be_over_in(std::chrono::milliseconds time) {
  stream_->set_deadline(time, [weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->over({StreamEnd::kDeadline, "no answer in time"});
  });
}

void ControlConnection::accepted() {
  if (!pending_) return;
  pending_ = false;
  stream_->clear_deadline();
  stream_->allow_input(trust::MeteredSocket::kUnlimited);
  proved();
}

void ControlConnection::refuse(Reason reason, std::string text, bool last, std::uint32_t retry_after_s) {
  answer(control::Refused{reason, std::move(text), retry_after_s}, last);
}

void ControlConnection::answer(control::Body body, bool last) {
  if (finished_ || writing_) return;  // the last word is on its way already
  if (auto* const refused = std::get_if<control::Refused>(&body); refused != nullptr && workstation_ && plane_.trust_.on_disk()) {  // strangers learn nothing of this computer
    std::string text = with_options(refused->text, "tandem-server", {"ticket", "enroll", "revoke"}, trust::server_state_option(plane_.trust_.folder()->path()));
    if (text.size() <= control::kTextMax) refused->text = std::move(text);
  }
  refused_ = refused_ || (standing_ && std::holds_alternative<control::Refused>(body));
  auto frame = control::encode({request_, std::move(body)});
  if (!frame) {  // ours, and beyond its bounds
    plane_.note(ControlEvent::kTrouble, address_, workstation_ ? workstation_->name : "", "an answer could not be written");
    return finish();
  }
  // Who does not take his answer is let go of.
  if (!pending_) must_be_over_in(plane_.limits_.answer_deadline);
  writing_ = true;
  stream_->write(std::move(*frame), [self = shared_from_this(), last](std::expected<void, trust::StreamFault> written) {
    self->writing_ = false;
    if (!written) return self->over(written.error());
    if (!self->pending_) self->stream_->clear_deadline();
    if (last) return self->finish();
    self->plane_.busy(*self, false);
    self->read_next();
  });
}

void ControlConnection::over(const trust::StreamFault& fault) {
  if (finished_) return;
  switch (fault.end) {
    case StreamEnd::kDeadline: plane_.note(ControlEvent::kDeadline, address_, workstation_ ? workstation_->name : ""); break;
    case StreamEnd::kTooMuch: plane_.note(ControlEvent::kTooMuchInput, address_); break;
    case StreamEnd::kLength:
      plane_.note(ControlEvent::kBadFrame, address_, workstation_ ? workstation_->name : "", fault.text);
      return refuse(Reason::kBadFrame, fault.text, true);
    case StreamEnd::kHandshake: plane_.note(ControlEvent::kHandshakeFailed, address_, "", fault.text); break;
    case StreamEnd::kClosed:
    case StreamEnd::kStopped:
    case StreamEnd::kTrouble: break;
  }
  finish();
}

void ControlConnection::finish() {
  if (finished_) return;
  finished_ = true;
  const auto self = shared_from_this();
  stream_->close();
  if (standing_) plane_.admissions_.left(*standing_, refused_ && !acted_);
  plane_.ended(*self);
}

}  // namespace tandem::server
