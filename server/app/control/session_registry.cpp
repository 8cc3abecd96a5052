#include "server/app/control/session_registry.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "common/auth/base32.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "proto/text/seat_setup.h"
#include "server/session/connection_id.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;

std::string names_of(const std::list<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

rpc::SessionPhase SessionRegistry::phase_of(wire::SessionState state) noexcept {
  switch (state) {
    case wire::SessionState::kWaiting:
      return rpc::SessionPhase::kWaiting;
    case wire::SessionState::kRunning:
    case wire::SessionState::kHeld:
      return rpc::SessionPhase::kRunning;
    case wire::SessionState::kPaused:
      return rpc::SessionPhase::kPaused;
    case wire::SessionState::kStopped:
      return rpc::SessionPhase::kStopped;
    case wire::SessionState::kOverloaded:
      return rpc::SessionPhase::kOverloaded;
    case wire::SessionState::kEnding:
      break;
  }
  return rpc::SessionPhase::kEnding;
}

std::string make_session_code() {
  return auth::to_base32(auth::random_bytes<std::array<std::byte, 7>>()).substr(0, rpc::kSessionCodeSize);
}

std::string code_text(const std::string& code) { return auth::grouped(code, 5); }

SessionRegistry::SessionRegistry(asio::io_context& context, auth::ServerKeystore& trust, const LoadLimits& limits)
    : context_(context), trust_(trust), limits_(limits) {}
SessionRegistry::~SessionRegistry() = default;

void SessionRegistry::add(Registration opening) {
  const std::size_t seats = opening.session->scene().seats.size();
  entries_.push_back({std::move(opening), std::vector<SeatReservation>(seats), 0, {}});
  restore_reservations(entries_.back());
}

void SessionRegistry::add_running(Registration opening) {
  add(std::move(opening));
  ShardRequest order;
  order.what = ShardRequest::What::kAddSession;
  order.session = entries_.back().registration.session;
  order.done = [](ShardRequest&) {};
  post(entries_.back(), std::move(order));
}

void SessionRegistry::remove(const auth::Id16& id, std::function<void()> gone) {
  SessionEntry* const found = find_entry(id);
  if (found == nullptr) return gone();
  found->on_closed = std::move(gone);
  close_if_idle(*found);
}

void SessionRegistry::close_if_idle(SessionEntry& room) {
  if (!room.on_closed || room.pending_requests > 0) return;
  const auto gone = std::move(room.on_closed);
  entries_.remove_if([&](const SessionEntry& r) { return &r == &room; });
  gone();
}

void SessionRegistry::end_session(const auth::Id16& id) {
  SessionEntry* const found = find_entry(id);
  if (found == nullptr) return;
  ShardRequest order;
  order.what = ShardRequest::What::kEndSession;
  order.session = found->registration.session;
  order.done = [](ShardRequest&) {};
  post(*found, std::move(order));
}

void SessionRegistry::watch_completions(Shard& shard) {
  watched_shards_.push_back({&shard, asio::posix::stream_descriptor{context_, ::dup(shard.completion_fd())}});
  await_completions(watched_shards_.back());
}

void SessionRegistry::stop_watching() { watched_shards_.clear(); }

void SessionRegistry::await_completions(WatchedShard& watched) {
  watched.completions.async_wait(asio::posix::stream_descriptor::wait_read, [this, &watched](asio::error_code error) {
    if (error) return;
    watched.shard->clear_completions();
    while (ShardRequest* const order = watched.shard->next_completed()) {
      order->done(*order);
      requests_.remove_if([&](const ShardRequest& o) { return &o == order; });
    }
    await_completions(watched);
  });
}

void SessionRegistry::post(SessionEntry& room, ShardRequest order) {
  ++room.pending_requests;
  order.done = [this, &room, done = std::move(order.done)](ShardRequest& answered) {
    done(answered);
    --room.pending_requests;
    close_if_idle(room);
  };
  ShardRequest& kept = requests_.emplace_back(std::move(order));
  if (room.registration.shard->post(kept)) return;
  kept.result = JoinResult::kSessionOver;
  kept.done(kept);
  requests_.pop_back();
}

SessionRegistry::SessionEntry* SessionRegistry::find_entry(const rpc::Id& id) {
  const auto found =
      std::ranges::find_if(entries_, [&](const SessionEntry& r) { return r.registration.id == id && !r.on_closed; });
  return found == entries_.end() ? nullptr : &*found;
}

std::variant<SessionRegistry::SessionEntry*, ErrorReply> SessionRegistry::resolve_session(const JoinRequest& request) {
  std::list<std::string> open;
  for (const SessionEntry& r : entries_)
    if (!r.on_closed && !r.registration.session->over()) open.push_back(r.registration.name);
  SessionEntry* found = nullptr;
  if (const auto* id = std::get_if<rpc::Id>(&request.hello.session)) {
    found = find_entry(*id);
  } else if (const auto* code = std::get_if<std::string>(&request.hello.session)) {
    for (SessionEntry& r : entries_)
      if (!r.on_closed && !r.registration.code.empty() && r.registration.code == *code) found = &r;
  } else if (open.size() == 1) {
    for (SessionEntry& r : entries_)
      if (!r.on_closed && !r.registration.session->over()) found = &r;
  } else if (!open.empty()) {
    return ErrorReply{ErrorCode::kNoSession,
                      "this server has several sessions: " + names_of(open) + "; choose one with --session", 0};
  }
  if (found == nullptr && open.empty())
    return ErrorReply{ErrorCode::kNoSession, "no session is open on this server", 0};
  if (found == nullptr) {
    const bool by_code = std::holds_alternative<std::string>(request.hello.session);
    // A request that names a session by its code is an attempt at the code, whatever other credential it has.
    return ErrorReply{
        by_code ? ErrorCode::kCode : ErrorCode::kNoSession,
        (by_code
             ? "no session on this server has this code (a restarted session has a new code: ask its operator); open: "
             : "this server has no such session; open: ") +
            names_of(open),
        0};
  }
  if (found->registration.session->over()) return ErrorReply{ErrorCode::kSessionOver, "this session is over", 0};
  return found;
}

void SessionRegistry::admit(const JoinRequest& request, std::function<void(JoinReply)> answer) {
  // A console operates sessions, so it may join while the server drains.
  const bool stands = request.hello.seat.empty() && !request.hello.link_test;
  if (draining_ && !stands)
    return answer(ErrorReply{
        ErrorCode::kDraining,
        "this server is draining and rejects new joins; wait until it has restarted, or ask its operator", 10});
  const auto found = resolve_session(request);
  if (const auto* refused = std::get_if<ErrorReply>(&found)) return answer(*refused);
  SessionEntry& room = *std::get<SessionEntry*>(found);
  if (stands) return join_console(room, request, answer);
  if (const auto busy = overload_reply(room);
      busy && !std::holds_alternative<rpc::ResumeCredential>(request.hello.credential))
    return answer(*busy);
  if (request.hello.link_test) return join_link_test(room, request, std::move(answer));
  join_seat(room, request, std::move(answer));
}

std::optional<ErrorReply> SessionRegistry::overload_reply(const SessionEntry& room) const {
  double all = 0;
  for (const WatchedShard& w : watched_shards_) all += w.shard->cpu_share();
  std::string why = rejection_reason({room.registration.shard->load(), room.registration.shard->cpu_share(),
                                      room.registration.shard->load_state().level == ShedLevel::kNewJoins},
                                     all, std::thread::hardware_concurrency(), limits_);
  if (why.empty()) return std::nullopt;
  return ErrorReply{ErrorCode::kFull, std::move(why), 5};
}

void SessionRegistry::join_seat(SessionEntry& room, const JoinRequest& request, std::function<void(JoinReply)> answer) {
  const SeatCatalogue& reception = room.registration.session->seat_catalogue();
  const auto seat = reception.seat_named(request.hello.seat);
  if (!seat) return answer(ErrorReply{ErrorCode::kNoSeat, "no seat of this name; seats: " + reception.seat_names(), 0});
  if (const std::string why = reception.device_incompatibility(request.hello.device); !why.empty())
    return answer(ErrorReply{ErrorCode::kDeviceUnfit, why, 0});
  SeatReservation& claim = room.reservations[*seat];
  const auto* resume = std::get_if<rpc::ResumeCredential>(&request.hello.credential);
  const ResumeMatch back =
      resume != nullptr ? verify_resume_secret(claim, resume->secret, request.workstation) : ResumeMatch::kNone;
  const bool same_owner = back != ResumeMatch::kNone;
  const ErrorReply nothing{ErrorCode::kResume,
                           "nothing to resume: the seat was given to another client, or the resume secret has expired",
                           0};
  if (resume != nullptr && !same_owner) return answer(nothing);
  const ErrorReply taken{ErrorCode::kSeatTaken, "this seat is taken already", 2};
  if (claim.joining) return answer(taken);
  if (!same_owner && reserved_for_owner(claim))
    return answer(ErrorReply{ErrorCode::kSeatTaken,
                             "this seat is reserved for 2 s for the client that had it when the server died", 2});

  claim.joining = true;
  ShardRequest order;
  order.what = ShardRequest::What::kQuerySeat;
  order.session = room.registration.session;
  order.seat = *seat;
  order.same_owner = same_owner;
  order.done = [this, &room, &claim, request, seat = *seat, taken, nothing, same_owner, back,
                answer = std::move(answer)](ShardRequest& asked) {
    std::optional<ErrorReply> refused;
    // A ticket can only lower the force. A resume has no ticket and keeps the stored scale.
    double force_scale = same_owner ? claim.force_scale : 1;
    if (same_owner && (resume_expired(claim, asked.silence) || (back == ResumeMatch::kPrevious && asked.ever_heard)))
      refused = nothing;
    claim.next_previous_hash = !same_owner                              ? Checkpoint::Hash{}
                               : asked.ever_heard || claim.resume_until ? claim.resume_hash
                                                                        : claim.previous_hash;
    if (asked.result == JoinResult::kSeatTaken) refused = taken;
    if (asked.result == JoinResult::kSessionOver)
      refused = ErrorReply{ErrorCode::kSessionOver, "the session is ending", 0};
    // Checked last, because a redeemed ticket is used.
    if (!refused) refused = check_credential(room, request, seat, force_scale);
    if (refused) {
      claim.joining = false;
      return answer(*refused);
    }
    claim.offered_scale = force_scale;
    answer(welcome(room, seat, &request.hello.device, static_cast<std::uint8_t>(seat + 1), request.hello.has_aes,
                   force_scale));
  };
  post(room, std::move(order));
}

std::optional<ErrorReply> SessionRegistry::check_credential(SessionEntry& room, const JoinRequest& request,
                                                            std::size_t seat, double& force_scale) {
  const AccessRole role = access_role(room.registration.session->scene().seats[seat].role);
  if (const auto* ticket = std::get_if<rpc::TicketCredential>(&request.hello.credential)) {
    const auth::TicketUse use{room.registration.id,
                              room.registration.epoch,
                              request.hello.seat,
                              role,
                              auth::KeyFingerprint{request.workstation.spki},
                              auth::wall_seconds()};
    const auto redeemed = trust_.redeem(ticket->bytes, use);
    if (!redeemed) return ticket_refused(redeemed.error());
    force_scale = static_cast<double>(redeemed->force_scale) / auth::Ticket::kFullForce;
    room.reservations[seat].ticket = redeemed->ticket_id;
    return std::nullopt;
  }
  if (const auto* code = std::get_if<rpc::CodeCredential>(&request.hello.credential)) {
    if (is_removed(room, request.workstation))
      return ErrorReply{ErrorCode::kNotAllowed,
                        "the participant of this workstation was removed from the session; to join again, ask an "
                        "operator for a ticket",
                        0};
    if (room.registration.code.empty() || code->code != room.registration.code)
      return ErrorReply{ErrorCode::kCode, "this is not the session's code", 0};
    if (role == AccessRole::kInstructor)
      return ErrorReply{ErrorCode::kNotAllowed,
                        "the instructor's seat needs a ticket: on the server, `tandem-server ticket --session " +
                            room.registration.name + " --seat " + request.hello.seat + " --workstation " +
                            request.workstation.name + "`",
                        0};
    return std::nullopt;
  }
  if (std::holds_alternative<rpc::ResumeCredential>(request.hello.credential))
    return std::nullopt;  // checked by the caller
  return ErrorReply{ErrorCode::kTicket,
                    "a ticket or the session's code is needed; ask for `tandem-server ticket --session " +
                        room.registration.name + " --seat " + request.hello.seat + " --workstation " +
                        request.workstation.name + "`",
                    0};
}

rpc::Welcome SessionRegistry::welcome(const SessionEntry& room, std::size_t seat, const rpc::DeviceFacts* device,
                                      std::uint8_t place, bool has_aes, double force_scale) {
  const bool visit = device == nullptr;
  const LiveSession& session = *room.registration.session;
  rpc::Welcome w;
  w.session_id = room.registration.id;
  w.session_name = room.registration.name;
  w.epoch = room.registration.epoch;
  const auto drawn = auth::random_bytes<std::array<std::byte, 2>>();
  w.server_cid = connection_id(
      static_cast<std::uint16_t>(std::to_integer<unsigned>(drawn[0]) << 8 | std::to_integer<unsigned>(drawn[1])),
      session.slot(), place);
  const bool aes = has_aes && transport::fastest_cipher() == transport::Cipher::kAes256Gcm;
  w.cipher = aes ? rpc::Cipher::kAes256Gcm : rpc::Cipher::kChaCha20Poly1305;
  if (!visit) w.seat = session.scene().seats[seat].name;
  w.role = visit ? AccessRole::kObserver : access_role(session.scene().seats[seat].role);
  SeatSetup own = visit ? session.seat_catalogue().setup(seat) : session.seat_catalogue().setup_for(seat, *device);
  own.gate.force_max *= force_scale;  // a ticket can only lower the force
  std::array<char, wire::kSetupMax> setup;
  const std::size_t size = encode_seat_setup(own, setup);
  for (std::size_t i = 0; i < size; ++i) w.setup.push_back(static_cast<std::byte>(setup[i]));
  w.udp_port = room.registration.shard->address().port();
  w.resume_secret = Secret<32>{auth::random_bytes<std::array<std::byte, 32>>()};
  return w;
}

void SessionRegistry::on_joined(const JoinRequest& request, const rpc::Welcome& welcome,
                                const Secret<auth::kExportSize>& secrets) {
  SessionEntry* const found = find_entry(welcome.session_id);
  if (found == nullptr) return;
  // A console sends no datagrams.
  if (request.hello.seat.empty() && !request.hello.link_test) {
    io::log_event(io::Level::kInfo, {.event = "console-joined",
                                     .session = welcome.session_name,
                                     .text = request.address + " " + std::string(to_text(welcome.role))});
    return;
  }
  transport::SecureChannel::Params params;
  params.outgoing = transport::Direction::kToClient;
  params.own_cid = welcome.server_cid;
  params.peer_cid = request.hello.client_cid;
  const auto cipher =
      welcome.cipher == rpc::Cipher::kAes256Gcm ? transport::Cipher::kAes256Gcm : transport::Cipher::kChaCha20Poly1305;
  params.secrets = transport::secrets_from_exporter(secrets.bytes, cipher);
  const SeatCatalogue& reception = found->registration.session->seat_catalogue();
  ShardRequest order;
  order.session = found->registration.session;
  order.done = [](ShardRequest&) {};
  if (request.hello.link_test) {
    order.what = ShardRequest::What::kAdmitLinkTest;
    params.tick = reception.tick();
    order.connection.link = std::make_unique<transport::SecureChannel>(params);
    order.done = [found, by = request.workstation, cid = welcome.server_cid](ShardRequest& o) {
      on_link_test_joined(*found, o, by, cid);
    };
  } else {
    const std::size_t seat = place_of(welcome.server_cid) - std::size_t{1};
    SeatReservation& claim = found->reservations[seat];
    claim.ticket.reset();  // it is used
    claim.owner = request.workstation;
    claim.cid = welcome.server_cid;
    order.what = ShardRequest::What::kAdmit;
    order.seat = seat;
    order.same_owner = true;  // the query succeeded, and the seat has been reserved since
    order.connection = reception.make_connection(seat, params, request.hello.device);
    if (std::string softer = reception.softened_spring_text(seat, request.hello.device); !softer.empty())
      io::log_event(io::Level::kInfo, {.event = "stiffness_reduced",
                                       .session = welcome.session_name,
                                       .seat = welcome.seat,
                                       .cid = welcome.server_cid,
                                       .text = std::move(softer)});
    rotate_resume_secret(claim, welcome.resume_secret, request.workstation, order.connection);
    order.done = [&claim](ShardRequest&) { claim.joining = false; };
  }
  io::log_event(io::Level::kInfo, {.event = request.hello.link_test ? "link-test-joined" : "seat-joined",
                                   .session = welcome.session_name,
                                   .seat = welcome.seat,
                                   .cid = welcome.server_cid,
                                   .text = request.address});
  post(*found, std::move(order));
}

void SessionRegistry::on_join_failed(const rpc::Welcome& welcome) {
  SessionEntry* const found = find_entry(welcome.session_id);
  if (found == nullptr) return;
  if (!welcome.seat.empty()) {
    SeatReservation& claim = found->reservations[place_of(welcome.server_cid) - std::size_t{1}];
    claim.joining = false;
    if (const auto ticket = std::exchange(claim.ticket, std::nullopt)) restore_ticket(*ticket, *found);
  }
  if (welcome.seat.empty()) release_console(*found, welcome, true);
  if (place_of(welcome.server_cid) > kSeatsMax) --found->link_tests_joining;
}

rpc::SessionList SessionRegistry::list(const WorkstationRow&) {
  rpc::SessionList list;
  for (const SessionEntry& r : entries_) {
    if (r.on_closed || r.registration.session->over()) continue;
    if (list.sessions.size() == rpc::kSessionsMax) {
      list.more = true;
      break;
    }
    const SessionStatus status = r.registration.session->status();
    rpc::ListedSession& s = list.sessions.emplace_back();
    s.id = r.registration.id;
    s.name = r.registration.name;
    s.phase = phase_of(status.state);
    const SceneSpec& scene = r.registration.session->scene();
    for (std::size_t i = 0; i < scene.seats.size(); ++i)
      s.seats.push_back({scene.seats[i].name, access_role(scene.seats[i].role),
                         status.seats[i].taken || r.reservations[i].joining || reserved_for_owner(r.reservations[i]),
                         scene.seats[i].required});
  }
  return list;
}

ServingSpec SessionRegistry::serving() const {
  ServingSpec out;
  for (const SessionEntry& r : entries_) {
    if (r.on_closed) continue;
    const SessionStatus status = r.registration.session->status();
    OpenSession session{r.registration.id,
                        r.registration.code,
                        r.registration.name,
                        r.registration.epoch,
                        {},
                        to_text(r.registration.session->over() ? rpc::SessionPhase::kEnding : phase_of(status.state))};
    const auto& seats = r.registration.session->scene().seats;
    for (std::size_t i = 0; i < seats.size(); ++i)
      session.seats.push_back({seats[i].name, access_role(seats[i].role), status.seats[i].taken, seats[i].required});
    out.sessions.push_back(std::move(session));
  }
  return out;
}

std::vector<const SessionRegistry::Registration*> SessionRegistry::registrations() const {
  std::vector<const Registration*> all;
  for (const SessionEntry& r : entries_)
    if (!r.on_closed) all.push_back(&r.registration);
  return all;
}

std::vector<const Shard*> SessionRegistry::shards() const {
  std::vector<const Shard*> all;
  for (const WatchedShard& w : watched_shards_) all.push_back(w.shard);
  return all;
}

}  // namespace tandem::server
