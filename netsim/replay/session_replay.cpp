#include "netsim/replay/session_replay.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "common/base/format.h"
#include "hal/sim/local_slaves.h"
#include "server/session/build_text.h"

namespace tandem::netsim {

bool SessionReplay::apply(const JournalEvent& event) {
  if (difference_ || !error_.empty()) return false;
  std::visit([this](const auto& e) { apply_event(e); }, event);
  return !difference_ && error_.empty();
}

std::string SessionReplay::seat_name(std::size_t seat) const {
  return seat < scene_->seats.size() ? scene_->seats[seat].name : "seat " + std::to_string(seat);
}

void SessionReplay::differ(ReplayDifference difference) {
  difference.tick = counts_.ticks;
  difference.session_tick = session_->clock().session_tick();
  difference_ = std::move(difference);
}

void SessionReplay::apply_event(const JournalBegin& begin) {
  ++counts_.sessions;
  if (begin.build != server::build_text() && std::ranges::find(other_builds_, begin.build) == other_builds_.end())
    other_builds_.push_back(begin.build);
  same_scene_ = same_scene_ && begin.scene == expected_scene_.value_or(server::scene_hash(*scene_));
  std::optional<server::Checkpoint> from = begin.from;
  if (from) {
    from->scene = server::scene_hash(*scene_);  // `same_scene` tells whether it was another one
    if (const std::string problem = server::incompatibility(*from, *scene_); !problem.empty()) {
      error_ = "the session was restored from a checkpoint that does not fit its scene: " + problem;
      return;
    }
  }
  auto slaves = hal::sim::make_local_slaves(
      *scene_, begin.start, [&](std::size_t tool) { return from ? &from->tools[tool].slave : nullptr; });
  if (!slaves) {
    error_ = slaves.error().front();
    return;
  }
  session_ = from ? std::make_unique<server::Session>(*scene_, std::move(*slaves), begin.scale, *from)
                  : std::make_unique<server::Session>(*scene_, std::move(*slaves), begin.scale);
  session_->attach_journal(digests_, begin.start, server::build_text());
  for (Seat& seat : seats_) seat = {};
  for (std::size_t i = 0; i < scene_->seats.size(); ++i)
    seats_[i].output = static_cast<std::uint16_t>(digests_.outputs(i).value());
}

void SessionReplay::apply_event(const JournalAdmit& admit) {
  const server::SeatCatalogue& catalogue = session_->seat_catalogue();
  if (admit.seat >= scene_->seats.size()) {
    error_ = "a client took seat " + std::to_string(admit.seat) + ", which the scene does not have";
    return;
  }
  if (const std::string problem = catalogue.device_incompatibility(admit.device); !problem.empty()) {
    error_ = "seat " + seat_name(admit.seat) + ": " + problem;
    return;
  }
  ReplayKeys& keys = seats_[admit.seat].keys.emplace(counts_.sessions << 32 | admit.own_cid);
  server::SeatConnection entry = catalogue.make_connection(
      admit.seat, {.own_cid = admit.own_cid, .peer_cid = admit.peer_cid, .secrets = keys.secrets()}, admit.device);
  entry.force_scale = admit.force_scale;
  if (session_->admit(admit.at, admit.seat, entry, admit.same_owner) != server::JoinResult::kAccepted)
    differ({.channel = "/" + seat_name(admit.seat) + "/join", .recorded = "accepted", .replayed = "rejected"});
}

void SessionReplay::apply_event(const JournalDatagram& datagram) {
  ++counts_.datagrams;
  const bool known = datagram.seat < scene_->seats.size();
  const transport::SecureChannel* const link = known ? std::as_const(*session_).seat(datagram.seat).link() : nullptr;
  if (link == nullptr) {
    differ({.channel = "/" + seat_name(datagram.seat) + "/inputs",
            .recorded = "a datagram of the seat's client",
            .replayed = "the seat is free"});
    return;
  }
  const auto bytes = seats_[datagram.seat].keys->seal(datagram, link->own_cid(), link->receiving_phase());
  if (bytes.empty()) {
    error_ = format("seat %s: a datagram under key %u, which does not follow the ones before",
                    seat_name(datagram.seat).c_str(), static_cast<unsigned>(datagram.key_phase));
    return;
  }
  // The store has exactly the token that the recording server took, if it took one: peers without a seat took others.
  if (datagram.token) session_->path_tokens().add(*datagram.token);
  session_->on_datagram(datagram.at, datagram.from, bytes);
  if (session_->path_tokens().take())
    differ({.channel = "/" + seat_name(datagram.seat) + "/address",
            .recorded = "the new address of the client is challenged",
            .replayed = "it is not"});
}

void SessionReplay::apply_event(const JournalCommand& command) {
  static_cast<void>(server::execute_command(*session_, command.at, command.command));
}

void SessionReplay::apply_event(const JournalRemove& remove) { session_->remove(remove.seat, remove.why); }

void SessionReplay::apply_event(const JournalEnd& end) { session_->end(end.why); }

void SessionReplay::apply_event(const JournalContacts& contacts) {
  error_ =
      "the surfaces near tool " + std::to_string(contacts.tool + 1) +
      " came from a source of the program that recorded (Session::set_contact_source); the inputs do not have them";
}

void SessionReplay::apply_event(const JournalOverflow& overflow) {
  error_ = format("the recording lost inputs after %llu ticks: nothing behind them can be replayed",
                  static_cast<unsigned long long>(overflow.ticks));
}

void SessionReplay::apply_event(const JournalTick& tick) {
  session_->lifecycle().set_load_state(tick.settings.load);
  session_->lifecycle().set_may_act(tick.settings.may_act);
  session_->set_telemetry_every_tick(tick.settings.telemetry_every_tick);
  session_->set_record_interval(tick.settings.record_interval);
  session_->on_tick(tick.at, tick.missed);
  while (session_->poll_transmit(tick.at, buffer_)) {
  }
  while (session_->audit().poll()) {
  }
  if (compare)
    if (auto difference = compare(*session_)) differ(std::move(*difference));
  if (!difference_) compare_outputs(tick);
  ++counts_.ticks;
}

void SessionReplay::compare_outputs(const JournalTick& tick) {
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) {
    Seat& seat = seats_[i];
    const bool sent = (tick.sent >> i & 1) != 0;
    if (sent) seat.output = tick.outputs[i];
    counts_.outputs += sent ? 1 : 0;
    const auto own = static_cast<std::uint16_t>(digests_.outputs(i).value());
    if (own == seat.output) continue;
    differ({.channel = "/" + seat_name(i) + "/outputs",
            .recorded = format("hash %04x", static_cast<unsigned>(seat.output)),
            .replayed = format("hash %04x", static_cast<unsigned>(own))});
    return;
  }
}

}  // namespace tandem::netsim
