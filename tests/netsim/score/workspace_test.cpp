// Hulls of motions, angular paths and transparency, with numbers computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "common/base/rng.h"
#include "netsim/score/hull_volume.h"
#include "netsim/score/motion_lesson.h"
#include "tests/netsim/score/lesson_maker.h"

namespace tandem::netsim::score {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<LessonTriple> corners(double a, double b, double c) {
  std::vector<LessonTriple> out;
  for (int k = 0; k < 8; ++k) out.push_back({(k & 1) != 0 ? a : 0, (k & 2) != 0 ? b : 0, (k & 4) != 0 ? c : 0});
  return out;
}

TEST(HullVolume, OfPolyhedraIsThatOfTheirFormulas) {
  EXPECT_NEAR(hull_volume(corners(1, 1, 1)), 1, 1e-12);
  EXPECT_NEAR(hull_volume(corners(0.1, 0.2, 0.3)), 0.006, 1e-15);
  EXPECT_NEAR(hull_volume(std::vector<LessonTriple>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 1.0 / 6, 1e-12);
  const std::vector<LessonTriple> octahedron{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  EXPECT_NEAR(hull_volume(octahedron), 4.0 / 3, 1e-12);
}

TEST(HullVolume, IsNotChangedByInnerRepeatedAndUnknownPoints) {
  std::vector<LessonTriple> points = corners(1, 1, 1);
  RandomStream random{5};
  for (int k = 0; k < 2000; ++k) points.push_back({random.uniform(), random.uniform(), random.uniform()});
  points.insert(points.end(), {points[7], points[7], kUnknownTriple, {INFINITY, 0, 0}});
  EXPECT_NEAR(hull_volume(points), 1, 1e-12);
}

TEST(HullVolume, OfFlatMotionsIsZero) {
  EXPECT_EQ(hull_volume({}), 0);
  EXPECT_EQ(hull_volume(std::vector<LessonTriple>(3, LessonTriple{1, 2, 3})), 0);
  EXPECT_EQ(hull_volume(std::vector<LessonTriple>(100, LessonTriple{1, 2, 3})), 0) << "a hand at rest";
  std::vector<LessonTriple> line, circle;
  for (int k = 0; k < 500; ++k) {
    line.push_back({0.001 * k, 0.002 * k, -0.001 * k});
    circle.push_back({std::cos(0.1 * k), std::sin(0.1 * k), 0.5});
  }
  EXPECT_NEAR(hull_volume(line), 0, 1e-12);
  EXPECT_NEAR(hull_volume(circle), 0, 1e-12);
}

/// A hand that moves along edges through all corners of a cube of 0.1 m, one edge per second.
LessonTriple along_edges(double t) {
  constexpr int kOrder[] = {0, 1, 3, 2, 6, 7, 5, 4};  // neighbours differ in one bit
  const auto cube = corners(0.1, 0.1, 0.1);
  const int edge = std::min(6, static_cast<int>(t));
  const LessonTriple &from = cube[static_cast<std::size_t>(kOrder[edge])],
                     &to = cube[static_cast<std::size_t>(kOrder[edge + 1])];
  return interpolated(from, to, minimum_jerk(t - edge));
}

TEST(ScoreMotion, HasTheVolumeOfACubeWhoseCornersAHandVisits) {
  LessonMaker maker;
  const LessonScores s = maker.ticks(8000).hand(0, along_edges).scores();
  EXPECT_NEAR(value_of(s, "trainee", Metric::kHullVolume), 1e-3, 2e-6);
  EXPECT_NEAR(value_of(s, "trainee", Metric::kWorkspace), 1e-3, 2e-6) << "equal for a cube along the axes";
  EXPECT_TRUE(std::isnan(value_of(s, "trainee", Metric::kAngularPath))) << "recordings have no orientation";
  LessonMaker flat;
  flat.ticks(3000).hand(0, [](double t) { return LessonTriple{0.1 * std::cos(t), 0.1 * std::sin(t), 0.02}; });
  EXPECT_NEAR(value_of(flat.scores(), "trainee", Metric::kHullVolume), 0, 1e-12);
}

/// A table of 2 s at 100 Hz: the hand turns about z by `angle` as `angle_at` says.
template <class Angle>
std::string turning(const Angle& angle_at, const std::string& q = "q0[1],a_q1[1],a_q2[1],a_q3") {
  std::string csv = "t_s[s],a_x_m[m],a_y_m[m],a_z_m[m],a_" + q + "[1]\n";
  for (int k = 0; k < 200; ++k) {
    const double angle = angle_at(0.01 * k), sign = k % 7 < 3 ? -1 : 1;  // q and -q are the same orientation
    char row[160];
    std::snprintf(row, sizeof row, "%.2f,%.6f,0,0,%.12f,0,0,%.12f\n", 0.01 * k, 0.001 * k, sign * std::cos(angle / 2),
                  sign * std::sin(angle / 2));
    csv += row;
  }
  return csv;
}

double angular_path(const std::string& csv) {
  const auto lesson = read_motion(csv, "m.csv");
  EXPECT_TRUE(lesson) << lesson.error();
  const auto scores = score_lesson(*lesson);
  EXPECT_TRUE(scores) << scores.error();
  return value_of(*scores, "a", Metric::kAngularPath);
}

TEST(AngularPath, IsTheSumOfTheAngles) {
  EXPECT_NEAR(angular_path(turning([](double t) { return kPi / 2 * minimum_jerk(t - 0.5); })), kPi / 2, 1e-3);
  EXPECT_NEAR(angular_path(turning([](double t) { return 3 * kPi * minimum_jerk(t / 2); })), 3 * kPi, 0.05)
      << "more than a turn";
  EXPECT_NEAR(angular_path(turning([](double t) { return minimum_jerk(t) - minimum_jerk(t - 1); })), 2, 5e-3)
      << "there and back";
  EXPECT_NEAR(angular_path(turning([](double) { return 1.0; })), 0, 1e-9);
  EXPECT_NEAR(angular_path(turning([](double t) { return minimum_jerk(t); }, "qw[1],a_qx[1],a_qy[1],a_qz")), 1, 2e-3)
      << "the other names";
}

TEST(AngularPath, IsUnknownWithoutWholeQuaternions) {
  EXPECT_TRUE(std::isnan(angular_path(turning([](double) { return 0.0; }, "q0[1],a_q1[1],a_q2[1],a_other"))));
  std::string csv = "t_s[s],a_x_m[m],a_y_m[m],a_z_m[m],a_q0[1],a_q1[1],a_q2[1],a_q3[1]\n";
  for (int k = 0; k < 100; ++k) csv += std::to_string(0.01 * k) + ",0,0,0,0,0,0,0\n";
  EXPECT_TRUE(std::isnan(angular_path(csv))) << "motion capture lost the body";
}

/// A hand and a tool that press on a wall along x, with forces `gain` and 1 times the same stiffness.
LessonMaker pressing(double gain, double noise = 0) {
  LessonMaker maker;
  const auto x = [](double t) {
    double sum = 0;
    for (int k = 1; k <= 12; ++k) sum += 1e-3 / k * std::sin(2 * kPi * k / 1.28 * t + k * k);
    return sum;
  };
  constexpr double kStiffness = 800;
  RandomStream random{3};
  maker.ticks(20'000)
      .hand(0, [&](double t) { return LessonTriple{x(t), 0, 0}; })
      .force(0,
             [&](double t) {
               return LessonTriple{-3 - gain * kStiffness * x(t) + noise * (random.uniform() - 0.5), 0, 0};
             })
      .tool([&](double t) { return LessonTriple{x(t), 0, 0}; },
            [&](double t) { return LessonTriple{-3 - kStiffness * x(t), 0, 0}; });
  maker.lesson.scene.tools[0].environment.wall.emplace().axis = 0;
  return maker;
}

TEST(Transparency, IsTheRatioOfTheImpedances) {
  for (const double gain : {1.0, 2.0, 0.25})
    EXPECT_NEAR(value_of(pressing(gain).scores(), "trainee", Metric::kTransparency), gain, 1e-6 * gain);
  EXPECT_NEAR(value_of(pressing(2, 1).scores(), "trainee", Metric::kTransparency), 2, 0.1) << "with some noise";
}

TEST(Transparency, IsUnknownWithoutCoherenceContactOrSurface) {
  EXPECT_TRUE(std::isnan(value_of(pressing(1, 1e4).scores(), "trainee", Metric::kTransparency)))
      << "the force is noise";
  LessonMaker brief = pressing(1);
  for (std::size_t k = 4000; k < 20'000; ++k) brief.lesson.tools[0].f_env[k] = {};
  EXPECT_TRUE(std::isnan(value_of(brief.scores(), "trainee", Metric::kTransparency))) << "4 s give 5 windows";
  LessonMaker free = pressing(1);
  free.lesson.scene.tools[0].environment.wall.reset();
  EXPECT_TRUE(std::isnan(value_of(free.scores(), "trainee", Metric::kTransparency)));
}

}  // namespace
}  // namespace tandem::netsim::score
