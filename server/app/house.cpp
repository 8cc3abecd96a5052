#include "server/app/house.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "common/trust/base32.h"
#include "proto/seat_setup.h"
#include "server/connection_id.h"

namespace tandem::server {
namespace {

using control::Reason;
using control::Refused;

std::string names_of(const std::list<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

control::SessionPhase House::phase_of(wire::SessionState state) noexcept {
  switch (state) {
    case wire::SessionState::kWaiting:
      return control::SessionPhase::kWaiting;
    case wire::SessionState::kRunning:
    case wire::SessionState::kHeld:
      return control::SessionPhase::kRunning;
    case wire::SessionState::kPaused:
      return control::SessionPhase::kPaused;
    case wire::SessionState::kStopped:
      return control::SessionPhase::kStopped;
    case wire::SessionState::kPassive:
      return control::SessionPhase::kPassive;
    case wire::SessionState::kEnding:
      break;
  }
  return control::SessionPhase::kEnding;
}

std::string draw_session_code() {
  return trust::to_base32(trust::random_bytes<std::array<std::byte, 7>>()).substr(0, control::kSessionCodeSize);
}

std::string code_text(const std::string& code) { return trust::grouped(code, 5); }

House::House(asio::io_context& context, trust::ServerTrust& trust, const LoadLimits& limits) : context_(context), trust_(trust), limits_(limits) {}
House::~House() = default;

void House::open(Opening opening) {
  const std::size_t seats = opening.session->scene().seats.size();
  rooms_.push_back({std::move(opening), std::vector<Claim>(seats), 0, {}});
  remember(rooms_.back());
}

void House::open_late(Opening opening) {
  open(std::move(opening));
  Order order;
  order.what = Order::What::kHost;
  order.session = rooms_.back().opening.session;
  order.done = [](Order&) {};
  post(rooms_.back(), std::move(order));
}

void House::close(const trust::Id16& id, std::function<void()> gone) {
  Room* const found = room(id);
  if (found == nullptr) return gone();
  found->gone = std::move(gone);
  sweep(*found);
}

void House::sweep(Room& room) {
  if (!room.gone || room.orders > 0) return;
  const auto gone = std::move(room.gone);
  rooms_.remove_if([&](const Room& r) { return &r == &room; });
  gone();
}

void House::end(const trust::Id16& id) {
  Room* const found = room(id);
  if (found == nullptr) return;
  Order order;
  order.what = Order::What::kEnd;
  order.session = found->opening.session;
  order.done = [](Order&) {};
  post(*found, std::move(order));
}

void House::watch(Shard& shard) {
  watched_.push_back({&shard, asio::posix::stream_descriptor{context_, ::dup(shard.news_fd())}});
  hear(watched_.back());
}

void House::stop_watching() { watched_.clear(); }

void House::hear(Watched& watched) {
  watched.news.async_wait(asio::posix::stream_descriptor::wait_read, [this, &watched](asio::error_code error) {
    if (error) return;
    watched.shard->news_read();
    while (Order* const order = watched.shard->answered()) {
      order->done(*order);
      orders_.remove_if([&](const Order& o) { return &o == order; });
    }
    hear(watched);
  });
}

void House::post(Room& room, Order order) {
  ++room.orders;
  order.done = [this, &room, done = std::move(order.done)](Order& answered) {
    done(answered);
    --room.orders;
    sweep(room);
  };
  Order& kept = orders_.emplace_back(std::move(order));
  if (room.opening.shard->post(kept)) return;
  kept.result = JoinResult::kSessionOver;
  kept.done(kept);
  orders_.pop_back();
}

House::Room* House::room(const control::Id& id) {
  const auto found = std::ranges::find_if(rooms_, [&](const Room& r) { return r.opening.id == id && !r.gone; });
  return found == rooms_.end() ? nullptr : &*found;
}

std::variant<House::Room*, Refused> House::room_for(const JoinRequest& request) {
  std::list<std::string> open;
  for (const Room& r : rooms_)
    if (!r.gone && !r.opening.session->over()) open.push_back(r.opening.name);
  Room* found = nullptr;
  if (const auto* id = std::get_if<control::Id>(&request.hello.session)) {
    found = room(*id);
  } else if (const auto* code = std::get_if<std::string>(&request.hello.session)) {
    for (Room& r : rooms_)
      if (!r.gone && !r.opening.code.empty() && r.opening.code == *code) found = &r;
  } else if (open.size() == 1) {
    for (Room& r : rooms_)
      if (!r.gone && !r.opening.session->over()) found = &r;
  } else if (!open.empty()) {
    return Refused{Reason::kNoSession, "this server has several sessions: " + names_of(open) + "; say which with --session", 0};
  }
  if (found == nullptr && open.empty()) return Refused{Reason::kNoSession, "no session is open on this server", 0};
  if (found == nullptr) {
    const bool by_code = std::holds_alternative<std::string>(request.hello.session);
    // A code that names a session is tried by it, whatever else is shown.
    return Refused{by_code ? Reason::kCode : Reason::kNoSession, (by_code ? "no session here has this code (a session that starts again has another: ask for it); open: " : "there is no such session here; open: ") + names_of(open), 0};
  }
  if (found->opening.session->over()) return Refused{Reason::kSessionOver, "this session is over", 0};
  return found;
}

void House::admit(const JoinRequest& request, std::function<void(Admission)> answer) {
  const bool stands = request.hello.seat.empty() && !request.hello.visit;  // looks after sessions: also while the server drains
  if (draining_ && !stands) return answer(Refused{Reason::kDraining, "this server is about to end and lets nobody in; wait until it is back, or ask its operator", 10});
  const auto found = room_for(request);
  if (const auto* refused = std::get_if<Refused>(&found)) return answer(*refused);
  Room& room = *std::get<Room*>(found);
  if (stands) return stand(room, request, answer);
  if (const auto busy = too_busy(room); busy && !std::holds_alternative<control::ResumeCredential>(request.hello.credential)) return answer(*busy);
  if (request.hello.visit) return visit(room, request, std::move(answer));
  sit(room, request, std::move(answer));
}

std::optional<Refused> House::too_busy(const Room& room) const {
  double all = 0;
  for (const Watched& w : watched_) all += w.shard->core();
  std::string why = no_room({room.opening.shard->load(), room.opening.shard->core(), room.opening.shard->relief().rung == Rung::kNewcomers}, all, std::thread::hardware_concurrency(), limits_);
  if (why.empty()) return std::nullopt;
  return Refused{Reason::kFull, std::move(why), 5};
}

void House::sit(Room& room, const JoinRequest& request, std::function<void(Admission)> answer) {
  const Reception& reception = room.opening.session->reception();
  const auto seat = reception.seat_named(request.hello.seat);
  if (!seat) return answer(Refused{Reason::kNoSeat, "no seat of this name; seats: " + reception.seat_names(), 0});
  if (const std::string why = reception.unfit(request.hello.device); !why.empty()) return answer(Refused{Reason::kDeviceUnfit, why, 0});
  Claim& claim = room.claims[*seat];
  const auto* resume = std::get_if<control::ResumeCredential>(&request.hello.credential);
  const Back back = resume != nullptr ? comes_back(claim, resume->secret, request.workstation) : Back::kNo;
  const bool same_owner = back != Back::kNo;
  const Refused nothing{Reason::kResume, "nothing to resume: the seat was given to somebody else, or too long ago", 0};
  if (resume != nullptr && !same_owner) return answer(nothing);
  const Refused taken{Reason::kSeatTaken, "somebody sits there already", 2};
  if (claim.being_given) return answer(taken);
  if (!same_owner && held_for_another(claim)) return answer(Refused{Reason::kSeatTaken, "it is kept for who sat there when the server died, for 2 s", 2});

  claim.being_given = true;
  Order order;
  order.what = Order::What::kAsk;
  order.session = room.opening.session;
  order.seat = *seat;
  order.same_owner = same_owner;
  order.done = [this, &room, &claim, request, seat = *seat, taken, nothing, same_owner, back, answer = std::move(answer)](Order& asked) {
    std::optional<Refused> refused;
    double force_scale = same_owner ? claim.force_scale : 1;  // a ticket may only take away, and who comes back shows none
    if (same_owner && (too_late(claim, asked.silence) || (back == Back::kByOneBefore && asked.spoken))) refused = nothing;
    claim.before_next = !same_owner ? Checkpoint::Hash{} : asked.spoken || claim.back_until ? claim.resume_hash : claim.before_hash;
    if (asked.result == JoinResult::kSeatTaken) refused = taken;
    if (asked.result == JoinResult::kSessionOver) refused = Refused{Reason::kSessionOver, "the session is ending", 0};
    if (!refused) refused = judge(room, request, seat, force_scale);  // last: a ticket that was redeemed is used
    if (refused) {
      claim.being_given = false;
      return answer(*refused);
    }
    claim.offered_scale = force_scale;
    answer(welcome(room, seat, &request.hello.device, static_cast<std::uint8_t>(seat + 1), request.hello.has_aes, force_scale));
  };
  post(room, std::move(order));
}

std::optional<Refused> House::judge(Room& room, const JoinRequest& request, std::size_t seat, double& force_scale) {
  const AccessRole role = access_role(room.opening.session->scene().seats[seat].role);
  if (const auto* ticket = std::get_if<control::TicketCredential>(&request.hello.credential)) {
    const trust::TicketUse use{room.opening.id,  room.opening.epoch, request.hello.seat, role, trust::Pin{request.workstation.spki}, trust::wall_seconds()};
    const auto redeemed = trust_.redeem(ticket->bytes, use);
    if (!redeemed) return ticket_refused(redeemed.error());
    force_scale = static_cast<double>(redeemed->force_scale) / trust::Ticket::kFullForce;
    room.claims[seat].ticket = redeemed->ticket_id;
    return std::nullopt;
  }
  if (const auto* code = std::get_if<control::CodeCredential>(&request.hello.credential)) {
    if (was_sent_away(room, request.workstation))
      return Refused{Reason::kNotAllowed, "whoever sat at this workstation was removed from the session; a ticket lets it in again", 0};
    if (room.opening.code.empty() || code->code != room.opening.code) return Refused{Reason::kCode, "this is not the session's code", 0};
    if (role == AccessRole::kInstructor)
      return Refused{Reason::kNotAllowed, "the instructor's seat needs a ticket: on the server, `tandem-server ticket --session " + room.opening.name + " --seat " +
                                              request.hello.seat + " --workstation " + request.workstation.name + "`", 0};
    return std::nullopt;
  }
  if (std::holds_alternative<control::ResumeCredential>(request.hello.credential)) return std::nullopt;  // judged before
  return Refused{Reason::kTicket, "a ticket or the session's code is needed; ask for `tandem-server ticket --session " + room.opening.name + " --seat " +
                                      request.hello.seat + " --workstation " + request.workstation.name + "`", 0};
}

control::Welcome House::welcome(const Room& room, std::size_t seat, const control::DeviceFacts* device, std::uint8_t place, bool has_aes, double force_scale) {
  const bool visit = device == nullptr;
  const HostedSession& session = *room.opening.session;
  control::Welcome w;
  w.session_id = room.opening.id;
  w.session_name = room.opening.name;
  w.epoch = room.opening.epoch;
  const auto drawn = trust::random_bytes<std::array<std::byte, 2>>();
  w.server_cid = connection_id(static_cast<std::uint16_t>(std::to_integer<unsigned>(drawn[0]) << 8 | std::to_integer<unsigned>(drawn[1])), session.slot(), place);
  const bool aes = has_aes && link::fastest_cipher() == link::Cipher::kAes256Gcm;
  w.cipher = aes ? control::Cipher::kAes256Gcm : control::Cipher::kChaCha20Poly1305;
  if (!visit) w.seat = session.scene().seats[seat].name;
  w.role = visit ? AccessRole::kObserver : access_role(session.scene().seats[seat].role);
  SeatSetup own = visit ? session.reception().setup(seat) : session.reception().setup_for(seat, *device);
  own.gate.force_max *= force_scale;  // a ticket may only take away
  std::array<char, wire::kSetupMax> setup;
  const std::size_t size = encode_seat_setup(own, setup);
  for (std::size_t i = 0; i < size; ++i) w.setup.push_back(static_cast<std::byte>(setup[i]));
  w.udp_port = room.opening.shard->address().port();
  w.resume_secret = Secret<32>{trust::random_bytes<std::array<std::byte, 32>>()};
  return w;
}

void House::seated(const JoinRequest& request, const control::Welcome& welcome, const Secret<trust::kExportSize>& secrets) {
  Room* const found = room(welcome.session_id);
  if (found == nullptr) return;
  if (request.hello.seat.empty() && !request.hello.visit) {  // no datagrams are expected
    io::tell(io::Level::kInfo, {.event = "stands", .session = welcome.session_name, .text = request.address + " " + std::string(to_text(welcome.role))});
    return;
  }
  link::Link::Params params;
  params.outgoing = link::Direction::kToClient;
  params.own_cid = welcome.server_cid;
  params.peer_cid = request.hello.client_cid;
  const auto cipher = welcome.cipher == control::Cipher::kAes256Gcm ? link::Cipher::kAes256Gcm : link::Cipher::kChaCha20Poly1305;
  params.secrets = link::secrets_from_exporter(secrets.bytes, cipher);
  const Reception& reception = found->opening.session->reception();
  Order order;
  order.session = found->opening.session;
  order.done = [](Order&) {};
  if (request.hello.visit) {
    order.what = Order::What::kVisit;
    params.tick = reception.tick();
    order.entry.link = std::make_unique<link::Link>(params);
    order.done = [found, by = request.workstation, cid = welcome.server_cid](Order& o) { visited(*found, o, by, cid); };
  } else {
    const std::size_t seat = place_of(welcome.server_cid) - std::size_t{1};
    Claim& claim = found->claims[seat];
    claim.ticket.reset();  // used
    claim.by = request.workstation;
    claim.cid = welcome.server_cid;
    order.what = Order::What::kAdmit;
    order.seat = seat;
    order.same_owner = true;  // it was asked for, and held since
    order.entry = reception.prepare(seat, params, request.hello.device);
    if (std::string softer = reception.softened_words(seat, request.hello.device); !softer.empty())
      io::tell(io::Level::kInfo, {.event = "softer", .session = welcome.session_name, .seat = welcome.seat, .cid = welcome.server_cid, .text = std::move(softer)});
    give(claim, welcome.resume_secret, request.workstation, order.entry);
    order.done = [&claim](Order&) { claim.being_given = false; };
  }
  io::tell(io::Level::kInfo, {.event = request.hello.visit ? "visit" : "seated", .session = welcome.session_name, .seat = welcome.seat, .cid = welcome.server_cid,
                              .text = request.address});
  post(*found, std::move(order));
}

void House::abandoned(const control::Welcome& welcome) {
  Room* const found = room(welcome.session_id);
  if (found == nullptr) return;
  if (!welcome.seat.empty()) {
    Claim& claim = found->claims[place_of(welcome.server_cid) - std::size_t{1}];
    claim.being_given = false;
    if (const auto ticket = std::exchange(claim.ticket, std::nullopt)) give_back(*ticket, *found);
  }
  if (welcome.seat.empty()) stands_no_more(*found, welcome, true);
  if (place_of(welcome.server_cid) > kSeatsMax) --found->visits_being_given;
}

control::SessionList House::list(const WorkstationRow&) {
  control::SessionList list;
  for (const Room& r : rooms_) {
    if (r.gone || r.opening.session->over()) continue;
    if (list.sessions.size() == control::kSessionsMax) {
      list.more = true;
      break;
    }
    const SessionStatus status = r.opening.session->status();
    control::ListedSession& s = list.sessions.emplace_back();
    s.id = r.opening.id;
    s.name = r.opening.name;
    s.phase = phase_of(status.state);
    const SceneSpec& scene = r.opening.session->scene();
    for (std::size_t i = 0; i < scene.seats.size(); ++i)
      s.seats.push_back({scene.seats[i].name, access_role(scene.seats[i].role), status.seats[i].taken || r.claims[i].being_given || held_for_another(r.claims[i]), scene.seats[i].required});
  }
  return list;
}

ServingSpec House::serving() const {
  ServingSpec out;
  for (const Room& r : rooms_) {
    if (r.gone) continue;
    const SessionStatus status = r.opening.session->status();
    OpenSession session{r.opening.id, r.opening.code, r.opening.name, r.opening.epoch, {},
                        to_text(r.opening.session->over() ? control::SessionPhase::kEnding : phase_of(status.state))};
    const auto& seats = r.opening.session->scene().seats;
    for (std::size_t i = 0; i < seats.size(); ++i) session.seats.push_back({seats[i].name, access_role(seats[i].role), status.seats[i].taken, seats[i].required});
    out.sessions.push_back(std::move(session));
  }
  return out;
}

std::vector<const House::Opening*> House::openings() const {
  std::vector<const Opening*> all;
  for (const Room& r : rooms_)
    if (!r.gone) all.push_back(&r.opening);
  return all;
}

std::vector<const Shard*> House::shards() const {
  std::vector<const Shard*> all;
  for (const Watched& w : watched_) all.push_back(w.shard);
  return all;
}

}  // namespace tandem::server
