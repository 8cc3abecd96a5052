// Compares channel laws and flow source modes with the same hands, networks and seeds. The table is the basis for the
// choice of defaults.
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "proto/text/scene_text.h"
#include "tests/support/simulation_run.h"

namespace {

using namespace tandem;

struct Choice {
  const char* name;
  LawKind law;
  MfsMode mfs;
};
constexpr Choice kChoices[] = {{"replica, open", LawKind::kReplica, MfsMode::kOpen},
                               {"replica, tank", LawKind::kReplica, MfsMode::kTank},
                               {"set_position, open", LawKind::kSetPosition, MfsMode::kOpen},
                               {"set_position, tank", LawKind::kSetPosition, MfsMode::kTank},
                               {"set_position, seed", LawKind::kSetPosition, MfsMode::kSeed},
                               {"set_position, seed_signed", LawKind::kSetPosition, MfsMode::kSeedSigned},
                               {"tdpa, open", LawKind::kTdpa, MfsMode::kOpen},
                               {"wave, open", LawKind::kWave, MfsMode::kOpen},
                               {"pd, open", LawKind::kPd, MfsMode::kOpen},
                               {"raw, open", LawKind::kRaw, MfsMode::kOpen}};

/// Hand of the follower: damping b [N s/m], stiffness k [N/m]. The scene defines the hand of the leader.
struct Hand {
  const char* name;
  double b, k;
};
constexpr Hand kHands[] = {{"b 2", 2, 0}, {"b 6", 6, 0}, {"b 5 k 50", 5, 50}};

struct Mean {
  double sum = 0;
  int n = 0;
  void add(double v) {
    if (std::isfinite(v)) sum += v, ++n;
  }
  [[nodiscard]] double value() const { return n == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / n; }
};

}  // namespace

int main() {
  const std::vector<double> delays{0, 20, 100};
  std::printf(
      "free motion, demonstration phase, mean over %zu follower hands: leader - slave / follower - slave RMS [mm], "
      "broken promises\n",
      std::size(kHands));
  std::printf("%-27s", "law, flow sources");
  for (const double d : delays) std::printf("  %8.0f ms one way  ", d);
  std::printf("  ledger\n");
  double reference = 0;
  for (const Choice& c : kChoices) {
    std::printf("%-27s", c.name);
    std::string ledger = "kept";
    for (const double d : delays) {
      Mean leader, follower;
      for (const Hand& h : kHands) {
        SceneSpec scene = (c.law == LawKind::kReplica ? test::shipped : test::set_position)("free_motion");
        choose_law(scene, c.law);
        scene.channel.mfs = c.mfs;
        scene.duration = 11.5;
        scene.timeline.clear();
        scene.seats[1].hand.deviations.clear();
        scene.seats[1].hand.relaxed_b = h.b;
        if (h.k > 0) {
          scene.seats[1].hand.model = HandModel::kResting;
          scene.seats[1].hand.from = 0;
          scene.seats[1].hand.k = h.k;
          scene.seats[1].hand.b = h.b;
        }
        const auto r = test::run(scene, test::delayed(d));
        leader.add(1e3 * r.phase("demonstration", "trainer").tracking_rms_m);
        follower.add(1e3 * r.phase("demonstration", "trainee").tracking_rms_m);
        for (const auto& v : r.report.violations)
          if (v.invariant == "ledger" || v.invariant == "energy_monotone")
            ledger = v.expected ? "broken, never promised" : "BROKEN";
      }
      if (reference == 0) reference = leader.value();
      std::printf("  %5.1f / %5.1f (%4.1f)", leader.value(), follower.value(), leader.value() / reference);
    }
    std::printf("  %s\n", ledger.c_str());
  }
  std::printf("in brackets: leader - slave as a multiple of the first number\n");
  return 0;
}
