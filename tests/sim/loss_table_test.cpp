// The table of link loss in contact (tests/FAILURES.md): five forces and devices, three kinds of hands, both laws. Law
// `replica` continues its force through a gap that its gate tolerates; its loss is therefore detected later. The limit
// of energy after the last fresh datagram is the same tank. The same table with a killed server:
// tests/io/restart_loss_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/base/format.h"
#include "proto/text/scene_text.h"
#include "tests/sim/session_driver.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;
using test::SessionDriver;

struct Case {
  const char* seat;
  double force_n, mass_kg;
};
constexpr std::array<Case, 5> kCases{
    {{"a", 0.5, 0.05}, {"b", 3.3, 0.05}, {"c", 3.3, 0.1}, {"d", 7.9, 0.15}, {"e", 20, 0.4}}};
/// A hand that opens at the loss; one that opens while 3 N drag the handle in the motor's direction; one that rests
/// (the published fit: 0.55 kg, 6.45 N s/m, 135 N/m).
enum class Grip { kReleased, kDragged, kResting };
constexpr std::array kGrips{Grip::kReleased, Grip::kDragged, Grip::kResting};

constexpr double kWall = -0.15;      // [m], so that the intended position of a soft hand is within the scene's range
constexpr double kTooFast = 1.5;     // [m/s], above which a hand is released on every network
constexpr std::size_t kAround = 10;  // ticks of a speed; the gate damps the device's filtered speed
constexpr double kLoss = 5;          // [s] of the session, approximate time of the cut
constexpr double kDrag = 3;          // [N]
constexpr double kBelowTank = 1e-3;  // [J] within one tick
constexpr double kDamping = 5;       // [N s/m] that remains when the force is gone
constexpr double kSilence = 0.020, kRamp = 0.100;  // [s]

double tank(double mass_kg) { return std::min(0.100, std::max(0.020, 0.180 * mass_kg)); }

/// Returns one hand alone on the tool, which is at the wall at 0. @param opens  session time at which the hand opens
/// [s]
SceneSpec scene_of(LawKind law, const Case& c, Grip grip, double opens) {
  const bool resting = grip == Grip::kResting;
  const double hand = resting ? 135 : 1000;
  const double springs =
      law == LawKind::kReplica ? 1 / (1 / 400.0 + 1 / 20000.0) : 1 / (1 / 400.0 + 1 / 1500.0 + 1 / 400.0 + 1 / 20000.0);
  const std::string motion = format("trajectory { waypoint { at_s: 0.5 x_m: %g } waypoint { at_s: 3 x_m: %.6f } }",
                                    kWall, kWall + c.force_n / hand + c.force_n / springs);
  const std::string model = resting ? "LEADER k_n_m: 135 b_n_s_m: 6.45 m_kg: 0.55 "
                                    : format("LETTING_GO release_at_s: %.4f drags_n { x: %g } ", opens,
                                             grip == Grip::kDragged ? -kDrag : 0.0);
  const std::string slave =
      law == LawKind::kReplica ? "" : "model: LINEAR friction_n: 0 encoder_m: 0 force_peak_n: 40 ";
  const auto scene = parse_scene(
      format("version: 1 dof: 1 tick_hz: 1000 duration_s: 8 unsafe_gains: true\nchannel { law: %s k_min_n_m: 200 }\n"
             "device_coupling { k_c_n_m: 400 b_n_s_m: 2 m_c_kg: 0.02 }\ngate { silence_limit_ms: 20 loop_age_max_ms: "
             "2500 latch: false force_max_n: 40 }\n"
             "seat { name: \"hand\" kind: MASTER role: INSTRUCTOR device { model: LINEAR mass_kg: %g friction_n: 0 "
             "damping_n_s_m: 0.05 encoder_m: 0 force_peak_n: 40 start_m { x: %g } } ",
             law == LawKind::kReplica ? "REPLICA" : "SET_POSITION", c.mass_kg, kWall) +
          "hand { model: " + model + motion + " } }\ntool { name: \"tool\" k_s_n_m: 400 b_s_n_s_m: 0.5 slave { " +
          slave +
          format("start_m { x: %g } environment { wall { axis: X at_m: %g k_n_m: 20000 } } } }\n", kWall, kWall) +
          "authority { tool: \"tool\" seat: \"hand\" alpha: 1 }\n",
      "loss.textproto");
  if (!scene) throw std::runtime_error(to_text(scene.error()));
  return *scene;
}

struct Loss {
  double pressed_n = 0, energy_j = 0, beyond_m = 0, counted_j = 0;
  Duration seen{};    ///< from the last fresh datagram until the gate detected the loss
  double left_n = 0;  ///< beyond the damping, when the force must be gone
  double speed = 0;   ///< largest until `seen` [m/s]
};

/// @param replayed  an attacker replays every earlier datagram while the network is cut
Loss lose(LawKind law, const Case& c, Grip grip, Duration cut, bool replayed) {
  SceneSpec scene = scene_of(law, c, grip, 1e6);
  double opens = 0;
  {  // session time at the cut
    SessionDriver rehearsal{test::with(scene)};
    rehearsal.until(cut);
    opens = rehearsal.simulation->session().clock().time();
  }
  scene = scene_of(law, c, grip, opens);
  const double limit = silence_limits(scene.gate, law, 1).most;
  netsim::SimulationConfig setup = test::with(scene);
  netsim::OutageSpec outage;
  outage.start = cut;
  outage.length = 2s;
  setup.network.up.outages = setup.network.down.outages = {outage};
  if (replayed) setup.faults = {{netsim::Fault::Kind::kReplay, "hand", cut, 1500ms}};
  SessionDriver life{setup};
  life.until(cut);
  EXPECT_TRUE(life.active(0));
  Loss out;
  out.pressed_n = std::abs(life.before[0][0]);
  const double target =
      life.simulation->device(0).ground_truth().x[0] + out.pressed_n / (grip == Grip::kResting ? 135 : 1000);
  std::array<double, kAround> speeds{};
  std::size_t tick = 0;
  double given = 0, x = life.simulation->device(0).ground_truth().x[0];
  while (life.at() < cut + 1400ms) {
    life.step();
    const Duration into = life.at() - cut;
    const double now = life.simulation->device(0).ground_truth().x[0];
    speeds[tick++ % kAround] = std::abs(life.simulation->device(0).ground_truth().dx[0]);
    const double v = std::ranges::max(speeds);
    if (out.seen == Duration{}) out.speed = std::max(out.speed, v);
    given += life.before[0][0] * (now - x);
    x = now;
    out.energy_j = std::max(out.energy_j, given);
    out.beyond_m = std::max(out.beyond_m, now - target);
    if (out.seen == Duration{} && !life.active(0)) out.seen = into;
    if (seconds(into) > limit + kRamp + 0.003)
      out.left_n = std::max(out.left_n, std::abs(life.before[0][0]) - kDamping * v);
  }
  out.counted_j = life.simulation->seat(0)->gate().tank().given_max();
  // A hand that the motor and 3 N accelerate too much is released for its speed, before its silence counts as a loss.
  EXPECT_EQ(life.simulation->seat(0)->gate().trips(), out.seen < from_seconds(limit) && out.speed > kTooFast ? 0u : 1u);
  life.expect_nothing_broken();
  return out;
}

void judge(Grip grip, bool replayed) {
  const char* const name = grip == Grip::kReleased ? "released" : grip == Grip::kDragged ? "dragged" : "resting";
  for (const LawKind law : {LawKind::kReplica, LawKind::kSetPosition})
    for (const Case& c : kCases) {
      double most = 0, pressed = 0, beyond = 0;
      Duration seen_last{};
      for (const Duration phase : {0us, 300us, 700us}) {  // of the cut within a tick
        SCOPED_TRACE(format("%s %s %g N %g kg", law == LawKind::kReplica ? "replica" : "set_position", name, c.force_n,
                            c.mass_kg));
        const Loss loss = lose(law, c, grip, from_seconds(kLoss) + phase, replayed);
        const Duration limit = from_seconds(law == LawKind::kReplica ? GateSpec{}.local_hold : kSilence);
        EXPECT_NEAR(loss.pressed_n, c.force_n, 0.15 * c.force_n + 0.1)
            << "pressed as it should, or the table is not the table";
        if (loss.speed <= kTooFast) {
          EXPECT_GT(loss.seen, limit - 3ms);
        }
        EXPECT_LE(loss.seen, limit + 3ms);
        EXPECT_LE(loss.energy_j, tank(c.mass_kg) + kBelowTank);
        EXPECT_LE(loss.counted_j, tank(c.mass_kg) + kBelowTank);
        EXPECT_LE(loss.left_n, 0.05) << "the remaining force is damping only";
        most = std::max(most, loss.energy_j);
        beyond = std::max(beyond, loss.beyond_m);
        pressed = loss.pressed_n;
        seen_last = loss.seen;
      }
      std::printf(
          "[  figures ] %-12s %-8s %4.1f N %.2f kg: pressed %5.2f N, seen after %3.0f ms, %5.1f of %3.0f mJ, beyond "
          "its target %.1f mm\n",
          law == LawKind::kReplica ? "replica" : "set_position", name, c.force_n, c.mass_kg, pressed,
          1e3 * seconds(seen_last), 1e3 * most, 1e3 * tank(c.mass_kg), 1e3 * beyond);
    }
}

TEST(LossTable, ReleasedHandsGetNoMoreThanTheTank) { judge(Grip::kReleased, false); }
TEST(LossTable, DraggedHandlesGetNoMoreThanTheTank) { judge(Grip::kDragged, false); }
TEST(LossTable, RestingHandsGetNoMoreThanTheTank) { judge(Grip::kResting, false); }
TEST(LossTable, ReplayedDatagramsGiveNoMore) {
  for (const Grip grip : kGrips) judge(grip, true);
}

}  // namespace
}  // namespace tandem
