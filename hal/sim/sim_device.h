#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "hal/core/device.h"
#include "hal/sim/hand.h"
#include "hal/sim/linear_plant.h"
#include "hal/sim/touch_plant.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal::sim {

template <class Dynamics>
class IntegratedPlant;
struct TouchDynamics;
struct LinearDynamics;

/// Ground truth of a simulation: the state of the plant itself, without encoder and filter. A device does not report
/// it.
struct GroundTruth {
  AxisArray q{};                      ///< [rad] or [m]
  AxisArray dq{};                     ///< [rad/s] or [m/s]
  Vec3 x = Vec3::Zero();              ///< tip [m]
  Vec3 dx = Vec3::Zero();             ///< tip [m/s]
  Vec3 f_environment = Vec3::Zero();  ///< force of the environment on the tip, mean over the last period [N]
  Vec3 f_hand = Vec3::Zero();  ///< force of the hand on the tip without its inertia, mean over the last period [N]
  double penetration = 0;      ///< deepest of wall and tissue [m], 0: no contact
};

/// Counters of a simulated device.
struct SimCounts {
  std::uint64_t ticks = 0;      ///< calls of `advance`
  std::uint64_t expired = 0;    ///< periods during which a command had expired
  std::uint64_t rejected = 0;   ///< commands with a non-finite effort
  std::uint64_t saturated = 0;  ///< commands reduced to the motors' limit
};

/// Everything from which a simulated device is made.
struct SimSetup {
  SimDeviceSpec device;                          ///< kind and parameters
  HandSpec hand;                                 ///< model kNone: no hand holds the device
  EnvironmentSpec environment;                   ///< surfaces, for simulated slaves
  std::shared_ptr<const RecordedMotion> motion;  ///< recording for HandModel::kRecorded
  Time start{};                                  ///< `State::sampled_at` of the first reading
  /// Joint position to start at (a previous State::q), instead of the tip position of `device.start`.
  std::optional<AxisArray> joints = {};
};

/// A simulated device, Touch or one axis, with a hand or an environment at its tip. State is what a host measures: q is
/// quantised by the encoder, dq is its filtered difference; x, dx and J follow from these. The effort of a command is
/// limited to `force_peak` at the tip. Gravity compensation and friction feed-forward are added internally and not
/// reported, as a host does. After a calibration (hal/sim/sim_calibration.h) they use its result.
/// Deterministic; no heap after make(); total: every input leaves a finite state.
class SimDevice final : public SteppedDevice {
 public:
  /// Returns a new device, calibrated if its setup requests that. Error: a failed calibration, a number that is not
  /// finite or out of range, or a start pose out of reach.
  [[nodiscard]] static Result<std::unique_ptr<SimDevice>> make(const SimSetup& setup);
  ~SimDevice() override;

  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  [[nodiscard]] const State& state() const noexcept override { return state_; }
  /// `command.expires` is compared with `state().sampled_at`; a command that expires within `dt` acts until then.
  /// `dt` is limited to [0, 1 s]. tau_out and f_out are means over `dt`.
  void advance(const Command& command, Duration dt) noexcept TANDEM_REALTIME override;

  /// See Hand::set_session_time. Thread-safe.
  void set_session_time(std::optional<double> t) noexcept TANDEM_REALTIME { hand_.set_session_time(t); }
  /// Returns the hand that holds the device.
  [[nodiscard]] const Hand& hand() const noexcept { return hand_; }
  /// Returns the state of the plant itself.
  [[nodiscard]] const GroundTruth& ground_truth() const noexcept { return ground_truth_; }
  /// Returns the counters so far.
  [[nodiscard]] const SimCounts& counts() const noexcept { return counts_; }
  /// Sets the pressed buttons: `State::buttons` from the next reading on. Thread-safe.
  void press(unsigned mask) noexcept { buttons_.store(mask, std::memory_order_relaxed); }
  /// Adds a push of the operator to the force of the hand model.
  /// @param force  at the tip [N]  @param length  from now on [s], at most 1
  void push(const Vec3& force, double length) noexcept {
    push_ = force.allFinite() ? force : Vec3(Vec3::Zero());
    push_left_ = length > 0 ? std::min(length, 1.0) : 0;
  }

 private:
  using Plant = std::variant<TouchPlant, LinearPlant, std::unique_ptr<IntegratedPlant<TouchDynamics>>,
                             std::unique_ptr<IntegratedPlant<LinearDynamics>>>;
  [[nodiscard]] static Plant touch_plant(const SimSetup& setup, const Vec3& q0);
  [[nodiscard]] static Plant linear_plant(const SimSetup& setup, const Vec3& start);
  SimDevice(const SimSetup& setup, Plant plant, const Vec3& start);
  [[nodiscard]] static Result<std::unique_ptr<SimDevice>> make_uncalibrated(const SimSetup& setup);
  void make_caps();
  void set_load(const DeviceLoad& load) noexcept;
  void read_truth() noexcept;
  void measure(double dt) noexcept;
  void derive_pose() noexcept;
  struct Effort {
    AxisArray tau{};            ///< within the motors' limit
    Vec3 force = Vec3::Zero();  ///< the same at the tip
  };
  [[nodiscard]] Effort limited_effort(const Command& command) noexcept;
  /// Advances the plant through a part of a period: `length` [s] around the instant `middle` [s] after its start.
  void move(const Vec3& tau, HandPull pull, double middle, double length, double period) noexcept;
  [[nodiscard]] Vec3 compensation() const noexcept;

  SimDeviceSpec spec_;
  Plant plant_;
  Hand hand_;
  std::atomic<unsigned> buttons_{0};
  Vec3 push_ = Vec3::Zero();
  double push_left_ = 0;  ///< [s]
  DeviceCaps caps_;
  std::optional<DeviceLoad> load_;  ///< as calibrated
  State state_;
  GroundTruth ground_truth_;
  SimCounts counts_;
  TouchPose pose_;         ///< at the measured q, for gravity compensation
  double filter_dt_ = -1;  ///< period for which the velocity filter's factor was computed
  double filter_ = 1;
};

}  // namespace tandem::hal::sim
