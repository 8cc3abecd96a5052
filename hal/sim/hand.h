#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>

#include "hal/device.h"
#include "hal/sim/recorded_motion.h"
#include "hal/sim/trajectory.h"
#include "proto/scene_spec.h"

namespace tandem::hal::sim {

/// What a hand does to the tip it holds: F = k (x - tip) + b (v - d tip/dt) + force, and its mass moves with the tip.
/// `x` and `v` are meant for the middle of the period; within the period x moves on with v.
struct HandPull {
  double k = 0, b = 0, m = 0;  ///< [N/m, N s/m, kg]
  Vec3 x = Vec3::Zero();       ///< intended tip position [m], HAL frame
  Vec3 v = Vec3::Zero();       ///< intended velocity [m/s]
  Vec3 force = Vec3::Zero();   ///< on top of it [N]
};

/// Where the keys want the tip to be. Written by a person's thread, read by the device's; axes are independent atomics,
/// a torn read mixes two neighbouring wishes and the hand is limited in speed anyway.
class KeyboardTarget {
 public:
  explicit KeyboardTarget(const Vec3& start) noexcept;
  void set(const Vec3& position) noexcept;  ///< tip position [m], HAL frame; non-finite is ignored
  [[nodiscard]] Vec3 get() const noexcept;

 private:
  std::array<std::atomic<double>, 3> p_;
};

/// Stiffness, damping and mass of a model; zeros in HandSpec mean these.
[[nodiscard]] HandPull impedance_of(HandModel model) noexcept;

/// A simulated person's hand: an impedance about an intended motion (design notes, control 8), following session time.
/// - Not engaged (no session time): holds the pose, k 300 N/m, b 10 N s/m, so that nothing drifts.
/// - Engaged: fades within 0.5 s into its model, without a jump of the intended position or of the stiffness.
/// - `HandSpec::from`: RELAXED before, then fades within 0.5 s into its own model, moving there with minimum jerk;
/// `until`: fades back to RELAXED within 0.5 s. Hands that a person moves (`moved_by_person`) ignore both. Deterministic, no heap after construction, total.
class Hand {
 public:
  /// @param start   tip position at the start [m], HAL frame
  /// @param motion  needed by HandModel::kRecorded, ignored otherwise; without it such a hand holds the start
  Hand(const HandSpec& spec, const Vec3& start, std::shared_ptr<const RecordedMotion> motion = nullptr);

  /// Time since all required seats engaged [s], or none while not engaged. Thread-safe. The hand runs on by itself
  /// between calls; a difference of more than 50 ms is a jump, a smaller one is closed gently so that a jittery source
  /// causes no kicks.
  void set_session_time(std::optional<double> t) noexcept TANDEM_REALTIME;

  /// The pull during the coming `dt` [s], and moves the hand's own time on.
  /// @param tip  tip position now [m]
  [[nodiscard]] HandPull advance(const Vec3& tip, double dt) noexcept TANDEM_REALTIME;

  [[nodiscard]] HandModel model() const noexcept { return spec_.model; }
  /// The intended position is read from here by HandModel::kKeyboard.
  [[nodiscard]] const std::shared_ptr<KeyboardTarget>& keyboard() const noexcept { return keyboard_; }
  /// Session time at the end of the last period, if engaged [s].
  [[nodiscard]] std::optional<double> time() const noexcept { return time_; }

 private:
  void follow_session(const Vec3& tip, double dt) noexcept;
  void engage(double t, const Vec3& tip) noexcept;
  [[nodiscard]] MotionPoint intended(double t) noexcept;
  void move_keyboard(double dt) noexcept;
  [[nodiscard]] Vec3 deviation(double t) const noexcept;

  HandSpec spec_;
  HandPull impedance_;  ///< of the own model
  std::shared_ptr<const RecordedMotion> motion_;
  RecordedMotion::Cursor cursor_;
  std::shared_ptr<KeyboardTarget> keyboard_;
  std::atomic<double> session_;  ///< NaN: not engaged
  double session_seen_ = 0;      ///< last value acted on

  std::optional<double> time_;
  Vec3 hold_;  ///< held while not engaged
  double engaged_at_ = 0;
  Vec3 tip_engaged_;  ///< tip when engaged
  Vec3 approach_ =
      Vec3::Zero();  ///< hold - intended at engagement, fades out; used when the intended motion starts at rest
  bool approach_by_offset_ = true;
  bool own_ = false;             ///< `from` has passed
  bool from_blend_ = false;      ///< it passed while engaged: the hand moves over from where it was
  Vec3 tip_own_ = Vec3::Zero();  ///< tip when it passed
  MotionPoint key_;              ///< rate-limited keyboard motion
};

}  // namespace tandem::hal::sim
