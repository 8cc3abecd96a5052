#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "hal/adaptive_rate.h"
#include "hal/clock.h"
#include "hal/driver.h"
#include "hal/pipes.h"
#include "hal/reply_pace.h"
#include "hal/woodenhaptics/board_report.h"
#include "hal/woodenhaptics/counter.h"
#include "hal/woodenhaptics/kinematics.h"
#include "hal/woodenhaptics/motors.h"

namespace tandem::hal::woodenhaptics {

struct WoodenHapticsOptions {
  WoodenHapticsSpec spec;
  /// The boards' USB id is anybody's, and a wrong preset pushes the wrong way: without this word no current flows at all.
  bool energise = false;
  /// A person says that the arm rests in its calibration pose when the device is opened. Believed once.
  bool home_at_start = false;
};

/// WoodenHaptics, AluHaptics and Polhem v1 behind a Haptikfabriken HID board: three motors, counters without a reference.
///
/// Homing: every start is unhomed, and unhomed means no current. The person puts the arm into the calibration pose and
/// presses the board's calibration button, or says so to the host (`home_here`, `home_at_start`); the board's counters are
/// preset then (a v1 board cannot, its counts get an offset here). A press from before the start or from while the arm
/// was homed does not count: its latch is only released. A counter that moves faster than the mechanism can has lost its reference: unhomed again, at once.
/// `Orders::homing` keeps the motors still and triggers nothing: the host cannot know where the arm is.
///
/// Readings: v2 and raw64 answer each order with one report, sampled when the order arrived. So what acted between two
/// readings is the order before: `State::tau_out` and `State::echo_command` are of that one. Late answers are drained.
/// Joints: A, B, C [rad] of kinematics.h. Raw: six encoders, unwrapped. Buttons: bit 0 stylus, bit 1 calibration.
class WoodenHapticsDriver final : public Driver {
 public:
  /// @param pipe, clock  outlive the driver
  WoodenHapticsDriver(DeviceId id, HidPipe& pipe, Clock& clock, const WoodenHapticsOptions& options);

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const Orders& orders, State& state) noexcept TANDEM_REALTIME override;
  void silence() noexcept override;

  /// The arm is in its calibration pose now. From any thread; acts at the next exchange if that one asks for no effort,
  /// is forgotten otherwise.
  void home_here() noexcept { home_asked_.store(true); }
  [[nodiscard]] bool homed() const noexcept { return homed_; }

 private:
  struct Taken {
    std::optional<BoardReport> newest;
    bool torn = false;  ///< reports of a wrong length came too
  };
  std::expected<void, Errc> take_reports(Duration timeout, Taken& taken) noexcept;
  std::expected<void, Errc> send(const BoardOrder& order) noexcept;
  [[nodiscard]] BoardOrder preset_order() const noexcept;
  void book(const Vec3& effort, Time until) noexcept;
  [[nodiscard]] MotorOrder motors_for(const Orders& orders, Time now) noexcept;
  [[nodiscard]] double holding_share(bool asked, Time now) noexcept;
  /// @return whether positions may have jumped
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

  std::array<Counter, kEncoders> counters_{};
  std::array<AdaptiveRate, 3> rates_;
  Vec3 q_ = Vec3::Zero();
  bool homed_ = false;
  int presets_left_ = 0;  ///< frames that still may be sent until the board shows the preset counts
  bool homed_by_preset_ = false;  ///< else they only release the button's latch
  bool latched_ = false;          ///< calibration button, as the board last said
  bool button_armed_ = false;     ///< it was seen released since the arm became unhomed: a press is meant
  std::atomic<bool> home_asked_{false};

  std::uint64_t readings_ = 0;
  std::size_t odd_length_ = 0;  ///< of the last report with a wrong length
  Time read_at_{}, sent_at_{};
  double holding_ = 0;  ///< share of gravity that the motors carry now, 0..1
  Time asked_at_{};     ///< last order with an effort
  bool ever_asked_ = false;
  Vec3 acting_ = Vec3::Zero();      ///< joint effort of the order the board has
  Vec3 acted_sum_ = Vec3::Zero();   ///< effort times time [N m s] since the last reading
  double acted_for_ = 0;            ///< that time [s]
  Time booked_until_{};
  ReplyPace pace_;
  std::uint64_t acting_seq_ = 0;
  bool saturated_ = false;
};

}  // namespace tandem::hal::woodenhaptics
