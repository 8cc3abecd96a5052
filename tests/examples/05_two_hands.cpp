// Two hands on one tool, in virtual time: the trainer leads, the trainee follows by a soft hand and gets half of the
// authority after 4 s. The report says what each of them felt, and which invariants were violated.
//
// Prints:
//   pass: 0 violations in 8 s
//   trainer: authority 0.77, tool within 2.0 mm, at most 1.4 N
//   trainee: authority 0.23, tool within 2.3 mm, at most 0.7 N
#include <tandem/netsim.h>

#include <cstdio>

using namespace tandem;

constexpr const char* kScene = R"(
  version: 1
  duration_s: 8
  seat {
    name: "trainer" role: INSTRUCTOR required: true device { model: TOUCH }
    hand { model: LEADER trajectory { circle { radius_m: 0.03 frequency_hz: 0.5 normal: Y } } }
  }
  seat { name: "trainee" role: TRAINEE required: true device { model: TOUCH } hand { model: RELAXED } }
  tool { name: "tool" slave { } }
  authority { tool: "tool" seat: "trainer" alpha: 1 }
  timeline {
    at_s: 4
    authority { tool: "tool" seat: "trainer" alpha: 0.5 }
    authority { tool: "tool" seat: "trainee" alpha: 0.5 }
  }
)";

int main() {
  const auto scene = parse_scene(kScene, "two_hands.textproto");
  const auto network = netsim::shipped_profile("wifi-good");
  if (!scene) return std::fputs(to_text(scene.error()).c_str(), stderr), 1;
  const netsim::SimulationResult result =
      netsim::run_simulation({.scene = *scene, .network = network->link, .seed = 7});
  if (!result.trouble.empty()) return std::fprintf(stderr, "%s\n", result.trouble.c_str()), 1;
  const netsim::RunReport& report = result.report;
  std::printf("%s: %zu violations in %.0f s\n", report.verdict(), report.violations.size(), report.duration_s);
  for (const netsim::SeatReport& seat : report.seats)
    std::printf("%s: authority %.2f, tool within %.1f mm, at most %.1f N\n", seat.name.c_str(), seat.alpha_mean,
                1e3 * seat.metrics.tracking_rms_m, seat.metrics.effort_peak_n);
}
