#pragma once

#include <array>
#include <cstddef>

#include "common/control/numerics.h"
#include "common/control/virtual_tool.h"
#include "proto/spec/scene_spec.h"

namespace tandem::netsim::tradeoff {

/// The motion of a simulated tool for which its numerics are judged: one hand pulls it by the spring and the damper of
/// a scene for one second. With a surface the hand moves from 5 mm before the first one to 5 mm behind it within 0.25
/// s, moves along it, and returns. Without one it moves on a circle of 20 mm at 2 Hz. The hand follows this path
/// whatever the tool does, and surfaces have no friction.
struct ToolTask {
  control::VirtualTool::Gains tool;  ///< of the scene's first tool
  std::size_t axes = 3;
  control::ContactSet contacts;  ///< of that tool, without friction
  double k_c = 400;              ///< hand to tool [N/m]
  double b_rel = 14;             ///< hand to tool [N s/m]

  static constexpr double kDuration = 1;  ///< [s]
};
/// Distance from the truth beyond which a run counts as unstable [m].
inline constexpr double kLost = 0.01;

/// Position [m] and velocity [m/s] of the hand.
template <class S>
struct HandPoint {
  std::array<S, 3> x{}, v{};
};

/// Returns the task of the first tool, simulated or not: its hand, body and surfaces.
[[nodiscard]] ToolTask tool_task(const SceneSpec& scene);

/// Returns the hand at time `t` [s], in double for runs and in long double for the reference.
[[nodiscard]] HandPoint<double> hand_at(const ToolTask& task, double t) noexcept;
[[nodiscard]] HandPoint<long double> hand_at(const ToolTask& task, long double t) noexcept;

/// State of the tool at one tick, and the force on the hand.
struct ToolSample {
  std::array<double, 3> x{}, v{};
  std::array<double, 3> force{};  ///< k_c (x - q) [N]
  double energy = 0;              ///< of the tool, the hand's spring and the surfaces [J]
};
/// Returns the sample of a tool with position `x` and velocity `v` while the hand is at `q`.
[[nodiscard]] ToolSample sample_of(const ToolTask& task, const std::array<double, 3>& x, const std::array<double, 3>& v,
                                   const std::array<double, 3>& q) noexcept;

/// The same tool, stepped by a session's code.
class SteppedTool {
 public:
  /// @param from  time at which the motion begins, with the tool at rest at the hand [s]
  SteppedTool(const ToolTask& task, double tick_hz, const control::Numerics& numerics, double from = 0) noexcept;
  /// Moves the hand by one tick. The tool sees it as it is at the end of the tick, as a client samples it.
  void prepare() noexcept;
  /// Advances the tool by one tick. @return false if the result was not finite
  bool advance() noexcept { return tool_.step(1 / tick_hz_, pulls_); }
  /// Both, in this order.
  bool step() noexcept {
    prepare();
    return advance();
  }
  [[nodiscard]] ToolSample sample() const noexcept;

 private:
  ToolTask task_;
  double tick_hz_;
  control::VirtualTool tool_;
  std::size_t ticks_ = 0;
  HandPoint<double> hand_;
  control::VirtualTool::Pulls pulls_{};
};

}  // namespace tandem::netsim::tradeoff
