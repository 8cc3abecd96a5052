#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>

#include "hal/core/device.h"
#include "hal/sim/recorded_motion.h"
#include "hal/sim/trajectory.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal::sim {

/// Force law of a hand that holds the tip: F = k (x - tip) + b (v - d tip/dt) + force. The mass m moves with the tip.
/// `x` and `v` are given for the middle of the period; within the period x advances with v.
struct HandPull {
  double k = 0, b = 0, m = 0;  ///< [N/m, N s/m, kg]
  Vec3 x = Vec3::Zero();       ///< intended tip position [m], HAL frame
  Vec3 v = Vec3::Zero();       ///< intended velocity [m/s]
  Vec3 force = Vec3::Zero();   ///< additional force [N]
};

/// Target tip position of the keyboard. The input thread writes it, the device thread reads it.
/// The axes are independent atomics. A torn read mixes two consecutive targets, which is harmless because the hand's
/// speed is limited.
class KeyboardTarget {
 public:
  explicit KeyboardTarget(const Vec3& start) noexcept;
  void set(const Vec3& position) noexcept;  ///< tip position [m], HAL frame; non-finite is ignored
  [[nodiscard]] Vec3 get() const noexcept;

 private:
  std::array<std::atomic<double>, 3> p_;
};

/// Returns stiffness, damping and mass of a model. A zero in HandSpec selects the model's value.
[[nodiscard]] HandPull impedance_of(HandModel model) noexcept;

/// Simulated hand of an operator: an impedance about an intended motion, driven by session time.
/// - Not engaged (no session time): holds the pose with k 300 N/m and b 10 N s/m, so that nothing drifts.
/// - Engaged: fades within 0.5 s into its model, without a jump of the intended position or of the stiffness.
/// - `HandSpec::from`: RELAXED before. Then the hand fades within 0.5 s into its own model and moves there with minimum
///   jerk.
/// - `HandSpec::until`: the hand fades back to RELAXED within 0.5 s.
/// Models driven by a user or a recording (`moved_by_person`) ignore `from` and `until`. Deterministic, no heap after
/// construction, total.
class Hand {
 public:
  /// @param start   tip position at the start [m], HAL frame
  /// @param motion  recording for HandModel::kRecorded, ignored otherwise; without it such a hand holds the start
  Hand(const HandSpec& spec, const Vec3& start, std::shared_ptr<const RecordedMotion> motion = nullptr);

  /// Sets the time since all required seats engaged [s]; empty: not engaged. Thread-safe.
  /// Between calls the hand's own time runs on. A difference of more than 50 ms is a jump. A smaller one is closed
  /// gradually, so that a jittery source causes no force steps.
  void set_session_time(std::optional<double> t) noexcept TANDEM_REALTIME;

  /// Returns the force law for the coming `dt` [s] and advances the hand's time by `dt`.
  /// @param tip  present tip position [m]
  [[nodiscard]] HandPull advance(const Vec3& tip, double dt) noexcept TANDEM_REALTIME;

  [[nodiscard]] HandModel model() const noexcept { return spec_.model; }
  /// Returns the target that HandModel::kKeyboard reads its intended position from.
  [[nodiscard]] const std::shared_ptr<KeyboardTarget>& keyboard() const noexcept { return keyboard_; }
  /// Returns the session time at the end of the last period [s]; empty: not engaged.
  [[nodiscard]] std::optional<double> time() const noexcept { return time_; }

 private:
  void follow_session(const Vec3& tip, double dt) noexcept;
  void engage(double t, const Vec3& tip) noexcept;
  [[nodiscard]] MotionPoint intended(double t) noexcept;
  void move_keyboard(double dt) noexcept;
  [[nodiscard]] Vec3 deviation(double t) const noexcept;

  HandSpec spec_;
  HandPull impedance_;  ///< of the hand's own model
  std::shared_ptr<const RecordedMotion> motion_;
  RecordedMotion::Cursor cursor_;
  std::shared_ptr<KeyboardTarget> keyboard_;
  std::atomic<double> session_;  ///< NaN: not engaged
  double session_seen_ = 0;      ///< last value used

  std::optional<double> time_;
  Vec3 hold_;  ///< held while not engaged
  double engaged_at_ = 0;
  Vec3 tip_engaged_;  ///< tip when engaged
  /// hold - intended at engagement, fades out; used if the intended motion starts at rest.
  Vec3 approach_ = Vec3::Zero();
  bool approach_by_offset_ = true;
  bool own_ = false;             ///< `from` has passed
  bool from_blend_ = false;      ///< `from` passed while engaged: the hand blends from its position at that time
  Vec3 tip_own_ = Vec3::Zero();  ///< tip position when `from` passed
  MotionPoint key_;              ///< rate-limited keyboard motion
};

}  // namespace tandem::hal::sim
