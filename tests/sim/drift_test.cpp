// A client whose clock runs fast for hours, to find errors that accumulate. 8 hours at 200 ppm make 5.8 s of difference
// between the clocks. The shorter runs use 1000 ppm, the largest drift of an endpoint.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "tests/common/base/counts.h"
#include "tests/sim/session_driver.h"

namespace tandem {
namespace {

using namespace std::chrono_literals;

struct DriftRun {
  Duration length;
  double ppm;
};

DriftRun by_counts() {
  constexpr std::array<DriftRun, 3> kRuns{{{5min, 1000}, {96min, 1000}, {8h, 200}}};
  return kRuns[test::draws(0, 1, 2)];
}

/// Numbers of one seat in a part of the session.
struct Part {
  Duration loop_age_max{};  ///< limited by its gate
  Duration age_max{};       ///< of the newest FORCE, one way, from the transit times of both clocks
  double gap_max = 0;       ///< between a hand and its tool [m]
  double refused = 0;       ///< energy that the spring requested and the client's ledger did not have [J]
};

void live_with_drift(SceneSpec scene) {
  const DriftRun planned = by_counts();
  for (SeatSpec& s : scene.seats) s.hand.deviations.clear();
  scene.timeline.clear();
  scene.duration = seconds(planned.length);
  // The trainer moves all the time, the trainee never. Each uses its own clock, which gains seconds on the session's
  // clock.
  scene.seats[0].hand.until = 2 * scene.duration;
  scene.seats[1].hand.from = 2 * scene.duration;
  scene.phases = {{"all", 1, scene.duration, false}};
  netsim::SimulationConfig setup = test::with(scene);
  setup.network = netsim::link_from(test::delayed(1));
  setup.endpoints["trainee"].drift_ppm = planned.ppm;
  setup.endpoints["trainer"].drift_ppm = -0.1 * planned.ppm;
  test::SessionDriver life{std::move(setup)};

  constexpr std::size_t kParts = 10;
  std::array<std::vector<Part>, kParts> parts;
  for (auto& part : parts) part.resize(2);
  life.until(5s);
  const Duration begin = life.at();
  double way = 0;
  std::array<double, 2> refused{};
  for (std::size_t i = 0; i < 2; ++i) refused[i] = life.simulation->record().seats[i].refused_j;
  hal::Vec3 last = life.simulation->device(0).ground_truth().x;
  while (life.step() && life.at() < begin + planned.length - 6s) {
    const auto part =
        static_cast<std::size_t>(static_cast<double>(kParts) * seconds(life.at() - begin) / seconds(planned.length));
    const server::TickRecord& record = life.simulation->record();
    if (!record.running) continue;
    const hal::Vec3 now = life.simulation->device(0).ground_truth().x;
    way += (now - last).norm();
    last = now;
    for (std::size_t i = 0; i < 2; ++i) {
      Part& p = parts[part][i];
      const server::SeatRecord& seat = record.seats[i];
      const transport::LinkTiming& freshness = life.simulation->seat(i)->link().timing();
      const Time own = life.simulation->client(i).own_time(life.simulation->now());
      p.loop_age_max = std::max(p.loop_age_max, freshness.loop_age(own));
      p.age_max = std::max(p.age_max, freshness.age(own));
      p.gap_max = std::max(
          p.gap_max, (life.simulation->device(i).ground_truth().x - hal::Vec3(record.tools[0].x_tool.data())).norm());
      p.refused += seat.refused_j - refused[i];
      refused[i] = seat.refused_j;
      ASSERT_TRUE(life.active(i)) << "seat " << i << " at " << seconds(life.at()) << " s";
    }
  }
  EXPECT_GT(way, 0.01 * seconds(planned.length)) << "no hand moved [m]";
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(life.simulation->seat(i)->gate().trips(), 0u);
    std::printf(
        "[  drift   ] seat %zu, %.0f s at %.0f ppm: loop age at most %.1f ms in the first tenth, %.1f ms in the last; "
        "one way %.1f, %.1f ms; gap %.2f, %.2f mm; refused %.4f, %.4f J\n",
        i, seconds(planned.length), planned.ppm, 1e3 * seconds(parts[0][i].loop_age_max),
        1e3 * seconds(parts[kParts - 1][i].loop_age_max), 1e3 * seconds(parts[0][i].age_max),
        1e3 * seconds(parts[kParts - 1][i].age_max), 1e3 * parts[0][i].gap_max, 1e3 * parts[kParts - 1][i].gap_max,
        parts[0][i].refused, parts[kParts - 1][i].refused);
    const Part& first = parts[0][i];
    for (std::size_t part = 0; part < kParts; ++part) {
      SCOPED_TRACE(part);
      const Part& p = parts[part][i];
      EXPECT_LE(p.loop_age_max, 4ms) << "1 ms each way and two ticks";
      // The one-way delay is relative to the fastest datagram of the last 10 s or less. The clocks diverge during that
      // time.
      EXPECT_LE(p.age_max, 4ms + std::chrono::duration_cast<Duration>(
                                     std::chrono::duration<double>(1.1 * 10 * 1e-6 * planned.ppm)));
      EXPECT_LE(p.gap_max, 1.5 * first.gap_max) << "[m]";
      EXPECT_LE(p.gap_max, 0.01) << "[m]";
      EXPECT_LE(p.refused, 1.5 * first.refused + 1e-3 * seconds(planned.length) / kParts) << "[J]";
    }
  }
  life.expect_nothing_broken();
}

TEST(Drift, KeepsHandsEngagedForHoursOfClockDrift) {
  for (const SceneSpec& scene : test::under_both_laws("free_motion")) live_with_drift(scene);
}

}  // namespace
}  // namespace tandem
