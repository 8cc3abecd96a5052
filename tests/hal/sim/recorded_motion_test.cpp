#include "hal/sim/recorded_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/rng.h"
#include "tests/support/alloc_guard.h"

namespace tandem::hal::sim {
namespace {

MotionOptions options(std::string_view text = "f.csv") {
  auto o = parse_motion_options(text);
  EXPECT_TRUE(o.has_value()) << o.error();
  return *o;
}
RecordedMotion parsed(const std::string& csv, std::string_view text = "f.csv") {
  auto m = RecordedMotion::parse(csv, options(text), "f.csv");
  EXPECT_TRUE(m.has_value()) << m.error();
  return std::move(*m);
}
std::string error_of(const std::string& csv, std::string_view text = "f.csv") {
  const auto m = RecordedMotion::parse(csv, options(text), "f.csv");
  return m ? "no error" : m.error();
}
Vec3 position(const RecordedMotion& m, double t) {
  RecordedMotion::Cursor c;
  return m.at(t, c).x;
}

const std::string kSmall = "t_s[s],px[m],py[m],pz[m]\n0,0.50,0.1,0\n0.1,0.52,0.1,0\n0.2,0.54,0.1,0.01\n";

TEST(MotionOptions, ReadAllOptions) {
  const auto o = options("a/b.csv,columns=baton,rec=2,scale=0.5,axes=-y+x+z,end=loop");
  EXPECT_EQ(o.file, "a/b.csv");
  EXPECT_EQ(o.columns, "baton");
  EXPECT_EQ(o.rec, 2.0);
  EXPECT_EQ(o.scale, 0.5);
  EXPECT_EQ(o.axes[0].from, 1);
  EXPECT_EQ(o.axes[0].sign, -1.0);
  EXPECT_EQ(o.axes[1].from, 0);
  EXPECT_TRUE(o.loop);
  EXPECT_FALSE(o.keep_middle);
  EXPECT_TRUE(options("f.csv,middle=keep").keep_middle);
  EXPECT_FALSE(options("f.csv,scale=auto").scale.has_value());
}

TEST(MotionOptions, ReportMistakes) {
  const struct {
    const char* text;
    const char* part;
  } cases[] = {
      {"", "FILE.csv"},
      {"columns=p", "FILE.csv"},
      {"f.csv,colums=p", "valid: columns"},
      {"f.csv,rec=a", "rec=a"},
      {"f.csv,scale=0", "scale=0"},
      {"f.csv,middle=no", "middle=no: zero or keep"},
      {"f.csv,scale=nan", "scale="},
      {"f.csv,axes=+x+x+z", "axes="},
      {"f.csv,axes=xyz", "axes=xyz"},
      {"f.csv,end=stop", "hold or loop"},
      {"f.csv,rec=1,rec=2", "twice"},
      {"f.csv,", "comma"},
      {"f.csv,loop", "name=value"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.text);
    const auto o = parse_motion_options(c.text);
    ASSERT_FALSE(o.has_value());
    EXPECT_NE(o.error().find(c.part), std::string::npos) << o.error();
  }
}

TEST(RecordedMotion, CentresWithoutEnlarging) {
  const RecordedMotion m = parsed(kSmall);
  EXPECT_EQ(m.scale(), 1.0);
  EXPECT_LT((m.middle() - Vec3(0.52, 0.1, 0.005)).norm(), 1e-15);
  EXPECT_LT((position(m, 0.0) - Vec3(-0.02, 0, -0.005)).norm(), 1e-15);
  EXPECT_LT((position(m, 0.1) - Vec3(0, 0, -0.005)).norm(), 1e-15);
  EXPECT_LT((position(m, 99.0) - Vec3(0.02, 0, 0.005)).norm(), 1e-15);
  EXPECT_EQ(m.duration(), 0.2);
}

TEST(RecordedMotion, ShrinksMotionLargerThanTheWorkspace) {
  const RecordedMotion m = parsed("t_s[s],px_mm[mm],py_mm[mm],pz_mm[mm]\n0,0,0,0\n1,600,0,0\n2,0,0,0\n");
  EXPECT_NEAR(m.scale(), 0.2, 1e-15);
  EXPECT_NEAR(position(m, 1.0)[0], 0.06, 1e-15);
  EXPECT_NEAR(parsed(kSmall, "f.csv,scale=2").scale(), 2.0, 0);
  EXPECT_NEAR(position(parsed(kSmall, "f.csv,scale=2"), 0.0)[0], -0.04, 1e-15);
}

TEST(RecordedMotion, RotatesTheAxes) {
  const RecordedMotion m = parsed(kSmall, "f.csv,axes=-z+x+y");
  EXPECT_LT((position(m, 0.0) - Vec3(0.005, -0.02, 0)).norm(), 1e-15);
}

TEST(RecordedMotion, TakesTheUnitFromTheBracketsNotTheName) {
  const RecordedMotion m = parsed("t_ms[ms],tip_x_m[mm],tip_y_m[mm],tip_z_m[mm]\n0,0,0,0\n1000,10,0,0\n");
  EXPECT_NEAR(position(m, 1.0)[0], 0.005, 1e-15);
  EXPECT_NEAR(m.duration(), 1.0, 1e-15);
  EXPECT_EQ(m.columns(), "tip");
}

TEST(RecordedMotion, IsExactForAParabolaAtUnevenSteps) {
  std::string csv = "t_s[s],px[m],py[m],pz[m]\n";
  RandomStream r(9);
  double t = 0;
  const auto x = [](double s) { return 0.01 + 0.02 * s - 0.03 * s * s; };
  for (int i = 0; i < 60; ++i) {
    char line[128];
    std::snprintf(line, sizeof line, "%.17g,%.17g,0,0\n", t, x(t));
    csv += line;
    t += r.uniform(0.2e-3, 30e-3);
  }
  const RecordedMotion m = parsed(csv);
  RecordedMotion::Cursor c;
  for (double s = 0.05; s < m.duration() - 0.05; s += 1e-3) {
    const MotionPoint p = m.at(s, c);
    EXPECT_NEAR(p.x[0] + m.middle()[0], x(s), 1e-12);
    EXPECT_NEAR(p.v[0], 0.02 - 0.06 * s, 1e-9);
  }
}

TEST(RecordedMotion, GivesTheDerivativeAsVelocityInAnyOrderOfTimes) {
  std::string csv = "t_s[s],px[m],py[m],pz[m]\n";
  RandomStream r(2);
  for (int i = 0; i < 40; ++i) {
    char line[128];
    std::snprintf(line, sizeof line, "%.17g,%.17g,%.17g,%.17g\n", 0.01 * i, r.uniform(), r.uniform(), r.uniform());
    csv += line;
  }
  const RecordedMotion m = parsed(csv);
  RecordedMotion::Cursor playing;
  for (double s = 0.0011; s < m.duration(); s += 0.00317) {
    const MotionPoint p = m.at(s, playing);
    EXPECT_LT((position(m, s) - p.x).norm(), 1e-15);
    EXPECT_LT(((position(m, s + 1e-7) - position(m, s - 1e-7)) / 2e-7 - p.v).norm(), 1e-3);
  }
}

TEST(RecordedMotion, SmoothsRepeatedRowsOfALogger) {
  // 0.2 m/s, but every second row repeats the last position. Taken literally, the speed would alternate between 0 and
  // 0.4 m/s.
  std::string csv = "t_s[s],px[m],py[m],pz[m]\n";
  for (int i = 0; i < 200; ++i) csv += std::to_string(i * 1e-3) + "," + std::to_string(0.2e-3 * (i - i % 2)) + ",0,0\n";
  const RecordedMotion m = parsed(csv);
  EXPECT_EQ(m.repeated(), 99u);
  RecordedMotion::Cursor c;
  for (double t = 0.01; t < 0.19; t += 1e-3) EXPECT_NEAR(m.at(t, c).v[0], 0.2, 1e-6);
}

TEST(RecordedMotion, KeepsAPause) {
  std::string csv = "t_s[s],px[m],py[m],pz[m]\n0,0,0,0\n";
  for (int i = 1; i < 100; ++i) csv += std::to_string(0.1 + i * 1e-3) + ",0.01,0,0\n";
  csv += "0.3,0.02,0,0\n";
  const RecordedMotion m = parsed(csv);
  EXPECT_EQ(m.rows(), 4u);
  EXPECT_NEAR(position(m, 0.15)[0], 0.0, 2e-3);
  EXPECT_NEAR(m.duration(), 0.3, 1e-12);
}

// A hand that moves at 10 mm/s, rests for 16 s and moves on: the last slope must not swing it while it rests.
TEST(RecordedMotion, RestsDuringAPauseOfAnyLength) {
  for (const double pause : {0.1, 1.0, 16.0}) {
    std::string csv = "t_s[s],px[m],py[m],pz[m]\n";
    const auto row = [&](double t, double x) { csv += std::to_string(t) + "," + std::to_string(x) + ",0,0\n"; };
    for (int i = 0; i <= 1000; ++i) row(i * 1e-3, i * 1e-5);
    for (int i = 1; i < 10; ++i) row(1 + pause * i / 10, 0.01);
    for (int i = 0; i <= 1000; ++i) row(1 + pause + i * 1e-3, 0.01 - i * 1e-5);
    const RecordedMotion m = parsed(csv, "f.csv,middle=keep,scale=1");
    RecordedMotion::Cursor c;
    for (double t = 1.001; t < 0.999 + pause; t += 0.01) {
      EXPECT_NEAR(m.at(t, c).x[0], 0.01, 1e-9) << pause << " s, at " << t;
      EXPECT_NEAR(m.at(t, c).v[0], 0, 1e-9) << pause << " s, at " << t;
    }
    EXPECT_NEAR(position(m, 0.5)[0], 0.005, 1e-6) << "the motion itself is unchanged";
  }
}

// Positions that a recording lacks: the hand crosses the gap without leaving the space between its ends.
TEST(RecordedMotion, CrossesAGapBetweenItsEnds) {
  std::vector<double> t;
  std::vector<Vec3> x;
  for (int i = 0; i <= 100; ++i) t.push_back(i * 1e-3), x.push_back({i * 1e-4, 0, -i * 1e-4});
  for (int i = 0; i <= 100; ++i) t.push_back(3 + i * 1e-3), x.push_back({0.012 - i * 1e-4, 0, 0.02 + i * 1e-4});
  const auto m = RecordedMotion::from_points(t, x);
  ASSERT_TRUE(m) << m.error();
  RecordedMotion::Cursor c;
  for (double at = 0.1; at <= 3; at += 0.01) {
    const Vec3 p = m->at(at, c).x;
    EXPECT_GE(p[0], 0.01 - 1e-12) << at;
    EXPECT_LE(p[0], 0.012 + 1e-12) << at;
    EXPECT_GE(p[2], -0.01 - 1e-12) << at;
    EXPECT_LE(p[2], 0.02 + 1e-12) << at;
  }
}

TEST(RecordedMotion, HoldsOrLoopsAtItsEnd) {
  RecordedMotion::Cursor c;
  EXPECT_EQ(parsed(kSmall).at(50.0, c).v.norm(), 0.0);
  const RecordedMotion loop = parsed(kSmall, "f.csv,end=loop");
  double jump = 0;
  Vec3 last = loop.at(0.0, c).x;
  for (double t = 0; t < 5.0; t += 1e-3) {
    const Vec3 x = loop.at(t, c).x;
    jump = std::max(jump, (x - last).norm());
    last = x;
  }
  EXPECT_LT(jump, 0.5e-3);
}

const std::string kRecs = "rec[1],t_s[s],px[m],py[m],pz[m]\n0,0,0,0,0\n0,0.1,0.01,0,0\n1,0,0,0,0\n1,0.5,0.02,0,0\n";

TEST(RecordedMotion, ChoosesARecording) {
  EXPECT_EQ(parsed(kRecs).duration(), 0.1);
  EXPECT_EQ(parsed(kRecs, "f.csv,rec=1").duration(), 0.5);
  EXPECT_NE(error_of(kRecs, "f.csv,rec=7").find("recordings: 0.0, 1.0"), std::string::npos)
      << error_of(kRecs, "f.csv,rec=7");
}

TEST(RecordedMotion, ReportsFileLineColumnAndValue) {
  const std::string head = "t_s[s],px[m],py[m],pz[m]\n0,0,0,0\n";
  EXPECT_EQ(error_of(head + "0.1,nan,0,0\n"), "f.csv:3: column 2: px: 'nan' is not a finite number");
  EXPECT_EQ(error_of(head + "0.1,0,left,0\n"), "f.csv:3: column 3: py: 'left' is not a finite number");
  EXPECT_EQ(error_of(head + "0.1,0,0,\n"), "f.csv:3: column 4: pz: missing");
  EXPECT_EQ(error_of(head + "0.2,1,0,0\n0.1,2,0,0\n"), "f.csv:4: t_s: time goes back from 0.2 to 0.1 s");
  EXPECT_EQ(error_of(head + "0,1,0,0\n"), "f.csv:3: t_s: two positions at 0.0 s");
  EXPECT_NE(error_of(head).find("at least 2"), std::string::npos);
  EXPECT_NE(error_of("t_s[s],q[rad]\n0,1\n").find("position columns are"), std::string::npos);
  EXPECT_NE(error_of("x[s],px[m],py[m],pz[m]\n0,1,1,1\n").find("t_s[s]"), std::string::npos);
  EXPECT_NE(error_of(kSmall, "f.csv,columns=hand").find("the file has p"), std::string::npos);
  EXPECT_NE(error_of("t_s[s],a_x[m],a_y[m],a_z[m],b_x[m],b_y[m],b_z[m]\n0,0,0,0,0,0,0\n").find("one of a, b"),
            std::string::npos);
}

TEST(RecordedMotion, PlaysWithoutHeap) {
  const RecordedMotion m = parsed(kSmall, "f.csv,end=loop");
  RecordedMotion::Cursor c;
  const test::AllocGuard guard;
  Vec3 sum = Vec3::Zero();
  for (double t = 0; t < 3; t += 1e-3) sum += m.at(t, c).x;
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_TRUE(sum.allFinite());
}

// Points of a parabola: three-point tangents are exact for it (two-point ones at both ends). Nothing is centred or
// scaled.
TEST(RecordedMotion, PlaysGivenPointsUnchanged) {
  const auto made = RecordedMotion::from_points(
      {0, 0.5, 2, 3, 4}, {{1, 0, 0}, {1.25, 0, 0}, {5, 0, 0}, {10, 0, 0}, {17, 0, 0}});  // 1 + t^2
  ASSERT_TRUE(made) << made.error();
  EXPECT_DOUBLE_EQ(made->duration(), 4);
  EXPECT_EQ(made->rows(), 5u);
  EXPECT_EQ(made->scale(), 1);
  EXPECT_EQ(made->middle().norm(), 0);
  for (const double t : {0.0, 0.5, 0.7, 1.3, 2.0, 2.9, 3.0, 4.0})
    EXPECT_NEAR(position(*made, t)[0], 1 + t * t, 1e-12) << t;
  RecordedMotion::Cursor cursor;
  EXPECT_NEAR(made->at(1, cursor).v[0], 2, 1e-12);
  EXPECT_DOUBLE_EQ(position(*made, 9)[0], 17) << "held at its end";
  EXPECT_EQ(made->at(9, cursor).v.norm(), 0);
  EXPECT_DOUBLE_EQ(position(*made, -1)[0], 1);
}

TEST(RecordedMotion, ReportsWhichPointIsInvalidAndWhy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto error = [](std::vector<double> t, std::vector<Vec3> x) {
    const auto made = RecordedMotion::from_points(std::move(t), std::move(x));
    return made ? std::string("none") : made.error();
  };
  const Vec3 o = Vec3::Zero();
  EXPECT_NE(error({0}, {o}).find("at least two points"), std::string::npos);
  EXPECT_NE(error({0, 1}, {o}).find("one position per time"), std::string::npos);
  EXPECT_EQ(error({0, nan}, {o, o}), "point 1 is not finite");
  EXPECT_EQ(error({0, 1}, {o, Vec3(0, nan, 0)}), "point 1 is not finite");
  EXPECT_EQ(error({0.1, 1}, {o, o}), "point 0: time must begin at 0 and ascend");
  EXPECT_EQ(error({0, 1, 1}, {o, o, o}), "point 2: time must begin at 0 and ascend");
  EXPECT_EQ(error({0, 1, 2}, {o, o, o}), "none");
}

}  // namespace
}  // namespace tandem::hal::sim
