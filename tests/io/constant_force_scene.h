#pragma once

#include <string>

namespace tandem::test {

/// Two hands press one tool against a wall and hold still from 3 s on, each with half the authority. One axis, 500 Hz.
/// The gates tolerate long silence, so that no hand is released because this machine delays a thread.
/// @param silence_ms  silence after which a gate releases
/// @param second      the trainee's seat is required
inline std::string constant_force_scene(int silence_ms = 300, bool second = true) {
  const std::string hand =
      " kind: MASTER device { model: LINEAR damping_n_s_m: 2 friction_n: 0.1 } hand { model: LEADER trajectory { "
      "waypoint { at_s: 0.5 x_m: 0 } waypoint { at_s: 2.5 x_m: 0.03 } } } ";
  return "version: 1 dof: 1 tick_hz: 500 duration_s: 900 gate { silence_limit_ms: " + std::to_string(silence_ms) +
         " loop_age_max_ms: 2500 latch: false }\ndevice_coupling { k_c_n_m: 100 b_n_s_m: 1 }\nseat { name: \"trainer\" "
         "role: INSTRUCTOR required: true" +
         hand + "}\nseat { name: \"trainee\" role: TRAINEE required: " + (second ? "true" : "false") + hand +
         "}\ntool { name: \"tool\" k_s_n_m: 100 slave { model: LINEAR environment { wall { axis: X at_m: 0.01 k_n_m: "
         "5000 } } } }\n"
         "authority { tool: \"tool\" seat: \"trainer\" alpha: 0.5 } authority { tool: \"tool\" seat: \"trainee\" "
         "alpha: 0.5 }\n";
}

}  // namespace tandem::test
