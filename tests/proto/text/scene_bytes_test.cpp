// A scene as bytes: every shipped scene comes back the same and fits; hostile bytes give an error.
#include "proto/text/scene_bytes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/base/rng.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "proto/wire/wire_messages.h"

namespace tandem {
namespace {

std::vector<char> encoded(const SceneSpec& scene) {
  std::vector<char> bytes(wire::kSetupMax);
  bytes.resize(encode_scene(scene, bytes));
  return bytes;
}

TEST(SceneBytes, CarryEveryShippedScene) {
  for (const EmbeddedFile& file : shipped_scenes()) {
    SCOPED_TRACE(std::string(file.name));
    const auto scene = parse_scene(file.text, std::string(file.name) + ".textproto");
    ASSERT_TRUE(scene);
    const std::vector<char> bytes = encoded(*scene);
    ASSERT_FALSE(bytes.empty());
    const auto back = decode_scene(bytes, std::string(file.name));
    ASSERT_TRUE(back) << back.error().front().message;
    EXPECT_EQ(back->name, file.name);
    EXPECT_EQ(effective_scene_text(*back), effective_scene_text(*scene));
    std::printf("[  scene   ] %s: %zu bytes\n", std::string(file.name).c_str(), bytes.size());
  }
}

TEST(SceneBytes, CarryEveryShippedSceneInAShorterSession) {
  for (const EmbeddedFile& file : shipped_scenes()) {
    auto scene = parse_scene(file.text, std::string(file.name) + ".textproto");
    ASSERT_TRUE(scene);
    for (const double end : {0.1, 5.0, 12.0, 15.0}) {
      SCOPED_TRACE(std::string(file.name) + ", " + std::to_string(end) + " s");
      scene->duration = end;
      const auto back = decode_scene(encoded(*scene), std::string(file.name));
      ASSERT_TRUE(back) << back.error().front().message;
      EXPECT_EQ(back->duration, end);
      EXPECT_EQ(back->seats.size(), scene->seats.size());
      EXPECT_EQ(back->authority.size(), scene->authority.size());
      for (const PhaseSpec& phase : back->phases) EXPECT_LE(phase.to, end);
      std::size_t reached = 0;
      for (const PhaseSpec& phase : scene->phases) reached += phase.from < end ? 1 : 0;
      EXPECT_EQ(back->phases.size(), reached);
    }
  }
}

TEST(SceneBytes, DoNotFitIntoLessRoom) {
  const auto scene = parse_scene(find_shipped_scene("one_axis")->text, "one_axis.textproto");
  std::vector<char> room(encoded(*scene).size() - 1);
  EXPECT_EQ(encode_scene(*scene, room), 0u);
}

TEST(SceneBytes, GiveAnErrorOrAValidSceneForAnyBytes) {
  const auto scene = parse_scene(find_shipped_scene("contact")->text, "contact.textproto");
  const std::vector<char> good = encoded(*scene);
  RandomStream random(5);
  for (int n = 0; n < 300; ++n) {
    std::vector<char> bad = good;
    for (int k = 0; k < 1 + n % 4; ++k) bad[random.below(bad.size())] = static_cast<char>(random.bits());
    const auto got = decode_scene(bad, "contact");
    if (got) {
      EXPECT_GE(got->tick_hz, 100);
      EXPECT_LE(got->seats.size(), kSeatsMax);
    } else {
      EXPECT_FALSE(got.error().empty());
    }
    const auto cut = decode_scene(std::span(good).first(random.below(good.size())), "contact");
    if (!cut) {
      EXPECT_FALSE(cut.error().empty());
    }
  }
  EXPECT_FALSE(decode_scene(std::vector<char>(wire::kSetupMax + 1), "x"));
}

}  // namespace
}  // namespace tandem
