// The thread between the tick records of a session and its recording.
#include "server/app/process/recorder.h"

#include <gtest/gtest.h>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::server {
namespace {

/// Records of a session that makes one of 17 ticks until it knows of its recording.
TEST(Recorder, BeginsARecordingWithTheFirstOfItsTicks) {
  const SceneSpec scene = *parse_scene(find_shipped_scene("free_motion")->text, "free_motion.textproto");
  TickQueue records(256, scene.seats.size(), scene.tools.size());
  io::OutputFile trace;
  const auto feed = std::make_shared<TickFeed>(scene.seats.size(), scene.tools.size());
  Recorder recorder(scene, records, trace);
  recorder.copy_to(feed);
  const auto add = [&](std::uint32_t tick, bool every_tick) {
    TickRecord record;
    record.tick = tick;
    record.running = true;
    record.every_tick = every_tick;
    ASSERT_TRUE(records.push(record));
  };
  add(17, false);
  add(34, false);
  for (std::uint32_t tick = 43; tick < 60; ++tick) add(tick, true);
  recorder.finish();
  std::vector<std::uint32_t> recorded;
  for (const TickRecord* record = feed->ticks().front(); record != nullptr; record = feed->ticks().front()) {
    recorded.push_back(record->tick);
    feed->ticks().pop();
  }
  ASSERT_EQ(recorded.size(), 17U) << "no row from before, which a gap of 9 ticks would follow";
  EXPECT_EQ(recorded.front(), 43U);
  EXPECT_EQ(recorded.back(), 59U);
}

}  // namespace
}  // namespace tandem::server
