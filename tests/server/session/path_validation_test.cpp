#include "server/session/path_validation.h"

#include <gtest/gtest.h>

#include <vector>

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr Time at(Duration d) { return Time{1h + d}; }

PeerAddress address(std::uint8_t n) {
  PeerAddress e;
  e.bytes[0] = std::byte{n};
  e.size = 1;
  return e;
}

/// Tokens that count up from `first`, so that a test knows the next one.
PathTokens tokens_from(std::uint64_t first) {
  PathTokens tokens;
  for (std::uint64_t n = PathTokens::kMax; n-- > 0;) tokens.add(first + n);
  return tokens;
}

TEST(PathTokens, GivesEachTokenOnceAndNoneWhenEmpty) {
  PathTokens tokens = tokens_from(7);
  EXPECT_EQ(tokens.free_slots(), 0U);
  tokens.add(99);  // the store is full: no effect
  for (std::uint64_t n = 0; n < PathTokens::kMax; ++n) EXPECT_EQ(tokens.take(), 7 + n);
  EXPECT_TRUE(tokens.low());
  EXPECT_FALSE(tokens.take());
  PathValidation proof;
  proof.on_datagram_from(at(0ms), address(1), tokens);
  EXPECT_FALSE(proof.challenge_due(at(0ms))) << "without a token no challenge is sent";
  tokens.add(5);
  proof.on_datagram_from(at(1ms), address(1), tokens);
  EXPECT_EQ(proof.challenge_due(at(1ms))->token, 5U);
}

TEST(PathValidation, SendsNoMoreChallengesThanDatagramsCame) {
  PathTokens tokens = tokens_from(7);
  PathValidation proof;
  proof.on_datagram_from(at(0ms), address(1), tokens);
  int asked = 0;
  for (Duration t = 0ms; t < 1000ms; t += 1ms) asked += proof.challenge_due(at(t)) ? 1 : 0;
  EXPECT_EQ(asked, 1) << "one datagram came, whose source may be forged";
  proof.on_datagram_from(at(1000ms), address(1), tokens);
  proof.on_datagram_from(at(1000ms), address(1), tokens);
  for (Duration t = 1000ms; t < 2000ms; t += 1ms) asked += proof.challenge_due(at(t)) ? 1 : 0;
  EXPECT_EQ(asked, 3);
}

TEST(PathValidation, SendsAtMostFiveChallengesIn250Milliseconds) {
  PathTokens tokens = tokens_from(7);
  PathValidation proof;
  EXPECT_FALSE(proof.challenge_due(at(0ms)));
  proof.on_datagram_from(at(0ms), address(1), tokens);
  std::vector<Duration> asked;
  for (Duration t = 0ms; t < 240ms; t += 1ms) {
    if (const auto c = proof.challenge_due(at(t))) {
      EXPECT_EQ(c->to, address(1));
      EXPECT_EQ(c->token, 7U);
      asked.push_back(t);
    }
    proof.on_datagram_from(at(t), address(1), tokens);  // more datagrams from there cause no more challenges
  }
  EXPECT_EQ(asked, (std::vector<Duration>{0ms, 50ms, 100ms, 150ms, 200ms}));
}

TEST(PathValidation, AcceptsAResponseOnceAndOnlyFromTheChallengedAddress) {
  PathTokens tokens = tokens_from(7);
  PathValidation proof;
  proof.on_datagram_from(at(0ms), address(1), tokens);
  EXPECT_FALSE(proof.on_response(address(2), 7));
  EXPECT_FALSE(proof.on_response(address(1), 8));
  EXPECT_TRUE(proof.on_response(address(1), 7));
  EXPECT_FALSE(proof.on_response(address(1), 7));
  EXPECT_FALSE(proof.challenge_due(at(50ms)));
}

TEST(PathValidation, AcceptsALateResponse) {
  PathValidation proof;
  PathTokens tokens = tokens_from(7);
  int asked = 0;
  for (Duration t = 0ms; t < 1000ms; t += 1ms) {
    proof.on_datagram_from(at(t), address(1), tokens);
    asked += proof.challenge_due(at(t)) ? 1 : 0;
  }
  EXPECT_EQ(asked, 20) << "five in 250 ms, repeated while datagrams arrive from there";
  EXPECT_TRUE(proof.on_response(address(1), 7)) << "a second later: the first challenge is still good";
}

TEST(PathValidation, ChallengesTheClientWhileAnUnknownPeerSendsCopies) {
  PathTokens tokens = tokens_from(7);
  PathValidation proof;
  proof.on_datagram_from(at(0ms), address(9), tokens);  // a copy from an unknown host
  proof.on_datagram_from(at(1ms), address(1), tokens);
  EXPECT_EQ(proof.challenge_due(at(1ms))->to, address(9));
  EXPECT_EQ(proof.challenge_due(at(1ms))->to, address(1));
  proof.on_datagram_from(at(2ms), address(8), tokens);  // a third address is not challenged at once
  EXPECT_FALSE(proof.challenge_due(at(2ms)));
  proof.on_datagram_from(at(50ms), address(8), tokens);
  EXPECT_FALSE(proof.on_response(address(9), 7)) << "the oldest challenge was replaced";
  EXPECT_TRUE(proof.on_response(address(1), 8));
  EXPECT_FALSE(proof.on_response(address(8), 9)) << "the address that answered first is validated";
}

}  // namespace
}  // namespace tandem::server
