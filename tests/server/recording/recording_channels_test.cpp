#include "server/recording/recording_channels.h"

#include <gtest/gtest.h>

#include <set>

#include "common/mcap/mcap_reader.h"
#include "tests/server/recording/recording_sample.h"

namespace tandem::server {
namespace {

using namespace server::test;

std::set<std::string> topics_of(const std::string& file) {
  std::set<std::string> topics;
  const auto reader = mcap::Reader::open(bytes_of(file));
  for (const mcap::Channel& channel : reader->channels()) EXPECT_TRUE(topics.insert(channel.topic).second);
  return topics;
}

TEST(RecordingChannels, HaveTheirTopicsAndSchemas) {
  const SceneSpec scene = shipped_scene("contact");
  const std::string file = recording_of(scene, {smooth_record(scene, 1)});
  const std::set<std::string> topics = topics_of(file);
  for (const char* topic : {"/authority", "/session", "/inputs", "/link", "/events", "/marks", "/sheets", "/counts",
                            "/view/scene", "/tf", "/log"})
    EXPECT_TRUE(topics.contains(topic)) << topic;
  for (const SeatSpec& seat : scene.seats) EXPECT_TRUE(topics.contains("/" + seat.name + "/measured_cp"));
  const auto reader = mcap::Reader::open(bytes_of(file));
  for (const mcap::Channel& channel : reader->channels()) {
    EXPECT_EQ(channel.message_encoding, "protobuf");
    EXPECT_NE(std::ranges::find(reader->schemas(), channel.schema_id, &mcap::Schema::id), reader->schemas().end());
  }
}

TEST(RecordingChannels, GiveEverySeatAndToolATopicOfItsOwn) {
  SceneSpec scene = shipped_scene("contact");
  scene.seats[0].name = "link";
  scene.seats[1].name = "tool";
  scene.tools[0].name = "tool";
  EXPECT_EQ(seat_topic(scene, 0), "/link_");
  EXPECT_EQ(seat_topic(scene, 1), "/tool");
  EXPECT_EQ(tool_topic(scene, 0), "/tool_");
  static_cast<void>(topics_of(recording_of(scene, {smooth_record(scene, 1)})));
}

TEST(TickAccount, CountsDropsOnlyWhereTicksAreMissing) {
  TickAccount account;
  account.add(5);
  account.drop(10);  // of which the session clock passed two ticks
  account.add(8);
  EXPECT_EQ(account.ticks(), 4u);
  EXPECT_EQ(account.of(2).dropped, 2u);
  EXPECT_EQ(account.of(2).never_received, 0u);
  account.add(12);
  EXPECT_EQ(account.of(3).never_received, 3u);
  account.drop(1);
  account.finish();
  EXPECT_EQ(account.ticks(), 9u);
  EXPECT_EQ(account.of(3).dropped, 3u);
}

}  // namespace
}  // namespace tandem::server
