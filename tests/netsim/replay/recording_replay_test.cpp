// Recordings replay from their files: equal, changed, cut, without inputs, with lost inputs.
#include "netsim/replay/recording_replay.h"

#include <gtest/gtest.h>

#include "common/base/raw_bytes.h"
#include "netsim/system/swarm.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "tests/netsim/replay/recorded_file.h"

namespace tandem::netsim {
namespace {

using test::record_file;

SimulationConfig delayed(const std::string& scene) {
  SimulationConfig setup;
  setup.scene = *parse_scene(find_shipped_scene(scene)->text, scene + ".textproto");
  setup.network.up.floor = setup.network.down.floor = std::chrono::milliseconds(20);
  setup.network.up.loss.probability = 0.05;
  return setup;
}

TEST(RecordingReplay, IsEqualToTheRecording) {
  for (const std::string scene : {"contact", "two_by_two", "contact_remote", "eight_seats", "seed_contact"}) {
    SCOPED_TRACE(scene);
    const auto replay = replay_recording(bytes_of(record_file(delayed(scene), 4)));
    ASSERT_TRUE(replay) << replay.error();
    EXPECT_EQ(replay->difference, std::nullopt)
        << replay->difference->channel << " " << replay->difference->recorded << " " << replay->difference->replayed;
    EXPECT_EQ(replay->error, "");
    EXPECT_TRUE(replay->equal());
    EXPECT_TRUE(replay->complete);
    EXPECT_TRUE(replay->seats_compared);
    EXPECT_FALSE(replay->other_scene);
    EXPECT_TRUE(replay->other_builds.empty());
    EXPECT_EQ(replay->counts.ticks, 4000u);
    EXPECT_GT(replay->rows, 2000u);
  }
}

TEST(RecordingReplay, GoesAcrossRestartsOfTheServer) {
  SimulationConfig setup = delayed("contact");
  setup.faults = {{Fault::Kind::kServerRestart, "", std::chrono::milliseconds(2500), std::chrono::milliseconds(300)}};
  const auto replay = replay_recording(bytes_of(record_file(setup, 8)));
  ASSERT_TRUE(replay) << replay.error();
  EXPECT_TRUE(replay->equal()) << replay->error;
  EXPECT_EQ(replay->counts.sessions, 2u);
  EXPECT_GT(replay->rows, 4000u);
}

TEST(RecordingReplay, OfACutFileEndsWithItsLastWholeChunk) {
  const std::string file = record_file(delayed("contact"), 4);
  std::uint64_t ticks = 0;
  for (const double share : {0.3, 0.6, 0.95, 0.999}) {
    const auto cut =
        std::string_view(file).substr(0, static_cast<std::size_t>(share * static_cast<double>(file.size())));
    const auto replay = replay_recording(bytes_of(cut));
    ASSERT_TRUE(replay) << replay.error();
    EXPECT_TRUE(replay->equal()) << replay->error;
    EXPECT_FALSE(replay->complete);
    EXPECT_GE(replay->counts.ticks, ticks);
    ticks = replay->counts.ticks;
  }
  EXPECT_GT(ticks, 3000u);
}

TEST(RecordingReplay, SaysWhereInputsWereLost) {
  const auto replay = replay_recording(bytes_of(record_file(delayed("contact"), 2, true, 4096)));
  ASSERT_TRUE(replay) << replay.error();
  EXPECT_TRUE(replay->equal()) << "drained at every tick, 4 KiB suffice: " << replay->error;
  const auto lost = replay_recording(bytes_of(record_file(delayed("eight_seats"), 2, true, 1024)));
  ASSERT_TRUE(lost) << lost.error();
  EXPECT_FALSE(lost->equal());
  EXPECT_NE(lost->error.find("lost inputs"), std::string::npos) << lost->error;
}

TEST(RecordingReplay, RefusesAFileWithoutInputs) {
  const auto replay = replay_recording(bytes_of(record_file(delayed("contact"), 2, false)));
  ASSERT_FALSE(replay);
  EXPECT_NE(replay.error().find("/inputs"), std::string::npos) << replay.error();
  EXPECT_NE(replay.error().find("It was made without them"), std::string::npos) << replay.error();
  EXPECT_FALSE(replay_recording(bytes_of("no recording")));
}

}  // namespace
}  // namespace tandem::netsim
