#include "proto/rpc/rpc_convert.h"

#include <algorithm>
#include <array>
#include <string>
#include <variant>

#include "proto/rpc/rpc_bounds.h"
#include "proto/rpc/rpc_convert_service.h"
#include "proto/rpc/rpc_convert_sessions.h"

namespace tandem::rpc {
namespace {

namespace wire_pb = pb::rpc;
using Pb = wire_pb::ControlFrame;

bool read(const wire_pb::Device& in, DeviceFacts& out) {
  out = {in.joints(),       in.tip_axes(),      in.simulated(), in.prismatic(),
         in.force_peak_n(), in.damping_n_s_m(), in.mass_kg(),   in.latency_s()};
  return within(in.joints(), 1, kAxesMax) && within(in.tip_axes(), 1, kAxesMax) && within(in.force_peak_n()) &&
         within(in.damping_n_s_m()) && within(in.mass_kg()) && in.latency_s() >= 0 && in.latency_s() <= kLatencyMax;
}

bool read(const wire_pb::Hello& in, Hello& out) {
  out.versions.assign(in.versions().begin(), in.versions().end());
  bool good = !out.versions.empty() && out.versions.size() <= kVersionsMax && out.versions.front() >= 1 &&
              out.versions.back() <= 65535 &&
              std::ranges::adjacent_find(out.versions, std::greater_equal{}) == out.versions.end();
  if (in.has_session_id()) good = take(in.session_id(), out.session.emplace<Id>()) && good;
  if (in.has_session_code()) {
    out.session = in.session_code();
    good = good && is_code(in.session_code());
  }
  good = take_name(in.seat(), out.seat, true) && good;
  if (in.has_ticket()) {
    out.credential = TicketCredential{to_bytes(in.ticket())};
    good = good && !in.ticket().empty() && in.ticket().size() <= kTicketMax;
  } else if (in.has_resume_secret()) {
    good = take(in.resume_secret(), out.credential.emplace<ResumeCredential>().secret.bytes) && good;
  } else if (in.has_code()) {
    out.credential = CodeCredential{in.code()};
    good = good && is_code(in.code());
  }
  out.client_cid = in.client_cid();
  out.has_aes = in.has_aes();
  out.link_test = in.visit();
  out.watch = in.watch();
  good = good && !(in.watch() && (in.visit() || !in.seat().empty()));
  return in.has_device() && read(in.device(), out.device) && good;
}
void write(const Hello& in, wire_pb::Hello& out) {
  out.mutable_versions()->Add(in.versions.begin(), in.versions.end());
  if (const auto* id = std::get_if<Id>(&in.session)) out.set_session_id(text_of(*id));
  if (const auto* code = std::get_if<std::string>(&in.session)) out.set_session_code(*code);
  out.set_seat(in.seat);
  if (const auto* t = std::get_if<TicketCredential>(&in.credential)) out.set_ticket(text_of(t->bytes));
  if (const auto* r = std::get_if<ResumeCredential>(&in.credential)) out.set_resume_secret(text_of(r->secret.bytes));
  if (const auto* c = std::get_if<CodeCredential>(&in.credential)) out.set_code(c->code);
  out.set_client_cid(in.client_cid);
  auto& d = *out.mutable_device();
  d.set_joints(in.device.joints);
  d.set_tip_axes(in.device.tip_axes);
  d.set_simulated(in.device.simulated);
  d.set_prismatic(in.device.prismatic);
  d.set_force_peak_n(in.device.force_peak_n);
  d.set_damping_n_s_m(in.device.damping_n_s_m);
  d.set_mass_kg(in.device.mass_kg);
  d.set_latency_s(in.device.latency_s);
  out.set_has_aes(in.has_aes);
  out.set_visit(in.link_test);
  out.set_watch(in.watch);
}

bool read(const wire_pb::RateLimits& in, RateLimits& out) {
  out = {in.datagrams_per_s(), in.datagrams_burst(), in.authority_per_s(),
         in.authority_burst(), in.commands_per_s(),  in.commands_burst()};
  const std::array all{out.datagrams_per_s, out.datagrams_burst, out.authority_per_s,
                       out.authority_burst, out.commands_per_s,  out.commands_burst};
  return std::ranges::all_of(all, [](std::uint32_t v) { return within(v, 1, 1000000); });
}

bool read(const wire_pb::Welcome& in, Welcome& out) {
  out.version = in.version();
  bool good = within(in.version(), 1, 65535) && take(in.session_id(), out.session_id);
  good = take_name(in.session_name(), out.session_name) && good;
  out.epoch = in.epoch();
  out.server_cid = in.server_cid();
  out.cipher = static_cast<Cipher>(in.cipher() & 1U);
  good = in.cipher() <= 1 && take_name(in.seat(), out.seat, true) && take_role(in.role(), out.role) && good;
  out.setup = to_bytes(in.setup());
  good = out.setup.size() <= wire::kSetupMax && within(in.udp_port(), 1, 65535) && good;
  out.udp_port = static_cast<std::uint16_t>(in.udp_port());
  good = take(in.resume_secret(), out.resume_secret.bytes) && good;
  out.authority_version = in.authority_version();
  good = take_name(in.person(), out.person, true) && read_members(in.member(), out.members) && good;
  return in.has_limits() && read(in.limits(), out.limits) && good;
}
void write(const Welcome& in, wire_pb::Welcome& out) {
  out.set_version(in.version);
  out.set_session_id(text_of(in.session_id));
  out.set_session_name(in.session_name);
  out.set_epoch(in.epoch);
  out.set_server_cid(in.server_cid);
  out.set_cipher(static_cast<std::uint32_t>(in.cipher));
  out.set_seat(in.seat);
  out.set_role(static_cast<std::uint32_t>(in.role));
  out.set_setup(text_of(in.setup));
  out.set_udp_port(in.udp_port);
  out.set_resume_secret(text_of(in.resume_secret.bytes));
  out.set_authority_version(in.authority_version);
  auto& l = *out.mutable_limits();
  l.set_datagrams_per_s(in.limits.datagrams_per_s);
  l.set_datagrams_burst(in.limits.datagrams_burst);
  l.set_authority_per_s(in.limits.authority_per_s);
  l.set_authority_burst(in.limits.authority_burst);
  l.set_commands_per_s(in.limits.commands_per_s);
  l.set_commands_burst(in.limits.commands_burst);
  out.set_person(in.person);
  for (const std::string& member : in.members) out.add_member(member);
}

bool read(const wire_pb::ErrorReply& in, ErrorReply& out) {
  out = {static_cast<ErrorCode>(in.reason() & 0xffU), in.text(), in.retry_after_s()};
  return within(in.reason(), 1, kErrorCodes) && is_text(in.text()) && in.retry_after_s() <= 86400;
}
void write(const ErrorReply& in, wire_pb::ErrorReply& out) {
  out.set_reason(static_cast<std::uint32_t>(in.code));
  out.set_text(in.text);
  out.set_retry_after_s(in.retry_after_s);
}

bool read(const wire_pb::Enroll& in, Enroll& out) {
  out.service = in.service();
  return take(in.code(), out.code.bytes);
}
void write(const Enroll& in, wire_pb::Enroll& out) {
  out.set_code(text_of(in.code.bytes));
  out.set_service(in.service);
}
bool read(const wire_pb::EnrollAck& in, EnrollAck& out) {
  return take_name(in.workstation(), out.workstation) && read_members(in.member(), out.members);
}
void write(const EnrollAck& in, wire_pb::EnrollAck& out) {
  out.set_workstation(in.workstation);
  for (const std::string& member : in.members) out.add_member(member);
}

/// Stops and pauses: a session and a reason.
template <class Wire, class Command>
bool read_command(const Wire& in, Command& out) {
  out.why = in.why();
  return take(in.session_id(), out.session_id) && is_text(in.why());
}
template <class Command, class Wire>
void write_command(const Command& in, Wire& out) {
  out.set_session_id(text_of(in.session_id));
  out.set_why(in.why);
}
bool read(const wire_pb::StopSession& in, StopSession& out) { return read_command(in, out); }
void write(const StopSession& in, wire_pb::StopSession& out) { write_command(in, out); }
bool read(const wire_pb::PauseSession& in, PauseSession& out) { return read_command(in, out); }
void write(const PauseSession& in, wire_pb::PauseSession& out) { write_command(in, out); }
bool read(const wire_pb::RemoveParticipant& in, RemoveParticipant& out) {
  return read_command(in, out) && take_name(in.seat(), out.seat);
}
void write(const RemoveParticipant& in, wire_pb::RemoveParticipant& out) {
  write_command(in, out);
  out.set_seat(in.seat);
}
bool read(const wire_pb::ResumeSession& in, ResumeSession& out) {
  out.stop = in.stop();
  return take(in.session_id(), out.session_id);
}
void write(const ResumeSession& in, wire_pb::ResumeSession& out) {
  out.set_session_id(text_of(in.session_id));
  out.set_stop(in.stop);
}

/// The authority over one tool, in a request and in its reply.
template <class Wire, class Message>
bool read_authority(const Wire& in, Message& out) {
  out.tool = in.tool();
  out.version = in.version();
  return in.tool() < kToolsMax && take_weights(in.alpha(), out.alpha);
}
template <class Message, class Wire>
void write_authority(const Message& in, Wire& out) {
  out.set_tool(in.tool);
  out.set_version(in.version);
  out.mutable_alpha()->Add(in.alpha.begin(), in.alpha.end());
}
bool read(const wire_pb::SetAuthority& in, SetAuthority& out) {
  return read_authority(in, out) && take(in.session_id(), out.session_id);
}
void write(const SetAuthority& in, wire_pb::SetAuthority& out) {
  write_authority(in, out);
  out.set_session_id(text_of(in.session_id));
}
bool read(const wire_pb::AuthorityReply& in, AuthorityReply& out) {
  out.applied = in.applied();
  return read_authority(in, out);
}
void write(const AuthorityReply& in, wire_pb::AuthorityReply& out) {
  write_authority(in, out);
  out.set_applied(in.applied);
}

bool read(const wire_pb::Drain& in, Drain& out) {
  out.grace_s = in.grace_s();
  return in.grace_s() <= 3600;
}
void write(const Drain& in, wire_pb::Drain& out) { out.set_grace_s(in.grace_s); }
bool read(const wire_pb::Ping& in, Ping& out) {
  out.nonce = in.nonce();
  return true;
}
void write(const Ping& in, wire_pb::Ping& out) { out.set_nonce(in.nonce); }
bool read(const wire_pb::Pong& in, Pong& out) {
  out.nonce = in.nonce();
  return true;
}
void write(const Pong& in, wire_pb::Pong& out) { out.set_nonce(in.nonce); }
bool read(const wire_pb::Ok& in, Ok& out) {
  out.not_stored = in.not_stored();
  return is_text(out.not_stored);
}
void write(const Ok& in, wire_pb::Ok& out) { out.set_not_stored(in.not_stored); }

bool read(const wire_pb::StatusRequest& in, StatusRequest& out) { return take(in.session_id(), out.session_id); }
void write(const StatusRequest& in, wire_pb::StatusRequest& out) { out.set_session_id(text_of(in.session_id)); }

bool read(const wire_pb::StatusStop& in, StatusStop& out) {
  out = {in.number(), static_cast<StopKind>(in.kind()), {}, {}, {}, in.why(), in.ago_s(), in.ends(), in.yours(), {}};
  return in.number() > 0 && within(in.kind(), 1, static_cast<std::uint32_t>(StopKind::kFault)) &&
         take_name(in.seat(), out.seat, true) && take_name(in.workstation(), out.workstation, true) &&
         (out.seat.empty() || out.workstation.empty()) && take_role(in.role(), out.role) && is_text(out.why) &&
         in.ago_s() >= 0 && in.ago_s() <= kTimeMax && is_text(out.ends) && take_name(in.person(), out.person, true);
}
void write(const StatusStop& in, wire_pb::StatusStop& out) {
  out.set_number(in.number);
  out.set_kind(static_cast<std::uint32_t>(in.kind));
  out.set_seat(in.seat);
  out.set_workstation(in.workstation);
  out.set_role(static_cast<std::uint32_t>(in.role));
  out.set_why(in.why);
  out.set_ago_s(in.ago_s);
  out.set_ends(in.ends);
  out.set_yours(in.yours);
  out.set_person(in.person);
}

bool read(const wire_pb::Status& in, Status& out) {
  if (in.seat_size() > static_cast<int>(kListedSeatsMax) || in.tool_size() > static_cast<int>(kToolsMax)) return false;
  if (in.state() >= kSessionPhases || !(in.time_s() >= 0 && in.time_s() <= kTimeMax)) return false;
  out.phase = static_cast<SessionPhase>(in.state());
  out.stops = in.stops();
  out.authority_version = in.authority_version();
  out.time_s = in.time_s();
  out.draining = in.draining();
  out.shed = in.shed();
  out.notes = in.notes();
  if (in.shed() > kShedMax) return false;
  if (!take(in.session_id(), out.session_id) || !take_name(in.name(), out.name)) return false;
  for (const wire_pb::StatusSeat& s : in.seat()) {
    StatusSeat& seat = out.seats.emplace_back();
    seat.taken = s.taken();
    seat.heard = s.heard();
    seat.master = s.master();
    if (!take_name(s.name(), seat.name) || !take_role(s.role(), seat.role)) return false;
    if (!take_name(s.person(), seat.person, true)) return false;
  }
  for (const wire_pb::StatusTool& t : in.tool()) {
    StatusTool& tool = out.tools.emplace_back();
    tool.alpha.assign(t.alpha().begin(), t.alpha().end());
    if (!take_name(t.name(), tool.name) || tool.alpha.size() > kMastersMax) return false;
    if (!std::ranges::all_of(tool.alpha, [](double a) { return a >= 0 && a <= 1; })) return false;
  }
  if (in.has_counts()) out.counts = {in.counts().stops(), in.counts().restarts(), in.counts().moves()};
  if (in.has_drain()) out.drain = {in.drain().left_s(), in.drain().sessions(), in.drain().people()};
  if (in.news_size() > static_cast<int>(kStatusEventsMax) || !is_text(in.held())) return false;
  out.held = in.held();
  for (const wire_pb::StatusEvent& n : in.news()) {
    if (n.number() == 0 || !is_text(n.text())) return false;
    out.events.push_back({n.number(), n.text()});
  }
  if (!is_text(in.no_recording()) || !is_text(in.not_stored())) return false;
  out.no_recording = in.no_recording();
  out.not_stored = in.not_stored();
  if (in.has_recording() && !read(in.recording(), out.recording.emplace())) return false;
  return !in.has_stop() || read(in.stop(), out.stop.emplace());
}
void write(const Status& in, wire_pb::Status& out) {
  out.set_session_id(text_of(in.session_id));
  out.set_name(in.name);
  out.set_state(static_cast<std::uint32_t>(in.phase));
  out.set_stops(in.stops);
  out.set_authority_version(in.authority_version);
  out.set_time_s(in.time_s);
  out.set_draining(in.draining);
  out.set_shed(in.shed);
  out.set_notes(in.notes);
  out.set_no_recording(in.no_recording);
  out.set_not_stored(in.not_stored);
  for (const StatusSeat& s : in.seats) {
    auto& seat = *out.add_seat();
    seat.set_name(s.name);
    seat.set_role(static_cast<std::uint32_t>(s.role));
    seat.set_taken(s.taken);
    seat.set_heard(s.heard);
    seat.set_master(s.master);
    seat.set_person(s.person);
  }
  for (const StatusTool& t : in.tools) {
    auto& tool = *out.add_tool();
    tool.set_name(t.name);
    tool.mutable_alpha()->Add(t.alpha.begin(), t.alpha.end());
  }
  if (in.stop) write(*in.stop, *out.mutable_stop());
  out.set_held(in.held);
  for (const StatusEvent& n : in.events) {
    auto& news = *out.add_news();
    news.set_number(n.number);
    news.set_text(n.text);
  }
  if (in.recording) write(*in.recording, *out.mutable_recording());
  if (in.counts) {
    out.mutable_counts()->set_stops(in.counts->stops);
    out.mutable_counts()->set_restarts(in.counts->restarts);
    out.mutable_counts()->set_moves(in.counts->moves);
  }
  if (!in.drain) return;
  out.mutable_drain()->set_left_s(in.drain->left_s);
  out.mutable_drain()->set_sessions(in.drain->sessions);
  out.mutable_drain()->set_people(in.drain->participants);
}

/// How one kind of message gets out of a ControlFrame and into it.
struct Conversion {
  bool (*read)(const Pb& in, Body& out);
  void (*write)(const Body& in, Pb& out);
};
/// @tparam get, mutate  accessors of the message in a ControlFrame
template <class Message, auto get, auto mutate>
constexpr Conversion conversion() {
  return {[](const Pb& in, Body& out) { return read((in.*get)(), out.emplace<Message>()); },
          [](const Body& in, Pb& out) { write(std::get<Message>(in), *(out.*mutate)()); }};
}
/// One row per message, in the order of Body.
constexpr std::array<Conversion, kKinds> kConversions{
    conversion<Hello, &Pb::hello, &Pb::mutable_hello>(),
    conversion<Welcome, &Pb::welcome, &Pb::mutable_welcome>(),
    conversion<ErrorReply, &Pb::error_reply, &Pb::mutable_error_reply>(),
    conversion<Enroll, &Pb::enroll, &Pb::mutable_enroll>(),
    conversion<EnrollAck, &Pb::enroll_ack, &Pb::mutable_enroll_ack>(),
    conversion<SessionListRequest, &Pb::session_list_request, &Pb::mutable_session_list_request>(),
    conversion<SessionList, &Pb::session_list, &Pb::mutable_session_list>(),
    conversion<StopSession, &Pb::stop_session, &Pb::mutable_stop_session>(),
    conversion<ResumeSession, &Pb::resume_session, &Pb::mutable_resume_session>(),
    conversion<PauseSession, &Pb::pause_session, &Pb::mutable_pause_session>(),
    conversion<SetAuthority, &Pb::set_authority, &Pb::mutable_set_authority>(),
    conversion<AuthorityReply, &Pb::authority_reply, &Pb::mutable_authority_reply>(),
    conversion<Drain, &Pb::drain, &Pb::mutable_drain>(),
    conversion<Ping, &Pb::ping, &Pb::mutable_ping>(),
    conversion<Pong, &Pb::pong, &Pb::mutable_pong>(),
    conversion<Ok, &Pb::ok, &Pb::mutable_ok>(),
    conversion<RemoveParticipant, &Pb::remove_participant, &Pb::mutable_remove_participant>(),
    conversion<StatusRequest, &Pb::status_request, &Pb::mutable_status_request>(),
    conversion<Status, &Pb::status, &Pb::mutable_status>(),
    conversion<CreateSession, &Pb::create_session, &Pb::mutable_create_session>(),
    conversion<SessionCreated, &Pb::session_created, &Pb::mutable_session_created>(),
    conversion<EndSession, &Pb::end_session, &Pb::mutable_end_session>(),
    conversion<Note, &Pb::note, &Pb::mutable_note>(),
    conversion<SceneListRequest, &Pb::scene_list_request, &Pb::mutable_scene_list_request>(),
    conversion<SceneList, &Pb::scene_list, &Pb::mutable_scene_list>(),
    conversion<NotesRequest, &Pb::notes_request, &Pb::mutable_notes_request>(),
    conversion<NoteList, &Pb::note_list, &Pb::mutable_note_list>(),
    conversion<RecordSession, &Pb::record_session, &Pb::mutable_record_session>(),
    conversion<Elsewhere, &Pb::elsewhere, &Pb::mutable_elsewhere>(),
};

}  // namespace

bool from_pb(const Pb& in, Body& out) {
  const auto row = static_cast<std::size_t>(in.body_case()) - static_cast<std::size_t>(Kind::kHello);
  return row < kKinds && kConversions[row].read(in, out);
}

void to_pb(const Body& in, Pb& out) { kConversions[in.index()].write(in, out); }

void wipe_secrets(Pb& frame) noexcept {
  if (frame.has_hello() && frame.hello().has_ticket()) wipe(*frame.mutable_hello()->mutable_ticket());
  if (frame.has_hello() && frame.hello().has_resume_secret()) wipe(*frame.mutable_hello()->mutable_resume_secret());
  if (frame.has_welcome()) wipe(*frame.mutable_welcome()->mutable_resume_secret());
  for (int i = 0; i < frame.session_created().ticket_size(); ++i)
    wipe(*frame.mutable_session_created()->mutable_ticket(i)->mutable_ticket());
  if (frame.has_enroll()) wipe(*frame.mutable_enroll()->mutable_code());
}

}  // namespace tandem::rpc
