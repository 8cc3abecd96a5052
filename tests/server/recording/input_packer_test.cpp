// Blocks of inputs: every journal comes back byte for byte, from any rows, and any bytes are safe.
#include "server/recording/input_packer.h"

#include <gtest/gtest.h>

#include <cstring>

#include "server/recording/input_block.h"
#include "server/recording/input_unpacker.h"
#include "server/session/input_records.h"
#include "tests/common/base/counts.h"
#include "tests/server/recording/recording_sample.h"

namespace tandem::server {
namespace {

using namespace server::test;

template <class Value>
void append(std::string& out, Value value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string piece_of(std::uint64_t position, std::string_view bytes) {
  std::string out;
  append(out, position);
  return out + std::string(bytes);
}

/// A datagram of the journal with the numbers of a record, and others.
std::string datagram(std::uint8_t seat, const SeatRecord& r, std::uint64_t e_in, float filtered) {
  std::string plaintext;
  append(plaintext, e_in * 3);
  append(plaintext, r.sample_tick);
  for (const double x : r.x) append(plaintext, static_cast<float>(x));
  plaintext += '\x12';
  append(plaintext, filtered);
  append(plaintext, r.e_in[0]);
  append(plaintext, r.f_out[1]);  // in double precision
  std::string out{static_cast<char>(InputRecord::kDatagram), static_cast<char>(seat), '\2', '\0'};
  append(out, static_cast<std::uint16_t>(plaintext.size()));
  append(out, std::int64_t{1'000'000});
  append(out, std::int64_t{0});
  return out + plaintext;
}

/// A recording's rows and the journal beside them.
struct Sample {
  SceneSpec scene = shipped_scene("contact");
  Lesson lesson;
  std::vector<TickRecord> records;
  std::vector<std::string> journal;  ///< of each tick
};

Sample sample_of(std::uint64_t seed, std::uint32_t ticks) {
  Sample out;
  RandomStream random{RandomKey{seed}};
  float filtered = 0;
  double v = 0;
  for (std::uint32_t tick = 1; tick <= ticks; ++tick) {
    TickRecord record = smooth_record(out.scene, tick);
    std::string inputs;
    for (std::uint8_t i = 0; i < 2; ++i) {
      SeatRecord& r = record.seats[i];
      for (double& x : r.x) x = static_cast<float>(random.below(1'000'000)) * 1e-7F;
      const auto before = static_cast<float>(v);
      v += static_cast<double>(random.below(1000)) * 1e-6 - 5e-4;
      r.v[0] = static_cast<float>(v);
      filtered = static_cast<float>(0.99 * static_cast<double>(filtered) +
                                    8.0 * (static_cast<double>(static_cast<float>(v)) - static_cast<double>(before)));
      r.e_in[0] = random.bits();
      r.f_out[1] = random.uniform(-1, 1);
      if (random.below(20) > 0) inputs += datagram(i, r, tick, i == 0 ? filtered : 0.F);  // others are lost
    }
    inputs += static_cast<char>(InputRecord::kTick);
    append(inputs, std::int64_t{0});
    append(inputs, std::uint32_t{0});
    append(inputs, std::uint32_t{1});
    append(inputs, static_cast<std::uint16_t>(random.bits()));
    if (random.below(50) == 0) inputs += std::string("\x08\x01", 2) + '\2';  // a removal
    if (random.below(50) == 0) inputs.append(random.below(40), '\0');        // the end of the ring
    out.journal.push_back(inputs);
    out.records.push_back(record);
  }
  out.lesson = *read_lesson(bytes_of([&] {
    RecordingWriter writer{out.scene, sample_info(out.scene)};
    for (const TickRecord& record : out.records) writer.add(record);
    writer.finish();
    return writer.take();
  }()));
  return out;
}

/// Packs the journal in blocks of any length and unpacks them. @return bytes of all blocks
std::size_t expect_same(const Sample& sample, RandomStream& random, std::string* some_block = nullptr) {
  InputPacker packer{sample.scene};
  InputUnpacker unpacker{sample.lesson};
  std::string all, back, block;
  std::size_t packed = 0;
  const auto take = [&](bool rest) {
    packer.take(block, rest);
    packed += block.size();
    if (block.empty()) return;
    const auto piece = unpacker.unpack(bytes_of(block));
    ASSERT_TRUE(piece);
    std::uint64_t position = 0;
    std::memcpy(&position, piece->data(), sizeof position);
    ASSERT_EQ(position, back.size());
    back += text_of(piece->subspan(sizeof position));
    if (some_block != nullptr && some_block->size() < block.size()) *some_block = block;
  };
  for (std::size_t k = 0; k < sample.records.size(); ++k) {
    packer.add_row(sample.records[k]);
    // Two pieces that end anywhere.
    const std::string& inputs = sample.journal[k];
    const std::size_t cut = random.below(inputs.size());
    for (const std::string_view part :
         {std::string_view{inputs}.substr(0, cut), std::string_view{inputs}.substr(cut)}) {
      EXPECT_TRUE(packer.add(bytes_of(piece_of(all.size(), part))));
      all += part;
      if (random.below(400) == 0) take(false);
    }
  }
  take(true);
  EXPECT_EQ(back == all, true) << back.size() << " of " << all.size() << " bytes";
  return packed;
}

TEST(InputPacker, GivesEveryJournalBackByteForByte) {
  const std::uint64_t count = tandem::test::seeds(20);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{RandomKey{seed}};
    const Sample sample = sample_of(seed, 600);
    std::size_t size = 0;
    for (const std::string& inputs : sample.journal) size += inputs.size();
    // 67 bytes of a datagram repeat numbers of the recording; 2 of each tick are a hash.
    EXPECT_LT(expect_same(sample, random), size / 4);
  }
}

TEST(InputPacker, KeepsBytesThatAreNoJournal) {
  const SceneSpec scene = shipped_scene("contact");
  const Lesson lesson;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    RandomStream random{RandomKey{seed}};
    std::string bytes(1 + random.below(3000), '\0');
    for (char& c : bytes) c = static_cast<char>(random.below(15));
    InputPacker packer{scene};
    ASSERT_TRUE(packer.add(bytes_of(piece_of(77, bytes))));
    std::string block;
    packer.take(block, true);
    InputUnpacker unpacker{lesson};
    const auto piece = unpacker.unpack(bytes_of(block));
    ASSERT_TRUE(piece) << seed;
    EXPECT_TRUE(text_of(*piece) == piece_of(77, bytes)) << seed;
    EXPECT_EQ(packer.size(), 0u);
  }
}

TEST(InputPacker, LeavesARecordThatIsNotWholeToTheNextBlock) {
  const SceneSpec scene = shipped_scene("contact");
  InputPacker packer{scene};
  const std::string removal{"\x08\x01\x02", 3};
  ASSERT_EQ(removal[0], static_cast<char>(InputRecord::kRemove));
  ASSERT_TRUE(packer.add(bytes_of(piece_of(0, removal + removal.substr(0, 2)))));
  std::string block;
  packer.take(block, false);
  EXPECT_EQ(packer.size(), 2u);
  ASSERT_TRUE(packer.add(bytes_of(piece_of(5, removal.substr(2)))));
  EXPECT_FALSE(packer.add(bytes_of(piece_of(7, removal)))) << "a gap";
  packer.take(block, false);
  const Lesson lesson;
  InputUnpacker unpacker{lesson};
  EXPECT_EQ(text_of(*unpacker.unpack(bytes_of(block))), piece_of(3, removal));
  packer.take(block, true);
  EXPECT_TRUE(block.empty());
}

TEST(InputUnpacker, IsSafeForAnyBytes) {
  const Sample sample = sample_of(1, 200);
  RandomStream random{RandomKey{3}};
  std::string block;
  static_cast<void>(expect_same(sample, random, &block));
  InputUnpacker unpacker{sample.lesson};
  for (std::size_t size = 0; size < block.size(); ++size)
    ASSERT_FALSE(unpacker.unpack(bytes_of(std::string_view{block}.substr(0, size)))) << size;
  const std::uint64_t count = tandem::test::seeds(3000);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    std::string bytes = block;
    for (std::uint64_t n = 1 + random.below(3); n > 0; --n)
      bytes[random.below(seed % 2 == 0 ? 400 : bytes.size())] = static_cast<char>(random.bits());
    const auto piece = unpacker.unpack(bytes_of(bytes));
    ASSERT_TRUE(!piece || piece->size() <= input_block::kPieceMax + sizeof(std::uint64_t));
  }
}

TEST(InputUnpacker, RefusesAPieceThatIsTooLong) {
  // 100 000 rows of 4 000 bytes: the block itself has 105 kB.
  std::string block = piece_of(0, "");
  append(block, std::uint32_t{1});
  append(block, std::uint32_t{0});
  append(block, std::uint32_t{100'000});
  block.append(100'000, '\0');
  block += '\1';
  append(block, input_block::kNoSeat);
  append(block, std::uint16_t{4000});
  append(block, input_block::kNoKey);
  block.append(4000, '\0');  // lanes of one byte without differences
  block.append(4000, 'x');
  const Lesson lesson;
  EXPECT_FALSE(InputUnpacker{lesson}.unpack(bytes_of(block)));
}

}  // namespace
}  // namespace tandem::server
