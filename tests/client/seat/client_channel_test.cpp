#include "client/seat/client_channel.h"

#include <gtest/gtest.h>

#include <array>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr Time kNow{1s};

/// A channel whose server end is `server`.
struct ChannelPair {
  wire::Codec codec{3, PortSpace::kTip};
  ClientChannel channel{{transport::Direction::kToServer, 1, 2}, codec};
  transport::SecureChannel server{{transport::Direction::kToClient, 2, 1}};
  std::array<std::byte, transport::kDatagramMax> buffer{};

  void challenge(std::uint64_t number) {
    const std::size_t size = codec.encode(server.preamble(kNow, 0), wire::PathMessage{number}, buffer);
    channel.on_path_challenge(std::span{buffer}.first(size));
  }
};

TEST(ClientChannel, AnswersTheNewestPathChallengeOnce) {
  ChannelPair ends;
  EXPECT_FALSE(ends.channel.answer_due());
  ends.challenge(7);
  ends.challenge(8);
  ASSERT_TRUE(ends.channel.answer_due());
  const auto size = ends.channel.seal_answer(kNow, 5, ends.buffer);
  ASSERT_TRUE(size);
  EXPECT_FALSE(ends.channel.answer_due());
  const auto opened = ends.server.open(kNow, std::span{ends.buffer}.first(*size));
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->type, wire::Type::kPathResponse);
  const auto answer = ends.codec.decode_path(opened->plaintext);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->message.token, 8U);
  EXPECT_EQ(answer->preamble.tick, 5U);
  EXPECT_EQ(ends.channel.link().stats().others, 2U) << "a challenge is no sample, and it is not lost";
}

TEST(ClientChannel, CountsAnInvalidChallengeAndDoesNotAnswerIt) {
  ChannelPair ends;
  ends.channel.on_path_challenge({});
  EXPECT_FALSE(ends.channel.answer_due());
  EXPECT_EQ(ends.channel.link().stats().dropped[static_cast<std::size_t>(transport::DropReason::kBody)], 1U);
  EXPECT_EQ(ends.channel.link().stats().others, 0U);
}

TEST(ClientChannel, DropsADueAnswerWithTheConnectionAndReturnsTheOldOne) {
  ChannelPair ends;
  ends.challenge(7);
  auto next = std::make_unique<transport::SecureChannel>(
      transport::SecureChannel::Params{transport::Direction::kToServer, 1, 3});
  ends.channel.swap_link(next);
  EXPECT_FALSE(ends.channel.answer_due());
  EXPECT_EQ(ends.channel.link().peer_cid(), 3U);
  EXPECT_EQ(next->peer_cid(), 2U);
}

TEST(ClientChannel, SealsNothingIntoABufferThatIsTooSmall) {
  ChannelPair ends;
  const wire::CloseMessage close{wire::CloseReason::kLeaving};
  EXPECT_FALSE(
      ends.channel.seal(kNow, 0, wire::Type::kClose, close, std::span{ends.buffer}.first(transport::kHeaderSize)));
  EXPECT_EQ(ends.channel.link().stats().sent, 0U);
  EXPECT_TRUE(ends.channel.seal(kNow, 0, wire::Type::kClose, close, ends.buffer));
  EXPECT_EQ(ends.channel.link().stats().sent, 1U);
}

}  // namespace
}  // namespace tandem::client
