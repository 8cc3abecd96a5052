#pragma once

#include <cstdint>
#include <optional>

#include "common/base/command_lifetime.h"
#include "common/base/time.h"
#include "hal/core/device.h"

namespace tandem::hal {

/// Limits of a driver's motors. Forces are at the tip [N].
/// The client's force gate decides the force on the operator. These limits hold even if the gate, the client or the
/// link fails.
struct GuardLimits {
  double peak_n = 0;                   ///< largest force; 0: no force at all
  std::optional<double> continuous_n;  ///< force the motors sustain without time limit; empty: same as the peak
  Duration heat_time = std::chrono::seconds(10);         ///< thermal time constant of the motors
  double speed_max_m_s = 3;                              ///< above this tip speed no force is given
  double jump_max_m = 0.02;                              ///< larger steps between two exchanges count as wrong readings
  Duration soft_start = std::chrono::milliseconds(500);  ///< duration of the ramp from zero force
  Duration fade_time = kCommandFade;                     ///< from the last effort to zero after a command expired
  Duration miss_limit = std::chrono::milliseconds(10);   ///< longest time of exchanges without a complete reply
};

/// Knowledge of a device's motor directions. Relevant only for devices whose signs come from a file.
enum class MotorSigns : std::uint8_t {
  kUnconfirmed,     ///< no force
  kBeingConfirmed,  ///< up to kConfirmingShare of the peak, in pulses that the user agreed to
  kConfirmed,       ///< each motor was observed to push in the configured direction, on this device with this file
};
/// Share of the peak force that is allowed while motor directions are confirmed.
inline constexpr double kConfirmingShare = 0.3;

/// Returns the least peak force of the axes [N]; 0: the device gives no peak force.
[[nodiscard]] double peak_of(const DeviceCaps& caps) noexcept;
/// Returns the limits that follow from a device's capabilities: the least peak force of its axes.
/// A guessed force scale reduces the limits to a tenth. Motor signs from a file that are not confirmed allow no force.
[[nodiscard]] GuardLimits limits_of(const DeviceCaps& caps, MotorSigns signs = MotorSigns::kUnconfirmed) noexcept;

/// Last guard between the commanding client and the driver that encodes the effort.
/// Checks, in sequence: finite, not expired, within the motors' peak force (direction kept), within their heat, soft
/// start.
/// After implausible readings the force restarts at zero. Pure; total: every input gives finite efforts within the
/// limits. Real-time safe.
///
/// A command acts until it expires, at most `kCommandLifetimeMax` after its arrival. A later `expires` or a repetition
/// does not extend this. Then its effort fades to zero within `fade_time`.
class DriverGuard {
 public:
  /// Result of a limit; kInhibited: a reading or the soft start allows no force.
  enum class Verdict : std::uint8_t { kPassed, kClamped, kExpired, kNotFinite, kInhibited };
  /// Effort for the motors, and what was done to the command.
  struct Output {
    AxisArray effort{};                  ///< joint effort, finite [N m or N]
    Verdict verdict = Verdict::kPassed;  ///< reason of a change
  };

  /// Starts without a reading: the first efforts are zero.
  /// @param limits  limits of the motors
  /// @param joints  number of joints in use
  DriverGuard(const GuardLimits& limits, std::size_t joints) noexcept;

  /// Restarts the soft start: forces begin at zero.
  void start(Time now) noexcept;
  /// Takes a new reading.
  /// @param now         time of the reading
  /// @param state       the reading
  /// @param continuous  false: the position may have jumped for a known reason; forces restart at zero
  void observe(Time now, const State& state, bool continuous) noexcept TANDEM_REALTIME;
  /// Returns the effort that the motors may get now.
  [[nodiscard]] Output limit(Time now, const Command& command, const State& state) noexcept TANDEM_REALTIME;

  /// Returns the number of implausible readings since the last `start`.
  [[nodiscard]] std::uint64_t implausible() const noexcept { return implausible_; }
  /// Returns the present force limit at the tip, after heat and soft start [N].
  [[nodiscard]] double force_limit(Time now) const noexcept;

 private:
  GuardLimits limits_;
  std::size_t joints_;
  Time started_{}, seen_at_{}, passed_at_{};
  bool seen_ = false, passed_ = false;
  Vec3 x_ = Vec3::Zero();
  double heat_ = 0;     ///< mean square of the force, weighted by the thermal time constant [N^2]
  double given_n_ = 0;  ///< force of the last output [N]
  AxisArray last_{};    ///< effort of the last command that had not expired
  std::uint64_t seq_ = 0;
  Time asked_{};    ///< expiry that the newest command requests
  Time expires_{};  ///< effective expiry: at most `kCommandLifetimeMax` after the command's arrival
  Time died_{};     ///< when it expired
  std::uint64_t implausible_ = 0;
};

}  // namespace tandem::hal
