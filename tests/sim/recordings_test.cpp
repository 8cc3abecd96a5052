// Recorded human motion as a hand. The real files are used when TANDEM_TRACES names their folder; synthetic files with
// the same columns always.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "hal/sim/recorded_motion.h"
#include "tests/support/simulation_run.h"

namespace tandem {
namespace {

struct Recording {
  const char* file;     ///< of the shared recordings
  const char* options;  ///< options that a user has to add
  const char* header;   ///< of the synthetic file
  double step_s;
  int columns_before;  ///< columns between time and the position triple
  int columns_after;
};

// Columns as in the recordings: columns similar to the position triple surround it.
constexpr Recording kRecordings[] = {
    {"motion_franka_teleop_follower_1khz_a.csv", "",
     "t_s[s],q1_rad[rad],dq1_radps[rad/s],tauext1_Nm[N*m],px_m[m],py_m[m],pz_m[m]", 0.00105, 3, 0},
    {"motion_human_handover_120hz.csv", ",columns=baton",
     "t_s[s],giver_fx_N[N],baton_x_m[m],baton_y_m[m],baton_z_m[m],baton_q0[1],giver_hand_x_m[m],giver_hand_y_m[m],"
     "giver_hand_z_m[m]",
     1.0 / 120, 1, 4},
    {"motion_panda_comanip_1khz.csv", "", "rec[1],t_s[s],px_m[m],py_m[m],pz_m[m],vx_mps[m/s],fx_N[N]", 0.001, -1, 2},
};

std::string look_alike(const Recording& r) {
  std::ostringstream out;
  out << r.header << "\n";
  for (int k = 0; k * r.step_s < 6; ++k) {
    const double t = k * r.step_s + (k % 7 == 0 ? 0.1 * r.step_s : 0);  // jitter of the logger
    const auto position = [&](std::ostringstream& o) {
      o << "," << 0.5 + 0.2 * std::sin(1.3 * t) << "," << -0.1 + 0.1 * std::sin(2.1 * t) << ","
        << 0.8 + 0.05 * std::sin(0.7 * t);
    };
    if (r.columns_before < 0) out << "0,";
    out << t;
    for (int c = 0; c < r.columns_before; ++c) out << ",0.5";
    position(out);
    for (int c = 0; c < r.columns_after; ++c) out << ",0.25";
    out << "\n";
  }
  return out.str();
}

void expect_followed(const std::string& csv, const Recording& r, const std::string& name) {
  const auto options = hal::sim::parse_motion_options(name + r.options);
  ASSERT_TRUE(options) << options.error();
  auto motion = hal::sim::RecordedMotion::parse(csv, *options, name);
  ASSERT_TRUE(motion) << motion.error();
  EXPECT_GT(motion->duration(), 5.0);
  SceneSpec scene = test::shipped("free_motion");
  scene.duration = 5;
  scene.timeline.clear();
  scene.phases = {{"run", 1, 5, false}};
  auto made = netsim::Simulation::make({scene,
                                        netsim::link_from(test::delayed(10)),
                                        1,
                                        {{"trainer", std::make_shared<hal::sim::RecordedMotion>(std::move(*motion))}}});
  ASSERT_TRUE(made) << made.error();
  netsim::Simulation& simulation = **made;
  server::ReportBuilder builder{simulation.scene()};
  while (simulation.step()) builder.add(simulation.record());
  const auto report = netsim::simulation_report(simulation, builder, 1);
  EXPECT_TRUE(report.passed) << name;
  EXPECT_GT(report.seats[0].metrics.speed_peak_m_s, 0.01) << name << " did not move the hand";
  EXPECT_LE(report.seats[0].metrics.tracking_rms_m, 0.005) << name;
}

TEST(Recordings, LookAlikesOfEveryRecordingMoveAHand) {
  for (const Recording& r : kRecordings) expect_followed(look_alike(r), r, r.file);
}

TEST(Recordings, EverySharedRecordingMovesAHand) {
  const char* folder = std::getenv("TANDEM_TRACES");
  if (folder == nullptr)
    GTEST_SKIP() << "TANDEM_TRACES, the folder of the shared recordings, is not set (./test --traces DIR)";
  for (const Recording& r : kRecordings) {
    const std::string path = std::string(folder) + "/" + r.file;
    if (!std::filesystem::exists(path)) {
      std::printf("[ NOT RUN ] %s: no --traces folder with it; its look-alike ran in Recordings.LookAlikes\n", r.file);
      continue;
    }
    std::ifstream in{path};
    std::ostringstream text;
    text << in.rdbuf();
    expect_followed(text.str(), r, r.file);
  }
}

}  // namespace
}  // namespace tandem
