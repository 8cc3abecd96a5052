// The bytes of files, against the tables of https://mcap.dev/spec.
#include "common/mcap/mcap_writer.h"

#include <gtest/gtest.h>

#include "common/base/hex.h"
#include "common/mcap/crc32.h"
#include "tests/common/mcap/mcap_sample.h"

namespace tandem::mcap {
namespace {

std::string hex(std::string_view text) { return to_hex(bytes_of(text)); }

TEST(Crc32, IsThatOfZlib) {
  EXPECT_EQ(crc32(bytes_of("123456789")), 0xcbf43926u);  // check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc32(bytes_of("6789"), crc32(bytes_of("12345"))), 0xcbf43926u);
}

TEST(McapWriter, BeginsWithMagicAndHeader) {
  Writer writer{"p", "lib"};
  EXPECT_EQ(hex(writer.take()),
            "894d434150300d0a"  // magic
            "01"
            "0c00000000000000"  // header, 12 bytes
            "01000000"
            "70"  // profile
            "03000000"
            "6c6962");  // library
}

TEST(McapWriter, WritesDefinitionsByTheTable) {
  Writer writer{"", ""};
  static_cast<void>(writer.take());
  EXPECT_EQ(writer.add_schema("s", "protobuf", "D"), 1);
  EXPECT_EQ(hex(writer.take()),
            "03"
            "1800000000000000"
            "0100"
            "01000000"
            "73"
            "08000000"
            "70726f746f627566"
            "01000000"
            "44");
  EXPECT_EQ(writer.add_channel("/t", 1, "pb", {{"k", "v"}}), 1);
  EXPECT_EQ(hex(writer.take()),
            "04"
            "1e00000000000000"
            "0100"
            "0100"
            "02000000"
            "2f74"
            "02000000"
            "7062"
            "0a000000"
            "01000000"
            "6b"
            "01000000"
            "76");
}

TEST(McapWriter, EndsAnEmptyFileWithDataEndSummaryAndFooter) {
  Writer writer{"", ""};
  const std::string begin = writer.take();
  writer.finish();
  const std::string end = writer.take();
  ASSERT_GE(end.size(), 13u);
  EXPECT_EQ(hex(end.substr(0, 9)),
            "0f"
            "0400000000000000");
  const std::uint32_t crc = crc32(bytes_of(begin));
  EXPECT_EQ(end.substr(9, 4), std::string(reinterpret_cast<const char*>(&crc), 4));
  EXPECT_EQ(hex(end.substr(end.size() - 8)), "894d434150300d0a");
  // Statistics are all that the summary of an empty file has: opcode 11, 46 bytes of zeros.
  EXPECT_EQ(hex(end.substr(13, 9 + 46)),
            "0b"
            "2e00000000000000" +
                std::string(2 * 46, '0'));
}

TEST(McapWriter, GivesWholeRecordsAtAnyTime) {
  Writer writer{"", ""};
  const std::uint16_t channel = writer.add_channel("/t", 0, "text");
  std::string file;
  for (std::uint32_t n = 0; n < 100; ++n) {
    writer.add_message(channel, n, n, std::string(n, 'x'));
    if (n % 7 == 0) writer.close_chunk();
    file += writer.take();
    const auto reader = Reader::open(bytes_of(file));
    ASSERT_TRUE(reader);
    ASSERT_EQ(reader->data_end(), file.size());
    ASSERT_EQ(test::messages_of(*reader).size(), n / 7 * 7 + 1);
  }
}

TEST(McapWriter, ClosesNoEmptyChunk) {
  Writer writer{"", ""};
  writer.close_chunk();
  EXPECT_EQ(writer.statistics().chunks, 0u);
}

TEST(McapWriter, GivesTheSameBytesAgain) { EXPECT_EQ(test::sample_file().bytes, test::sample_file().bytes); }

TEST(McapWriter, WritesNoChunkIndexBeyondItsBound) {
  DataSection section{"", ""};
  const std::map<std::uint16_t, ChunkContent::Places> none;
  std::string file;
  for (std::size_t k = 0; k <= DataSection::kChunksIndexed; ++k) {
    section.add_chunk({.compression = "", .records = "", .places = &none});
    if (k % 1000 == 0) file += section.take();
  }
  section.finish();
  file += section.take();
  const auto reader = Reader::open(bytes_of(file));
  ASSERT_TRUE(reader);
  EXPECT_TRUE(reader->complete());
  EXPECT_EQ(reader->parts().size(), DataSection::kChunksIndexed + 1);
  const auto summary = parse_summary(bytes_of(file));
  ASSERT_TRUE(summary);
  EXPECT_TRUE(summary->chunks.empty());
}

}  // namespace
}  // namespace tandem::mcap
