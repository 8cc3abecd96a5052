#pragma once

#include <span>

#include "proto/spec/scene_spec.h"
#include "proto/wire/wire_messages.h"
#include "server/policy/load_shedder.h"
#include "server/session/audit_trail.h"
#include "server/session/participants.h"
#include "server/session/session_clock.h"
#include "server/session/start_condition.h"
#include "server/session/stop_control.h"
#include "server/session/tool.h"

namespace tandem::server {

/// The state of a session from its begin to its end: WAITING, RUNNING, HELD, PAUSED, STOPPED, OVERLOADED or ENDING. It
/// begins the session, counts its time and ends it at the scene's duration.
class SessionLifecycle {
 public:
  /// All arguments must outlive this.
  SessionLifecycle(const SceneSpec& scene, SessionClock& clock, Participants& participants, StartCondition& start,
                   StopControl& stop, AuditTrail& audit) noexcept
      : scene_(&scene), clock_(&clock), participants_(&participants), start_(&start), stop_(&stop), audit_(&audit) {}

  /// Sets the load-shedding level, effective from the next tick. If `overloaded`, all hands are disengaged.
  void set_load_state(const LoadState& load) noexcept { load_state_ = load; }
  [[nodiscard]] const LoadState& load_state() const noexcept { return load_state_; }

  /// Sets whether this server may act on hands, effective from the next tick. If not, all hands are disengaged: another
  /// server may own the session by now.
  void set_may_act(bool may_act) noexcept { may_act_ = may_act; }
  [[nodiscard]] bool may_act() const noexcept { return may_act_; }

  /// Emits an audit event if an overload began or ended, or the permission to act. To be called once per tick.
  void report_changes(Time now) noexcept TANDEM_REALTIME;
  /// Begins the session, counts its time, or advances its end. In ENDING the clock is stopped, so that a restart
  /// resumes at the time when the end began.
  void step(Time now, std::span<const Tool> tools) noexcept TANDEM_REALTIME;

  [[nodiscard]] wire::SessionState state() const noexcept;
  [[nodiscard]] bool ending() const noexcept { return participants_->closing().session.begun(); }
  /// Clock and timeline are stopped: the session is ENDING, or it is STOPPED or PAUSED and `clock_runs_while_stopped`
  /// is false in its scene.
  [[nodiscard]] bool clock_stopped() const noexcept {
    return clock_->begun() && (ending() || (stop_->latch().latched() && !scene_->clock_runs_while_stopped));
  }
  /// No seat may be engaged now: the session is ending, stopped, paused or overloaded, or this server may not act.
  [[nodiscard]] bool disengages_all() const noexcept {
    return ending() || stop_->latch().latched() || load_state_.overloaded || !may_act_;
  }

 private:
  const SceneSpec* scene_;
  SessionClock* clock_;
  Participants* participants_;
  StartCondition* start_;
  StopControl* stop_;
  AuditTrail* audit_;
  LoadState load_state_;
  bool may_act_ = true;
  bool overloaded_ = false, acts_ = true;  ///< as of the last audit event
  bool held_ = false;  ///< no tool has a present seat with authority over it; false before the session begins
};

}  // namespace tandem::server
