#pragma once

#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/command_life.h"
#include "common/base/time.h"

namespace tandem::control {

enum class GatePhase : std::uint8_t { kOff, kZero, kRampIn, kActive, kPassive, kDamped, kFault };

/// The last instance before the motor, at the client, trusting nobody (design notes, control 7; design notes, security 2.3):
/// finite -> clamp -> slew -> silence and loop age -> energy tank -> latched state.
struct GateParams {
  std::size_t dof = 3;
  AxisArray scale{1, 1, 1, 1, 1, 1, 1};  ///< diag(J^T J): a limit F at the tip is F sqrt(scale) on the axis
  double force_max = 3.3;                ///< at the tip [N]
  double mass = 0.1;                     ///< of the device at the tip [kg]; scales the energy tank
  double tank_share = 1;                 ///< (0, 1], of the tank that this mass would have
  Duration silence_limit = std::chrono::milliseconds(20);
  Duration loop_age_max = std::chrono::milliseconds(100);
  Duration ramp_in = std::chrono::milliseconds(500);
  bool latch = true;
  Duration command_life = kCommandLifeMin;  ///< after which the device forgets an effort that is not renewed
};

class ForceGate {
 public:
  struct Input {
    Time now{};
    bool fresh = false;          ///< a strictly newer valid datagram came since the last call
    Duration loop_age{};         ///< own counter echoed by the peer: age on the own clock
    Duration rtt_p99{};          ///< learned
    Duration patience{};         ///< how long what is simulated here may act without news, where that is longer than the silence limit
    bool engage = false;         ///< the server wants this seat active
    bool reset = false;          ///< the person pressed the button that clears DAMPED
    bool reading_valid = true;   ///< false: position not finite for more than 3 samples -> FAULT
    AxisArray wanted{};          ///< effort of the controller [N or N m]
    AxisArray q{};               ///< measured port position, for the energy actually given
    AxisArray v{};               ///< port velocity
  };
  struct Output {
    AxisArray effort{};
    bool clipped = false, not_finite = false;
    bool tripped = false;        ///< a loss began now
    bool engaged_now = false;    ///< RAMP_IN begins now: start the controller bumplessly
  };

  explicit ForceGate(const GateParams& p) noexcept;
  [[nodiscard]] Output step(const Input& in) noexcept TANDEM_REALTIME;

  [[nodiscard]] GatePhase phase() const noexcept { return phase_; }
  /// The controller's effort may reach the hand (in part).
  [[nodiscard]] bool active() const noexcept { return phase_ == GatePhase::kRampIn || phase_ == GatePhase::kActive; }
  [[nodiscard]] std::uint32_t trips() const noexcept { return trips_; }
  [[nodiscard]] std::uint64_t not_finite() const noexcept { return not_finite_; }
  [[nodiscard]] Duration loop_age_limit() const noexcept { return age_limit_; }
  [[nodiscard]] double tank_size() const noexcept { return tank_size_; }          ///< [J]
  [[nodiscard]] double given_since_fresh() const noexcept { return given_; }      ///< [J]
  [[nodiscard]] double given_after_loss_max() const noexcept { return given_max_; }  ///< worst loss so far [J]

 private:
  void change_phase(const Input& in, Output& out) noexcept;
  void lose(const Input& in, Output& out) noexcept;
  void limit(const Input& in, Output& out) noexcept;
  void keep_within_tank(const Input& in, AxisArray& effort) noexcept;

  GateParams p_;
  double tank_size_;
  GatePhase phase_ = GatePhase::kZero;
  Time since_{};                 ///< begin of the phase
  Time ramp_since_{};            ///< begin of the ramp that takes the force away; before `since_` if a silence was noticed late
  Time last_fresh_{}, last_step_{};
  double pace_ = 0;              ///< longest time between two steps of late: for how long an effort may act [s]
  bool started_ = false, heard_ = false;
  bool renewed_ = false;         ///< this tick brought a fresh datagram from a loop that is young enough
  Duration age_limit_{};
  Duration silence_limit_{};     ///< in force
  AxisArray effort_{};           ///< held by the motor
  AxisArray at_loss_{};          ///< effort when PASSIVE began
  AxisArray q_{}, moved_{};      ///< position, and its change in the last step
  double given_ = 0, given_max_ = 0;
  std::uint32_t trips_ = 0;
  std::array<Time, 3> losses_{};  ///< the last three
  std::uint64_t not_finite_ = 0;
};

}  // namespace tandem::control
