#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/sim/integrated_plant.h"
#include "hal/sim/linear_plant.h"
#include "hal/sim/touch_plant.h"
#include "netsim/tradeoff/tool_task.h"

namespace tandem::netsim::tradeoff {

/// Models of the body that a hand moves, from the cheapest to the fullest. All of them are keys of a scene.
enum class ModelTier : std::uint8_t {
  kPoint,        ///< a mass on a rail: `model: LINEAR`, dof 1
  kVirtualTool,  ///< `model: VIRTUAL`: a mass without a device
  kArm,          ///< `model: TOUCH gravity: false friction_n: 0`
  kFullArm,      ///< `model: TOUCH`, with weight and friction
};
inline constexpr std::array<std::string_view, 4> kModelTierNames{"point", "virtual tool", "arm",
                                                                 "arm with friction and gravity"};
/// Models of the surfaces that it touches.
enum class ContactTier : std::uint8_t {
  kNone,      ///< no `environment`
  kPlane,     ///< `wall`: spring and damper
  kTissue,    ///< `tissue`: stiffening spring and damper
  kFriction,  ///< the same with `friction`: VIRTUAL slaves only
};
inline constexpr std::array<std::string_view, 4> kContactTierNames{"none", "plane", "tissue", "friction"};

/// The motion for which the numerics of a simulated device are judged: a hand holds its tip by a spring and a damper
/// and follows the path of `ToolTask`. Motors balance the weight once per tick if the scene says so.
struct DeviceTask {
  ToolTask path;  ///< motion of the hand; its surfaces are those that the device touches
  SimDeviceSpec device;
  EnvironmentSpec environment;
  double k = 1000, b = 10;  ///< of the hand [N/m, N s/m]
};
/// Returns the task of a scene's device: the slave of its first tool, or the device of its first seat, which touches
/// nothing, if that tool is VIRTUAL or belongs to a SLAVE seat.
[[nodiscard]] DeviceTask device_task(const SceneSpec& scene);
/// Returns the tier of a device.
[[nodiscard]] ModelTier tier_of(const SimDeviceSpec& device) noexcept;

/// A device in that motion, stepped by the code of sessions.
class DeviceRun {
 public:
  /// @param numerics  empty: the built-in scheme
  /// @param from      time at which the motion begins, with the device at rest at the hand [s]
  DeviceRun(const DeviceTask& task, double tick_hz, const std::optional<NumericsSpec>& numerics, double from = 0);
  /// Moves the hand by one tick and balances the weight.
  void prepare() noexcept;
  /// Advances the device by one tick.
  void advance() noexcept;
  /// Both, in this order. @return true
  bool step() noexcept {
    prepare();
    advance();
    return true;
  }
  [[nodiscard]] ToolSample sample() const noexcept;

 private:
  DeviceTask task_;
  double tick_hz_;
  std::variant<hal::sim::TouchPlant, hal::sim::LinearPlant, hal::sim::IntegratedPlant<hal::sim::TouchDynamics>,
               hal::sim::IntegratedPlant<hal::sim::LinearDynamics>>
      plant_;
  std::size_t ticks_ = 0;
  hal::sim::HandPull hand_;
  hal::Vec3 tau_ = hal::Vec3::Zero();
};

/// Returns the samples of the task at every tick: classical Runge-Kutta in long double, at least 64 steps per tick and
/// 100 000 per second, hand and motors in continuous motion.
[[nodiscard]] std::vector<ToolSample> device_reference(const DeviceTask& task, double tick_hz);

}  // namespace tandem::netsim::tradeoff
