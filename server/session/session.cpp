#include "server/session/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/session/connection_id.h"
#include "server/session/session_record.h"
#include "server/session/session_telemetry.h"

namespace tandem::server {

namespace {

std::vector<SeatEndpoint> make_seats(const SceneSpec& scene, const AxisArray& scale) {
  std::vector<SeatEndpoint> seats;
  seats.reserve(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i) seats.emplace_back(scene, i, scale);
  return seats;
}

}  // namespace

Session::Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves,
                 const AxisArray& scale)
    : scene_(&scene),
      masters_(scene.masters()),
      seats_(make_seats(scene, scale)),
      seat_catalogue_(scene, scale),
      clock_(scene.tick_hz),
      audit_(clock_),
      participants_(seats_, clock_, audit_),
      link_test_peers_(body_layout(seat_setup(scene, 0)), from_seconds(1.0 / scene.tick_hz),
                       participants_.closing().session),
      watchers_(scene, participants_.closing().session),
      control_(scene, std::move(slaves), scale, seats_, participants_.present()),
      start_(scene, seats_, participants_.present(), clock_),
      stop_(scene, participants_, start_, audit_),
      lifecycle_(scene, clock_, participants_, start_, stop_, audit_),
      authority_(scene, clock_, control_.tools(), seats_, participants_.present(), audit_),
      leading_hands_(scene, clock_.dt()),
      send_(scene, seats_),
      scene_hash_(scene_hash(scene)) {}

Session::Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves,
                 const AxisArray& scale, const Checkpoint& from, Time saved_at)
    : Session(scene, std::move(slaves), scale) {
  epoch_ = from.epoch + 1;
  clock_.restore(from.session_tick);
  authority_.restore(from);
  start_.restore(from);
  stop_.restore(from, saved_at);
  for (std::size_t i = 0; i < seats_.size(); ++i) seats_[i].set_resume(from.seats[i].resume, from.seats[i].force_scale);
  // A tool with its own slave starts at the slave's position, so that the spring between them starts without force.
  for (std::size_t j = 0; j < control_.tools().size(); ++j)
    if (control_.tools()[j].slave() == nullptr) control_.rest_tool(j, from.tools[j].x);
  if (start_.recovering())
    audit_.emit(Time{}, AuditEvent::What::kRestored, AuditEvent::kNoSeat, static_cast<std::uint32_t>(epoch_));
}

bool Session::attach_journal(InputJournal& journal, Time start, std::string_view build, const Checkpoint* from) {
  if (clock_.ticked() || std::ranges::any_of(seats_, &SeatEndpoint::taken)) return false;
  journal.begin({.build = build,
                 .start = start,
                 .from = from,
                 .scale = seat_catalogue_.setup(0).axis_scale,
                 .scene = scene_hash_,
                 .seats = seats_.size()});
  for (std::size_t i = 0; i < seats_.size(); ++i) seats_[i].record_outputs(&journal.outputs(i));
  journal_ = &journal;
  return true;
}

bool Session::idle() const noexcept {
  return std::ranges::none_of(seats_, &SeatEndpoint::taken) && !watchers_.any() && !link_test_peers_.any();
}

void Session::end(wire::CloseReason why) noexcept {
  if (journal_ != nullptr && !participants_.closing().session.begun()) journal_->end(why);
  participants_.end(why);
}

bool Session::remove(std::size_t seat, wire::CloseReason why) noexcept {
  const bool removed = participants_.remove(seat, why);
  if (removed && journal_ != nullptr) journal_->remove(seat, why);
  return removed;
}

bool Session::set_contact_source(std::size_t tool, std::unique_ptr<ContactSource> source) {
  if (scene_->channel.law != LawKind::kReplica || tool >= control_.tools().size() ||
      control_.tools()[tool].body() == nullptr)
    return false;
  control_.tools()[tool].set_contact_source(std::move(source));
  if (journal_ != nullptr) journal_->contacts(tool);
  return true;
}

Checkpoint Session::checkpoint() const noexcept {
  Checkpoint c;
  c.scene = scene_hash_;
  c.epoch = epoch_;
  const CloseOut& closing = participants_.closing().session;
  c.handed_over = closing.begun() && closing.reason() == wire::CloseReason::kServerReturns;
  c.session_tick = clock_.session_tick();
  c.seats_n = static_cast<std::uint8_t>(seats_.size());
  c.masters_n = static_cast<std::uint8_t>(masters_);
  c.tools_n = static_cast<std::uint8_t>(control_.tools().size());
  c.dof = static_cast<std::uint8_t>(scene_->dof);
  authority_.save(c);
  start_.save(c);
  stop_.save(c, clock_.last_tick());
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    c.seats[i].resume = seats_[i].resume();
    c.seats[i].force_scale = seats_[i].force_scale();
  }
  for (std::size_t j = 0; j < control_.tools().size(); ++j) {
    c.tools[j].x = control_.tools()[j].position();
    if (const hal::SteppedDevice* slave = control_.tools()[j].slave()) c.tools[j].slave = slave->state().q;
  }
  return c;
}

JoinResult Session::admit(Time now, std::size_t i, SeatConnection& entry, bool same_owner) noexcept {
  const JoinResult result = participants_.admit(now, i, entry, same_owner);
  if (result != JoinResult::kAccepted) return result;
  stop_.clear_seat(i);
  if (journal_ != nullptr)
    journal_->admit(now, i, seats_[i].link()->own_cid(), seats_[i].link()->peer_cid(), entry.device,
                    seats_[i].force_scale(), same_owner);
  return result;
}

void Session::on_datagram(Time now, const PeerAddress& from, std::span<const std::byte> bytes) noexcept {
  const auto header = transport::read_header(bytes);
  if (!header) {
    ++unmatched_datagrams_;
    return;
  }
  const std::size_t i = static_cast<std::size_t>(place_of(header->cid)) - 1;
  if (i >= seats_.size() || !seats_[i].taken() || seats_[i].link()->own_cid() != header->cid) {
    if (!link_test_peers_.on_datagram(now, from, *header, bytes, path_tokens_) &&
        !watchers_.on_datagram(now, from, *header, bytes, path_tokens_))
      ++unmatched_datagrams_;
    return;
  }
  const std::uint64_t tokens = path_tokens_.taken();
  const SeatEndpoint::Received heard = seats_[i].on_datagram(now, from, *header, bytes, path_tokens_);
  if (journal_ != nullptr && heard.plaintext.data() != nullptr) [[unlikely]]
    journal_->datagram(now, i, from, *header, heard.plaintext,
                       path_tokens_.taken() != tokens ? &path_tokens_.last_taken() : nullptr);
  handle_message(now, i, heard);
}

void Session::handle_message(Time now, std::size_t i, const SeatEndpoint::Received& heard) noexcept {
  if (heard.forbidden) participants_.reject_forbidden(now, i);
  if (heard.accepted_state) handle_requests(now, i);
  if (heard.authority != nullptr && !participants_.removing(i) &&
      authority_.request(now, requester_at(i, seats_[i].role()), *heard.authority) == CommandResult::kForbidden)
    participants_.reject_forbidden(now, i);
  if (heard.close) participants_.leave(now, i);
}

/// A participant who is being removed may stop the session, and request nothing else.
void Session::handle_requests(Time now, std::size_t i) noexcept {
  const wire::StateMessage& state = seats_[i].last_state();
  const auto by = [&] { return requester_at(i, seats_[i].role()); };
  if (stop_.rising_edge(i, state.stop_all) && !stop_.request(now, by())) participants_.reject_forbidden(now, i);
  if (state.resume_stop != 0 && !participants_.removing(i) &&
      stop_.resume(now, by(), state.resume_stop) == CommandResult::kForbidden)
    participants_.reject_forbidden(now, i);
}

void Session::on_tick(Time now, std::uint32_t missed) noexcept {
  recorded_ = false;
  if (over()) return;
  if (journal_ != nullptr) [[unlikely]]
    journal_->tick(now, missed, {lifecycle_.load_state(), telemetry_due(), record_interval_, lifecycle_.may_act()});
  for (SeatEndpoint& seat : seats_)
    if (auto* link = seat.link()) link->tick(now);
  const std::uint32_t catch_up = clock_.begin_tick(now, missed);
  for (std::uint32_t i = 0; i <= catch_up && !over(); ++i) run_one_tick(now);
  // Until the session runs, every tick makes a record, so that the first running one has a record at any interval.
  if (!over() && (++since_record_ >= record_interval_ || !record_.running)) {
    since_record_ = 0;
    record_tick(*this, leading_hands_, record_);
    record_.every_tick = telemetry_every_tick_;
    recorded_ = true;
  }
  if (participants_.any_removal()) participants_.step_removals(now);
  fill_force_messages(now);
  send_.begin_tick(now, clock_.tick(), lifecycle_.load_state().level, participants_.closing());
  if (link_test_peers_.any()) link_test_peers_.on_tick(now);
  if (watchers_.any()) serve_watchers(now);
}

void Session::serve_watchers(Time now) noexcept {
  if (watchers_.on_tick(now, clock_.tick(), lifecycle_.load_state().level))
    fill_telemetry(*this, now, watchers_.next_turn(), watchers_.telemetry());
}

void Session::run_one_tick(Time now) noexcept {
  const Duration elapsed = clock_.begin_step();
  for (Tool& tool : control_.tools()) tool.advance_slave(elapsed);
  lifecycle_.report_changes(now);
  participants_.step(now);
  if (faults_.faulty(now, control_.not_finite())) stop_.stop_for_fault(now);
  lifecycle_.step(now, control_.tools());
  if (over()) return;
  if (authority_.any_change()) authority_.step(now, lifecycle_.clock_stopped());
  control_.step_authority(lifecycle_.disengages_all());
  control_.move_references(now);
  control_.step_tools(clock_.time());
  if (leading_hands_.any()) leading_hands_.step(clock_.tick(), participants_.present(), seats_, control_.tools());
  control_.step_targets(clock_.tick(), leading_hands_);
}

void Session::fill_force_messages(Time now) noexcept {
  const std::array<bool, kSeatsMax>& ready = participants_.ready();
  std::uint32_t missing_now = 0;
  const std::span<SeatEndpoint> seats = seats_;
  const std::span<const Tool> tools = control_.tools();
  for (std::size_t i = 0; i < seats.size(); ++i) missing_now += start_.required(i) && !ready[i] ? 1 : 0;
  std::array<bool, kToolsMax> entitled{}, touches{};
  for (std::size_t j = 0; j < tools.size(); ++j) {
    const bool slave_ready = !tools[j].spec().remote || ready[tools[j].spec().seat];
    for (std::size_t i = 0; i < masters_ && slave_ready; ++i)
      entitled[j] |= ready[i] && tools[j].authority.requested()[i] > 0;
    touches[j] = control_.touching(now, j);
  }
  const bool engage = start_.may_engage() && !lifecycle_.disengages_all(), timeline_waits = lifecycle_.clock_stopped();
  const wire::SessionState state_now = state();

  for (std::size_t i = 0; i < seats.size(); ++i) {
    wire::ForceMessage& m = seats[i].tx;
    m.session = state_now;
    bool entitles = engage && participants_.admissible()[i];
    bool touching = false;
    for (std::size_t j = 0; j < tools.size(); ++j) {
      if (control_.hub().coupling(i, j).share == 0) continue;
      entitles &= entitled[j];
      touching |= touches[j];
    }
    m.engage = entitles;
    m.touching = touching;
    m.session_tick = clock_.session_tick();
    m.authority_version = authority_.version();
    m.missing = missing_now;
    m.telemetry_every_tick = telemetry_due();
    m.stops = stop_.latch().stops();
    authority_.fill_notice(i, timeline_waits, m);
  }
}

std::optional<Transmit> Session::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  std::optional<Transmit> out =
      send_.done() ? std::nullopt : send_.poll(now, clock_.tick(), participants_.closing(), buffer);
  if (out) [[likely]]
    return out;
  if (link_test_peers_.any()) out = link_test_peers_.poll_transmit(now, clock_.tick(), buffer);
  if (!out && watchers_.may_send()) out = watchers_.poll_transmit(now, clock_.tick(), buffer);
  if (out) return out;
  send_.rewind();
  if (journal_ != nullptr) [[unlikely]]
    journal_->end_tick();
  return std::nullopt;
}

}  // namespace tandem::server
