#include "server/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/connection_id.h"
#include "server/session_record.h"

namespace tandem::server {

namespace {
constexpr std::uint32_t kCatchUpMax = 50;      // ticks lived through after a stall; more are given up
constexpr double kFarewell = 0.15;             // [s] gates ramp out before CLOSE
constexpr Duration kSilentOwner = std::chrono::seconds(2);  // then his seat is free
constexpr double kWatcherHz = 60;              // who feels nothing is told no more often
constexpr double kIntervalsOfSilence = 6;      // isolated losses trip no gate: at 5 % random loss five in a row come every day or two
constexpr std::uint32_t kCloseRepeats = 20;    // CLOSE goes out this many ticks long: one may be lost
constexpr std::uint32_t kGhostForRecords = 16; // ticks between two looks for who leads where nobody is told
}  // namespace

Session::Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale)
    : scene_(&scene),
      dt_(1.0 / scene.tick_hz),
      tick_length_(from_seconds(dt_)),
      scale_(scale),
      masters_(scene.masters()),
      replica_(scene.channel.law == LawKind::kReplica),
      watcher_every_(static_cast<std::uint32_t>(std::ceil(scene.tick_hz / kWatcherHz))),
      feeler_every_max_(static_cast<std::uint32_t>(std::max(1.0, scene.gate.silence_limit * scene.tick_hz / kIntervalsOfSilence))),
      reception_(scene, scale),
      visitors_(scene.dof, scene.port, tick_length_),
      stop_lane_(scene.led()) {
  for (std::size_t a = 0; a < kAxesMax; ++a) root_scale_[a] = std::sqrt(scale_[a]);
  turns_.fill(~0u);
  leading_.fill(LeadingHand(dt_));
  seats_.reserve(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i) seats_.emplace_back(scene, i, scale);
  tools_.reserve(scene.tools.size());
  for (std::size_t j = 0; j < scene.tools.size(); ++j) tools_.emplace_back(scene, j, std::move(slaves[j]));
  for (const AuthorityRow& row : scene.authority) begin_authority(row.tool, weights_of(row));
  authority_version_ += static_cast<std::uint32_t>(scene.authority.size());
  scene_hash_ = scene_hash(scene);
}

Session::Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale,
                 const Checkpoint& from)
    : Session(scene, std::move(slaves), scale) {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    begin_authority(j, from.tools[j].alpha);
    // A tool with a slave of its own rests where that stands: the spring between them remembers no force.
    if (tools_[j].slave() == nullptr) tools_[j].rest_at(from.tools[j].x);
  }
  epoch_ = from.epoch + 1;
  session_tick_ = from.session_tick;
  authority_version_ = from.authority_version + 1;
  stop_before_ = from.stop;
  gathering_ = from.begun;
  for (std::size_t i = 0; i < seats_.size(); ++i) seats_[i].remember(from.seats[i].resume, from.seats[i].force_scale);
  if (!gathering_) {
    stop_lane_.restore(from.stop, from.stops);
    return;
  }
  stop_lane_.restore(StopLane::Level::kNone, from.stops + 1);  // a number an instructor can name to go on without somebody
  // What was announced when the checkpoint was made is decided, and in it.
  while (next_event_ < scene.timeline.size() && scene.timeline[next_event_].at <= time() + (Handover::kNotice + 0.5) * dt_) ++next_event_;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    bool has_weight = false;
    for (std::size_t j = 0; j < tools_.size(); ++j) {
      const auto& alpha = from.tools[j].alpha;
      has_weight = has_weight || (i < masters_ ? alpha[i] > 0 : scene.seats[i].tool == j);  // a slave seat carries its tool
    }
    awaited_[i] = from.seats[i].taken && (has_weight || seats_[i].role() == AccessRole::kInstructor);
  }
  note(Time{}, AuditEvent::What::kRestored, AuditEvent::kNoSeat, static_cast<std::uint32_t>(epoch_));
}

bool Session::set_contact_source(std::size_t tool, std::unique_ptr<ContactSource> source) {
  if (!replica_ || tool >= tools_.size() || tools_[tool].body() == nullptr) return false;
  tools_[tool].set_contact_source(std::move(source));
  return true;
}

Checkpoint Session::checkpoint() const noexcept {
  Checkpoint c;
  c.scene = scene_hash_;
  c.epoch = epoch_;
  c.session_tick = session_tick_;
  c.authority_version = authority_version_;
  c.stops = stop_lane_.stops();
  c.stop = gathering_ ? std::max(stop_before_, stop_lane_.level()) : stop_lane_.level();
  c.begun = begun();
  c.seats_n = static_cast<std::uint8_t>(seats_.size());
  c.masters_n = static_cast<std::uint8_t>(masters_);
  c.tools_n = static_cast<std::uint8_t>(tools_.size());
  c.dof = static_cast<std::uint8_t>(scene_->dof);
  for (std::size_t i = 0; i < seats_.size(); ++i) c.seats[i] = {seats_[i].taken() || awaited_[i], seats_[i].resume(), seats_[i].force_scale()};
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    c.tools[j].alpha = tools_[j].handover.decided();
    c.tools[j].x = tools_[j].position();
    if (const hal::SteppedDevice* slave = tools_[j].slave())
      c.tools[j].slave = slave->state().q;
  }
  return c;
}

void Session::on_datagram(Time now, const Endpoint& from, std::span<const std::byte> bytes) noexcept {
  const auto header = link::read_header(bytes);
  if (!header) {
    ++stray_;
    return;
  }
  const std::size_t i = static_cast<std::size_t>(place_of(header->cid)) - 1;
  if (i >= seats_.size() || !seats_[i].taken() || seats_[i].link()->own_cid() != header->cid) {
    if (!visitors_.on_datagram(now, from, header->cid, bytes, path_tokens_)) ++stray_;
    return;
  }
  hear(now, i, seats_[i].on_datagram(now, from, bytes, path_tokens_));
}

JoinResult Session::may_admit(Time now, std::size_t i, bool same_owner) const noexcept {
  if (over_ || state_ == wire::SessionState::kEnding) return JoinResult::kSessionOver;
  if (i >= seats_.size()) return JoinResult::kNoSuchSeat;
  if (seats_[i].taken() && !same_owner && seats_[i].silence(now) <= kSilentOwner) return JoinResult::kSeatTaken;
  return JoinResult::kAccepted;
}

JoinResult Session::admit(Time now, std::size_t i, Entry& entry, bool same_owner) noexcept {
  const JoinResult may = may_admit(now, i, same_owner);
  if (may != JoinResult::kAccepted) return may;
  seats_[i].take(now, entry);
  farewells_[i] = {};
  stop_lane_.forget(i);
  watch_[i] = {};
  note(now, AuditEvent::What::kJoin, i);
  return may;
}

JoinResult Session::admit_visitor(Time now, std::unique_ptr<link::Link>& link, std::size_t* place) noexcept {
  if (over_ || state_ == wire::SessionState::kEnding) return JoinResult::kSessionOver;
  const auto taken = visitors_.admit(now, link);
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
  slipped_ += missed - live;
  for (std::uint32_t i = 0; i <= live && !over_; ++i) live_one_tick(now);
  say_farewell(now);
  fill_force_messages(now);
  next_to_tell_ = 0;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (auto* l = seats_[i].link()) l->tick(now);
    const bool due = due_to_be_told(i) && seats_[i].reachable();
    send_due_[i] = due && (closing(i) ? !seats_[i].forgotten(now) : seats_[i].may_be_told(now));
  }
  visitors_.on_tick(now);
}

std::uint32_t Session::told_every(std::size_t i) const noexcept {
  const SeatPort& seat = seats_[i];
  const auto spared = [&](Rung rung) { return relief_.rung >= rung; };
  if (!seat.feels()) return watcher_every_ * (spared(Rung::kObserversMore) ? 6 : spared(Rung::kObservers) ? 3 : 1);
  if (seat.role() != AccessRole::kEvaluator || i >= masters_ || scene_->seats[i].required) return 1;
  return std::min(feeler_every_max_, spared(Rung::kEvaluatorsMore) ? 3u : spared(Rung::kEvaluators) ? 2u : 1u);
}

/// Once in each interval, also when ticks were missed. Who only feels is due in another tick than his neighbours: at one time all of them would
/// make one tick as long as ever.
bool Session::due_to_be_told(std::size_t i) noexcept {
  const std::uint32_t turn = (tick_ + (seats_[i].feels() ? static_cast<std::uint32_t>(i) : 0)) / told_every(i);
  return turn != std::exchange(turns_[i], turn);
}

void Session::live_one_tick(Time now) noexcept {
  for (auto& tool : tools_) tool.advance_slave(elapsed_any_ ? tick_length_ : Duration{0});
  elapsed_any_ = true;
  change_state(now);
  if (over_) return;
  move_handovers_on();
  follow_timeline(now);
  hand_over(now);
  share_authority();
  tie_seats();
  move_references(now);
  step_tools();
  if (replica_ || tick_ % kGhostForRecords == 0) see_leaders();
  step_following();
  take_record(*this, record_);
}

void Session::change_state(Time now) noexcept {
  for (std::size_t i = 0; i < seats_.size(); ++i) present_[i] = seats_[i].feels() && seats_[i].present(now) && !leaving(i);
  look_after_people(now);
  if (state_ == wire::SessionState::kEnding) {  // the session clock stands: a restart goes on where people were when the end began
    if (farewell_ > 0) {
      --farewell_;
    } else {
      over_ = true;
    }
    return;
  }
  if (!begun_) {
    wait_for_people(now);
  } else {
    if (clock_stands()) {
      ++stood_;
    } else {
      ++session_tick_;
    }
    held_ = std::ranges::all_of(tools_, [](const Tool& t) { return t.authority.held(); });
  }
  settle_state();
  if (begun_ && time() >= scene_->duration) stop(wire::CloseReason::kDone);
}

/// After a tick, and after an order: who asks next sees what became of it.
void Session::settle_state() noexcept {
  if (state_ == wire::SessionState::kEnding) return;
  state_ = !begun_ ? wire::SessionState::kWaiting : relief_.passive ? wire::SessionState::kPassive : held_ ? wire::SessionState::kHeld : wire::SessionState::kRunning;
  if (stop_lane_.level() == StopLane::Level::kPaused) state_ = wire::SessionState::kPaused;
  if (stop_lane_.level() == StopLane::Level::kStopped) state_ = wire::SessionState::kStopped;
}

void Session::stop(wire::CloseReason why) noexcept {
  if (state_ == wire::SessionState::kEnding) return;
  state_ = wire::SessionState::kEnding;
  close_reason_ = why;
  farewell_ = static_cast<std::uint32_t>(std::lround(kFarewell / dt_)) + kCloseRepeats;
}

bool Session::dismiss(std::size_t i, wire::CloseReason why) noexcept {
  if (i >= seats_.size() || !seats_[i].taken() || leaving(i)) return false;
  farewells_[i] = {static_cast<std::uint32_t>(std::lround(kFarewell / dt_)) + kCloseRepeats + 1, why};
  return true;
}

/// After the last repeat of its CLOSE the seat is free, and nobody comes back to it by the old secret.
void Session::say_farewell(Time now) noexcept {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (!leaving(i) || --farewells_[i].ticks > 0) continue;
    if (!seats_[i].taken()) continue;  // left by himself
    seats_[i].release();
    seats_[i].remember({}, 1);
    note(now, AuditEvent::What::kRemoved, i);
  }
}

/// Whether the slave of a tool presses against something, as far as its device tells.
bool Session::touching(Time now, std::size_t j) const noexcept {
  constexpr double kTouchN = 0.05;  // below it a sensor's noise
  if (const hal::SteppedDevice* const slave = tools_[j].slave()) return slave->state().penetration > 0 || slave->state().f_env.squaredNorm() > kTouchN * kTouchN;
  if (const control::VirtualTool* const body = tools_[j].body(); body != nullptr && !scene_->tools[j].remote) return body->penetration() > 0;
  if (!scene_->tools[j].remote || !seats_[scene_->tools[j].seat].alive(now)) return false;
  const wire::Telemetry& heard = seats_[scene_->tools[j].seat].heard().telemetry;
  return heard.penetration_m > 0 || std::ranges::any_of(heard.f_env, [](double f) { return std::abs(f) > kTouchN; });
}

void Session::fill_force_messages(Time now) noexcept {
  std::array<bool, kSeatsMax> ready{};
  std::uint32_t missing_now = 0;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    ready[i] = seats_[i].ready(now);
    missing_now += needed(i) && !ready[i] ? 1 : 0;
  }
  std::array<bool, kToolsMax> entitled{}, touches{};
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const bool slave_ready = !scene_->tools[j].remote || ready[scene_->tools[j].seat];
    for (std::size_t i = 0; i < masters_; ++i) entitled[j] |= slave_ready && tools_[j].authority.requested()[i] > 0 && ready[i];
    touches[j] = touching(now, j);
  }
  const bool engage = engage_ && state_ != wire::SessionState::kEnding && !lets_go();

  for (std::size_t i = 0; i < seats_.size(); ++i) {
    wire::ForceMessage& m = seats_[i].tx;
    m.session = state_;
    m.engage = engage && seats_[i].feels() && !seats_[i].conduct().isolated(now) && !leaving(i);
    m.touching = false;
    for (std::size_t j = 0; j < tools_.size(); ++j) {
      const Tie& tie = ties_[i][j];
      m.engage = m.engage && (tie.share == 0 || entitled[j]);
      m.touching = m.touching || (tie.share > 0 && touches[j]);
    }
    m.session_tick = session_tick_;
    m.authority_version = authority_version_;
    m.missing = missing_now;
    m.stops = stop_lane_.stops();
    if (told_of_others(i)) {
      tell_ties(i);
    } else {
      tell_tools(i);
    }
    tell_handover(i, m);
  }
}

bool Session::closing() const noexcept { return over_ || (state_ == wire::SessionState::kEnding && farewell_ < kCloseRepeats); }
bool Session::closing(std::size_t i) const noexcept { return closing() || (leaving(i) && farewells_[i].ticks <= kCloseRepeats); }

std::optional<Transmit> Session::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  const bool all = closing();
  for (; next_to_tell_ < seats_.size(); ++next_to_tell_) {
    const std::size_t i = next_to_tell_;
    if (const auto challenge = seats_[i].transmit_challenge(now, tick_, buffer)) return challenge;
    if (!std::exchange(send_due_[i], false)) continue;
    const Transmit out = closing(i) ? seats_[i].transmit_close(now, tick_, all ? close_reason_ : farewells_[i].why, buffer)
                                    : seats_[i].transmit(now, tick_, buffer);
    if (out.size > 0) return out;
  }
  const auto out = visitors_.poll_transmit(now, tick_, all ? std::optional{close_reason_} : std::nullopt, buffer);
  if (!out) next_to_tell_ = 0;
  return out;
}

std::vector<std::size_t> Session::missing(Time now) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < seats_.size(); ++i)
    if (needed(i) && !seats_[i].ready(now)) out.push_back(i);
  return out;
}

}  // namespace tandem::server
