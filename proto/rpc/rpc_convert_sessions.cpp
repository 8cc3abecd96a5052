#include "proto/rpc/rpc_convert_sessions.h"

#include <algorithm>
#include <functional>
#include <string>

#include "proto/rpc/rpc_bounds.h"

namespace tandem::rpc {

bool read_listed(const pb::rpc::Session& in, ListedSession& out) {
  if (in.seat_size() > static_cast<int>(kListedSeatsMax) || in.state() >= kSessionPhases) return false;
  out.phase = static_cast<SessionPhase>(in.state());
  if (!take(in.id(), out.id) || !take_name(in.name(), out.name) || !take_name(in.server(), out.server, true))
    return false;
  for (const pb::rpc::Seat& seat : in.seat()) {
    ListedSeat& listed = out.seats.emplace_back();
    listed.taken = seat.taken();
    listed.required = seat.required();
    if (!take_name(seat.name(), listed.name) || !take_role(seat.role(), listed.role)) return false;
  }
  return true;
}
void write_listed(const ListedSession& in, pb::rpc::Session& out) {
  out.set_id(text_of(in.id));
  out.set_name(in.name);
  out.set_state(static_cast<std::uint32_t>(in.phase));
  for (const ListedSeat& listed : in.seats) {
    auto& seat = *out.add_seat();
    seat.set_name(listed.name);
    seat.set_role(static_cast<std::uint32_t>(listed.role));
    seat.set_taken(listed.taken);
    seat.set_required(listed.required);
  }
  out.set_server(in.server);
}

bool read(const pb::rpc::SessionListRequest& in, SessionListRequest& out) {
  out = {in.after(), in.service()};
  return true;
}
void write(const SessionListRequest& in, pb::rpc::SessionListRequest& out) {
  out.set_after(in.after);
  out.set_service(in.service);
}

bool read(const pb::rpc::SessionList& in, SessionList& out) {
  if (in.session_size() > static_cast<int>(kListedSessionsMax)) return false;
  out.more = in.more();
  out.last = in.last();
  out.old = in.old();
  return std::ranges::all_of(in.session(), [&](const auto& s) { return read_listed(s, out.sessions.emplace_back()); });
}
void write(const SessionList& in, pb::rpc::SessionList& out) {
  out.set_more(in.more);
  out.set_last(in.last);
  out.set_old(in.old);
  for (const ListedSession& s : in.sessions) write_listed(s, *out.add_session());
}

bool read(const pb::rpc::CreateSession& in, CreateSession& out) {
  out.scene_text = in.scene_text();
  out.tickets_only = in.tickets_only();
  out.life_s = in.life_s();
  if (!take_name(in.name(), out.name) || !take_name(in.scene(), out.scene, true)) return false;
  if (out.scene.empty() == out.scene_text.empty() || out.scene_text.size() > kSceneTextMax) return false;
  if (out.life_s > kLifeMaxS || in.holder_size() > static_cast<int>(kHoldersMax)) return false;
  for (const pb::rpc::SeatHolder& h : in.holder()) {
    const bool sits = !h.seat().empty();
    if (sits && std::ranges::find(out.holders, h.seat(), &SeatHolder::seat) != out.holders.end()) return false;
    SeatHolder& holder = out.holders.emplace_back();
    if (!take_name(h.seat(), holder.seat, true) || !take_name(h.workstation(), holder.workstation)) return false;
    if (!take_name(h.person(), holder.person, true) || !take_role(h.role(), holder.role)) return false;
    if (sits && holder.role != AccessRole{}) return false;
  }
  return true;
}
void write(const CreateSession& in, pb::rpc::CreateSession& out) {
  out.set_name(in.name);
  out.set_scene(in.scene);
  out.set_scene_text(in.scene_text);
  out.set_tickets_only(in.tickets_only);
  out.set_life_s(in.life_s);
  for (const SeatHolder& h : in.holders) {
    auto& holder = *out.add_holder();
    holder.set_seat(h.seat);
    holder.set_workstation(h.workstation);
    holder.set_person(h.person);
    holder.set_role(static_cast<std::uint32_t>(h.role));
  }
}

bool read(const pb::rpc::SessionCreated& in, SessionCreated& out) {
  out.code = in.code();
  if (!in.has_session() || !read_listed(in.session(), out.session)) return false;
  if (!(out.code.empty() || is_code(out.code)) || in.ticket_size() > static_cast<int>(kHoldersMax)) return false;
  for (const pb::rpc::SeatTicket& t : in.ticket()) {
    SeatTicket& ticket = out.tickets.emplace_back();
    ticket.ticket = to_bytes(t.ticket());
    if (t.ticket().empty() || t.ticket().size() > kTicketMax) return false;
    if (!take_name(t.seat(), ticket.seat, true) || !take_name(t.workstation(), ticket.workstation)) return false;
    if (!take_name(t.person(), ticket.person, true) || !take_role(t.role(), ticket.role)) return false;
  }
  return true;
}
void write(const SessionCreated& in, pb::rpc::SessionCreated& out) {
  write_listed(in.session, *out.mutable_session());
  out.set_code(in.code);
  for (const SeatTicket& t : in.tickets) {
    auto& ticket = *out.add_ticket();
    ticket.set_seat(t.seat);
    ticket.set_workstation(t.workstation);
    ticket.set_ticket(text_of(t.ticket));
    ticket.set_person(t.person);
    ticket.set_role(static_cast<std::uint32_t>(t.role));
  }
}

bool read(const pb::rpc::EndSession& in, EndSession& out) {
  out.why = in.why();
  return take(in.session_id(), out.session_id) && is_text(in.why());
}
void write(const EndSession& in, pb::rpc::EndSession& out) {
  out.set_session_id(text_of(in.session_id));
  out.set_why(in.why);
}

bool read(const pb::rpc::Note& in, Note& out) {
  out.kind = static_cast<NoteKind>(in.kind() & 3U);
  out.json = in.json();
  return take(in.session_id(), out.session_id) && within(in.kind(), 1, 2) && !out.json.empty() &&
         is_text(out.json, kNoteMax);
}
void write(const Note& in, pb::rpc::Note& out) {
  out.set_session_id(text_of(in.session_id));
  out.set_kind(static_cast<std::uint32_t>(in.kind));
  out.set_json(in.json);
}

bool read(const pb::rpc::SceneListRequest&, SceneListRequest&) { return true; }
void write(const SceneListRequest&, pb::rpc::SceneListRequest&) {}

bool read(const pb::rpc::SceneList& in, SceneList& out) {
  out.more = in.more();
  out.scenes.assign(in.scene().begin(), in.scene().end());
  if (in.seat_size() > static_cast<int>(kSceneSeatsMax)) return false;
  for (const pb::rpc::SceneSeat& s : in.seat()) {
    SceneSeat& seat = out.seats.emplace_back();
    seat.scene = s.scene();
    if (seat.scene >= out.scenes.size() || !take_name(s.name(), seat.name) || !take_role(s.role(), seat.role))
      return false;
  }
  if (!std::ranges::is_sorted(out.seats, {}, &SceneSeat::scene)) return false;
  if (in.duration_s_size() != 0 && in.duration_s_size() != in.scene_size()) return false;
  out.durations_s.assign(in.duration_s().begin(), in.duration_s().end());
  if (!std::ranges::all_of(out.durations_s, [](double s) { return s >= 0 && s <= kTimeMax; })) return false;
  return out.scenes.size() <= kScenesMax && std::ranges::all_of(out.scenes, [](const auto& s) { return is_name(s); }) &&
         std::ranges::adjacent_find(out.scenes, std::greater_equal{}) == out.scenes.end();
}
void write(const SceneList& in, pb::rpc::SceneList& out) {
  for (const std::string& scene : in.scenes) out.add_scene(scene);
  for (const SceneSeat& s : in.seats) {
    auto& seat = *out.add_seat();
    seat.set_scene(s.scene);
    seat.set_name(s.name);
    seat.set_role(static_cast<std::uint32_t>(s.role));
  }
  for (const double duration : in.durations_s) out.add_duration_s(duration);
  out.set_more(in.more);
}

bool read(const pb::rpc::NotesRequest& in, NotesRequest& out) {
  out.after = in.after();
  return take(in.session_id(), out.session_id);
}
void write(const NotesRequest& in, pb::rpc::NotesRequest& out) {
  out.set_session_id(text_of(in.session_id));
  out.set_after(in.after);
}

bool read(const pb::rpc::NoteList& in, NoteList& out) {
  out.more = in.more();
  if (in.note_size() > static_cast<int>(kNotesMax)) return false;
  std::uint32_t last = 0;
  std::size_t size = 0;
  for (const pb::rpc::StoredNote& n : in.note()) {
    if (n.number() <= last || !within(n.kind(), 1, 2) || !(n.time_s() >= 0 && n.time_s() <= kTimeMax)) return false;
    last = n.number();
    size += n.json().size();
    StoredNote& note = out.notes.emplace_back();
    note.number = n.number();
    note.kind = static_cast<NoteKind>(n.kind());
    note.time_s = n.time_s();
    note.yours = n.yours();
    note.json = n.json();
    if (!take_name(n.person(), note.person, true) || !take_name(n.workstation(), note.workstation) ||
        !take_name(n.seat(), note.seat, true) || !take_role(n.role(), note.role) || note.json.empty() ||
        !is_text(note.json, kNoteMax) || size > kNotesBytesMax)
      return false;
  }
  return true;
}
void write(const NoteList& in, pb::rpc::NoteList& out) {
  out.set_more(in.more);
  for (const StoredNote& n : in.notes) {
    auto& note = *out.add_note();
    note.set_number(n.number);
    note.set_kind(static_cast<std::uint32_t>(n.kind));
    note.set_time_s(n.time_s);
    note.set_person(n.person);
    note.set_workstation(n.workstation);
    note.set_role(static_cast<std::uint32_t>(n.role));
    note.set_seat(n.seat);
    note.set_yours(n.yours);
    note.set_json(n.json);
  }
}

bool read(const pb::rpc::RecordSession& in, RecordSession& out) {
  out.on = in.on();
  return take(in.session_id(), out.session_id);
}
void write(const RecordSession& in, pb::rpc::RecordSession& out) {
  out.set_session_id(text_of(in.session_id));
  out.set_on(in.on);
}

bool read(const pb::rpc::StatusRecording& in, StatusRecording& out) {
  out = {in.by_server(), in.by_recorders(), in.pseudonyms(), in.dropped(), in.trouble()};
  return (out.by_server || out.by_recorders > 0) && out.by_recorders <= kRecordersMax && is_text(out.trouble);
}
void write(const StatusRecording& in, pb::rpc::StatusRecording& out) {
  out.set_by_server(in.by_server);
  out.set_by_recorders(in.by_recorders);
  out.set_pseudonyms(in.pseudonyms);
  out.set_dropped(in.dropped);
  out.set_trouble(in.trouble);
}

}  // namespace tandem::rpc
