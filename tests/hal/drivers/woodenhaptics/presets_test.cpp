#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <numbers>

#include "hal/drivers/woodenhaptics/kinematics.h"
#include "hal/drivers/woodenhaptics/woodenhaptics_caps.h"
#include "proto/text/device_text.h"
#include "proto/text/presets_embedded.h"
#include "tests/hal/drivers/woodenhaptics/mechanisms.h"

namespace tandem::hal::woodenhaptics {
namespace {

WoodenHapticsSpec shipped(std::string_view name) {
  const EmbeddedFile* preset = find_shipped_preset(name);
  if (preset == nullptr) {
    ADD_FAILURE() << "no preset " << name;
    return test::wooden_2015();
  }
  const auto file = parse_device_text(preset->text, std::string(name) + ".textproto");
  EXPECT_TRUE(file.has_value()) << to_text(file.error());
  return file && file->woodenhaptics ? *file->woodenhaptics : test::wooden_2015();
}

void expect_same_mechanism(const WoodenHapticsSpec& a, const WoodenHapticsSpec& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a.capstan[i], b.capstan[i], 1e-12);
    EXPECT_NEAR(a.body[i], b.body[i], 1e-12);
    EXPECT_NEAR(a.link[i], b.link[i], 1e-12);
    EXPECT_NEAR(a.origin[i], b.origin[i], 1e-12);
    EXPECT_NEAR(a.torque_constant[i], b.torque_constant[i], 1e-12);
    EXPECT_EQ(a.calibration_counts[i], b.calibration_counts[i]);
    EXPECT_EQ(a.encoder_direction[i], b.encoder_direction[i]);
    EXPECT_EQ(a.motor_direction[i], b.motor_direction[i]);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.arm_mass[i], b.arm_mass[i], 1e-12);
    EXPECT_NEAR(a.arm_mass_at[i], b.arm_mass_at[i], 1e-12);
  }
  EXPECT_EQ(a.counts_per_turn, b.counts_per_turn);
  EXPECT_EQ(a.stiffness_max, b.stiffness_max);
}

TEST(WoodenPresets, MatchThePublishedNumbers) {
  WoodenHapticsSpec y2015 = test::wooden_2015();  // on its V1 board
  y2015.calibration_counts = {0, 0, -6000};
  y2015.encoder_direction = {-1, -1, -1};
  y2015.motor_direction = {1, -1, -1};
  expect_same_mechanism(shipped("woodenhaptics-2015"), y2015);
  expect_same_mechanism(shipped("aluhaptics-v2"), test::aluhaptics_v2());
  expect_same_mechanism(shipped("polhem-v1"), test::polhem_v1());
  WoodenHapticsSpec y2019 = test::wooden_2015();
  y2019.torque_constant = {0.0603, 0.0603, 0.0603};
  expect_same_mechanism(shipped("woodenhaptics-2019"), y2019);
  EXPECT_EQ(shipped("woodenhaptics-2015").protocol, WoodenProtocol::kV1);
}

TEST(WoodenPresets, HaveAReachableNonSingularCalibrationPose) {
  for (const EmbeddedFile& preset : shipped_presets()) {
    SCOPED_TRACE(preset.name);
    const Kinematics k(shipped(preset.name));
    const auto& c = shipped(preset.name).calibration_counts;
    const Vec3 q = k.angles({c[0], c[1], c[2]});
    const Eigen::Matrix3d j = k.jacobian(q);
    EXPECT_LT(k.tip(q).norm(), 0.21);
    EXPECT_GT(j.jacobiSvd().singularValues()[2], 0.05) << "a motor without a lever [m]";
    EXPECT_TRUE(k.inverse(k.tip(q))) << "in front of the base";
  }
}

TEST(WoodenPresets, HaveConservativeLimits) {
  EXPECT_EQ(shipped_presets().size(), 4u);
  for (const EmbeddedFile& preset : shipped_presets()) {
    SCOPED_TRACE(preset.name);
    const WoodenHapticsSpec spec = shipped(preset.name);
    EXPECT_LE(spec.current_max, 2.0);
    EXPECT_LE(spec.current_continuous, 1.0);
    EXPECT_LE(spec.force_max, 5.0);
    EXPECT_FALSE(spec.force_checked);
    EXPECT_FALSE(spec.gravity);
    EXPECT_FALSE(spec.damping.has_value()) << "the published 8 N s/m are what it can show, not what it has";
    EXPECT_FALSE(preset.summary.empty());
    EXPECT_TRUE(Kinematics(spec).inverse(Vec3::Zero()).has_value());
    for (const AxisLimit& axis : caps_of(spec).axis) EXPECT_TRUE(axis.peak.has_value());
  }
  EXPECT_EQ(find_shipped_preset("polhem-v3"), nullptr) << "its mechanism is another one, not built here";
}

struct BadLine {
  const char *from, *to, *says;
};

TEST(WoodenPresets, ReportMistakesWithTheirPlace) {
  const std::string good(find_shipped_preset("woodenhaptics-2019")->text);
  for (const BadLine& bad : {
           BadLine{"protocol: V2", "protocol: V3", "V3"},
           BadLine{"protocol: V2", "protocol: UNKNOWN", "must be V1, V2 or RAW64"},
           BadLine{"protocol: V2", "", "is missing"},
           BadLine{"body_mm: 160", "body_mm: 0", "must be in [5, 1000] mm"},
           BadLine{"torque_constant_nm_a: 0.0603", "torque_constant_nm_a: nan", "torque_constant_nm_a"},
           BadLine{"calibration_counts: 6000", "calibration_counts: 40000", "must be in [-32768, 32767] counts"},
           BadLine{"max_a: 2", "max_a: 7", "must be in (0, 6] A"},
           BadLine{"continuous_a: 1 ", "continuous_a: 3 ", "is above max_a, 2"},
           BadLine{"max_a: 2 continuous_a: 1 firmware_full_scale_a: 3 amplifier_full_scale_a: 3",
                   "max_a: 4 continuous_a: 1 firmware_full_scale_a: 3 amplifier_full_scale_a: 3",
                   "above what the amplifier makes"},
           BadLine{"firmware_full_scale_a: 3 ", "", "firmware_full_scale_a: "},
           BadLine{"max_a: 2 ", "", "current.max_a: "},
           BadLine{"force_n: 5 ", "", "limits.force_n: "},
           BadLine{"upper_mm: 205", "upper_mm: 20", "mm from the shoulder"},
           BadLine{"counts_per_turn: 2000", "counts_per_turn: 2000 gear: 3", "gear"},
           BadLine{"counts_per_turn: 2000", "counts_per_turn: 2000 measured: \"\"", "name the author"},
       }) {
    SCOPED_TRACE(bad.to);
    std::string text = good;
    const auto at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(bad.from).size(), bad.to);
    const auto file = parse_device_text(text, "mine.textproto");
    ASSERT_FALSE(file.has_value());
    EXPECT_NE(to_text(file.error()).find(bad.says), std::string::npos) << to_text(file.error());
    EXPECT_NE(to_text(file.error()).find("mine.textproto:"), std::string::npos);
  }
}

TEST(WoodenPresets, NameAllMissingParts) {
  const auto file =
      parse_device_text("woodenhaptics { protocol: V1 counts_per_turn: 2000 stylus_on_encoder_d: true }", "f");
  ASSERT_FALSE(file.has_value());
  const std::string told = to_text(file.error());
  for (const char* part : {"base {", "shoulder {", "elbow {", "arm {", "current {", "limits {", "no encoder d"}) {
    EXPECT_NE(told.find(part), std::string::npos) << told;
  }
}

TEST(WoodenPresets, RejectAFileWithoutCurrentOrLimits) {
  for (const char* part : {"  current {", "  limits {"}) {
    SCOPED_TRACE(part);
    std::string text(find_shipped_preset("woodenhaptics-2015")->text);
    const auto at = text.find(part);
    ASSERT_NE(at, std::string::npos);
    text.erase(at, text.find('\n', at) - at);
    const auto file = parse_device_text(text, "mine.textproto");
    ASSERT_FALSE(file.has_value());
    ASSERT_EQ(file.error().size(), 1u) << to_text(file.error());
    EXPECT_NE(file.error()[0].message.find(std::string("needs ") + (part + 2)), std::string::npos)
        << to_text(file.error());
    EXPECT_GT(file.error()[0].line, 0);
  }
}

TEST(WoodenPresets, ReadDirectionsWeightAndConfirmation) {
  std::string text(find_shipped_preset("woodenhaptics-2019")->text);
  const auto replace = [&](std::string_view from, std::string_view to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("calibration_counts: 6000", "calibration_counts: 6000 encoder_reversed: true motor_reversed: true");
  replace("carried: false", "carried: true");
  replace("protocol: V2", "protocol: RAW64 measured: \"A. B., 2026-11-21, 200 g\" stylus_on_encoder_d: true");
  const auto file = parse_device_text(text, "mine.textproto");
  ASSERT_TRUE(file.has_value()) << to_text(file.error());
  const WoodenHapticsSpec& spec = *file->woodenhaptics;
  EXPECT_EQ(spec.encoder_direction, (std::array{1, 1, -1}));
  EXPECT_EQ(spec.motor_direction, (std::array{1, 1, -1}));
  EXPECT_TRUE(spec.gravity && spec.force_checked && spec.stylus_on_encoder_d);
  EXPECT_EQ(spec.protocol, WoodenProtocol::kRaw64);
  EXPECT_TRUE(caps_of(spec).force_calibrated);
  EXPECT_LT(Kinematics(spec).angle_per_count()[2], 0.0);
}

TEST(SpaceMouseFile, ScalesAndReverses) {
  const auto file = parse_device_text(
      "spacemouse { speed_m_s: 0.05 turn_rad_s: 1 x { full_counts: 420 } turn_z { full_counts: 500 reversed: true } }",
      "f");
  ASSERT_TRUE(file.has_value()) << to_text(file.error());
  EXPECT_EQ(file->spacemouse->speed, 0.05);
  EXPECT_EQ(file->spacemouse->turn, 1.0);
  EXPECT_EQ(file->spacemouse->full, (std::array<double, 6>{420, 350, 350, 350, 350, 500}));
  EXPECT_EQ(file->spacemouse->sign, (std::array{1, 1, 1, 1, 1, -1}));
  EXPECT_FALSE(file->woodenhaptics.has_value());
  const auto bad = parse_device_text("spacemouse { speed_m_s: 3 x { full_counts: 0 } }", "f");
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().size(), 2u);
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
