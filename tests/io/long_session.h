#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "tests/io/programs.h"
#include "tests/netsim/replay/recorded_file.h"

namespace tandem::test {

/// The same session as one file, one.mcap, and in parts, lesson-1.mcap and so on.
struct LongSession {
  Folder folder;
  std::vector<std::string> parts;  ///< names

  explicit LongSession(const std::string& scene = "contact", double seconds = 3, double part_s = 0.8) {
    netsim::SimulationConfig setup;
    setup.scene = *parse_scene(find_shipped_scene(scene)->text, scene + ".textproto");
    setup.seed = 3;
    setup.network.up.floor = setup.network.down.floor = std::chrono::milliseconds(20);
    setup.network.up.loss.probability = 0.05;
    std::filesystem::create_directory(folder.file("one"));
    folder.write("one/one.mcap", netsim::test::PartsRecorder{.part_s = 100}.record(setup, seconds).at(0));
    for (const std::string& file : netsim::test::PartsRecorder{.part_s = part_s}.record(setup, seconds)) {
      parts.push_back("lesson-" + std::to_string(parts.size() + 1) + ".mcap");
      folder.write(parts.back(), file);
    }
  }
  [[nodiscard]] std::string path(std::size_t k) const { return folder.file(parts.at(k)); }
};

}  // namespace tandem::test
