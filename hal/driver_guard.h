#pragma once

#include <cstdint>
#include <optional>

#include "common/base/command_life.h"
#include "common/base/time.h"
#include "hal/device.h"

namespace tandem::hal {

/// What a driver's motors may do. The force gate of the client decides how hard a hand is pushed; this is what holds even
/// if the gate, the client or the link in between is wrong. Forces at the tip [N].
struct GuardLimits {
  double peak_n = 0;                   ///< never more; 0: no force at all
  std::optional<double> continuous_n;  ///< what the motors stand for ever; empty: as much as the peak
  Duration heat_time = std::chrono::seconds(10);  ///< time constant of the motors' heat
  double speed_max_m_s = 3;            ///< a tip that moves faster gets no force
  double jump_max_m = 0.02;            ///< a hand does not move so far between two exchanges: the reading is wrong
  Duration soft_start = std::chrono::milliseconds(500);
  Duration let_go = kCommandFade;  ///< from the last effort to zero when a command died of age
  Duration miss_limit = std::chrono::milliseconds(10);  ///< of asking without a whole answer
};

/// What is known of the directions of a device's motors. Counts only for devices whose signs come from a file.
enum class MotorSigns : std::uint8_t {
  kUnconfirmed,     ///< no force
  kBeingConfirmed,  ///< up to kConfirmingShare of the peak, in pulses that a person agreed to
  kConfirmed,       ///< each motor was seen to push the way it is told, on this device with this file
};
inline constexpr double kConfirmingShare = 0.3;

/// Least peak of the axes [N]; 0: the device says nothing of its force.
[[nodiscard]] double peak_of(const DeviceCaps& caps) noexcept;
/// Limits from what a device says of itself: the least peak of its axes, a tenth of it while its force scale is a guess; none if the
/// signs of its motors come from a file and are not confirmed.
[[nodiscard]] GuardLimits limits_of(const DeviceCaps& caps, MotorSigns signs = MotorSigns::kUnconfirmed) noexcept;

/// Between whoever commands and the driver that encodes: finite -> not expired -> within the force of the motors, direction
/// kept -> within their heat -> soft start; no force after readings that cannot be. Pure; total: every input gives finite
/// efforts within the limits. Real-time safe.
///
/// A command acts until it expires, at most `kCommandLifeMax` after it came, however late it wants to expire and however often it is repeated;
/// then its effort fades within `let_go`.
class DriverGuard {
 public:
  enum class Verdict : std::uint8_t { kPassed, kClamped, kExpired, kNotFinite, kHeldBack };
  struct Output {
    AxisArray effort{};
    Verdict verdict = Verdict::kPassed;
  };

  DriverGuard(const GuardLimits& limits, std::size_t joints) noexcept;

  /// Forces begin anew at zero.
  void start(Time now) noexcept;
  /// A reading came. @param continuous  false: positions may have jumped for a good reason; forces begin anew
  void see(Time now, const State& state, bool continuous) noexcept TANDEM_REALTIME;
  [[nodiscard]] Output pass(Time now, const Command& command, const State& state) noexcept TANDEM_REALTIME;

  /// Readings that cannot be since the last `start`.
  [[nodiscard]] std::uint64_t implausible() const noexcept { return implausible_; }
  /// Present limit at the tip, after heat and soft start [N].
  [[nodiscard]] double limit(Time now) const noexcept;

 private:
  GuardLimits limits_;
  std::size_t joints_;
  Time started_{}, seen_at_{}, passed_at_{};
  bool seen_ = false, passed_ = false;
  Vec3 x_ = Vec3::Zero();
  double heat_ = 0;     ///< mean square of the force, weighted by the motors' time constant [N^2]
  double given_n_ = 0;  ///< force of the effort passed last [N]
  AxisArray last_{};    ///< effort of the last command that lived
  std::uint64_t seq_ = 0;
  Time asked_{};        ///< until when the newest command wants to live
  Time expires_{};      ///< until when it does: at most `kCommandLifeMax` from when it came
  Time died_{};         ///< when it expired
  std::uint64_t implausible_ = 0;
};

}  // namespace tandem::hal
