#include "proto/text/device_text.h"

#include <gtest/gtest.h>

#include <string>

namespace tandem {
namespace {

std::string mistakes(std::string_view text) {
  const auto spec = parse_device_text(text, "mine.textproto");
  return spec ? std::string() : to_text(spec.error());
}
bool says(std::string_view text, std::string_view words) {
  const std::string found = mistakes(text);
  if (found.find(words) != std::string::npos) return true;
  ADD_FAILURE() << "expected '" << words << "' in:\n" << found;
  return false;
}

TEST(DeviceText, ReadsAFalconWithItsScale) {
  const auto spec = parse_device_text(R"(
    # my Falcon
    falcon {
      force { motor_1_counts_per_nm: 9000 motor_2_counts_per_nm: 10000 motor_3_counts_per_nm: 11000 }
      measured: "NN, 2026-11-21, masses of 50 and 100 g"
      peak_n: 6 continuous_n: 2.5 mass_kg: 0.15 damping_n_s_m: 0.8 latency_ms: 2.5
      firmware { sha256: "00112233445566778899AABBCCDDEEFF00112233445566778899aabbccddeeff" }
      flags { homing: 16 green: 4 blue: 8 red: 2 }
    })",
                                      "mine.textproto");
  ASSERT_TRUE(spec) << to_text(spec.error());
  const FalconSpec& falcon = *spec->falcon;
  EXPECT_EQ((*falcon.counts_per_nm)[2], 11000);
  EXPECT_EQ(falcon.peak, 6.0);
  EXPECT_EQ(falcon.mass, 0.15);
  EXPECT_FALSE(falcon.stiffness);
  EXPECT_EQ(falcon.latency, 0.0025);
  EXPECT_EQ(falcon.firmware_sha256, "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff");
  EXPECT_EQ(falcon.flags.homing, 16);
  EXPECT_EQ(falcon.flags.red, 2);
}

constexpr const char* kReading =
    "mass_reading { mass_kg: 0.1 up_z: 0.5 encoder { leg_1: 1 leg_2: 2 leg_3: 3 } "
    "motor_without { leg_1: 4 leg_2: 5 leg_3: 6 } motor_with { leg_1: 7 leg_2: 8 leg_3: 9 } } ";

TEST(DeviceText, ReadsMassReadingsAndNormalisesTheDirection) {
  const auto spec =
      parse_device_text(std::string("falcon { measured: \"me\" ") + kReading + kReading + "}", "mine.textproto");
  ASSERT_TRUE(spec) << to_text(spec.error());
  ASSERT_EQ(spec->falcon->readings.size(), 2u);
  const FalconMassReading& r = spec->falcon->readings[1];
  EXPECT_EQ(r.up, (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(r.encoder, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(r.motor_without, (std::array<double, 3>{4, 5, 6}));
  EXPECT_EQ(r.motor_with, (std::array<double, 3>{7, 8, 9}));
  EXPECT_FALSE(spec->falcon->counts_per_nm);
}

TEST(DeviceText, ReportsAFalconWithoutNumbersAsUncalibrated) {
  const auto spec = parse_device_text("falcon { flags { homing: 1 } }", "mine.textproto");
  ASSERT_TRUE(spec) << to_text(spec.error());
  EXPECT_FALSE(spec->falcon->counts_per_nm);
  EXPECT_TRUE(spec->falcon->readings.empty());
}

TEST(DeviceText, NamesEveryMistakeWithItsPlaceAndRange) {
  const std::string found =
      mistakes("falcon {\n  force { motor_1_counts_per_nm: 12 motor_2_counts_per_nm: nan }\n  peek_n: 3\n}");
  EXPECT_NE(found.find("mine.textproto:2:"), std::string::npos) << found;
  EXPECT_NE(found.find("motor_1_counts_per_nm = 12"), std::string::npos) << found;
  EXPECT_NE(found.find("500"), std::string::npos) << found;
  EXPECT_NE(found.find("motor_3_counts_per_nm"), std::string::npos) << found;
  EXPECT_NE(found.find("mine.textproto:3:"), std::string::npos) << found;
  EXPECT_NE(found.find("peek_n"), std::string::npos) << found;
}

TEST(DeviceText, RejectsContradictoryValues) {
  const std::string force =
      "force { motor_1_counts_per_nm: 9000 motor_2_counts_per_nm: 9000 motor_3_counts_per_nm: 9000 } ";
  EXPECT_TRUE(says("falcon { " + force + "}", "needs measured"));
  EXPECT_TRUE(
      says("falcon { measured: \"me\" " + force + kReading + kReading + "}", "cannot be combined with mass_reading"));
  EXPECT_TRUE(says(std::string("falcon { measured: \"me\" ") + kReading + "}", "at least two"));
  EXPECT_TRUE(says("falcon { mass_reading { mass_kg: 0.1 } mass_reading { mass_kg: 0.1 } }", "motor_without"));
  EXPECT_TRUE(says("falcon { peak_n: 2 continuous_n: 3 }", "above peak_n"));
  EXPECT_TRUE(says("falcon { firmware { sha256: \"abc\" } }", "64 hexadecimal"));
  EXPECT_TRUE(says("falcon { flags { homing: 3 } }", "one bit"));
  EXPECT_TRUE(says("falcon { flags { homing: 2 } }", "another flag"));
  EXPECT_FALSE(mistakes("").empty()) << "an empty file";
}

TEST(DeviceText, ReportsBinaryInputAsOneMistake) {
  std::string program =
      "falcon {\n\x7f"
      "ELF";
  for (int i = 0; i < 4000; ++i) program += static_cast<char>(i * 37);
  for (const char* name : {"mine.textproto", "mine.json"}) {
    const auto spec = parse_device_text(program, name);
    ASSERT_FALSE(spec);
    ASSERT_EQ(spec.error().size(), 1u) << to_text(spec.error());
    EXPECT_EQ(spec.error()[0].line, 2);
    EXPECT_EQ(spec.error()[0].column, 1);
    EXPECT_NE(spec.error()[0].message.find("is not text: it has the byte 0x7f"), std::string::npos)
        << spec.error()[0].message;
  }
  EXPECT_EQ(parse_device_text(std::string(10'000'000, '\0'), "zero").error().size(), 1u);
  EXPECT_TRUE(parse_device_text("falcon {\r\n\tflags { homing: 1 } # \xc3\xa9\r\n}", "mine.textproto"));
}

TEST(DeviceText, KeepsThePlaceOfReadings) {
  const auto spec = parse_device_text(
      std::string("falcon {\n  measured: \"me\"\n  ") + kReading + "\n" + kReading + "\n}", "mine.textproto");
  ASSERT_TRUE(spec) << to_text(spec.error());
  EXPECT_EQ(spec->falcon->line, 1);
  EXPECT_EQ(spec->falcon->readings[0].line, 3);
  EXPECT_EQ(spec->falcon->readings[1].line, 4);
}

}  // namespace
}  // namespace tandem
