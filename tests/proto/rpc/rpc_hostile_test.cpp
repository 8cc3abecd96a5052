#include <gtest/gtest.h>

#include <algorithm>

#include "proto/rpc/rpc_codec.h"
#include "tests/common/base/counts.h"
#include "tests/proto/rpc/rpc_samples.h"

/// Hostile bytes: every prefix, every flipped bit, spliced frames, noise. The result is an error, or a message whose
/// encoding is the very same bytes.
namespace tandem::rpc {
namespace {

using Bytes = std::vector<std::byte>;

/// Decodes `in` and checks the result; also the harness of a fuzzer. @return whether `in` was a message
bool survives(const Bytes& in) {
  const auto head = peek(in);
  const auto got = decode(in);
  if (!got) return false;
  EXPECT_EQ(head, (Head{kind_of(*got), got->request}));
  const auto again = encode(*got);
  EXPECT_TRUE(again) << "an accepted message can be sent";
  if (again) {
    EXPECT_TRUE(std::ranges::equal(again->bytes().subspan(kLengthSize), in));
  }
  return true;
}

Bytes body_of(const Frame& frame) {
  const auto out = encode(frame);
  return out ? Bytes(out->bytes().begin() + kLengthSize, out->bytes().end()) : Bytes{};
}

TEST(RpcHostile, RejectsEveryPrefix) {
  RandomStream random(1);
  for (std::size_t k = 0; k < kKinds; ++k) {
    Bytes body = body_of(samples::frame(random, samples::kind(k)));
    if (body.size() > 4000) body.resize(4000);
    ASSERT_FALSE(body.empty());
    for (std::size_t cut = 0; cut + 1 < body.size(); ++cut)
      survives(Bytes(body.begin(), body.begin() + static_cast<std::ptrdiff_t>(cut)));
    // A frame that is cut within its body is always rejected: the length before the body gives its full size.
    EXPECT_FALSE(survives(Bytes(body.begin(), body.end() - 1))) << k;
  }
}

TEST(RpcHostile, GivesAnErrorOrAValidMessageForEveryFlippedBit) {
  RandomStream random(2);
  std::size_t taken = 0, tried = 0;
  for (std::size_t k = 0; k < kKinds; ++k) {
    const Bytes body = body_of(samples::frame(random, samples::kind(k)));
    for (std::size_t bit = 0; bit < 8 * std::min<std::size_t>(body.size(), 200); ++bit) {
      Bytes changed = body;
      changed[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
      taken += survives(changed) ? 1 : 0;
      ++tried;
    }
  }
  EXPECT_GT(taken, 0u) << "the control connection is authenticated by TLS, not here";
  EXPECT_LT(taken, tried);
}

TEST(RpcHostile, SurvivesSplicedAndOverwrittenFramesAndNoise) {
  RandomStream random(3);
  const std::uint64_t count = tandem::test::seeds(8000);
  for (std::uint64_t i = 0; i < count; ++i) {
    Bytes a = body_of(samples::frame(random, samples::kind(random.below(kKinds))));
    switch (i % 4) {
      case 0:
        for (int k = 0; k < 4; ++k) a[random.below(a.size())] = static_cast<std::byte>(random.bits() & 0xff);
        break;
      case 1: {
        const Bytes b = body_of(samples::frame(random, samples::kind(random.below(kKinds))));
        a.resize(random.below(a.size()) + 1);
        a.insert(a.end(), b.begin() + static_cast<std::ptrdiff_t>(random.below(b.size())), b.end());
        break;
      }
      case 2: {
        const std::size_t from = random.below(a.size());
        a.erase(a.begin() + static_cast<std::ptrdiff_t>(from),
                a.begin() + static_cast<std::ptrdiff_t>(from + random.below(a.size() - from + 1)));
        break;
      }
      default:
        a.resize(random.below(300));
        samples::fill(random, a);
        if (a.size() > 2) a[0] = std::byte{8}, a[1] = std::byte{1};
    }
    if (a.size() <= kFrameMax) survives(a);
  }
}

TEST(RpcHostile, BoundsDeepNestingAndManyEmptyParts) {
  // SessionList is field 9: as many empty sessions as a frame holds.
  Bytes many{std::byte{8}, std::byte{1}, std::byte{0x4a}};
  const std::size_t room = kFrameMax - 10, parts = room / 2;
  for (std::size_t size = 2 * parts; size > 0; size >>= 7)
    many.push_back(static_cast<std::byte>((size & 0x7f) | (size > 0x7f ? 0x80 : 0)));
  for (std::size_t i = 0; i < parts; ++i) many.insert(many.end(), {std::byte{0x0a}, std::byte{0}});
  EXPECT_EQ(decode(many).error(), FrameError::kOutOfRange);
  Bytes deep{std::byte{8}, std::byte{1}};
  for (int i = 0; i < 20000; ++i) deep.push_back(std::byte{0x1b});  // a group within a group, 20000 deep
  EXPECT_FALSE(survives(deep));
}

TEST(RpcHostile, PrintsNothing) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  RandomStream random(7);
  for (int i = 0; i < 2000; ++i) {
    Bytes a = body_of(samples::frame(random, samples::kind(random.below(kKinds))));
    for (int k = 0; k < 3; ++k) a[random.below(a.size())] = static_cast<std::byte>(random.bits() & 0xff);
    (void)decode(a);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace tandem::rpc
