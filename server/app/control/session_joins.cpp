#include "server/app/control/session_joins.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/log.h"
#include "common/io/processors.h"
#include "server/app/control/audit_writer.h"
#include "server/app/control/join_replies.h"
#include "server/app/control/new_welcome.h"
#include "server/app/control/setup_bytes.h"
#include "server/app/control/slot_join.h"
#include "server/policy/roles.h"
#include "server/policy/shard_plan.h"
#include "server/session/connection_id.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using rpc::ErrorReply;
using ResumeMatch = SeatReservation::ResumeMatch;

constexpr std::uint8_t kConsolePlace = 0;  // no seat has it, so no datagram opens under a console's keys

bool is_watcher(const rpc::Welcome& joined) noexcept { return WatcherSlots::has_place(place_of(joined.server_cid)); }
bool is_console(const rpc::Welcome& joined) noexcept {
  return place_of(joined.server_cid) == kConsolePlace || is_watcher(joined);
}
std::size_t seat_index(const rpc::Welcome& joined) noexcept { return place_of(joined.server_cid) - std::size_t{1}; }

/// Key to which the resume secrets of this workstation are bound. Ephemeral keys are shared by all clients and change
/// with each start.
SeatReservation::Hash resume_binding(const auth::ServerKeystore& trust, const WorkstationRow& workstation) {
  return trust.on_disk() ? workstation.spki : SeatReservation::Hash{};
}

}  // namespace

SessionJoins::SessionJoins(SessionRegistry& registry, SessionCommands& commands, auth::ServerKeystore& trust,
                           const LoadLimits& limits, std::function<void(const std::string&)> on_message)
    : registry_(registry),
      commands_(commands),
      trust_(trust),
      tickets_(trust, std::move(on_message)),
      limits_(limits) {}

void SessionJoins::admit(const JoinRequest& request, std::function<void(JoinReply)> answer) {
  if (auto away = redirect_.find(request.hello.session, request.version >= rpc::kVersionOfServices))
    return std::visit([&](auto& reply) { answer(std::move(reply)); }, *away);
  // A console operates sessions, so it may join while the server drains.
  const bool console = request.hello.seat.empty() && !request.hello.link_test;
  if (registry_.drain().active() && !console) return answer(redirect_.draining());
  const auto found = registry_.choose(request.hello.session);
  if (const auto* refused = std::get_if<ErrorReply>(&found))
    return answer(redirect_.refusal(request.hello.session, *refused));
  SessionEntry& entry = *std::get<SessionEntry*>(found);
  answer = unless_given_up(entry.registration.id, request.hello.credential, std::move(answer));
  if (!request.hello.link_test)
    answer = used_once(
        tickets_.uses(), request, std::move(answer),
        [this, by = request.hello.credential](const rpc::Welcome& w) { take_back(w, by); },
        [&entry](const rpc::Welcome& w) { return entry.consoles.returned(w.resume_secret); });
  if (console) return join_console(entry, request, answer);
  if (const auto busy = overload_reply(entry);
      busy && !std::holds_alternative<rpc::ResumeCredential>(request.hello.credential))
    return answer(*busy);
  if (request.hello.link_test) return join_link_test(entry, request, std::move(answer));
  join_seat(entry, request, std::move(answer));
}

/// The last snapshot of a session that is given up here has no client that is admitted from now on: its next owner
/// would know neither the seat nor its secret, and the ticket would be used for nothing.
std::function<void(JoinReply)> SessionJoins::unless_given_up(const rpc::Id& session, const rpc::Credential& by,
                                                             std::function<void(JoinReply)> answer) {
  return [this, session, by, answer = std::move(answer)](JoinReply reply) {
    const SessionEntry* const entry = registry_.find(session);
    const auto* const welcome = std::get_if<rpc::Welcome>(&reply);
    const bool gone = entry == nullptr && welcome != nullptr;  // while the directory was asked about the ticket
    if (!gone && (entry == nullptr || !entry->given_up)) return answer(std::move(reply));
    if (welcome != nullptr) take_back(*welcome, by);
    answer(being_taken_over());
  };
}

void SessionJoins::take_back(const rpc::Welcome& welcome, const rpc::Credential& by) {
  if (registry_.find(welcome.session_id) != nullptr) return on_join_failed(welcome);
  if (const auto* const ticket = std::get_if<rpc::TicketCredential>(&by))
    tickets_.restore(claimed_id(*ticket), welcome.session_name, welcome.person);
}

std::optional<ErrorReply> SessionJoins::overload_reply(const SessionEntry& entry) {
  const auto load_of = [&](const Shard* shard) {
    return shard->load().cpu_share() + new_clients_[shard].expected(io::monotonic_now());
  };
  double all = 0;
  for (const Shard* shard : registry_.requests().shards()) all += load_of(shard);
  const Shard* const own = entry.registration.shard;
  std::string why = rejection_reason({load_of(own), own->load().state().level == ShedLevel::kNewJoins}, all,
                                     io::available_processors(), limits_);
  if (why.empty()) return std::nullopt;
  return ErrorReply{ErrorCode::kFull, std::move(why), 5};
}

// ---- Seats ----

void SessionJoins::join_seat(SessionEntry& entry, const JoinRequest& request, std::function<void(JoinReply)> answer) {
  const SeatCatalogue& catalogue = entry.session().seat_catalogue();
  const auto seat = catalogue.seat_named(request.hello.seat);
  if (!seat) return answer(ErrorReply{ErrorCode::kNoSeat, "no seat of this name; seats: " + catalogue.seat_names(), 0});
  if (const std::string why = catalogue.device_incompatibility(request.hello.device); !why.empty())
    return answer(ErrorReply{ErrorCode::kDeviceUnfit, why, 0});
  SeatReservation& reservation = entry.seats[*seat];
  const auto resume = resume_match(reservation, request);
  if (resume == ResumeMatch::kNone) return answer(nothing_to_resume());
  if (reservation.joining()) return answer(taken_or_used(entry, request, *seat));
  if (!resume && reservation.reserved(io::monotonic_now()))
    return answer(ErrorReply{ErrorCode::kSeatTaken,
                             "seat " + catalogue.scene().seats[*seat].name +
                                 " is reserved for 2 s for its client of before the restart or move",
                             2});

  reservation.begin_join();
  ShardRequest query{.what = ShardRequest::What::kQuerySeat, .seat = *seat, .same_owner = resume.has_value()};
  query.done = [this, &entry, request, answer = std::move(answer)](ShardRequest& asked) {
    JoinReply reply = decide_seat(entry, request, asked);
    if (std::holds_alternative<ErrorReply>(reply)) entry.seats[asked.seat].end_join();
    answer(std::move(reply));
  };
  registry_.post(entry, std::move(query));
}

ErrorReply SessionJoins::taken_or_used(const SessionEntry& entry, const JoinRequest& request, std::size_t seat) const {
  const SeatSpec& spec = entry.scene().seats[seat];
  if (const auto* const ticket = std::get_if<rpc::TicketCredential>(&request.hello.credential))
    if (auto used = tickets_.used(entry, request, *ticket, access_role(spec.role))) return std::move(*used);
  return seat_taken(spec.name);
}

std::optional<ResumeMatch> SessionJoins::resume_match(const SeatReservation& seat, const JoinRequest& request) const {
  const auto* const resume = std::get_if<rpc::ResumeCredential>(&request.hello.credential);
  if (resume == nullptr) return std::nullopt;
  return seat.match(resume->secret, resume_binding(trust_, request.workstation));
}

JoinReply SessionJoins::decide_seat(SessionEntry& entry, const JoinRequest& request, const ShardRequest& asked) {
  if (asked.result == JoinResult::kBusy) return shard_busy();
  if (asked.result == JoinResult::kSessionOver) return session_ends(entry);
  if (asked.result == JoinResult::kSeatTaken) return taken_or_used(entry, request, asked.seat);
  SeatReservation& reservation = entry.seats[asked.seat];
  if (reservation.join_void()) return seat_taken(entry.scene().seats[asked.seat].name);
  // The secret again, because the client may have been removed since it showed it.
  const ResumeMatch match = resume_match(reservation, request).value_or(ResumeMatch::kNone);
  if (asked.same_owner && !reservation.may_resume(match, asked.silence, asked.ever_heard, io::monotonic_now()))
    return nothing_to_resume();
  // Again, because other clients have joined since `admit`.
  if (auto busy = asked.same_owner ? std::nullopt : overload_reply(entry)) return std::move(*busy);
  const SeatSpec& seat = entry.scene().seats[asked.seat];
  const AccessRole role = access_role(seat.role);
  // A ticket can only lower the force. A resume has no ticket and keeps the stored scale and name.
  double force_scale = asked.same_owner ? reservation.force_scale() : 1;
  std::string person = asked.same_owner ? reservation.person() : std::string{};
  std::optional<auth::Id16> used;
  if (const auto* ticket = std::get_if<rpc::TicketCredential>(&request.hello.credential)) {
    const auto redeemed = tickets_.redeem(entry, request, *ticket, role, io::monotonic_now());
    if (!redeemed) return redeemed.error();
    force_scale = static_cast<double>(redeemed->force_scale) / auth::Ticket::kFullForce;
    used = redeemed->ticket_id;
    person = redeemed->person;
  } else if (const auto* code = std::get_if<rpc::CodeCredential>(&request.hello.credential)) {
    if (auto refused = code_refusal(entry, request, code->code, role)) return std::move(*refused);
  } else if (!asked.same_owner) {
    return ErrorReply{ErrorCode::kTicket,
                      "a ticket or the session's code is needed; ask for " +
                          ticket_command(entry, "--seat " + request.hello.seat, request.workstation.name),
                      0};
  }
  reservation.offer(match, asked.ever_heard, force_scale, used);
  if (!asked.same_owner)
    new_clients_[entry.registration.shard].add(io::monotonic_now(), expected_seat_cost(entry.scene().tick_hz));
  SeatSetup own = entry.session().seat_catalogue().setup_for(asked.seat, request.hello.device);
  own.gate.force_max *= force_scale;
  return make_welcome(entry, static_cast<std::uint8_t>(asked.seat + 1), role, request.hello.has_aes, seat.name,
                      encoded(own), std::move(person));
}

void SessionJoins::release_consoles(SessionEntry& entry) {
  for (const auth::Id16& ticket : entry.consoles.release_all())
    tickets_.restore(ticket, entry.registration.name, "", "ticket_restored");
}

// ---- Consoles and link tests ----

void SessionJoins::join_console(SessionEntry& entry, const JoinRequest& request,
                                std::function<void(JoinReply)> answer) {
  const auto* const ticket = std::get_if<rpc::TicketCredential>(&request.hello.credential);
  if (ticket == nullptr && !std::holds_alternative<rpc::ResumeCredential>(request.hello.credential))
    return answer(ErrorReply{ErrorCode::kNoSeat,
                             "a join without a seat needs a ticket, such as from " +
                                 ticket_command(entry, request.hello.watch ? "--role observer" : "--role operator",
                                                request.workstation.name) +
                                 "; seats: " + entry.session().seat_catalogue().seat_names(),
                             0});
  const auto role = ticket != nullptr ? auth::claimed_role(ticket->bytes) : std::nullopt;
  if (role && !may_join_console(*role))
    return answer(ErrorReply{ErrorCode::kNotAllowed,
                             "the role " + std::string(to_text(*role)) +
                                 " may see nothing of a session without a seat; ask for a ticket with one",
                             0});
  if (!request.hello.watch) return answer(admit_console(entry, request, kConsolePlace));
  reserve_slot(
      registry_, entry, entry.watchers, ShardRequest::Peers::kWatchers, "places of watching consoles",
      [this, &entry, request](std::uint8_t place) { return admit_console(entry, request, place); }, std::move(answer));
}

JoinReply SessionJoins::admit_console(SessionEntry& entry, const JoinRequest& request, std::uint8_t place) {
  std::vector<std::byte> scene;
  if (request.hello.watch) {
    scene = encoded(entry.scene());
    if (scene.empty())
      return ErrorReply{ErrorCode::kInternal,
                        format("the scene of this session takes more than %zu bytes, so it cannot be watched; join "
                               "without `watch`",
                               wire::kSetupMax),
                        0};
  }
  const bool aes = request.hello.has_aes;
  if (const auto* const resume = std::get_if<rpc::ResumeCredential>(&request.hello.credential)) {
    const auto* const own = entry.consoles.may_come_back(resume->secret, request.workstation, io::monotonic_now());
    if (own == nullptr) return console_is_gone();
    rpc::Welcome w = make_welcome(entry, place, own->role, aes, "", std::move(scene), own->person);
    w.resume_secret = resume->secret;
    return w;
  }
  const auto redeemed = tickets_.redeem(entry, request, std::get<rpc::TicketCredential>(request.hello.credential),
                                        std::nullopt, io::monotonic_now());
  if (!redeemed) return redeemed.error();
  rpc::Welcome w = make_welcome(entry, place, redeemed->role, aes, "", std::move(scene), redeemed->person);
  entry.consoles.add(w.resume_secret, w.server_cid,
                     {redeemed->ticket_id, redeemed->role, redeemed->person, request.workstation});
  return w;
}

/// Any enrolled workstation may test its link, because that touches no seat. The number of peers is limited.
void SessionJoins::join_link_test(SessionEntry& entry, const JoinRequest& request,
                                  std::function<void(JoinReply)> answer) {
  reserve_slot(
      registry_, entry, entry.link_tests, ShardRequest::Peers::kLinkTests, "link-test slots",
      [&entry, has_aes = request.hello.has_aes](std::uint8_t place) {
        return make_welcome(entry, place, AccessRole::kObserver, has_aes, "",
                            encoded(entry.session().seat_catalogue().setup(0)));
      },
      std::move(answer));
}

// ---- Joined connections ----

void SessionJoins::on_joined(const JoinRequest& request, const rpc::Welcome& welcome,
                             const Secret<auth::kExportSize>& secrets) {
  SessionEntry* const entry = registry_.find(welcome.session_id);
  if (entry == nullptr) return;
  if (is_console(welcome)) {
    entry->consoles.join(welcome.resume_secret, welcome.server_cid);
    entry->keep_consoles();
    io::log_event(io::Level::kInfo,
                  {.event = "console-joined",
                   .session = welcome.session_name,
                   .text = request.address + " " + std::string(to_text(welcome.role)) + by_person(welcome.person)});
    if (!is_watcher(welcome)) return;
  }
  const auto log = [&welcome](const char* event, std::string text) {
    io::log_event(io::Level::kInfo, {.event = event,
                                     .session = welcome.session_name,
                                     .seat = welcome.seat,
                                     .cid = welcome.server_cid,
                                     .text = std::move(text)});
  };
  const SeatCatalogue& catalogue = entry->session().seat_catalogue();
  const auto cipher =
      welcome.cipher == rpc::Cipher::kAes256Gcm ? transport::Cipher::kAes256Gcm : transport::Cipher::kChaCha20Poly1305;
  transport::SecureChannel::Params params{.outgoing = transport::Direction::kToClient,
                                          .own_cid = welcome.server_cid,
                                          .peer_cid = request.hello.client_cid,
                                          .secrets = transport::secrets_from_exporter(secrets.bytes, cipher)};
  ShardRequest joins;
  if (request.hello.link_test || is_watcher(welcome)) {
    params.tick = catalogue.tick();
    joins.what = ShardRequest::What::kAdmitPeer;
    joins.connection.link = std::make_unique<transport::SecureChannel>(params);
    const bool recorder = is_watcher(welcome) && welcome.role == AccessRole::kRecorder;
    const auto occupy = [by = request.workstation, cid = welcome.server_cid, recorder](auto& slots,
                                                                                       const ShardRequest& asked) {
      if (asked.result != JoinResult::kAccepted) return slots.cancel_join();
      slots.admit(asked.place, by, cid, recorder);
    };
    if (is_watcher(welcome)) {
      joins.peers = ShardRequest::Peers::kWatchers;
      joins.every_tick = recorder;
      joins.done = [this, entry, occupy, welcome](ShardRequest& asked) {
        occupy(entry->watchers, asked);
        if (!is_current(welcome)) stop_watching(*entry, welcome);  // it has gone already
      };
    } else {
      joins.done = [entry, occupy](ShardRequest& asked) { occupy(entry->link_tests, asked); };
    }
  } else {
    const std::size_t seat = seat_index(welcome);
    SeatReservation& reservation = entry->seats[seat];
    if (reservation.join_void()) return on_join_failed(welcome);
    const auto secret = resume_hash(welcome.resume_secret.bytes, resume_binding(trust_, request.workstation));
    reservation.admit(request.workstation, welcome.server_cid, secret, welcome.person, io::monotonic_now());
    entry->keep_persons();
    joins = {.what = ShardRequest::What::kAdmit,
             .seat = seat,
             .same_owner = true,  // the query succeeded, and the seat has been reserved since
             .connection = catalogue.make_connection(seat, params, request.hello.device),
             .done = [&reservation](ShardRequest&) { reservation.end_join(); }};
    if (RecordingDesk* const desk = entry->registration.recording.get())
      desk->set_person(seat, welcome.person, request.workstation.name);
    joins.connection.resume = secret;
    joins.connection.force_scale = reservation.force_scale();
    if (std::string softer = catalogue.softened_spring_text(seat, request.hello.device); !softer.empty())
      log("stiffness_reduced", std::move(softer));
  }
  if (!is_watcher(welcome))
    log(request.hello.link_test ? "link-test-joined" : "seat-joined", request.address + by_person(welcome.person));
  registry_.post(*entry, std::move(joins));
}

void SessionJoins::on_join_failed(const rpc::Welcome& welcome) {
  SessionEntry* const entry = registry_.find(welcome.session_id);
  if (entry == nullptr) return;
  if (!welcome.seat.empty())
    return tickets_.restore(entry->seats[seat_index(welcome)].end_join(), welcome.session_name, welcome.person);
  if (!is_console(welcome)) return entry->link_tests.cancel_join();
  if (is_watcher(welcome)) entry->watchers.cancel_join();
  tickets_.restore(entry->consoles.take(welcome.resume_secret, welcome.server_cid), welcome.session_name,
                   welcome.person);
  entry->keep_consoles();
}

void SessionJoins::command(const rpc::Welcome& joined, const WorkstationRow& workstation, rpc::Body command,
                           std::function<void(rpc::Body)> answer) {
  const auto* const end = std::get_if<rpc::EndSession>(&command);  // the only one for other sessions
  const rpc::Id& named = end == nullptr ? joined.session_id : end->session_id;
  if (std::as_const(registry_).find(named) == nullptr)
    if (auto away = redirect_.find(named, joined.version >= rpc::kVersionOfServices))
      return std::visit([&](auto& reply) { answer(std::move(reply)); }, *away);
  const SessionEntry* const entry = std::as_const(registry_).find(joined.session_id);
  if (entry != nullptr && is_console(joined) && entry->consoles.replaced(joined.resume_secret, joined.server_cid))
    return answer(ErrorReply{ErrorCode::kNotAllowed, "this console came back over another connection", 0});
  commands_.execute(joined, workstation, std::move(command), std::move(answer));
}

bool SessionJoins::is_current(const rpc::Welcome& joined) const {
  const SessionEntry* const entry = std::as_const(registry_).find(joined.session_id);
  if (entry == nullptr) return false;
  if (!joined.seat.empty()) return entry->seats[seat_index(joined)].owned_by(joined.server_cid);
  return is_console(joined) ? entry->consoles.contains(joined.resume_secret, joined.server_cid)
                            : entry->link_tests.find(joined.server_cid).has_value();
}

/// The right of a console to see the session ends with its control connection.
void SessionJoins::stop_watching(SessionEntry& entry, const rpc::Welcome& joined) {
  const auto slot = entry.watchers.find(joined.server_cid);
  if (!slot) return;
  entry.watchers.remove(*slot);
  registry_.post(entry, {.what = ShardRequest::What::kRemovePeer,
                         .peers = ShardRequest::Peers::kWatchers,
                         .place = *slot,
                         .cid = joined.server_cid});
}

/// Recorders, and trainees and observers without a seat, only query status, so their ticket counts as used.
void SessionJoins::on_disconnected(const rpc::Welcome& joined, bool in_vain) {
  SessionEntry* const entry = registry_.find(joined.session_id);
  if (entry == nullptr || !is_console(joined)) return;
  stop_watching(*entry, joined);
  ConsoleTickets& consoles = entry->consoles;
  const bool commands = allowed(joined.role, Right::kStopSession) != Grant::kNo && !watches_only(joined.role);
  if (in_vain && commands && !consoles.came_back(joined.resume_secret))
    tickets_.restore(consoles.take(joined.resume_secret, joined.server_cid), joined.session_name, joined.person);
  else
    consoles.leave(joined.resume_secret, joined.server_cid, io::monotonic_now());
  entry->keep_consoles();
}

}  // namespace tandem::server
