// Two recordings side by side: equal, within limits, beyond, not comparable.
#include "netsim/replay/lesson_diff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/raw_bytes.h"
#include "proto/recording/lesson_reader.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "tests/netsim/replay/recorded_file.h"

namespace tandem::netsim {
namespace {

Lesson lesson_of(const std::string& scene, double seconds) {
  SimulationConfig setup;
  setup.scene = *parse_scene(find_shipped_scene(scene)->text, scene + ".textproto");
  return *read_lesson(bytes_of(test::record_file(setup, seconds)));
}

std::vector<DiffLimit> limits(const std::vector<std::string>& texts) {
  std::vector<DiffLimit> out;
  for (const std::string& text : texts) out.push_back(*parse_diff_limit(text));
  return out;
}

TEST(LessonDiff, OfARecordingWithItselfIsEmpty) {
  const Lesson a = lesson_of("contact", 3);
  const auto diff = diff_lessons(a, a, {});
  ASSERT_TRUE(diff) << diff.error();
  EXPECT_TRUE(diff->within());
  EXPECT_TRUE(diff->channels.empty());
  EXPECT_EQ(diff->rows, a.rows());
}

// 1 mm at one tick and 3 mm at another: the larger one is given, with its tick and values.
TEST(LessonDiff, GivesTheLargestDifferenceOfAChannelAndItsTick) {
  const Lesson a = lesson_of("contact", 3);
  Lesson b = a;
  b.tools[0].x[100][1] += 0.001;
  b.tools[0].x[200][2] -= 0.003;
  const auto diff = diff_lessons(a, b, {});
  ASSERT_TRUE(diff) << diff.error();
  EXPECT_FALSE(diff->within());
  ASSERT_EQ(diff->channels.size(), 1u);
  const ChannelDifference& c = diff->channels[0];
  EXPECT_EQ(c.channel, "/tool/measured_cp");
  EXPECT_EQ(c.field, "z");
  EXPECT_NEAR(c.largest, 0.003, 1e-12);
  EXPECT_EQ(c.tick, a.tick[200]);
  EXPECT_EQ(c.rows, 2u);
  EXPECT_EQ(c.a, a.tools[0].x[200][2]);
  EXPECT_EQ(c.b, b.tools[0].x[200][2]);
  for (const auto& [texts, within] : std::vector<std::pair<std::vector<std::string>, bool>>{
           {{"/tool/measured_cp=0.0031"}, true},
           {{"measured_cp=0.0031"}, true},
           {{"measured_cp=0.0029"}, false},
           {{"/trainer/measured_cp=1"}, false},
           {{"measured_cp=0.0029", "/tool/measured_cp=0.0031"}, true},
           {{"/tool/measured_cp=0.0031", "measured_cp=0"}, false}})
    EXPECT_EQ(diff_lessons(a, b, limits(texts))->within(), within) << texts.back();
}

TEST(LessonDiff, SeesTheSmallestBitAndANumberThatIsMissing) {
  const Lesson a = lesson_of("one_axis", 3);
  Lesson b = a;
  b.seats[0].f[50][0] = std::nextafter(b.seats[0].f[50][0], 10);
  EXPECT_FALSE(diff_lessons(a, b, {})->within());
  EXPECT_TRUE(diff_lessons(a, b, limits({"measured_cf=1e-12"}))->within());
  b.seats[0].f[50][0] = std::numeric_limits<double>::quiet_NaN();
  const auto diff = diff_lessons(a, b, limits({"measured_cf=1e300"}));
  EXPECT_FALSE(diff->within());
  EXPECT_TRUE(std::isinf(diff->channels[0].largest));
}

TEST(LessonDiff, CountsTicksThatOnlyOneHas) {
  const Lesson a = lesson_of("one_axis", 3), b = lesson_of("one_axis", 2);
  const auto diff = diff_lessons(a, b, {});
  ASSERT_TRUE(diff);
  EXPECT_FALSE(diff->within());
  EXPECT_EQ(diff->only_a, a.rows() - b.rows());
  EXPECT_EQ(diff->only_b, 0u);
  EXPECT_EQ(diff->rows, b.rows());
  ASSERT_EQ(diff->channels.size(), 1u);
  EXPECT_EQ(diff->channels[0].channel, "/session/rows");
  EXPECT_TRUE(diff_lessons(a, b, limits({"/session/rows=1000"}))->within());
  EXPECT_FALSE(diff_lessons(a, b, limits({"/session/rows=999"}))->within());
}

TEST(LessonDiff, RefusesOtherSeatsAndUnknownChannels) {
  const Lesson a = lesson_of("one_axis", 2), b = lesson_of("contact", 2);
  EXPECT_FALSE(diff_lessons(a, b, {}));
  const auto unknown = diff_lessons(a, a, limits({"measured_xx=1"}));
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().find("there is no channel measured_xx"), std::string::npos) << unknown.error();
}

TEST(LessonDiff, ReadsLimits) {
  EXPECT_EQ(parse_diff_limit("/tool/measured_cp=5e-4")->most, 5e-4);
  for (const char* wrong : {"", "=1", "measured_cp", "measured_cp=", "measured_cp=-1", "measured_cp=nan", "a=1x"})
    EXPECT_FALSE(parse_diff_limit(wrong)) << wrong;
}

}  // namespace
}  // namespace tandem::netsim
