#include "common/mcap/mcap_reader.h"

#include <gtest/gtest.h>

#include "common/mcap/byte_order.h"
#include "common/mcap/crc32.h"
#include "tests/common/mcap/mcap_sample.h"

namespace tandem::mcap {
namespace {

using test::kSampleChunk;

TEST(McapReader, FindsAllPartsOfACompleteFile) {
  const auto file = test::sample_file();
  const auto reader = Reader::open(bytes_of(file.bytes));
  ASSERT_TRUE(reader);
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->profile(), "x-test");
  EXPECT_EQ(reader->library(), "test");
  ASSERT_EQ(reader->schemas().size(), 1u);
  EXPECT_EQ(reader->schemas()[0].name, "test.Text");
  ASSERT_EQ(reader->channels().size(), 2u);
  EXPECT_EQ(reader->channels()[0].metadata.at("kind"), "seat");
  EXPECT_EQ(reader->channels()[1].schema_id, 0);
  ASSERT_EQ(reader->metadata().size(), 2u);
  ASSERT_NE(reader->metadata("session"), nullptr);
  EXPECT_EQ(reader->metadata("session")->at("seed"), "7");
  EXPECT_EQ(reader->metadata("other"), nullptr);
  ASSERT_EQ(reader->attachments().size(), 1u);
  EXPECT_EQ(reader->attachments()[0].data, "a scene");
  ASSERT_TRUE(reader->statistics());
  EXPECT_EQ(reader->statistics()->messages, 60u);
  EXPECT_EQ(reader->statistics()->chunks, 3u);
  EXPECT_EQ(reader->statistics()->channel_messages.at(1), 30u);
  EXPECT_EQ(reader->statistics()->start_time, 0u);
  EXPECT_EQ(reader->statistics()->end_time, 29'000u);
  const auto messages = test::messages_of(*reader);
  ASSERT_EQ(messages.size(), 60u);
  EXPECT_EQ(messages[0], "/a 0 message a 0");
  EXPECT_EQ(messages[59], "/b 29 message b 29");
}

TEST(McapReader, GivesAllWholeChunksOfACutFile) {
  const auto file = test::sample_file();
  const auto uncut = Reader::open(bytes_of(file.bytes));
  const auto whole = test::messages_of(*uncut);
  std::size_t complete = 0;
  for (std::size_t size = 0; size <= file.bytes.size(); ++size) {
    SCOPED_TRACE(size);
    const auto reader = Reader::open(bytes_of(std::string_view{file.bytes}.substr(0, size)));
    if (!reader) {
      ASSERT_LT(size, kMagic.size() + kRecordHead + 4 + 6 + 4 + 4);
      continue;
    }
    complete += reader->complete() ? 1 : 0;
    std::size_t chunks = 0;
    // A chunk is whole before its message indexes are.
    for (const std::uint64_t offset : uncut->parts())
      chunks += record_at(bytes_of(file.bytes), offset)->end() <= size ? 1 : 0;
    const auto messages = test::messages_of(*reader);
    ASSERT_EQ(messages.size(), chunks * 2 * kSampleChunk);
    ASSERT_TRUE(std::equal(messages.begin(), messages.end(), whole.begin()));
  }
  EXPECT_EQ(complete, 1u) << "only the whole file has its end";
}

TEST(McapReader, ReadsATimeRange) {
  const auto file = test::sample_file();
  const auto reader = Reader::open(bytes_of(file.bytes));
  const auto messages = test::messages_of(*reader, {.from = 9'000, .to = 11'000});
  EXPECT_EQ(messages, (std::vector<std::string>{"/a 9 message a 9", "/b 9 message b 9", "/a 10 message a 10",
                                                "/b 10 message b 10", "/a 11 message a 11", "/b 11 message b 11"}));
}

TEST(McapReader, SkipsADamagedChunkAndNamesIt) {
  auto file = test::sample_file();
  const std::uint64_t second = Reader::open(bytes_of(file.bytes))->parts()[1];
  file.bytes[second + 60] ^= 1;  // inside the compressed records
  const auto reader = Reader::open(bytes_of(file.bytes));
  MessageCursor cursor{*reader};
  std::size_t messages = 0;
  while (cursor.next()) ++messages;
  EXPECT_EQ(messages, 40u);
  EXPECT_EQ(cursor.damaged(), 1u);
  ASSERT_TRUE(cursor.first_damage());
  EXPECT_EQ(cursor.first_damage()->offset, second);
  EXPECT_EQ(cursor.first_damage()->text("a.mcap").substr(0, 13), "a.mcap: byte ");
}

TEST(McapReader, IgnoresUnknownRecordsAndFields) {
  std::string file{kMagic};
  std::size_t at = begin_record(file, Opcode::kHeader);
  put_text(file, "p");
  put_text(file, "l");
  put_text(file, "a field of a later version");
  end_record(file, at);
  at = begin_record(file, static_cast<Opcode>(0x80));  // of an application
  put_text(file, "private");
  end_record(file, at);
  const auto reader = Reader::open(bytes_of(file));
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->library(), "l");
  EXPECT_EQ(reader->data_end(), file.size());
}

TEST(McapReader, ReadsDefinitionsAndMessagesWhereverTheyAre) {
  // As other writers do: an uncompressed chunk that defines its channel, and a message outside chunks.
  std::string records;
  std::size_t at = begin_record(records, Opcode::kChannel);
  put(records, std::uint16_t{7});
  put(records, std::uint16_t{0});
  put_text(records, "/inside");
  put_text(records, "text");
  put(records, std::uint32_t{0});
  end_record(records, at);
  std::string message;
  at = begin_record(message, Opcode::kMessage);
  put(message, std::uint16_t{7});
  put(message, std::uint32_t{1});
  put(message, std::uint64_t{10});
  put(message, std::uint64_t{10});
  message += "hello";
  end_record(message, at);
  records += message;
  DataSection section{"", ""};
  std::string file = section.take();
  at = begin_record(file, Opcode::kChunk);
  put(file, std::uint64_t{10});
  put(file, std::uint64_t{10});
  put(file, std::uint64_t{records.size()});
  put(file, crc32(bytes_of(records)));
  put_text(file, "");
  put(file, std::uint64_t{records.size()});
  file += records;
  end_record(file, at);
  file += message;
  const auto reader = Reader::open(bytes_of(file));
  ASSERT_TRUE(reader);
  EXPECT_EQ(test::messages_of(*reader), (std::vector<std::string>{"/inside 1 hello", "/inside 1 hello"}));
}

TEST(McapReader, RefusesOtherFilesWithWords) {
  for (const std::string& bytes : {std::string(), std::string("not an MCAP file"), std::string(kMagic)}) {
    const auto reader = Reader::open(bytes_of(bytes));
    ASSERT_FALSE(reader);
    EXPECT_FALSE(reader.error().message.empty());
  }
}

}  // namespace
}  // namespace tandem::mcap
