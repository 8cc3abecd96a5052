#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hal/drivers/woodenhaptics/kinematics.h"
#include "hal/sim/hand.h"
#include "proto/spec/woodenhaptics_spec.h"
#include "tests/hal/emulation/devices/emulated_device.h"
#include "tests/hal/emulation/devices/report_queue.h"

namespace tandem::hal::emulation {

struct WoodenHapticsModelParams {
  WoodenHapticsSpec spec;                                  ///< the true mechanism
  Vec3 start = Vec3::Zero();                               ///< tip at power-up [m], HAL frame; in reach
  double mass = 0.25;                                      ///< at the tip [kg]
  double damping = 0.5;                                    ///< [N s/m]
  bool weight = false;                                     ///< the arms have weight
  Duration answer_after = std::chrono::microseconds{200};  ///< v2, raw64: from a host's report to the board's next one
  Duration period = std::chrono::milliseconds{1};          ///< v1: period of unprompted reports
  std::string_view serial = "0001";
};

/// Faults. Counts decrease by one per affected report.
struct WoodenHapticsFaults {
  int lost_reports = 0;  ///< the next reports are lost
  int odd_reports = 0;   ///< the next reports have `odd_length` bytes
  std::size_t odd_length = 5;
  Duration late{0};     ///< added to answer_after
  bool silent = false;  ///< no reports at all
  bool frozen_encoders = false;
  bool stalled_out = false;  ///< the host's reports are answered with STALL
};

/// Model of a Haptikfabriken HID board with motors, encoders and an arm: firmware, watchdog, physics.
/// The tip is a mass held by a hand (sim::Hand) or free, or `place` moves it along a path.
/// v2 and raw64: one report, then one per host report. v1: a report every period.
/// Amplifiers are off from power-up to the first report of the host.
/// v1 and v2 (mbed firmware) switch them off after 0.5 s without a report. No watchdog of raw64 boards is published, so
/// their model has none.
class WoodenHapticsModel final : public EmulatedHidDevice {
 public:
  static constexpr Duration kWatchdog = std::chrono::milliseconds{500};
  /// A report of the host and its arrival time.
  struct HostReport {
    Time at{};
    std::array<std::int16_t, 3> current_ma{};
    bool preset = false;
  };
  static constexpr std::size_t kRemembered = 256;

  explicit WoodenHapticsModel(const WoodenHapticsModelParams& params);
  /// Creates a model with a hand at the tip.
  WoodenHapticsModel(const WoodenHapticsModelParams& params, const HandSpec& hand,
                     std::shared_ptr<const sim::RecordedMotion> motion = nullptr);

  void advance(Duration dt) noexcept override;
  void unplug() noexcept override;
  /// The board is powered by the bus: counters begin at zero at the arm's present pose, amplifiers are off.
  void plug_in() noexcept override;
  [[nodiscard]] bool plugged_in() const noexcept override { return plugged_in_; }
  [[nodiscard]] std::uint16_t vendor_id() const noexcept override;
  [[nodiscard]] std::uint16_t product_id() const noexcept override;
  [[nodiscard]] std::string_view manufacturer() const noexcept override;
  [[nodiscard]] std::string_view product() const noexcept override;
  [[nodiscard]] std::string_view serial() const noexcept override { return params_.serial; }
  [[nodiscard]] std::span<const std::byte> report_descriptor() const noexcept override { return descriptor_; }
  TransferResult report_out(std::span<const std::byte> report) noexcept override;
  TransferResult report_in(std::span<std::byte> into) noexcept override;
  TransferResult feature_set(std::span<const std::byte> report) noexcept override;
  TransferResult feature_get(std::span<std::byte> into) noexcept override;

  /// Presses the calibration button; latched until counters are preset.
  void press_calibration() noexcept { calibration_latched_ = true; }
  void hold_stylus(bool held) noexcept { stylus_ = held; }
  /// Moves the tip there at rest and holds it there against all forces. @return false: out of reach, nothing changed
  bool place(const Vec3& tip) noexcept;
  /// Releases the tip: the forces on it move it again.
  void let_go() noexcept { held_ = false; }
  void set_hand_time(std::optional<double> session) noexcept;

  WoodenHapticsFaults faults;

  [[nodiscard]] Time now() const noexcept { return now_; }
  [[nodiscard]] const Vec3& tip() const noexcept { return tip_; }
  [[nodiscard]] const Vec3& velocity() const noexcept { return velocity_; }
  [[nodiscard]] const Vec3& q() const noexcept { return q_; }
  /// Return the motors' present joint effort [N m] and force at the tip [N]; zero while the amplifiers are off.
  [[nodiscard]] Vec3 motor_effort() const noexcept;
  [[nodiscard]] Vec3 motor_force() const noexcept;
  [[nodiscard]] bool amplifiers_on() const noexcept { return amplifiers_; }
  [[nodiscard]] std::uint64_t host_reports() const noexcept { return host_reports_; }
  [[nodiscard]] std::uint64_t refused_reports() const noexcept { return refused_reports_; }
  /// Returns the report `back` places before the newest; back < min(host_reports(), kRemembered).
  [[nodiscard]] const HostReport& host_report(std::size_t back) const noexcept;

 private:
  [[nodiscard]] std::int32_t count(std::size_t motor) const noexcept;
  void move(double dt) noexcept;
  void send_report() noexcept;
  void power_up() noexcept;

  WoodenHapticsModelParams params_;
  woodenhaptics::Kinematics kinematics_;
  std::unique_ptr<sim::Hand> hand_;
  std::vector<std::byte> descriptor_;

  Time now_{};
  bool plugged_in_ = true;
  Vec3 tip_, velocity_ = Vec3::Zero(), q_ = Vec3::Zero();
  bool held_ = false;

  bool amplifiers_ = false;
  std::array<std::int16_t, 3> current_ma_{};
  std::array<std::int32_t, 6> zero_{};  ///< zero positions of the counters
  bool calibration_latched_ = false, stylus_ = false;
  Time heard_at_{};
  std::optional<Time> report_due_;
  std::array<std::int32_t, 3> frozen_{};
  ReportQueue queue_;

  std::uint64_t host_reports_ = 0, refused_reports_ = 0;
  std::array<HostReport, kRemembered> remembered_{};
};

}  // namespace tandem::hal::emulation
