#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "hal/core/adaptive_velocity_estimator.h"
#include "hal/core/clock.h"
#include "hal/core/driver.h"
#include "hal/core/pipes.h"
#include "hal/core/reply_deadline.h"
#include "hal/drivers/woodenhaptics/board_report.h"
#include "hal/drivers/woodenhaptics/gravity_fade.h"
#include "hal/drivers/woodenhaptics/kinematics.h"
#include "hal/drivers/woodenhaptics/mean_effort.h"
#include "hal/drivers/woodenhaptics/motors.h"
#include "hal/drivers/woodenhaptics/unwrapped_counter.h"

namespace tandem::hal::woodenhaptics {

struct WoodenHapticsOptions {
  WoodenHapticsSpec spec;
  /// Enables motor currents. The boards' USB id is shared by other devices, and a wrong preset reverses forces. The
  /// default is therefore no current.
  bool enable_motors = false;
  /// The user states that the arm rests in its calibration pose when the device is opened. Used for one bring-up only.
  bool home_at_start = false;
};

/// Driver of WoodenHaptics, AluHaptics and Polhem v1 with a Haptikfabriken HID board: three motors, counters without a
/// reference.
///
/// Homing: every start is unhomed, and no current flows while unhomed.
/// The user puts the arm into the calibration pose and presses the board's calibration button, or confirms the pose to
/// the host (`home_here`, `home_at_start`).
/// The driver then presets the board's counters; a v1 board has no preset, so its counts get an offset in the driver.
/// A press from before the start or while homed does not count: only its latch is cleared.
/// A counter that moves faster than the mechanism can has lost its reference: the driver is unhomed again at once.
/// `ServoCommand::homing` keeps the motors off and triggers nothing: the host cannot know the arm's pose.
///
/// Readings: v2 and raw64 answer each command with one report, sampled on arrival of the command.
/// Between two readings the previous command acted: `State::tau_out` and `State::echo_command` belong to that one. Late
/// replies are drained.
/// Joints: A, B, C [rad] of kinematics.h. Raw: six encoders, unwrapped. Buttons: bit 0 stylus, bit 1 calibration.
class WoodenHapticsDriver final : public Driver {
 public:
  /// @param pipe, clock  must outlive the driver
  WoodenHapticsDriver(DeviceId id, HidPipe& pipe, Clock& clock, const WoodenHapticsOptions& options);

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const ServoCommand& command, State& state) noexcept TANDEM_REALTIME override;
  void send_zeros() noexcept override;

  /// Confirms that the arm is in its calibration pose now. From any thread.
  /// Acts at the next exchange if that one commands no effort, otherwise it is discarded.
  void home_here() noexcept { home_requested_.store(true); }
  [[nodiscard]] bool homed() const noexcept { return homed_; }

 private:
  struct Taken {
    std::optional<BoardReport> newest;
    bool torn = false;  ///< reports of a wrong length arrived too
  };
  std::expected<void, Errc> take_reports(Duration timeout, Taken& taken) noexcept;
  std::expected<void, Errc> send(const BoardCommand& command) noexcept;
  [[nodiscard]] BoardCommand preset_command() const noexcept;
  [[nodiscard]] MotorCommand motors_for(const ServoCommand& command, Time now) noexcept;
  /// Tracks the counters with a new report. @return whether positions may have jumped
  bool follow(const BoardReport& report, Time at) noexcept;
  void preset_counters(bool then_homed) noexcept;
  void continue_homing(const BoardReport& report) noexcept;
  void settle_at(const BoardReport& report, bool home) noexcept;
  void note_button(const BoardReport& report) noexcept;
  void fill(const BoardReport& report, Time at, bool jumped, State& state) noexcept;
  DeviceError silent_board(bool torn, std::size_t length) const;

  DeviceId id_;
  DeviceCaps caps_;
  HidPipe& pipe_;
  Clock& clock_;
  WoodenHapticsOptions options_;
  Kinematics kinematics_;
  Motors motors_;
  Duration reply_timeout_;

  std::array<UnwrappedCounter, kEncoders> counters_{};
  std::array<AdaptiveVelocityEstimator, 3> rates_;
  Vec3 q_ = Vec3::Zero();
  bool homed_ = false;
  int presets_left_ = 0;          ///< preset frames that may still be sent until the board shows the preset counts
  bool homed_by_preset_ = false;  ///< false: they only clear the button's latch
  bool latched_ = false;          ///< calibration button, as in the board's last report
  bool button_armed_ = false;     ///< the button was released since the arm became unhomed: the next press is intended
  std::atomic<bool> home_requested_{false};

  std::uint64_t readings_ = 0;
  std::size_t odd_length_ = 0;  ///< length of the last report with a wrong length [bytes]
  Time read_at_{}, sent_at_{};
  GravityFade gravity_;
  Vec3 acting_ = Vec3::Zero();  ///< joint effort of the command the board has
  MeanEffort acted_;            ///< since the last reading
  ReplyDeadline pace_;
  std::uint64_t acting_seq_ = 0;
  bool saturated_ = false;
};

}  // namespace tandem::hal::woodenhaptics
