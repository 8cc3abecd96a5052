// The hash of a seat's outputs: any change of what was sent changes it, for good.
#include "server/session/output_digest.h"

#include <gtest/gtest.h>

#include <array>

namespace tandem::server {
namespace {

using Message = std::array<std::byte, 117>;

TEST(OutputDigest, SeesEveryBitAndKeepsTheDifference) {
  Message message{};
  for (std::size_t i = 0; i < message.size(); ++i) message[i] = static_cast<std::byte>(i * 7);
  OutputDigest same;
  same.add(wire::Type::kForce, message);
  for (std::size_t bit = 0; bit < 8 * message.size(); ++bit) {
    Message other = message;
    other[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    OutputDigest before = same, after;
    after.add(wire::Type::kForce, other);
    ASSERT_NE(before.value(), after.value()) << bit;
    for (int n = 0; n < 3; ++n) {
      before.add(wire::Type::kForce, message);
      after.add(wire::Type::kForce, message);
      ASSERT_NE(before.value(), after.value()) << bit;
    }
  }
}

TEST(OutputDigest, SeesTwoFlippedSigns) {
  Message message{}, other{};
  other[7] = other[15] = std::byte{0x80};
  OutputDigest a, b;
  a.add(wire::Type::kForce, message);
  b.add(wire::Type::kForce, other);
  EXPECT_NE(a.value(), b.value());
}

TEST(OutputDigest, SeesTypeLengthAndOrder) {
  const Message message{};
  const auto digest = [](auto... adds) {
    OutputDigest d;
    (adds(d), ...);
    return d.value();
  };
  const auto force = [&](OutputDigest& d) { d.add(wire::Type::kForce, message); };
  const auto close = [&](OutputDigest& d) { d.add(wire::Type::kClose, message); };
  const auto shorter = [&](OutputDigest& d) { d.add(wire::Type::kForce, std::span{message}.first(116)); };
  EXPECT_NE(digest(force), digest(close));
  EXPECT_NE(digest(force), digest(shorter));
  EXPECT_NE(digest(force, close), digest(close, force));
  EXPECT_NE(digest(force), digest(force, force));
  OutputDigest d;
  EXPECT_FALSE(d.sent());
  d.add(wire::Type::kForce, message);
  EXPECT_TRUE(d.sent());
  d.clear_sent();
  EXPECT_FALSE(d.sent());
}

}  // namespace
}  // namespace tandem::server
