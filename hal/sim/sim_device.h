#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "hal/device.h"
#include "hal/sim/hand.h"
#include "hal/sim/linear_plant.h"
#include "hal/sim/touch_plant.h"
#include "proto/scene_spec.h"

namespace tandem::hal::sim {

/// What a simulator may know and a device may not: the plant itself, without encoder and filter.
struct Truth {
  AxisArray q{};                      ///< [rad] or [m]
  AxisArray dq{};                     ///< [rad/s] or [m/s]
  Vec3 x = Vec3::Zero();              ///< tip [m]
  Vec3 dx = Vec3::Zero();             ///< tip [m/s]
  Vec3 f_environment = Vec3::Zero();  ///< of the environment on the tip, mean over the last period [N]
  Vec3 f_hand = Vec3::Zero();         ///< of the hand on the tip, without its inertia, mean over the last period [N]
  double penetration = 0;             ///< deepest of wall and tissue [m], 0: no contact
};

struct SimCounts {
  std::uint64_t ticks = 0;
  std::uint64_t expired = 0;    ///< commands that died of age, counted once per period in which one was dead
  std::uint64_t rejected = 0;   ///< commands with a non-finite effort
  std::uint64_t saturated = 0;  ///< commands cut to the motors' limit
};

struct SimSetup {
  SimDeviceSpec device;
  HandSpec hand;                                 ///< model kNone: nobody holds the device
  EnvironmentSpec environment;                   ///< slaves touch something
  std::shared_ptr<const RecordedMotion> motion;  ///< HandModel::kRecorded
  Time start{};                                  ///< `State::sampled_at` of the first reading
  /// Begins where a reading once was (State::q), instead of at the tip position of `device.start`.
  std::optional<AxisArray> joints = {};
};

/// A simulated device, Touch or one axis (design notes, control 8), with a hand or an environment at its tip. State is what a host
/// would see: q is quantised by the encoder, dq is its filtered difference, x, dx, J follow from these. The effort of a
/// command is limited to `force_peak` at the tip; gravity compensation and friction feed-forward are added inside, as a
/// host would, and are reported nowhere.
/// Deterministic; no heap after make(); total: every input leaves a finite state.
class SimDevice final : public SteppedDevice {
 public:
  /// Error: a number that is not finite or out of range, or a start pose out of reach.
  [[nodiscard]] static Result<std::unique_ptr<SimDevice>> make(const SimSetup& setup);

  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  [[nodiscard]] const State& state() const noexcept override { return state_; }
  /// `command.expires` is compared with `state().sampled_at`; a command that expires within `dt` acts until then.
  /// `dt` is cut to [0, 1 s]. tau_out and f_out are means over `dt`.
  void advance(const Command& command, Duration dt) noexcept TANDEM_REALTIME override;

  /// See Hand::set_session_time. Thread-safe.
  void set_session_time(std::optional<double> t) noexcept TANDEM_REALTIME { hand_.set_session_time(t); }
  [[nodiscard]] const Hand& hand() const noexcept { return hand_; }
  [[nodiscard]] const Truth& truth() const noexcept { return truth_; }
  [[nodiscard]] const SimCounts& counts() const noexcept { return counts_; }
  /// Buttons a person or a test presses: `State::buttons` from the next reading on. Thread-safe.
  void press(unsigned mask) noexcept { buttons_.store(mask, std::memory_order_relaxed); }
  /// A person pushes the handle, beside what the hand's model does.
  /// @param force  at the tip [N]  @param length  from now on [s], at most 1
  void push(const Vec3& force, double length) noexcept {
    push_ = force.allFinite() ? force : Vec3(Vec3::Zero());
    push_left_ = length > 0 ? std::min(length, 1.0) : 0;
  }

 private:
  using Plant = std::variant<TouchPlant, LinearPlant>;
  SimDevice(const SimSetup& setup, Plant plant, const Vec3& start);
  void make_caps();
  void read_truth() noexcept;
  void measure(double dt) noexcept;
  void derive_pose() noexcept;
  struct Effort {
    AxisArray tau{};            ///< within the motors' limit
    Vec3 force = Vec3::Zero();  ///< the same at the tip
  };
  [[nodiscard]] Effort limited_effort(const Command& command) noexcept;
  /// Part of a period: `length` [s] about the instant `middle` [s] after its beginning.
  void move(const Vec3& tau, HandPull pull, double middle, double length, double period) noexcept;
  [[nodiscard]] Vec3 compensation() const noexcept;

  SimDeviceSpec spec_;
  Plant plant_;
  Hand hand_;
  std::atomic<unsigned> buttons_{0};
  Vec3 push_ = Vec3::Zero();
  double push_left_ = 0;  ///< [s]
  DeviceCaps caps_;
  State state_;
  Truth truth_;
  SimCounts counts_;
  TouchPose pose_;         ///< at the measured q, for gravity compensation
  double filter_dt_ = -1;  ///< period the velocity filter's factor was computed for
  double filter_ = 1;
};

}  // namespace tandem::hal::sim
