#include "proto/io/scene_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "proto/text/scenes_embedded.h"

namespace tandem {
namespace {

struct Folder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / ("tandem_scene_" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  [[nodiscard]] std::string write(const char* name, std::string_view text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return (path / name).string();
  }
};

TEST(SceneFile, LoadsAShippedSceneByItsBareName) {
  const auto scene = load_scene("free_motion");
  ASSERT_TRUE(scene.has_value()) << to_text(scene.error());
  EXPECT_EQ(scene->name, "free_motion");
}

TEST(SceneFile, ReadsAPath) {
  const Folder folder;
  const auto path = folder.write("mine.textproto", find_shipped_scene("one_axis")->text);
  const auto scene = load_scene(path);
  ASSERT_TRUE(scene.has_value()) << to_text(scene.error());
  EXPECT_EQ(scene->name, "mine");
  EXPECT_EQ(scene->dof, 1u);
}

TEST(SceneFile, NamesThePathAsTypedInMistakes) {
  const Folder folder;
  const auto path = folder.write("bad.textproto", "version: 1\ndoff: 3\n");
  const auto scene = load_scene(path);
  ASSERT_FALSE(scene.has_value());
  EXPECT_TRUE(to_text(scene.error()[0]).starts_with(path + ":2:1: doff: ")) << to_text(scene.error());
}

TEST(SceneFile, SuggestsTheNearestForAMissingSceneAndListsAll) {
  for (const char* name : {"contcat", "contcat.textproto", "server/scenes/contcat.textproto"}) {
    const auto scene = load_scene(name);
    ASSERT_FALSE(scene.has_value());
    const auto text = to_text(scene.error());
    EXPECT_NE(text.find("did you mean contact?"), std::string::npos) << text;
    for (const auto& shipped : shipped_scenes()) EXPECT_NE(text.find(shipped.name), std::string::npos) << text;
  }
}

TEST(SceneFile, RejectsFoldersDevicesAndHugeFiles) {
  const Folder folder;
  EXPECT_FALSE(load_scene(folder.path.string()).has_value());
  EXPECT_FALSE(load_scene(folder.write("huge.textproto", std::string((1 << 20) + 1, '#'))).has_value());
  EXPECT_FALSE(load_scene("").has_value());
  EXPECT_FALSE(load_scene("/dev/zero").has_value());
}

}  // namespace
}  // namespace tandem
