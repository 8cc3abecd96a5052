#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "netsim/demo/app/joint_torques.h"
#include "netsim/demo/measure.h"
#include "netsim/demo/trace_data.h"

namespace tandem::netsim::demo {
namespace {

const std::string kHeader = [] {
  std::string h = "tick[1],t_s[s]";
  const auto triple = [&](const std::string& stem, const std::string& unit) {
    for (const char* a : {"x", "y", "z"}) h += "," + stem + a + unit;
  };
  for (const std::string seat : {"trainer", "trainee"}) {
    h += "," + seat + ".alpha[1]";
    for (const char* j : {"0", "1", "2"}) h += "," + seat + ".q" + j + "[rad]";
    triple(seat + ".", "[m]");
    triple(seat + ".f_cmd_", "[N]");
    triple(seat + ".f_out_", "[N]");
    h += "," + seat + ".e_in0[nJ]";
  }
  for (const char* j : {"0", "1", "2"}) h += std::string(",tool.q") + j + "[rad]";
  triple("tool.", "[m]");
  triple("tool.f_cmd_", "[N]");
  triple("tool.f_env_", "[N]");
  for (const char* j : {"0", "1", "2"}) h += std::string(",tool.e_p") + j + "[J]";
  return h + "\n";
}();

std::string row(int tick) {
  std::ostringstream line;
  line << tick << ',' << tick * 1e-3;
  for (int column = 2; column < 45; ++column) line << ',' << column;
  line << '\n';
  return line.str();
}

/// Returns a leader who presses on a wall at x = 0 with 250 N/m and 12 N s/m, and holds 36 mm depth from 6 s on.
TraceData pressing() {
  TraceData d;
  for (int k = 0; k < 20'000; ++k) {
    const double t = k * 1e-3, s = std::clamp((t - 3) / 3, 0.0, 1.0);
    const double x = 0.036 * s * s * (3 - 2 * s), v = s > 0 && s < 1 ? 0.036 * 6 * s * (1 - s) / 3 : 0;
    const double force = 250 * x + 12 * v;
    d.t.push_back(t);
    d.trainer.x[0].push_back(x);
    d.trainee.x[0].push_back(t < 13 ? 0 : x - 0.002);
    d.tool.x[0].push_back(0);
    d.trainer.f_cmd[0].push_back(-force);
    d.trainer.f_out[0].push_back(-force);
    d.trainee.f_cmd[0].push_back(-force + 0.2);
    d.trainee.f_out[0].push_back(-force + 0.2);
    d.tool.f_cmd[0].push_back(force);
    d.tool.f_env[0].push_back(-force);
  }
  return d;
}

TEST(ReadTrace, ReadsColumnsByNameAndSkipsOthers) {
  const auto data = read_trace(kHeader + row(0) + row(1));
  ASSERT_TRUE(data) << data.error();
  EXPECT_EQ(data->rows(), 2u);
  EXPECT_DOUBLE_EQ(data->t[1], 0.001);
  EXPECT_DOUBLE_EQ(data->trainer.alpha[0], 2);
  EXPECT_DOUBLE_EQ(data->trainer.f_out[2][0], 14);
  EXPECT_DOUBLE_EQ(data->trainee.alpha[0], 16) << "trainer.e_in0 lies between";
  EXPECT_DOUBLE_EQ(data->tool.e_p[2][1], 44) << "the last column";
}

TEST(ReadTrace, NamesMissingColumns) {
  const auto none = read_trace("tick[1],t_s[s]\n0,0\n");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().find("tool.e_p0"), std::string::npos) << none.error();
  EXPECT_FALSE(read_trace(""));
  const auto empty = read_trace(kHeader);
  ASSERT_FALSE(empty);
  EXPECT_NE(empty.error().find("no rows"), std::string::npos);
  EXPECT_FALSE(read_trace(kHeader + "0,0\n")) << "a short row";
}

TEST(ReadTrace, ReadsNonNumbersAsNaN) {
  std::string text = row(3);
  text.replace(text.find(",2,"), 3, ",nan,");
  const auto data = read_trace(kHeader + text);
  ASSERT_TRUE(data) << data.error();
  EXPECT_TRUE(std::isnan(data->trainer.alpha[0]));
}

TEST(ReadSamples, KeepTheSessionAndMatchTheRowsOfTheTrace) {
  std::string text =
      "t_s[s],q0[rad],q1[rad],q2[rad],x[m],y[m],z[m],f_cmd_x[N],f_cmd_y[N],f_cmd_z[N],f_out_x[N],f_out_y[N],f_out_z[N]"
      "\n";
  for (const double t : {-0.002, -0.001, 0.0004, 0.0014, 0.0024}) {
    std::ostringstream line;
    line << t;
    for (int c = 0; c < 12; ++c) line << ',' << 100 * t;
    text += line.str() + "\n";
  }
  const auto own = read_samples(text);
  ASSERT_TRUE(own) << own.error();
  EXPECT_EQ(own->t.size(), 3u) << "rows before the session are omitted";
  SeatTrace seat;
  for (Column3* c : {&seat.q, &seat.x, &seat.f_cmd, &seat.f_out}) c->fill(Column(4, 7.0));
  put_samples({0.0, 0.001, 0.002, 0.9}, *own, seat);
  EXPECT_NEAR(seat.x[0][1], 0.1, 1e-12) << "interpolated";
  EXPECT_NEAR(seat.x[0][0], 0.04, 1e-12) << "the nearest at the end";
  EXPECT_TRUE(std::isnan(seat.f_out[2][3])) << "nothing is known there";
}

TEST(RenderedStiffness, ExcludesTheDamper) {
  const TraceData d = pressing();
  EXPECT_NEAR(rendered_stiffness(d), 250, 0.5);
  EXPECT_NEAR(held_stiffness(d), 250, 1e-6);
}

TEST(RenderedStiffness, IsUnknownWithoutContact) {
  TraceData d = pressing();
  for (double& f : d.tool.f_env[0]) f = 0;
  EXPECT_TRUE(std::isnan(rendered_stiffness(d)));
}

TEST(ForceErrorX, IsTheDifferenceAgainstTheSlave) {
  const TraceData d = pressing();
  const ForceError leader = force_error_x(d, d.trainer, 5, 20, false),
                   follower = force_error_x(d, d.trainee, 13, 20, true);
  EXPECT_NEAR(leader.rms_n, 0, 1e-12);
  EXPECT_NEAR(follower.rms_n, 0.2, 1e-9);
  EXPECT_NEAR(follower.percent, 100 * 0.2 / 9.054, 0.05);
  const TraceNumbers n = measure(run_plan(Task::kContact, Setting::kDefaults), d);
  EXPECT_NEAR(n.aligned_x_m, 0.002, 1e-12);
}

TEST(ForceStep, IsTheLargestOfBothHandsWhileAlphaMoves) {
  TraceData d;
  for (int k = 0; k < 18'000; ++k) {
    const double t = k * 1e-3;
    d.t.push_back(t);
    d.trainer.alpha.push_back(t < 11.5 ? 1 : std::max(0.0, 12.5 - t));
    for (std::size_t a = 0; a < 3; ++a) {
      d.trainer.f_cmd[a].push_back(a == 0 && t >= 12.2 ? 0.15 : 0);
      d.trainee.f_cmd[a].push_back(a == 1 && t >= 14 ? 5 : 0);  // too late to count
    }
  }
  EXPECT_NEAR(force_step(d), 0.15, 1e-12);
  d.trainer_own.t = {12.0, 12.001, 12.002};
  d.trainer_own.f_cmd = {Column{0, 0.05, 0.1}, Column(3), Column(3)};
  EXPECT_NEAR(force_step(d), 0.05, 1e-12)
      << "a workstation's own samples are better than those that the server received";
}

TEST(JointTorques, AreThoseOfVirtualWork) {
  TraceData d;
  d.t = {0};
  for (SeatTrace* s : {&d.trainer, &d.trainee}) {
    s->q = {Column{0.1}, Column{0.742}, Column{0.553}};
    s->f_cmd = {Column{1}, Column{0}, Column{0}};
  }
  d.tool.q = d.trainer.q;
  d.tool.f_cmd = {Column{0}, Column{0}, Column{2}};
  add_joint_torques(d);
  const double rho = 0.13335 * (std::cos(0.742) + std::sin(0.553));
  EXPECT_NEAR(d.trainer.torque[0][0], -rho * std::cos(0.1), 1e-12);
  EXPECT_NEAR(d.tool.torque[0][0], 0, 1e-12);
  EXPECT_NEAR(d.tool.torque[1][0], 2 * 0.13335 * std::cos(0.742), 1e-12);
}

}  // namespace
}  // namespace tandem::netsim::demo
