#include "hal/io/motion_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/base/rng.h"
#include "hal/io/open_sim_device.h"

namespace tandem::hal {
namespace {

namespace fs = std::filesystem;

/// Files with the format of the shared recordings: same columns, steps and faults, invented motion.
class MotionFile : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("tandem_motion_" + std::to_string(getpid()));
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  std::string write(const char* name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  static std::string row(std::initializer_list<double> numbers) {
    std::string line;
    for (const double n : numbers) line += (line.empty() ? "" : ",") + std::to_string(n);
    return line + "\n";
  }
};

void expect_playable(const sim::RecordedMotion& m) {
  sim::RecordedMotion::Cursor c;
  double farthest = 0, fastest = 0;
  for (double t = 0; t <= m.duration() + 0.01; t += 1e-3) {
    const auto p = m.at(t, c);
    ASSERT_TRUE(p.x.allFinite() && p.v.allFinite());
    farthest = std::max(farthest, p.x.norm());
    fastest = std::max(fastest, p.v.norm());
  }
  EXPECT_LE(farthest, 0.061) << "splines may overshoot their points a little";
  EXPECT_GT(farthest, 0.005);
  std::printf("[ motion   ] %s, fastest %.3f m/s\n", m.describe().c_str(), fastest);
}

TEST_F(MotionFile, LoadsASyntheticArmLog) {
  std::string text = "t_s[s],q1_rad[rad],dq1_radps[rad/s],px_m[m],py_m[m],pz_m[m]\n";
  RandomStream r(1);
  double t = 0;
  for (int i = 0; i < 4000; ++i) {
    const double held = t - (r.uniform() < 0.26 ? 1e-3 : 0.0);  // sampled and held
    const auto at = [](double s) { return std::round(1e4 * (0.6 + 0.09 * std::sin(2.0 * s))) / 1e4; };
    text += row({t, 0.3, 0.001, at(held), 0.014, 0.03});
    t += r.uniform(0.4e-3, 2.7e-3);
  }
  const auto m = load_motion(*sim::parse_motion_options(write("arm.csv", text)));
  ASSERT_TRUE(m.has_value()) << m.error();
  EXPECT_NEAR((*m)->scale(), 0.06 / 0.09, 1e-3);
  EXPECT_GT((*m)->repeated(), 100u);
  expect_playable(**m);
}

TEST_F(MotionFile, LoadsASyntheticObjectHandover) {
  std::string text =
      "t_s[s],giver_fx_N[N],baton_x_m[m],baton_y_m[m],baton_z_m[m],baton_q0[1],hand_x_m[m],hand_y_m[m],hand_z_m[m]\n";
  for (int i = 0; i < 800; ++i) {
    const double s = i / 120.0;
    text += row({s, 1.0, 0.4 * std::sin(s), 0.1 * s, 0.8, 1.0, 0.1 * std::cos(s), 0.0, 0.9});
  }
  const std::string file = write("hand_over.csv", text);
  const auto unsure = load_motion(*sim::parse_motion_options(file));
  ASSERT_FALSE(unsure.has_value());
  EXPECT_NE(unsure.error().find("one of baton, hand"), std::string::npos) << unsure.error();
  const auto m = load_motion(*sim::parse_motion_options(file + ",columns=baton"));
  ASSERT_TRUE(m.has_value()) << m.error();
  expect_playable(**m);
}

TEST_F(MotionFile, OpensAsADevice) {
  const std::string file = write("line.csv", "t_s[s],px[m],py[m],pz[m]\n0,0,0,0\n1,0.04,0,0\n2,0,0,0\n");
  const auto d = open_sim_device("sim:motion=" + file + ",scale=0.5,end=loop", SimDeviceSpec{}, HandSpec{});
  ASSERT_TRUE(d.has_value()) << d.error().message;
  EXPECT_NE(d->note.find("scale 0.5"), std::string::npos) << d->note;
  for (int i = 0; i < 3000; ++i) {
    d->device->set_session_time(i * 1e-3);
    d->device->advance({}, std::chrono::milliseconds(1));
    if (i == 2000) {
      EXPECT_NEAR(d->device->ground_truth().x[0], -0.01, 1e-3) << "2 s: back at the start of the line";
    }
  }
}

TEST_F(MotionFile, LoadsTheSharedRecordings) {
  const char* traces = std::getenv("TANDEM_TRACES");
  if (traces == nullptr)
    GTEST_SKIP() << "TANDEM_TRACES, the folder of the shared recordings, is not set (./test --traces DIR)";
  const std::string base = std::string(traces) + "/";
  for (const auto& [text, scaled] : {std::pair{"motion_franka_teleop_follower_1khz_a.csv", true},
                                     {"motion_human_handover_120hz.csv,columns=baton", true},
                                     {"motion_human_handover_120hz.csv,columns=giver_hand", true},
                                     {"motion_human_handover_120hz.csv,columns=taker_hand,axes=-y+x+z", true},
                                     {"motion_panda_comanip_1khz.csv", true},
                                     {"motion_panda_comanip_1khz.csv,rec=1", true},
                                     {"motion_panda_comanip_1khz.csv,rec=2,end=loop", true}}) {
    SCOPED_TRACE(text);
    const auto m = load_motion(*sim::parse_motion_options(base + text));
    ASSERT_TRUE(m.has_value()) << m.error();
    EXPECT_EQ((*m)->scale() < 1.0, scaled);
    expect_playable(**m);
  }
  const auto unsure = load_motion(*sim::parse_motion_options(base + "motion_human_handover_120hz.csv"));
  ASSERT_FALSE(unsure.has_value());
  EXPECT_NE(unsure.error().find("baton, giver_hand, taker_hand"), std::string::npos) << unsure.error();
}

}  // namespace
}  // namespace tandem::hal
