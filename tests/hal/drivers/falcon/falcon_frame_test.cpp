#include "hal/drivers/falcon/falcon_frame.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string_view>
#include <vector>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::hal {
namespace {

std::string text(std::span<const std::byte> bytes) {
  std::string s;
  for (const std::byte b : bytes) s += static_cast<char>(b);
  return s;
}
FalconBytes frame(std::string_view s) {
  FalconBytes out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<std::byte>(s[i]);
  return out;
}
FalconReply random_reply(RandomStream& random) {
  FalconReply reply;
  for (auto& e : reply.encoder) e = static_cast<std::int16_t>(static_cast<std::uint16_t>(random.bits()));
  reply.buttons = static_cast<std::uint8_t>(random.below(16));
  reply.homed = static_cast<std::uint8_t>(random.below(8));
  return reply;
}

TEST(FalconFrame, MatchesTheHandMadeFrame) {
  // 1 is nibbles 1000, -1 is FFFF, 0x1234 is 4321, each + 'A'; flags homing 1 + red 8 = 9, 'J'.
  const FalconCommand order{.motor = {1, -1, 0x1234}, .homing = true, .lights = 4};
  EXPECT_EQ(text(encode(order)), "<BAAAPPPPEDCBJA>");
  EXPECT_EQ(*decode_command(encode(order)), order);
  // Buttons 1 + 4 and legs 1 and 3 homed: 5 + 0x50 + 'A' = 0x96, far beyond 'P'.
  const FalconReply reply{.encoder = {0, 2200, -2200}, .buttons = 5, .homed = 5};
  EXPECT_EQ(text(encode(reply)), std::string("<AAAAIJIAIGHP\x96"
                                             "A>",
                                             16));
  EXPECT_EQ(*decode_reply(encode(reply)), reply);
}

TEST(FalconFrame, TakesFlagBitsFromItsTable) {
  const FalconFlagBits bits{.homing = 0x10, .light = {4, 8, 2}};
  const FalconCommand order{.motor = {}, .homing = true, .lights = 4};
  const FalconBytes bytes = encode(order, bits);
  EXPECT_EQ(static_cast<int>(bytes[13]), 0x41 + 0x12);
  EXPECT_EQ(*decode_command(bytes, bits), order);
}

TEST(FalconFrame, RoundTripsEveryNumberWithoutABracket) {
  for (int n = -32768; n <= 32767; ++n) {
    const auto v = static_cast<std::int16_t>(n);
    const FalconReply reply{.encoder = {v, static_cast<std::int16_t>(~v), 0}, .buttons = 0, .homed = 0};
    const FalconBytes bytes = encode(reply);
    for (std::size_t i = 1; i < 15; ++i) ASSERT_TRUE(bytes[i] >= std::byte{0x41} && bytes[i] <= std::byte{0x50});
    ASSERT_EQ(*decode_reply(bytes), reply);
  }
}

TEST(FalconFrame, RejectsFramesThatNoDeviceSends) {
  EXPECT_EQ(decode_reply(frame(";AAAAAAAAAAAAAA>")).error(), FrameError::kBrackets);
  EXPECT_EQ(decode_reply(frame("<AAAAAAAAAAAAAAA")).error(), FrameError::kBrackets);
  EXPECT_EQ(decode_reply(frame("<AAQAAAAAAAAAAA>")).error(), FrameError::kNibble);
  EXPECT_EQ(decode_reply(frame("<AA@AAAAAAAAAAA>")).error(), FrameError::kNibble);
  EXPECT_EQ(decode_reply(frame("<AAAAAAAAAAAA@A>")).error(), FrameError::kFlags);
  EXPECT_TRUE(decode_reply(frame("<AAAAAAAAAAAA\xC0Z>")));
  EXPECT_EQ(decode_reply(frame("<AAAAAAAAAAAA\xC1Z>")).error(), FrameError::kFlags);
}

TEST(FalconFramer, NeverMixesAnOlderFrameIntoANewerOne) {
  // 14 bytes of one reply, then a complete one: the '>' of the older reply must not complete the newer.
  FalconFramer framer;
  const FalconReply old{.encoder = {1, 2, 3}, .buttons = 15, .homed = 0};
  const FalconReply fresh{.encoder = {4, 5, 6}, .buttons = 0, .homed = 7};
  std::vector<FalconReply> seen;
  const auto push = [&](std::span<const std::byte> bytes) {
    for (const std::byte b : bytes) {
      if (const auto f = framer.push(b)) seen.push_back(*decode_reply(*f));
    }
  };
  push(std::span<const std::byte>(encode(old)).first(14));
  EXPECT_TRUE(framer.inside_frame());
  push(encode(fresh));
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0], fresh);
  EXPECT_EQ(framer.thrown_away(), 14u);
}

TEST(FalconFramer, FindsTheFrameAtEveryOffsetInGarbage) {
  const FalconReply reply{.encoder = {100, -100, 7}, .buttons = 2, .homed = 7};
  for (std::size_t before = 0; before < 40; ++before) {
    for (const std::byte junk : {std::byte{'<'}, std::byte{'>'}, std::byte{'A'}, std::byte{0}, std::byte{0xFF}}) {
      FalconFramer framer;
      for (std::size_t i = 0; i < before; ++i) ASSERT_FALSE(framer.push(junk));
      int found = 0;
      for (const std::byte b : encode(reply)) {
        if (const auto f = framer.push(b)) {
          ++found;
          EXPECT_EQ(*decode_reply(*f), reply);
        }
      }
      EXPECT_EQ(found, 1);
      EXPECT_EQ(framer.thrown_away(), before);
    }
  }
}

// Streams of complete replies: cut, flipped, doubled and mixed with random bytes, pushed byte by byte.
// Every returned frame must occur in the stream as 16 consecutive bytes. Every complete reply far from damage must be
// returned.
TEST(FalconFramer, SurvivesTenMillionHostileFrames) {
  const std::size_t frames = test::draws(200'000, 10'000'000, 10'000'000);
  std::printf("[  frames  ] %zu\n", frames);
  RandomStream random(4711);
  FalconFramer framer;
  std::array<std::byte, 16> last{};
  std::size_t at = 0, whole = 0, out = 0, damaged = 0;
  const auto push = [&](std::byte b) {
    last[at++ % 16] = b;
    const auto f = framer.push(b);
    if (!f) return false;
    ++out;
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ((*f)[i], last[(at + i) % 16]) << "stale bytes in a frame";
    return true;
  };
  for (std::size_t n = 0; n < frames; ++n) {
    const FalconReply reply = random_reply(random);
    FalconBytes bytes = encode(reply);
    switch (random.below(6)) {
      case 0: {  // a flipped byte: rejected, or another valid frame; never more than one
        bytes[random.below(16)] ^= static_cast<std::byte>(1 + random.below(255));
        ++damaged;
        for (const std::byte b : bytes) (void)push(b);
        break;
      }
      case 1: {  // cut short
        const std::size_t length = random.below(16);
        ++damaged;
        for (std::size_t i = 0; i < length; ++i) (void)push(bytes[i]);
        break;
      }
      case 2: {  // random bytes
        const std::size_t length = random.below(24);
        for (std::size_t i = 0; i < length; ++i) (void)push(static_cast<std::byte>(random.below(256)));
        [[fallthrough]];
      }
      default: {
        bool found = false;
        for (const std::byte b : bytes) {
          const bool complete = push(b);
          ASSERT_FALSE(found) << "a frame ended twice";
          found = complete;
        }
        ASSERT_TRUE(found) << "frame " << n << " was lost";
        ++whole;
      }
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(out, whole);
  EXPECT_LE(out, whole + damaged + frames / 100);
}

}  // namespace
}  // namespace tandem::hal
