#include "server/session/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/session/connection_id.h"
#include "server/session/session_record.h"

namespace tandem::server {

namespace {
constexpr std::uint32_t kCatchUpMax = 50;                       // ticks that are run after a stall; more are skipped
constexpr double kCloseOutTime = 0.15;                          // [s] for the gates to ramp out before CLOSE
constexpr Duration kOwnerSilenceMax = std::chrono::seconds(2);  // after this silence another client can take the seat
constexpr double kObserverHz = 60;                              // FORCE rate to seats that receive no force
// Isolated losses must not trip a gate: at 5 % random loss, five in a row occur every day or two.
constexpr double kIntervalsOfSilence = 6;
constexpr std::uint32_t kCloseRepeats = 20;  // ticks in which CLOSE is sent, because single datagrams may be lost

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
      dt_(1.0 / scene.tick_hz),
      tick_length_(from_seconds(dt_)),
      masters_(scene.masters()),
      replica_(scene.channel.law == LawKind::kReplica),
      observer_interval_(static_cast<std::uint32_t>(std::ceil(scene.tick_hz / kObserverHz))),
      evaluator_interval_max_(
          static_cast<std::uint32_t>(std::max(1.0, scene.gate.silence_limit * scene.tick_hz / kIntervalsOfSilence))),
      seats_(make_seats(scene, scale)),
      control_(scene, std::move(slaves), scale, seats_, present_),
      leading_hands_(scene, dt_),
      seat_catalogue_(scene, scale),
      link_test_peers_(scene.dof, scene.port, tick_length_),
      stop_latch_(scene.has_instructor()) {
  last_interval_.fill(~0u);
  for (const AuthorityRow& row : scene.authority) set_initial_authority(row.tool, weights_of(row));
  authority_version_ += static_cast<std::uint32_t>(scene.authority.size());
  scene_hash_ = scene_hash(scene);
}

Session::Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves,
                 const AxisArray& scale, const Checkpoint& from)
    : Session(scene, std::move(slaves), scale) {
  for (std::size_t j = 0; j < tools().size(); ++j) {
    set_initial_authority(j, from.tools[j].alpha);
    // A tool with its own slave starts at the slave's position, so that the spring between them starts without force.
    if (tools()[j].slave() == nullptr) control_.rest_tool(j, from.tools[j].x);
  }
  epoch_ = from.epoch + 1;
  session_tick_ = from.session_tick;
  authority_version_ = from.authority_version + 1;
  stop_before_ = from.stop;
  recovering_ = from.begun;
  for (std::size_t i = 0; i < seats_.size(); ++i) seats_[i].set_resume(from.seats[i].resume, from.seats[i].force_scale);
  if (!recovering_) {
    stop_latch_.restore(from.stop, from.stops);
    return;
  }
  // A new number, which an instructor can name to resume without the missing seats.
  stop_latch_.restore(StopLatch::Level::kNone, from.stops + 1);
  // The checkpoint contains the result of the changes that were announced when it was made.
  while (next_event_ < scene.timeline.size() &&
         scene.timeline[next_event_].at <= time() + (AuthorityTransfer::kNotice + 0.5) * dt_)
    ++next_event_;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    bool has_weight = false;
    for (std::size_t j = 0; j < tools().size(); ++j) {
      const auto& alpha = from.tools[j].alpha;
      // A slave seat counts as having authority over its tool.
      has_weight = has_weight || (i < masters_ ? alpha[i] > 0 : scene.seats[i].tool == j);
    }
    required_for_resume_[i] = from.seats[i].taken && (has_weight || seats_[i].role() == AccessRole::kInstructor);
  }
  emit_event(Time{}, AuditEvent::What::kRestored, AuditEvent::kNoSeat, static_cast<std::uint32_t>(epoch_));
}

bool Session::set_contact_source(std::size_t tool, std::unique_ptr<ContactSource> source) {
  if (!replica_ || tool >= tools().size() || tools()[tool].body() == nullptr) return false;
  tools()[tool].set_contact_source(std::move(source));
  return true;
}

Checkpoint Session::checkpoint() const noexcept {
  Checkpoint c;
  c.scene = scene_hash_;
  c.epoch = epoch_;
  c.session_tick = session_tick_;
  c.authority_version = authority_version_;
  c.stops = stop_latch_.stops();
  c.stop = recovering_ ? std::max(stop_before_, stop_latch_.level()) : stop_latch_.level();
  c.begun = begun();
  c.seats_n = static_cast<std::uint8_t>(seats_.size());
  c.masters_n = static_cast<std::uint8_t>(masters_);
  c.tools_n = static_cast<std::uint8_t>(tools().size());
  c.dof = static_cast<std::uint8_t>(scene_->dof);
  for (std::size_t i = 0; i < seats_.size(); ++i)
    c.seats[i] = {seats_[i].taken() || required_for_resume_[i], seats_[i].resume(), seats_[i].force_scale()};
  for (std::size_t j = 0; j < tools().size(); ++j) {
    c.tools[j].alpha = tools()[j].transfer.scheduled();
    c.tools[j].x = tools()[j].position();
    if (const hal::SteppedDevice* slave = tools()[j].slave()) c.tools[j].slave = slave->state().q;
  }
  return c;
}

void Session::on_datagram(Time now, const PeerAddress& from, std::span<const std::byte> bytes) noexcept {
  const auto header = transport::read_header(bytes);
  if (!header) {
    ++unmatched_datagrams_;
    return;
  }
  const std::size_t i = static_cast<std::size_t>(place_of(header->cid)) - 1;
  if (i >= seats_.size() || !seats_[i].taken() || seats_[i].link()->own_cid() != header->cid) {
    if (!link_test_peers_.on_datagram(now, from, header->cid, bytes, path_tokens_)) ++unmatched_datagrams_;
    return;
  }
  handle_message(now, i, seats_[i].on_datagram(now, from, bytes, path_tokens_));
}

JoinResult Session::may_admit(Time now, std::size_t i, bool same_owner) const noexcept {
  if (over_ || state_ == wire::SessionState::kEnding) return JoinResult::kSessionOver;
  if (i >= seats_.size()) return JoinResult::kNoSuchSeat;
  if (seats_[i].taken() && !same_owner && seats_[i].silence(now) <= kOwnerSilenceMax) return JoinResult::kSeatTaken;
  return JoinResult::kAccepted;
}

JoinResult Session::admit(Time now, std::size_t i, SeatConnection& entry, bool same_owner) noexcept {
  const JoinResult may = may_admit(now, i, same_owner);
  if (may != JoinResult::kAccepted) return may;
  seats_[i].attach(now, entry);
  close_outs_[i] = {};
  stop_latch_.clear_seat(i);
  seat_monitor_[i] = {};
  emit_event(now, AuditEvent::What::kJoin, i);
  return may;
}

JoinResult Session::admit_link_test_peer(Time now, std::unique_ptr<transport::SecureChannel>& link,
                                         std::size_t* place) noexcept {
  if (over_ || state_ == wire::SessionState::kEnding) return JoinResult::kSessionOver;
  const auto taken = link_test_peers_.admit(now, link);
  if (taken && place != nullptr) *place = *taken;
  return taken ? JoinResult::kAccepted : JoinResult::kSeatTaken;
}

void Session::on_tick(Time now, std::uint32_t missed) noexcept {
  if (over_) return;
  if (!ticked_) {
    ticked_ = true;
    started_ = now;
  }
  last_tick_ = now;
  tick_ = static_cast<std::uint32_t>(std::llround(seconds(now - started_) / dt_));
  const std::uint32_t live = std::min(missed, kCatchUpMax);
  dropped_ticks_ += missed - live;
  for (std::uint32_t i = 0; i <= live && !over_; ++i) run_one_tick(now);
  finish_close_out(now);
  fill_force_messages(now);
  next_send_ = 0;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (auto* l = seats_[i].link()) l->tick(now);
    const bool due = send_turn_begins(i) && seats_[i].reachable();
    send_due_[i] = due && (sends_close(i) ? !seats_[i].expired(now) : seats_[i].may_send(now));
  }
  link_test_peers_.on_tick(now);
}

std::uint32_t Session::send_interval(std::size_t i) const noexcept {
  const SeatEndpoint& seat = seats_[i];
  const auto spared = [&](ShedLevel rung) { return load_state_.level >= rung; };
  if (!seat.receives_force())
    return observer_interval_ * (spared(ShedLevel::kObservers10Hz) ? 6 : spared(ShedLevel::kObservers20Hz) ? 3 : 1);
  if (seat.role() != AccessRole::kEvaluator || i >= masters_ || scene_->seats[i].required) return 1;
  return std::min(evaluator_interval_max_, spared(ShedLevel::kEvaluatorsEvery3rd)   ? 3u
                                           : spared(ShedLevel::kEvaluatorsEvery2nd) ? 2u
                                                                                    : 1u);
}

/// Whether a new send interval of the seat begins; true once per interval, even after missed ticks. Sends to
/// evaluators are staggered over ticks, so that no single tick carries all of them.
bool Session::send_turn_begins(std::size_t i) noexcept {
  const std::uint32_t turn =
      (tick_ + (seats_[i].receives_force() ? static_cast<std::uint32_t>(i) : 0)) / send_interval(i);
  return turn != std::exchange(last_interval_[i], turn);
}

void Session::run_one_tick(Time now) noexcept {
  for (auto& tool : tools()) tool.advance_slave(elapsed_any_ ? tick_length_ : Duration{0});
  elapsed_any_ = true;
  update_state(now);
  if (over_) return;
  advance_transfers();
  schedule_timeline_events(now);
  execute_transfers(now);
  control_.step_authority(state_ == wire::SessionState::kEnding || disengages_all());
  control_.move_references(now);
  control_.step_tools(time());
  leading_hands_.step(tick_, present_, seats_, tools());
  control_.step_targets(tick_, leading_hands_);
  record_tick(*this, record_);
}

void Session::update_state(Time now) noexcept {
  for (std::size_t i = 0; i < seats_.size(); ++i)
    present_[i] = seats_[i].receives_force() && seats_[i].present(now) && !closing_out(i);
  monitor_seats(now);
  // The session clock is stopped, so that a restart resumes at the time when the end began.
  if (state_ == wire::SessionState::kEnding) {
    if (ending_ticks_left_ > 0) {
      --ending_ticks_left_;
    } else {
      over_ = true;
    }
    return;
  }
  if (!begun_) {
    check_start_condition(now);
  } else {
    if (clock_stopped()) {
      ++stopped_ticks_;
    } else {
      ++session_tick_;
    }
    held_ = std::ranges::all_of(tools(), [](const Tool& t) { return t.authority.held(); });
  }
  derive_session_state();
  if (begun_ && time() >= scene_->duration) end(wire::CloseReason::kDone);
}

/// Called after a tick and after a command, so that the next query returns the new state.
void Session::derive_session_state() noexcept {
  if (state_ == wire::SessionState::kEnding) return;
  state_ = !begun_                  ? wire::SessionState::kWaiting
           : load_state_.overloaded ? wire::SessionState::kOverloaded
           : held_                  ? wire::SessionState::kHeld
                                    : wire::SessionState::kRunning;
  if (stop_latch_.level() == StopLatch::Level::kPaused) state_ = wire::SessionState::kPaused;
  if (stop_latch_.level() == StopLatch::Level::kStopped) state_ = wire::SessionState::kStopped;
}

void Session::end(wire::CloseReason why) noexcept {
  if (state_ == wire::SessionState::kEnding) return;
  state_ = wire::SessionState::kEnding;
  close_reason_ = why;
  ending_ticks_left_ = static_cast<std::uint32_t>(std::lround(kCloseOutTime / dt_)) + kCloseRepeats;
}

bool Session::remove_seat(std::size_t i, wire::CloseReason why) noexcept {
  if (i >= seats_.size() || !seats_[i].taken() || closing_out(i)) return false;
  close_outs_[i] = {static_cast<std::uint32_t>(std::lround(kCloseOutTime / dt_)) + kCloseRepeats + 1, why};
  return true;
}

/// After the last CLOSE the seat is free. The old resume secret is deleted, so that the removed participant cannot
/// resume.
void Session::finish_close_out(Time now) noexcept {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (!closing_out(i) || --close_outs_[i].ticks_left > 0) continue;
    if (!seats_[i].taken()) continue;  // the client left on its own during the close-out
    seats_[i].release();
    seats_[i].set_resume({}, 1);
    emit_event(now, AuditEvent::What::kRemoved, i);
  }
}

/// Whether the slave of a tool is in contact, as far as its device reports contact.
bool Session::touching(Time now, std::size_t j) const noexcept {
  constexpr double kTouchN = 0.05;  // [N] noise level of a force sensor
  if (const hal::SteppedDevice* const slave = tools()[j].slave())
    return slave->state().penetration > 0 || slave->state().f_env.squaredNorm() > kTouchN * kTouchN;
  if (const control::VirtualTool* const body = tools()[j].body(); body != nullptr && !scene_->tools[j].remote)
    return body->penetration() > 0;
  if (!scene_->tools[j].remote || !seats_[scene_->tools[j].seat].alive(now)) return false;
  const wire::Telemetry& heard = seats_[scene_->tools[j].seat].last_state().telemetry;
  return heard.penetration_m > 0 || std::ranges::any_of(heard.f_env, [](double f) { return std::abs(f) > kTouchN; });
}

void Session::fill_force_messages(Time now) noexcept {
  std::array<bool, kSeatsMax> ready{};
  std::uint32_t missing_now = 0;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    ready[i] = seats_[i].ready(now);
    missing_now += is_required(i) && !ready[i] ? 1 : 0;
  }
  std::array<bool, kToolsMax> entitled{}, touches{};
  for (std::size_t j = 0; j < tools().size(); ++j) {
    const bool slave_ready = !scene_->tools[j].remote || ready[scene_->tools[j].seat];
    for (std::size_t i = 0; i < masters_; ++i)
      entitled[j] |= slave_ready && tools()[j].authority.requested()[i] > 0 && ready[i];
    touches[j] = touching(now, j);
  }
  const bool engage = engage_ && state_ != wire::SessionState::kEnding && !disengages_all();

  for (std::size_t i = 0; i < seats_.size(); ++i) {
    wire::ForceMessage& m = seats_[i].tx;
    m.session = state_;
    m.engage = engage && seats_[i].receives_force() && !seats_[i].misbehaviour().quarantined(now) && !closing_out(i);
    m.touching = false;
    for (std::size_t j = 0; j < tools().size(); ++j) {
      const double share = control_.hub().coupling(i, j).share;
      m.engage = m.engage && (share == 0 || entitled[j]);
      m.touching = m.touching || (share > 0 && touches[j]);
    }
    m.session_tick = session_tick_;
    m.authority_version = authority_version_;
    m.missing = missing_now;
    m.stops = stop_latch_.stops();
    fill_transfer_message(i, m);
  }
}

bool Session::sends_close() const noexcept {
  return over_ || (state_ == wire::SessionState::kEnding && ending_ticks_left_ < kCloseRepeats);
}
bool Session::sends_close(std::size_t i) const noexcept {
  return sends_close() || (closing_out(i) && close_outs_[i].ticks_left <= kCloseRepeats);
}

std::optional<Transmit> Session::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  const bool all = sends_close();
  for (; next_send_ < seats_.size(); ++next_send_) {
    const std::size_t i = next_send_;
    if (const auto challenge = seats_[i].transmit_challenge(now, tick_, buffer)) return challenge;
    if (!std::exchange(send_due_[i], false)) continue;
    const Transmit out = sends_close(i)
                             ? seats_[i].transmit_close(now, tick_, all ? close_reason_ : close_outs_[i].why, buffer)
                             : seats_[i].transmit(now, tick_, buffer);
    if (out.size > 0) return out;
  }
  const auto out =
      link_test_peers_.poll_transmit(now, tick_, all ? std::optional{close_reason_} : std::nullopt, buffer);
  if (!out) next_send_ = 0;
  return out;
}

std::vector<std::size_t> Session::missing(Time now) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < seats_.size(); ++i)
    if (is_required(i) && !seats_[i].ready(now)) out.push_back(i);
  return out;
}

}  // namespace tandem::server
