#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "proto/schema/scene.pb.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "proto/text/text_format_reader.h"

namespace tandem {
namespace {

pb::Scene by_protobuf(std::string_view text) {
  pb::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(std::string(text), &scene));
  return scene;
}

/// Our parser and protobuf's own parser read the same message from every text that ours accepts.
TEST(TextReaderTwin, ReadsShippedScenesAsProtobufDoes) {
  for (const auto& shipped : shipped_scenes()) {
    SCOPED_TRACE(shipped.name);
    pb::Scene ours;
    text::MessageValidator validator("twin.textproto");
    text::read_text_format(shipped.text, ours, validator);
    EXPECT_TRUE(validator.ok());
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(ours, by_protobuf(shipped.text)));
  }
}

TEST(TextReaderTwin, ReadsTextPrintedByProtobuf) {
  for (const auto& shipped : shipped_scenes()) {
    std::string printed;
    ASSERT_TRUE(google::protobuf::TextFormat::PrintToString(by_protobuf(shipped.text), &printed));
    const auto twin = parse_scene(printed, "twin.textproto");
    ASSERT_TRUE(twin.has_value()) << to_text(twin.error());
    EXPECT_EQ(effective_scene_text(*twin), effective_scene_text(*parse_scene(shipped.text, "twin.textproto")));
  }
}

TEST(TextReaderTwin, ReadsJsonToTheSameScene) {
  for (const auto& shipped : shipped_scenes()) {
    std::string json;
    google::protobuf::util::JsonPrintOptions options;
    options.preserve_proto_field_names = true;
    ASSERT_TRUE(google::protobuf::util::MessageToJsonString(by_protobuf(shipped.text), &json, options).ok());
    const auto twin = parse_scene(json, "twin.json");
    ASSERT_TRUE(twin.has_value()) << to_text(twin.error());
    EXPECT_EQ(effective_scene_text(*twin), effective_scene_text(*parse_scene(shipped.text, "twin.textproto")));
  }
}

}  // namespace
}  // namespace tandem
