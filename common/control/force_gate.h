#pragma once

#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/command_lifetime.h"
#include "common/base/time.h"
#include "common/control/loss_latch.h"
#include "common/control/release_ramp.h"
#include "common/control/silence_tank.h"

namespace tandem::control {

/// Phases of a force gate.
enum class GatePhase : std::uint8_t {
  kOff,        ///< no effort
  kZero,       ///< no effort; ready to engage
  kRampIn,     ///< engaging: effort grows and damping fades
  kActive,     ///< effort passes
  kReleasing,  ///< effort is ramped to zero, with damping
  kLatched,    ///< after repeated losses: effort ramped to zero, damping until the participant resets
  kFault       ///< untrusted reading: no effort, until the participant resets
};

/// Parameters of a force gate.
struct GateParams {
  std::size_t dof = 3;                   ///< number of axes in use
  AxisArray scale{1, 1, 1, 1, 1, 1, 1};  ///< per axis: diag(J^T J); a limit F at the tip is F sqrt(scale) on the axis
  double force_max = 3.3;                ///< largest force at the tip [N]
  double mass = 0.1;                     ///< of the device at the tip [kg]; scales the energy tank
  double tank_share = 1;                 ///< share of the tank size that follows from `mass`, (0, 1]
  Duration silence_limit = std::chrono::milliseconds(20);  ///< silence after which force is released
  Duration loop_age_max = std::chrono::milliseconds(100);  ///< upper bound of the learned limit of the loop age
  Duration ramp_in = std::chrono::milliseconds(500);       ///< duration of kRampIn
  bool latch = true;                                       ///< three losses within 10 s latch the gate
  Duration command_lifetime = kCommandLifetimeMin;  ///< the device drops an effort that is not renewed within this time
};

/// Last safety stage before the motor, on the client; it trusts neither the server nor the controller (ARCHITECTURE.md,
/// invariants 3 to 5). Stages in order: finite check, clamp, slew limit, silence and loop age, energy tank, latch.
class ForceGate {
 public:
  /// Input of one step. Arrays are per axis of the port.
  struct Input {
    Time now{};                    ///< time of the tick
    bool fresh = false;            ///< a strictly newer valid datagram arrived since the last call
    Duration loop_age{};           ///< age of the own counter that the peer echoed, on the own clock
    Duration rtt_p99{};            ///< learned 99th percentile of the round-trip time
    Duration silence_allowance{};  ///< how long the local simulation may act without datagrams, where this exceeds the
                                   ///< silence limit
    bool engage = false;           ///< the server requests that this seat be active
    bool reset = false;            ///< the participant pressed the button that clears kLatched and kFault
    bool reading_valid = true;  ///< false: the position was not finite for more than 3 samples; the gate enters kFault
    AxisArray wanted{};         ///< effort requested by the controller [N or N m]
    AxisArray q{};              ///< measured port position; yields the energy that the motor really gave
    AxisArray v{};              ///< port velocity
  };
  /// Result of one step.
  struct Output {
    AxisArray effort{};        ///< effort for the motor [N or N m]
    AxisArray held_back{};     ///< share of the wanted effort that the slew of the ramp held back, [0, 1]
    bool clipped = false,      ///< the norm was clamped
        not_finite = false;    ///< the wanted effort was not finite and became 0
    bool tripped = false;      ///< a loss of the link began in this step
    bool engaged_now = false;  ///< kRampIn began in this step: the owner starts the controller without a bump
  };

  /// Starts in kZero. @param p  limits; see GateParams
  explicit ForceGate(const GateParams& p) noexcept;
  /// Limits the wanted effort; called once per tick. Accepts any input.
  [[nodiscard]] Output step(const Input& in) noexcept TANDEM_REALTIME;

  /// Returns the present phase.
  [[nodiscard]] GatePhase phase() const noexcept { return phase_; }
  /// True if the controller's effort may reach the hand, at least in part.
  [[nodiscard]] bool active() const noexcept { return phase_ == GatePhase::kRampIn || phase_ == GatePhase::kActive; }
  /// Number of losses so far.
  [[nodiscard]] std::uint32_t trips() const noexcept { return losses_.trips(); }
  /// Number of steps with an effort that was not finite.
  [[nodiscard]] std::uint64_t not_finite() const noexcept { return not_finite_; }
  /// Present limit of the loop age.
  [[nodiscard]] Duration loop_age_limit() const noexcept { return age_limit_; }
  /// Bounds the energy given to the hand since the last fresh datagram.
  [[nodiscard]] const SilenceTank& tank() const noexcept { return tank_; }

 private:
  void change_phase(const Input& in, Output& out) noexcept;
  void lose(const Input& in, Output& out) noexcept;
  void limit(const Input& in, Output& out) noexcept;
  [[nodiscard]] double gain_of_ramp(Time now) const noexcept;

  GateParams p_;
  SilenceTank tank_;
  ReleaseRamp ramp_;  ///< of kReleasing and kLatched
  LossLatch losses_;
  GatePhase phase_ = GatePhase::kZero;
  Time since_{};  ///< start of the phase
  Time last_fresh_{}, last_step_{};
  bool started_ = false, heard_ = false;
  bool renewed_ = false;  ///< in this tick a fresh datagram arrived whose loop age is within the limit
  Duration age_limit_{};
  Duration silence_limit_{};  ///< silence limit in force
  AxisArray effort_{};        ///< effort that the motor holds
  std::uint64_t not_finite_ = 0;
};

}  // namespace tandem::control
