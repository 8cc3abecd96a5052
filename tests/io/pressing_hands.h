#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/io/traces.h"

/// Two simulated hands that press a tool against a wall, and the absences of their server in their traces.
namespace tandem::test {

/// Gate states as in traces (wire::GateState).
enum Gate { kZero = 1, kRampIn = 2, kActive = 3, kPassive = 4 };

/// Two hands press the tool against a wall from 3 s on; both have authority.
inline std::string pressing(const std::string& more = "") {
  const auto seat = [](const std::string& name, const std::string& role) {
    return "seat { name: \"" + name + "\" kind: MASTER role: " + role +
           " required: true device { model: TOUCH friction_n: 0.1 start_m { x: -0.02 } } hand { model: LEADER "
           "trajectory { "
           "waypoint { at_s: 0.5 x_m: -0.02 } waypoint { at_s: 1.5 x_m: 0 } waypoint { at_s: 3 x_m: 0.012 } } } }\n";
  };
  return "version: 1 tick_hz: 1000 dof: 3 port: TIP duration_s: 3000\nchannel { law: SET_POSITION mfs: OPEN k_n_m: "
         "1500 }\n"
         "device_coupling { k_c_n_m: 400 b_n_s_m: 0.5 m_c_kg: 0.02 }\ngate { silence_limit_ms: 20 loop_age_max_ms: "
         "2500 latch: false }\n" +
         seat("trainer", "INSTRUCTOR") + seat("trainee", "TRAINEE") +
         "tool { name: \"tool\" k_s_n_m: 400 m_s_kg: 0.05 b_s_n_s_m: 0.2 slave { model: TOUCH friction_n: 0.1 start_m "
         "{ x: -0.02 } "
         "environment { wall { axis: X at_m: 0 k_n_m: 20000 } } } }\n"
         "authority { tool: \"tool\" seat: \"trainer\" alpha: 0.5 }\nauthority { tool: \"tool\" seat: \"trainee\" "
         "alpha: 0.5 }\n" +
         more;
}

/// One absence of the server, from a seat's trace.
struct Absence {
  double free_s = 0;      ///< from the gate's release until the force began to come up again
  double back_s = 0;      ///< from the gate's release until it was fully active again
  double first_n = 0;     ///< motor force in the first tick of the return, the largest if it began again
  double jump_mm = 0;     ///< of the tip, between two ticks around the return
  double beyond_n = 0;    ///< force in the first 500 ms above the maximum before
  double forward_mm = 0;  ///< motion of the hand in the 300 ms after the release
};
inline std::vector<Absence> absences(const Trace& t) {
  std::vector<Absence> out;
  const auto gate = [&](std::size_t i) { return static_cast<int>(t.at(i, "gate")); };
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (gate(i - 1) != kActive || gate(i) != kPassive) continue;
    Absence a;
    double before = 0;
    for (std::size_t k = i > 500 ? i - 500 : 0; k < i; ++k) before = std::max(before, norm(t.triple(k, "f_gate_")));
    for (std::size_t k = i; k < t.size() && t.at(k, "t_s") < t.at(i, "t_s") + 0.3; ++k)
      a.forward_mm = std::max(a.forward_mm, 1e3 * distance(t.triple(k, ""), t.triple(i, "")));
    std::size_t k = i;
    while (k < t.size() && gate(k) != kRampIn) ++k;
    if (k == t.size()) break;
    a.first_n = norm(t.triple(k, "f_gate_"));
    a.free_s = t.at(k, "t_s") - t.at(i, "t_s");
    for (std::size_t m = k; m < t.size() && t.at(m, "t_s") < t.at(k, "t_s") + 0.5; ++m) {
      // Ticks that this machine skipped.
      const double missed = std::max(1.0, (t.at(m, "t_s") - t.at(m - 1, "t_s")) / 1e-3);
      a.jump_mm = std::max(a.jump_mm, 1e3 * distance(t.triple(m, ""), t.triple(m - 1, "")) / missed);
      a.beyond_n = std::max(a.beyond_n, norm(t.triple(m, "f_gate_")) - before);
    }
    // A return may be cut short, by a new connection of the client; the next one begins at zero too.
    while (k < t.size() && gate(k) != kActive) {
      if (gate(k) == kRampIn && gate(k - 1) != kRampIn) a.first_n = std::max(a.first_n, norm(t.triple(k, "f_gate_")));
      ++k;
    }
    if (k == t.size()) break;
    a.back_s = t.at(k, "t_s") - t.at(i, "t_s");
    out.push_back(a);
    i = k;
  }
  return out;
}

inline void print(const char* what, std::vector<double> v) {
  std::ranges::sort(v);
  double sum = 0;
  for (const double x : v) sum += x;
  const double n = static_cast<double>(v.size());
  std::printf("[  figures ] %-46s min %.3f median %.3f mean %.3f max %.3f (%zu)\n", what, v.front(), v[v.size() / 2],
              sum / n, v.back(), v.size());
}

}  // namespace tandem::test
