// Any bytes are safe to read: flipped bits, hostile lengths, random bytes behind a valid beginning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "common/base/rng.h"
#include "common/mcap/byte_order.h"
#include "common/mcap/mcap_repair.h"
#include "tests/common/base/counts.h"
#include "tests/common/mcap/mcap_sample.h"

namespace tandem::mcap {
namespace {

using namespace tandem::test;

/// Reads all of a file. Every message found is one of the sample's, or has another text than the sample only if no CRC
/// covers it; a chunk's CRC does.
void expect_only_true_messages(std::string_view bytes, const std::vector<std::string>& known) {
  const auto reader = Reader::open(bytes_of(bytes));
  if (!reader) return;
  MessageCursor cursor{*reader};
  while (const auto message = cursor.next()) {
    const std::string text{text_of(message->data)};
    const bool found = std::ranges::any_of(known, [&](const std::string& m) { return m.ends_with(text); });
    ASSERT_TRUE(found) << text;
  }
}

TEST(McapHostile, FlippedBitsGiveTrueMessagesOrNone) {
  const auto file = mcap::test::sample_file(2);
  const auto known = mcap::test::messages_of(*Reader::open(bytes_of(file.bytes)));
  std::string bytes = file.bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      SCOPED_TRACE(testing::Message() << "byte " << i << " bit " << bit);
      bytes[i] = static_cast<char>(bytes[i] ^ (1 << bit));
      // A chunk's compression and CRC fields themselves have no CRC: "crc = 0" means unknown, and one flip cannot make
      // it.
      expect_only_true_messages(bytes, known);
      if (HasFatalFailure()) return;
      bytes[i] = file.bytes[i];
    }
}

TEST(McapHostile, EveryLengthFieldIsChecked) {
  const auto file = mcap::test::sample_file(2);
  for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{0x7fffffff},
                                    std::uint64_t{0xffffffff}, ~std::uint64_t{0}, ~std::uint64_t{0} - 8})
    for (std::size_t size : {std::size_t{4}, std::size_t{8}})
      for (std::size_t i = 0; i + size <= file.bytes.size(); ++i) {
        std::string bytes = file.bytes;
        std::memcpy(bytes.data() + i, &value, size);
        const auto reader = Reader::open(bytes_of(bytes));
        if (!reader) continue;
        MessageCursor cursor{*reader};
        std::size_t messages = 0;
        while (cursor.next()) ++messages;
        ASSERT_LE(messages, 40u);
      }
}

TEST(McapHostile, AChunkThatStatesAHugeSizeTakesNoMemory) {
  std::string message;
  DataSection section{"", ""};
  std::string file = section.take();
  const std::size_t at = begin_record(file, Opcode::kChunk);
  put(file, std::uint64_t{0});
  put(file, std::uint64_t{0});
  put(file, ~std::uint64_t{0});  // decompressed size
  put(file, std::uint32_t{0});
  put_text(file, "zstd");
  put_text(file, "");
  put(file, std::uint32_t{0});
  end_record(file, at);
  const auto reader = Reader::open(bytes_of(file));
  ASSERT_TRUE(reader);
  MessageCursor cursor{*reader};
  EXPECT_FALSE(cursor.next());
  EXPECT_EQ(cursor.damaged(), 1u);
}

TEST(McapHostile, AnotherCompressionIsNamed) {
  std::string out;
  Decompressor decompressor;
  const auto done = decompressor.decompress("lz4", {}, 10, out);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().find("lz4"), std::string::npos);
}

TEST(McapHostile, RandomBytesBehindAHeaderAreSafe) {
  const std::string head = mcap::test::sample_file(1).bytes.substr(0, 200);
  const std::uint64_t count = seeds(200);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    std::string bytes = head;
    for (std::uint64_t n = random.below(400); n > 0; --n)
      bytes += static_cast<char>(random.below(4) == 0 ? random.below(256) : random.below(16));
    if (random.below(2) == 0) bytes += kMagic;
    const auto reader = Reader::open(bytes_of(bytes));
    ASSERT_TRUE(reader);
    MessageCursor cursor{*reader};
    while (cursor.next()) {
    }
    const auto repaired = repair(bytes_of(bytes));
    ASSERT_TRUE(repaired);
    ASSERT_TRUE(Reader::open(bytes_of(repaired->file))->complete());
  }
}

}  // namespace
}  // namespace tandem::mcap
