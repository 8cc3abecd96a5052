#pragma once

#include <string>

#include "common/base/rng.h"
#include "proto/rpc/rpc_messages.h"

/// Random control messages within their limits: one of every kind, selected by its number.
namespace tandem::rpc::samples {

inline std::string name(RandomStream& r, bool may_be_empty = false) {
  constexpr std::string_view kLegal = "ABCXYZabcxyz0189_-";
  std::string out;
  const std::size_t size = (may_be_empty ? 0 : 1) + r.below(kNameMax);
  for (std::size_t i = 0; i < std::min(size, kNameMax); ++i) out += kLegal[r.below(kLegal.size())];
  return out;
}
inline std::string code(RandomStream& r) {
  std::string out;
  while (out.size() < kSessionCodeSize) out += "0123456789ABCDEFGHJKMNPQRSTVWXYZ"[r.below(32)];
  return out;
}
inline std::string text(RandomStream& r) {
  constexpr const char* kPieces[] = {
      "a", " ", "~", "\xc3\xa4", "\xe2\x82\xac", "\xf0\x9f\x99\x82", "words of any kind"};
  std::string out;
  for (std::uint64_t left = r.below(20); left > 0; --left) out += kPieces[r.below(7)];
  return out;
}
template <class Bytes>
void fill(RandomStream& r, Bytes& out) {
  for (std::byte& b : out) b = static_cast<std::byte>(r.bits() & 0xff);
}
inline std::vector<double> weights(RandomStream& r) {
  std::vector<double> out(1 + r.below(kMastersMax), 0.0);
  out[r.below(out.size())] = 0.25;
  out[r.below(out.size())] += 0.75;
  double sum = 0;
  for (double a : out) sum += a;
  if (sum != 1.0) out.assign(1, 1.0);
  return out;
}
inline AccessRole role(RandomStream& r) { return static_cast<AccessRole>(r.below(kAccessRoles)); }

inline Hello hello(RandomStream& r) {
  Hello m;
  m.versions.clear();
  for (std::uint32_t v = 1 + static_cast<std::uint32_t>(r.below(5));
       m.versions.size() < 1 + r.below(kVersionsMax) && v < 60000; v += 1 + static_cast<std::uint32_t>(r.below(9)))
    m.versions.push_back(v);
  if (m.versions.empty()) m.versions = {1};
  switch (r.below(3)) {
    case 0:
      fill(r, m.session.emplace<Id>());
      break;
    case 1:
      m.session = code(r);
      break;
    default:
      break;
  }
  m.seat = name(r, true);
  switch (r.below(4)) {
    case 0: {
      TicketCredential t{std::vector<std::byte>(1 + r.below(kTicketMax))};
      fill(r, t.bytes);
      m.credential = t;
      break;
    }
    case 1:
      fill(r, m.credential.emplace<ResumeCredential>().secret.bytes);
      break;
    case 2:
      m.credential = CodeCredential{code(r)};
      break;
    default:
      break;
  }
  m.client_cid = static_cast<std::uint32_t>(r.bits());
  m.device = {1 + static_cast<std::uint32_t>(r.below(kAxesMax)),
              1 + static_cast<std::uint32_t>(r.below(kAxesMax)),
              r.below(2) == 0,
              r.below(2) == 0,
              r.uniform(0, 1e4),
              r.uniform(0, 1e4),
              0};
  m.has_aes = r.below(2) == 0;
  m.link_test = r.below(2) == 0;
  m.watch = m.seat.empty() && !m.link_test && r.below(2) == 1;
  return m;
}

inline std::string address(RandomStream& r) { return name(r) + ":" + std::to_string(1 + r.below(65535)); }
inline std::vector<std::string> members(RandomStream& r) {
  std::vector<std::string> out(r.below(kMembersMax + 1));
  for (std::string& m : out) m = address(r);
  return out;
}

inline Welcome welcome(RandomStream& r) {
  Welcome m;
  m.version = 1 + static_cast<std::uint32_t>(r.below(65535));
  fill(r, m.session_id);
  m.session_name = name(r);
  m.epoch = r.bits();
  m.server_cid = static_cast<std::uint32_t>(r.bits());
  m.cipher = static_cast<Cipher>(r.below(2));
  m.seat = name(r, true);
  m.role = role(r);
  m.setup.resize(r.below(wire::kSetupMax + 1));
  fill(r, m.setup);
  m.udp_port = static_cast<std::uint16_t>(1 + r.below(65535));
  fill(r, m.resume_secret.bytes);
  m.authority_version = static_cast<std::uint32_t>(r.bits());
  m.limits.datagrams_per_s = 1 + static_cast<std::uint32_t>(r.below(1000000));
  if (r.below(2) == 0) m.person = name(r);
  m.members = members(r);
  return m;
}

inline SessionList session_list(RandomStream& r) {
  SessionList m;
  m.more = r.below(2) == 0;
  m.last = static_cast<std::uint32_t>(r.bits());
  m.old = r.below(2) == 0;
  for (std::uint64_t i = r.below(kListedSessionsMax + 1); i > 0; --i) {
    ListedSession& s = m.sessions.emplace_back();
    fill(r, s.id);
    s.name = name(r);
    s.phase = static_cast<SessionPhase>(r.below(kSessionPhases));
    if (r.below(2) == 0) s.server = name(r);
    for (std::uint64_t k = r.below(kListedSeatsMax + 1); k > 0; --k)
      s.seats.push_back({name(r), role(r), r.below(2) == 0, r.below(2) == 0});
  }
  return m;
}

inline Status status(RandomStream& r) {
  Status m;
  fill(r, m.session_id);
  m.name = name(r);
  m.phase = static_cast<SessionPhase>(r.below(kSessionPhases));
  m.stops = static_cast<std::uint32_t>(r.below(9));
  m.authority_version = static_cast<std::uint32_t>(r.bits());
  m.time_s = r.below(2) == 0 ? 0 : r.uniform(0, 1e9);
  m.draining = r.below(2) == 0;
  for (std::uint64_t k = r.below(kListedSeatsMax + 1); k > 0; --k)
    m.seats.push_back({name(r), role(r), r.below(2) == 0, r.below(2) == 0, r.below(2) == 0, name(r, true)});
  for (std::uint64_t k = r.below(kToolsMax + 1); k > 0; --k) m.tools.push_back({name(r), weights(r)});
  if (r.below(2) == 0) {
    const bool seated = r.below(2) == 0;
    m.stop = {1 + static_cast<std::uint32_t>(r.below(9)),
              static_cast<StopKind>(1 + r.below(3)),
              seated ? name(r, true) : "",
              seated ? "" : name(r, true),
              role(r),
              text(r),
              r.below(2) == 0 ? 0 : r.uniform(0, 1e9),
              text(r),
              r.below(2) == 0,
              name(r, true)};
  }
  if (r.below(2) == 0)
    m.counts = {static_cast<std::uint32_t>(r.below(9)), static_cast<std::uint32_t>(r.below(9)),
                static_cast<std::uint32_t>(r.below(9))};
  if (r.below(2) == 0)
    m.drain = {static_cast<std::uint32_t>(r.below(3601)), static_cast<std::uint32_t>(r.below(33)),
               static_cast<std::uint32_t>(r.below(300))};
  m.notes = static_cast<std::uint32_t>(r.below(3) * 700);
  if (r.below(2) == 0) m.held = "stopped by trainer: r resumes";
  for (std::uint64_t i = r.below(rpc::kStatusEventsMax + 1); i > 0; --i)
    m.events.push_back({static_cast<std::uint32_t>(1 + r.below(1000)), "RESUMED by trainer"});
  if (r.below(2) == 0)
    m.recording = {true, static_cast<std::uint32_t>(r.below(9)), r.below(2) == 0, r.below(1U << 30U), text(r)};
  if (r.below(2) == 0) m.no_recording = text(r);
  if (r.below(2) == 0) m.not_stored = text(r);
  return m;
}

inline CreateSession create_session(RandomStream& r) {
  CreateSession m{.name = name(r), .tickets_only = r.below(2) == 0};
  if (r.below(2) == 0) {
    m.scene = name(r);
  } else {
    m.scene_text = "version: 1\n" + std::string(r.below(200), 'x');
  }
  m.life_s = static_cast<std::uint32_t>(r.below(kLifeMaxS + 1));
  for (std::uint64_t k = r.below(kSeatsMax + 1); k > 0; --k)
    m.holders.push_back({"s" + std::to_string(k), name(r), name(r, true)});
  for (std::uint64_t k = r.below(kSeatsMax + 1); k > 0; --k) m.holders.push_back({"", name(r), name(r, true), role(r)});
  return m;
}
inline SessionCreated session_created(RandomStream& r) {
  SessionCreated m;
  fill(r, m.session.id);
  m.session.name = name(r);
  m.session.phase = static_cast<SessionPhase>(r.below(kSessionPhases));
  m.session.seats.push_back({name(r), role(r), r.below(2) == 0, r.below(2) == 0});
  if (r.below(2) == 0) m.code = code(r);
  for (std::uint64_t k = r.below(kSeatsMax + 1); k > 0; --k) {
    SeatTicket& t = m.tickets.emplace_back(name(r, true), name(r), std::vector<std::byte>(1 + r.below(kTicketMax)),
                                           name(r, true), role(r));
    fill(r, t.ticket);
  }
  return m;
}

inline NoteList note_list(RandomStream& r) {
  NoteList m{.notes = {}, .more = r.below(2) == 0};
  std::uint32_t number = 0;
  for (std::uint64_t k = r.below(kNotesMax + 1); k > 0; --k) {
    StoredNote& n = m.notes.emplace_back();
    n.number = number += 1 + static_cast<std::uint32_t>(r.below(3));
    n.kind = static_cast<NoteKind>(1 + r.below(2));
    n.time_s = r.below(2) == 0 ? 0 : r.uniform(0, 1e9);
    n.person = name(r, true);
    n.workstation = name(r);
    n.seat = name(r, true);
    n.role = role(r);
    n.yours = r.below(2) == 0;
    n.json = "{\"text\": \"" + text(r) + "\"}";
  }
  return m;
}

inline Frame frame(RandomStream& r, Kind kind) {
  Frame f;
  f.request = r.below(3) == 0 ? 0 : static_cast<std::uint32_t>(r.bits());
  switch (kind) {
    case Kind::kHello:
      f.body = hello(r);
      break;
    case Kind::kWelcome:
      f.body = welcome(r);
      break;
    case Kind::kErrorReply:
      f.body = ErrorReply{static_cast<ErrorCode>(1 + r.below(kErrorCodes)), text(r),
                          static_cast<std::uint32_t>(r.below(86401))};
      break;
    case Kind::kEnroll:
      fill(r, f.body.emplace<Enroll>().code.bytes);
      std::get<Enroll>(f.body).service = r.below(2) == 0;
      break;
    case Kind::kEnrollAck:
      f.body = EnrollAck{name(r), members(r)};
      break;
    case Kind::kSessionListRequest:
      f.body = SessionListRequest{static_cast<std::uint32_t>(r.bits()), r.below(2) == 0};
      break;
    case Kind::kSessionList:
      f.body = session_list(r);
      break;
    case Kind::kStopSession: {
      auto& m = f.body.emplace<StopSession>();
      fill(r, m.session_id);
      m.why = text(r);
      break;
    }
    case Kind::kResumeSession: {
      auto& m = f.body.emplace<ResumeSession>();
      fill(r, m.session_id);
      m.stop = static_cast<std::uint32_t>(r.below(5));
      break;
    }
    case Kind::kPauseSession:
      fill(r, f.body.emplace<PauseSession>().session_id);
      break;
    case Kind::kSetAuthority: {
      auto& m = f.body.emplace<SetAuthority>();
      fill(r, m.session_id);
      m.tool = static_cast<std::uint32_t>(r.below(kToolsMax));
      m.version = static_cast<std::uint32_t>(r.bits());
      m.alpha = weights(r);
      break;
    }
    case Kind::kAuthorityReply:
      f.body = AuthorityReply{r.below(2) == 0, static_cast<std::uint32_t>(r.below(kToolsMax)),
                              static_cast<std::uint32_t>(r.bits()), weights(r)};
      break;
    case Kind::kDrain:
      f.body = Drain{static_cast<std::uint32_t>(r.below(3601))};
      break;
    case Kind::kPing:
      f.body = Ping{r.bits()};
      break;
    case Kind::kPong:
      f.body = Pong{r.bits()};
      break;
    case Kind::kOk:
      f.body = Ok{r.below(2) == 0 ? text(r) : std::string{}};
      break;
    case Kind::kRemoveParticipant: {
      auto& m = f.body.emplace<RemoveParticipant>();
      fill(r, m.session_id);
      m.seat = name(r);
      m.why = text(r);
      break;
    }
    case Kind::kStatusRequest:
      fill(r, f.body.emplace<StatusRequest>().session_id);
      break;
    case Kind::kStatus:
      f.body = status(r);
      break;
    case Kind::kCreateSession:
      f.body = create_session(r);
      break;
    case Kind::kSessionCreated:
      f.body = session_created(r);
      break;
    case Kind::kEndSession: {
      auto& m = f.body.emplace<EndSession>();
      fill(r, m.session_id);
      m.why = text(r);
      break;
    }
    case Kind::kNote: {
      auto& m = f.body.emplace<Note>();
      fill(r, m.session_id);
      m.kind = static_cast<NoteKind>(1 + r.below(2));
      m.json = "{\"text\": \"" + text(r) + "\"}";
      break;
    }
    case Kind::kSceneListRequest:
      f.body = SceneListRequest{};
      break;
    case Kind::kSceneList: {
      auto& m = f.body.emplace<SceneList>();
      m.more = r.below(2) == 0;
      for (std::uint64_t k = r.below(50), i = 0; i < k; ++i) m.scenes.push_back("s" + std::to_string(100 + i));
      for (std::uint32_t i = 0; i < m.scenes.size(); ++i)
        for (std::uint64_t k = r.below(4); k > 0; --k) m.seats.push_back({i, name(r), role(r)});
      if (r.below(2) == 0)
        for (std::size_t i = 0; i < m.scenes.size(); ++i) m.durations_s.push_back(static_cast<double>(r.below(1000)));
      break;
    }
    case Kind::kNotesRequest: {
      auto& m = f.body.emplace<NotesRequest>();
      fill(r, m.session_id);
      m.after = static_cast<std::uint32_t>(r.below(3));
      break;
    }
    case Kind::kNoteList:
      f.body = note_list(r);
      break;
    case Kind::kElsewhere: {
      auto& m = f.body.emplace<Elsewhere>();
      m.address = address(r);
      fill(r, m.key);
      m.voucher.resize(1 + r.below(kVoucherMax));
      fill(r, m.voucher);
      m.session = name(r);
      if (r.below(2) == 0) fill(r, m.id.emplace());
      m.revision = r.bits();
      break;
    }
    case Kind::kRecordSession: {
      auto& m = f.body.emplace<RecordSession>();
      fill(r, m.session_id);
      m.on = r.below(2) == 0;
      break;
    }
  }
  return f;
}

inline Kind kind(std::size_t i) { return static_cast<Kind>(static_cast<std::size_t>(Kind::kHello) + i % kKinds); }

}  // namespace tandem::rpc::samples
