#include <gtest/gtest.h>

#include <string>

#include "common/base/rng.h"
#include "common/base/suggestions.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("contact", "contcat"), 1u);
  EXPECT_EQ(edit_distance("k_n_m", "k_nm"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

/// Scenes with a byte changed, removed or doubled: the parser returns a result or errors; it never crashes and never
/// returns a partial scene.
TEST(SceneReader, SurvivesDamagedFiles) {
  for (const auto& shipped : shipped_scenes()) {
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
      SCOPED_TRACE(std::string(shipped.name) + " seed " + std::to_string(seed));
      RandomStream random(seed);
      std::string text(shipped.text);
      const auto at = static_cast<std::size_t>(random.below(text.size()));
      switch (random.below(4)) {
        case 0:
          text[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          text.resize(at);
          break;
        case 2:
          text.erase(at, static_cast<std::size_t>(random.below(40)));
          break;
        default:
          text.insert(at, text.substr(static_cast<std::size_t>(random.below(text.size())), 40));
      }
      const auto scene = parse_scene(text, "damaged.textproto");
      if (scene) {
        EXPECT_FALSE(scene->seats.empty());
        EXPECT_EQ(scene->authority.size(), scene->tools.size());
      } else {
        EXPECT_FALSE(scene.error().empty());
      }
    }
  }
}

TEST(SceneReader, SurvivesBinaryInput) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream random(seed);
    std::string text(static_cast<std::size_t>(random.below(400)), '\0');
    for (auto& c : text) c = static_cast<char>(random.below(256));
    EXPECT_FALSE(parse_scene(text, "noise.textproto").has_value()) << seed;
    EXPECT_FALSE(parse_scene(text, "noise.json").has_value()) << seed;
  }
}

TEST(SceneReader, BoundsListedMistakesAndNesting) {
  std::string many = "version: 1\n";
  for (int i = 0; i < 5000; ++i) many += "nonsense: 1\n";
  const auto listed = parse_scene(many, "many.textproto");
  ASSERT_FALSE(listed.has_value());
  EXPECT_LE(listed.error().size(), 201u);
  EXPECT_NE(listed.error().back().message.find("more mistakes"), std::string::npos);
  EXPECT_FALSE(parse_scene(std::string(300000, '{'), "deep.textproto").has_value());
  EXPECT_FALSE(parse_scene("seat " + std::string(300000, '{'), "deep.textproto").has_value());
  EXPECT_FALSE(parse_scene(std::string((1 << 20) + 1, ' '), "long.textproto").has_value());
}

TEST(SceneReader, AcceptsBothBracketsListsSeparatorsAndComments) {
  const auto scene = parse_scene(
      "version: 1, dof: 1; # one\n"
      "seat < name: 'a' role: INSTRUCTOR; >\n"
      "tool: { name: \"t\", slave { } }\n"
      "authority { tool: \"t\" seat: \"a\" alpha: 1.0 }",
      "free.textproto");
  ASSERT_TRUE(scene.has_value()) << to_text(scene.error());
  EXPECT_EQ(scene->seats[0].name, "a");
}

/// A whole scene, with several messages on a line and comments.
TEST(SceneReader, ReadsTheOutlineOfTheProductDocument) {
  const auto scene = parse_scene(
      R"(version: 1  tick_hz: 1000  dof: 3  duration_s: 18  alpha_slew_per_s: 1
channel { law: SET_POSITION k_n_m: 1000 mfs: OPEN }   device_coupling { k_c_n_m: 400 b_n_s_m: 1 m_c_kg: 0.02 }   gate { silence_limit_ms: 20 }
seat { name: "trainer" kind: MASTER role: INSTRUCTOR required: true hand { model: LEADER } }
seat { name: "trainee" kind: MASTER role: TRAINEE required: true hand { model: RELAXED } }
tool { name: "tool" slave { model: TOUCH environment { wall { axis: X at_m: 0 k_n_m: 20000 } } } }        # or: seat { kind: SLAVE … } served by a third client
authority { tool: "tool" seat: "trainer" alpha: 1 }
timeline { at_s: 11.5 authority { tool: "tool" seat: "trainee" alpha: 1 } }
)",
      "outline.textproto");
  ASSERT_TRUE(scene.has_value()) << to_text(scene.error());
  EXPECT_EQ(scene->tools[0].environment.wall->k, 20000);
  EXPECT_EQ(scene->timeline[0].row.alpha[1], 1);
}

}  // namespace
}  // namespace tandem
