#pragma once

#include <string>

namespace tandem::test {

/// A scene in which one hand presses a tool against bone and holds still. Every spring in the chain carries the same
/// force, so a reader can calculate it by hand. The gains are the same at every rate; there is one axis and no
/// friction. The channel softens with the age of its samples (5 N s/m divided by the age). In a live session at 100 Hz
/// a datagram waits up to 15 ms for the next tick. The other springs are so soft that this costs at most 3 % of the
/// force.
struct PressScene {
  double tick_hz = 1000;
  double duration_s = 4;
  int silence_ms = 20, loop_age_ms = 2500;
  bool replica = false;   ///< law REPLICA and a tool without a device, instead of SET_POSITION and a simulated slave
  double reach_m = 0.03;  ///< target of the hand from `kSettled` on, behind the wall at 0 [m]

  static constexpr double kSettled = 2.5;  ///< [s]; from then on the force is `force`
  static constexpr double kHand = 1000, kDevice = 20, kChannel = 1500, kTool = 20, kWall = 20000;  ///< [N/m]
  /// Device spring under law REPLICA, where no other spring is soft [N/m].
  static constexpr double kReplicaDevice = 80;

  /// Returns whether the hand rests at session time `t` [s], before its release begins.
  [[nodiscard]] constexpr bool rests(double t) const { return t >= kSettled + 0.5 && t <= duration_s - 0.1; }

  /// Device spring, channel, tool spring and wall in series; under law REPLICA device spring and wall [N/m].
  [[nodiscard]] constexpr double stiffness() const {
    return replica ? 1 / (1 / kReplicaDevice + 1 / kWall) : 1 / (1 / kDevice + 1 / kChannel + 1 / kTool + 1 / kWall);
  }
  /// Force on the hand at rest [N]; the hand's own spring is part of the series.
  [[nodiscard]] constexpr double force() const { return reach_m / (1 / kHand + 1 / stiffness()); }

  [[nodiscard]] std::string text() const {
    const auto number = [](double v) { return std::to_string(v); };
    const std::string device =
        "device { model: LINEAR mass_kg: 0.1 friction_n: 0 damping_n_s_m: 2 start_m { x: -0.01 } } ";
    return "version: 1 dof: 1 port: TIP tick_hz: " + number(tick_hz) + " duration_s: " + number(duration_s) +
           "\nchannel { law: " + (replica ? "REPLICA" : "SET_POSITION") + " mfs: OPEN k_n_m: " + number(kChannel) +
           " }\ngate { silence_limit_ms: " + std::to_string(silence_ms) +
           " loop_age_max_ms: " + std::to_string(loop_age_ms) +
           " latch: false }\ndevice_coupling { k_c_n_m: " + number(replica ? kReplicaDevice : kDevice) +
           " b_n_s_m: 0.5 m_c_kg: 0.02 }\nseat { name: \"hand\" kind: MASTER role: INSTRUCTOR required: true " +
           device + "hand { model: LEADER k_n_m: " + number(kHand) +
           " trajectory { waypoint { at_s: 0.5 x_m: -0.01 } waypoint { at_s: 2 x_m: " + number(reach_m) +
           " } } } }\ntool { name: \"tool\" " +
           (replica ? "slave { model: VIRTUAL"
                    : "k_s_n_m: " + number(kTool) +
                          " m_s_kg: 0.05 b_s_n_s_m: 0.2 slave { model: LINEAR mass_kg: 0.1 friction_n: 0 "
                          "damping_n_s_m: 2") +
           " start_m { x: -0.01 } environment { wall { axis: X at_m: 0 k_n_m: " + number(kWall) +
           " } } } }\nauthority { tool: \"tool\" seat: \"hand\" alpha: 1 }\n";
  }
};

}  // namespace tandem::test
