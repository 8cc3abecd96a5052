#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hal/sim/hand.h"
#include "hal/wire/report_queue.h"
#include "hal/wire/wire_model.h"
#include "hal/woodenhaptics/kinematics.h"
#include "proto/woodenhaptics_spec.h"

namespace tandem::hal::wire {

struct WoodenHapticsModelParams {
  WoodenHapticsSpec spec;        ///< the mechanism that is really there
  Vec3 start = Vec3::Zero();     ///< tip at power-up [m], HAL frame; in reach
  double mass = 0.25;            ///< at the tip [kg]
  double damping = 0.5;          ///< [N s/m]
  bool weight = false;           ///< the arms have weight
  Duration answer_after = std::chrono::microseconds{200};  ///< v2, raw64: from a host's report to the board's next one
  Duration period = std::chrono::milliseconds{1};          ///< v1: of its own reports
  std::string_view serial = "0001";
};

/// Trouble to be had. Counts fall by one per report concerned.
struct WoodenHapticsFaults {
  int lost_reports = 0;     ///< the next reports never come
  int odd_reports = 0;      ///< the next reports have `odd_length` bytes
  std::size_t odd_length = 5;
  Duration late{0};         ///< added to answer_after
  bool silent = false;      ///< no reports at all
  bool frozen_encoders = false;
  bool stalled_out = false;  ///< the host's reports are answered by STALL
};

/// A Haptikfabriken HID board with motors, encoders and an arm: firmware, watchdog, physics. The tip is a mass in a hand
/// (sim::Hand), or nobody's, or moved along a path by `place`. v2 and raw64: one report, then nothing until the host's;
/// v1: a report every period. Amplifiers are off from power-up to the first report of the host. v1 and v2 (mbed firmware) switch them
/// off after 0.5 s without a report; nothing is published of a watchdog in raw64 boards, so their model never does.
class WoodenHapticsModel final : public HidWireModel {
 public:
  static constexpr Duration kWatchdog = std::chrono::milliseconds{500};
  /// What the host sent, and when.
  struct HostReport {
    Time at{};
    std::array<std::int16_t, 3> current_ma{};
    bool preset = false;
  };
  static constexpr std::size_t kRemembered = 256;

  explicit WoodenHapticsModel(const WoodenHapticsModelParams& params);
  /// With somebody's hand at the tip.
  WoodenHapticsModel(const WoodenHapticsModelParams& params, const HandSpec& hand,
                     std::shared_ptr<const sim::RecordedMotion> motion = nullptr);

  void advance(Duration dt) noexcept override;
  void unplug() noexcept override;
  /// The board's power is the bus's: counters begin at zero where the arm is, amplifiers are off.
  void plug_in() noexcept override;
  [[nodiscard]] bool plugged_in() const noexcept override { return plugged_in_; }
  [[nodiscard]] std::uint16_t vendor_id() const noexcept override;
  [[nodiscard]] std::uint16_t product_id() const noexcept override;
  [[nodiscard]] std::string_view manufacturer() const noexcept override;
  [[nodiscard]] std::string_view product() const noexcept override;
  [[nodiscard]] std::string_view serial() const noexcept override { return params_.serial; }
  [[nodiscard]] std::span<const std::byte> report_descriptor() const noexcept override { return descriptor_; }
  WireMoved report_out(std::span<const std::byte> report) noexcept override;
  WireMoved report_in(std::span<std::byte> into) noexcept override;
  WireMoved feature_set(std::span<const std::byte> report) noexcept override;
  WireMoved feature_get(std::span<std::byte> into) noexcept override;

  /// Somebody presses the calibration button; latched until counters are preset.
  void press_calibration() noexcept { calibration_latched_ = true; }
  void hold_stylus(bool held) noexcept { stylus_ = held; }
  /// Puts the tip there, at rest, and keeps it there whatever pushes. @return false: out of reach, nothing happened
  bool place(const Vec3& tip) noexcept;
  /// Gives the tip back to the forces on it.
  void let_go() noexcept { held_ = false; }
  void set_hand_time(std::optional<double> session) noexcept;

  WoodenHapticsFaults faults;

  [[nodiscard]] Time now() const noexcept { return now_; }
  [[nodiscard]] const Vec3& tip() const noexcept { return tip_; }
  [[nodiscard]] const Vec3& velocity() const noexcept { return velocity_; }
  [[nodiscard]] const Vec3& q() const noexcept { return q_; }
  /// What the motors give now: joint effort [N m] and force at the tip [N]. Zero while the amplifiers are off.
  [[nodiscard]] Vec3 motor_effort() const noexcept;
  [[nodiscard]] Vec3 motor_force() const noexcept;
  [[nodiscard]] bool amplifiers_on() const noexcept { return amplifiers_; }
  [[nodiscard]] std::uint64_t host_reports() const noexcept { return host_reports_; }
  [[nodiscard]] std::uint64_t refused_reports() const noexcept { return refused_reports_; }
  /// `back` reports before the newest; back < min(host_reports(), kRemembered).
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
  std::array<std::int32_t, 6> zero_{};  ///< of the counters
  bool calibration_latched_ = false, stylus_ = false;
  Time heard_at_{};
  std::optional<Time> report_due_;
  std::array<std::int32_t, 3> frozen_{};
  ReportQueue queue_;

  std::uint64_t host_reports_ = 0, refused_reports_ = 0;
  std::array<HostReport, kRemembered> remembered_{};
};

}  // namespace tandem::hal::wire
