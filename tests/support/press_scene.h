#pragma once

#include <string>

namespace tandem::test {

/// One hand presses a tool against bone and holds still: every spring in the chain carries the same force, so it is known by hand. The same
/// gains at every rate. One axis, no friction, nothing hidden. The channel softens with the age of its news (5 N s/m over it), and live at
/// 100 Hz a datagram waits up to 15 ms for the next tick: the other springs are so soft that this takes at most 3 % of the force.
struct PressScene {
  double tick_hz = 1000;
  double duration_s = 4;
  int silence_ms = 20, loop_age_ms = 2500;
  bool replica = false;   ///< law REPLICA and a tool without a device, instead of SET_POSITION and a simulated slave
  double reach_m = 0.03;  ///< where the hand means to be, behind the wall at 0, from `kSettled` on

  static constexpr double kSettled = 2.5;  ///< [s] from then on the force is that of `force`
  static constexpr double kHand = 1000, kDevice = 20, kChannel = 1500, kTool = 20, kWall = 20000;  ///< [N/m]
  static constexpr double kReplicaDevice = 80;  ///< the same for law REPLICA, where no other spring is soft [N/m]

  /// The hand rests at session time `t` [s], and nobody has begun to let it go.
  [[nodiscard]] constexpr bool rests(double t) const { return t >= kSettled + 0.5 && t <= duration_s - 0.1; }

  /// Device spring, channel, tool spring and wall in series; law REPLICA: device spring and wall [N/m].
  [[nodiscard]] constexpr double stiffness() const {
    return replica ? 1 / (1 / kReplicaDevice + 1 / kWall) : 1 / (1 / kDevice + 1 / kChannel + 1 / kTool + 1 / kWall);
  }
  /// On the hand at rest [N]: its own spring is in the series.
  [[nodiscard]] constexpr double force() const { return reach_m / (1 / kHand + 1 / stiffness()); }

  [[nodiscard]] std::string text() const {
    const auto number = [](double v) { return std::to_string(v); };
    const std::string device = "device { model: LINEAR mass_kg: 0.1 friction_n: 0 damping_n_s_m: 2 start_m { x: -0.01 } } ";
    return "version: 1 dof: 1 port: TIP tick_hz: " + number(tick_hz) + " duration_s: " + number(duration_s) +
           "\nchannel { law: " + (replica ? "REPLICA" : "SET_POSITION") + " mfs: OPEN k_n_m: " + number(kChannel) + " }\ngate { silence_limit_ms: " + std::to_string(silence_ms) +
           " loop_age_max_ms: " + std::to_string(loop_age_ms) + " latch: false }\ndevice_coupling { k_c_n_m: " + number(replica ? kReplicaDevice : kDevice) +
           " b_n_s_m: 0.5 m_c_kg: 0.02 }\nseat { name: \"hand\" kind: MASTER role: INSTRUCTOR required: true " + device + "hand { model: LEADER k_n_m: " +
           number(kHand) + " trajectory { waypoint { at_s: 0.5 x_m: -0.01 } waypoint { at_s: 2 x_m: " + number(reach_m) + " } } } }\ntool { name: \"tool\" " +
           (replica ? "slave { model: VIRTUAL" : "k_s_n_m: " + number(kTool) + " m_s_kg: 0.05 b_s_n_s_m: 0.2 slave { model: LINEAR mass_kg: 0.1 friction_n: 0 damping_n_s_m: 2") +
           " start_m { x: -0.01 } environment { wall { axis: X at_m: 0 k_n_m: " +
           number(kWall) + " } } } }\nauthority { tool: \"tool\" seat: \"hand\" alpha: 1 }\n";
  }
};

}  // namespace tandem::test
