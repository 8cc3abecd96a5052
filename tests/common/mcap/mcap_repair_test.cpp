#include "common/mcap/mcap_repair.h"

#include <gtest/gtest.h>

#include "tests/common/mcap/mcap_sample.h"

namespace tandem::mcap {
namespace {

TEST(McapRepair, LeavesACompleteFileAlone) {
  const auto file = test::sample_file();
  const auto result = repair(bytes_of(file.bytes));
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->was_complete);
  EXPECT_EQ(result->file, file.bytes);
  EXPECT_EQ(result->messages, 60u);
  EXPECT_EQ(result->chunks, 3u);
}

TEST(McapRepair, ClosesEveryCutOfAFile) {
  const auto file = test::sample_file();
  const auto whole = test::messages_of(*Reader::open(bytes_of(file.bytes)));
  for (std::size_t size = 100; size < file.bytes.size(); ++size) {
    SCOPED_TRACE(size);
    const std::string_view cut = std::string_view{file.bytes}.substr(0, size);
    const auto before = Reader::open(bytes_of(cut));
    ASSERT_TRUE(before);
    const auto result = repair(bytes_of(cut));
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->was_complete);
    const auto after = Reader::open(bytes_of(result->file));
    ASSERT_TRUE(after);
    ASSERT_TRUE(after->complete());
    ASSERT_EQ(test::messages_of(*after), test::messages_of(*before));
    ASSERT_EQ(after->statistics()->messages, result->messages);
    ASSERT_EQ(after->channels().size(), before->channels().size());
    ASSERT_EQ(after->metadata().size(), before->metadata().size());
    ASSERT_EQ(result->lost_bytes, size - before->data_end());
  }
}

TEST(McapRepair, GivesTheIndexOfTheWriterAgain) {
  const auto file = test::sample_file();
  const auto result = repair(bytes_of(std::string_view{file.bytes}.substr(0, file.chunk_ends.back())));
  ASSERT_TRUE(result);
  const auto made = parse_summary(bytes_of(file.bytes)), again = parse_summary(bytes_of(result->file));
  ASSERT_TRUE(made && again);
  ASSERT_EQ(again->chunks.size(), made->chunks.size());
  for (std::size_t i = 0; i < made->chunks.size(); ++i) {
    EXPECT_EQ(again->chunks[i].start_time, made->chunks[i].start_time);
    EXPECT_EQ(again->chunks[i].end_time, made->chunks[i].end_time);
    EXPECT_EQ(again->chunks[i].length, made->chunks[i].length);
    EXPECT_EQ(again->chunks[i].index_length, made->chunks[i].index_length);
  }
  EXPECT_EQ(again->statistics->channel_messages, made->statistics->channel_messages);
}

TEST(McapRepair, LeavesOutADamagedChunk) {
  auto file = test::sample_file();
  file.bytes[Reader::open(bytes_of(file.bytes))->parts()[1] + 60] ^= 1;
  const auto result = repair(bytes_of(file.bytes));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->damaged, 1u);
  EXPECT_EQ(result->chunks, 2u);
  EXPECT_EQ(result->messages, 40u);
  EXPECT_EQ(test::messages_of(*Reader::open(bytes_of(result->file))).size(), 40u);
}

TEST(McapRepair, RefusesAnotherKindOfFile) { EXPECT_FALSE(repair(bytes_of("no recording"))); }

}  // namespace
}  // namespace tandem::mcap
