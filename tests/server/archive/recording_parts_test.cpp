// Recordings that are read in parts: the parts together are the whole, whatever was cut or damaged.
#include "server/archive/recording_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "common/base/raw_bytes.h"
#include "common/base/rng.h"
#include "common/mcap/mcap_writer.h"
#include "common/mcap/message_cursor.h"
#include "proto/recording/lesson_reader.h"
#include "server/archive/summary_reader.h"
#include "tests/support/recorded_bytes.h"

namespace tandem::server {
namespace {

using tandem::test::recorded_bytes;

ReadAt reader_of(const std::vector<std::byte>& bytes) {
  return [&bytes](std::uint64_t offset, std::span<std::byte> into) {
    const std::size_t begin = std::min<std::size_t>(static_cast<std::size_t>(offset), bytes.size());
    const std::size_t count = std::min(into.size(), bytes.size() - begin);
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(begin), count, into.begin());
    return count;
  };
}

TEST(RecordingParts, TogetherAreTheWholeRecording) {
  const auto bytes = recorded_bytes("contact", 3);
  const auto read = reader_of(bytes);
  const auto parts = RecordingParts::find(read, bytes.size());
  ASSERT_TRUE(parts) << parts.error();
  EXPECT_TRUE(parts->complete());
  ASSERT_GE(parts->size(), 6u) << "chunks of 500 ms";
  const auto whole = read_lesson(bytes);
  ASSERT_TRUE(whole);
  const auto again = read_lesson(parts->piece(read, 0, parts->size()));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->tick, whole->tick);
  EXPECT_EQ(again->seats[0].x, whole->seats[0].x);
  std::vector<std::uint32_t> ticks;
  for (std::size_t i = 0; i < parts->size(); i += 3) {
    const auto piece = read_lesson(parts->piece(read, i, i + 3));
    ASSERT_TRUE(piece);
    EXPECT_LT(piece->rows(), whole->rows());
    ticks.insert(ticks.end(), piece->tick.begin(), piece->tick.end());
  }
  EXPECT_EQ(ticks, whole->tick);
  EXPECT_EQ(read_summary(*parts, read), summary_of(*whole));
}

/// A recording with every message in a chunk of its own, so that chunks end within ticks. At every third tick, the
/// message of each channel repeats the one before, so that some samples are not fresh.
std::vector<std::byte> with_a_chunk_per_message(const std::vector<std::byte>& bytes) {
  const auto reader = mcap::Reader::open(bytes);
  mcap::MessageCursor cursor{*reader};
  mcap::Writer writer{reader->profile(), "test"};
  for (const mcap::Metadata& metadata : reader->metadata()) writer.add_metadata(metadata);
  for (const mcap::Channel& channel : cursor.channels())
    writer.add_channel(channel.topic, 0, channel.message_encoding, channel.metadata);
  std::map<std::uint16_t, std::string> last;
  while (const auto message = cursor.next()) {
    std::string& data = last[message->channel];
    if (data.empty() || message->sequence % 3 != 0) data = text_of(message->data);
    writer.add_message(message->channel, message->sequence, message->log_time, data);
    writer.close_chunk();
  }
  writer.finish();
  const std::string text = writer.take();
  const auto all = bytes_of(text);
  return {all.begin(), all.end()};
}

TEST(RecordingParts, AreTheWholeLessonWhenRowsAreTakenBetweenThem) {
  const auto bytes = with_a_chunk_per_message(recorded_bytes("contact", 0.2));
  const auto read = reader_of(bytes);
  const auto parts = RecordingParts::find(read, bytes.size());
  ASSERT_TRUE(parts) << parts.error();
  const auto whole = read_lesson(bytes);
  ASSERT_TRUE(whole) << whole.error();
  ASSERT_GT(parts->size(), 3 * whole->rows()) << "ticks have several chunks";
  LessonReader reader;
  ASSERT_TRUE(reader.begin_file(parts->piece(read, 0, 0), bytes.size()));
  std::size_t row = 0;
  for (std::size_t i = 0; i < parts->size(); ++i) {
    reader.add_piece(parts->piece(read, i, i + 1));
    const Lesson rows = reader.take_rows(i + 1 == parts->size());
    for (std::size_t k = 0; k < rows.rows(); ++k, ++row) {
      ASSERT_EQ(rows.tick[k], whole->tick[row]);
      for (std::size_t seat = 0; seat < 2; ++seat) {
        ASSERT_EQ(rows.seats[seat].fresh[k], whole->seats[seat].fresh[row]) << "row " << row;
        ASSERT_EQ(rows.seats[seat].sample_tick[k], whole->seats[seat].sample_tick[row]) << "row " << row;
        ASSERT_EQ(rows.seats[seat].x[k], whole->seats[seat].x[row]);
      }
      ASSERT_EQ(rows.tools[0].x[k], whole->tools[0].x[row]);
    }
  }
  reader.end_file(parts->complete());
  EXPECT_EQ(row, whole->rows());
  EXPECT_LT(std::ranges::count(whole->seats[0].fresh, 1), static_cast<std::ptrdiff_t>(row)) << "some are repeated";
  const Lesson head = reader.take();
  EXPECT_EQ(head.rows(), 0u);
  EXPECT_EQ(head.complete, whole->complete);
  EXPECT_EQ(head.events.size(), whole->events.size());
}

TEST(RecordingParts, OfACutFileEndBeforeTheCut) {
  auto bytes = recorded_bytes("free_motion", 2);
  const std::size_t size = bytes.size();
  for (const double share : {0.9, 0.5, 0.1}) {
    SCOPED_TRACE(share);
    bytes.resize(static_cast<std::size_t>(share * static_cast<double>(size)));
    const auto read = reader_of(bytes);
    const auto parts = RecordingParts::find(read, bytes.size());
    const auto lesson = read_lesson(bytes);
    ASSERT_EQ(parts.has_value(), lesson.has_value());
    if (!parts) continue;
    EXPECT_FALSE(parts->complete());
    EXPECT_EQ(read_summary(*parts, read), summary_of(*lesson));
  }
}

TEST(RecordingParts, RefuseWhatIsNoRecording) {
  const std::vector<std::byte> none, zeros(1000);
  for (const auto* bytes : {&none, &zeros}) {
    const auto parts = RecordingParts::find(reader_of(*bytes), bytes->size());
    ASSERT_FALSE(parts);
    EXPECT_NE(parts.error().find("MCAP"), std::string::npos) << parts.error();
  }
}

// Seeds 1..200: any flipped byte and any length gives parts, an error, or fewer rows, and never more than there are.
TEST(RecordingParts, SurviveAnyFlippedByte) {
  const auto bytes = recorded_bytes("one_axis", 1);
  const auto whole = read_lesson(bytes);
  ASSERT_TRUE(whole);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    auto damaged = bytes;
    for (int i = 0; i < 3; ++i)
      damaged[random.bits() % damaged.size()] ^= static_cast<std::byte>(1 + random.bits() % 255);
    const auto read = reader_of(damaged);
    const auto parts = RecordingParts::find(read, damaged.size());
    if (!parts) continue;
    const auto piece = read_lesson(parts->piece(read, 0, parts->size()));
    if (piece) {
      EXPECT_LE(piece->rows(), whole->rows() + 100);
    }
    static_cast<void>(read_summary(*parts, read));
  }
}

TEST(RecordingParts, BoundTheMemoryOfDefinitions) {
  auto bytes = recorded_bytes("one_axis", 1);
  std::uint64_t offset = 8;  // the header begins behind the magic
  std::uint64_t content = 0;
  std::memcpy(&content, bytes.data() + offset + 1, sizeof content);
  offset += 9 + content;
  std::vector<std::byte> large(9 + (17u << 20));
  large[0] = std::byte{12};  // metadata
  content = large.size() - 9;
  std::memcpy(large.data() + 1, &content, sizeof content);
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(offset), large.begin(), large.end());
  const auto parts = RecordingParts::find(reader_of(bytes), bytes.size());
  ASSERT_FALSE(parts);
  EXPECT_EQ(parts.error(), "has more than 16 MiB of definitions");
}

}  // namespace
}  // namespace tandem::server
