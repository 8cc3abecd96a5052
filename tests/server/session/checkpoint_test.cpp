// Checkpoint codec: a checkpoint survives encoding and decoding; any other bytes give an error.
#include "server/session/checkpoint.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/support/simulation_run.h"

namespace tandem::server {
namespace {

Checkpoint drawn(std::uint64_t seed) {
  RandomStream random{seed};
  Checkpoint c;
  const auto hash = [&](Checkpoint::Hash& h) {
    for (auto& b : h) b = static_cast<std::byte>(random.below(256));
  };
  hash(c.scene);
  c.epoch = random.bits();
  c.session_tick = static_cast<std::uint32_t>(random.bits());
  c.authority_version = static_cast<std::uint32_t>(random.bits());
  c.stops = static_cast<std::uint32_t>(random.bits());
  c.stop = static_cast<StopLatch::Level>(random.below(3));
  c.begun = random.below(2) == 1;
  c.masters_n = static_cast<std::uint8_t>(1 + random.below(kMastersMax));
  c.tools_n = static_cast<std::uint8_t>(1 + random.below(kToolsMax));
  c.seats_n = static_cast<std::uint8_t>(c.masters_n + random.below(c.tools_n + 1U));
  c.dof = static_cast<std::uint8_t>(1 + random.below(kAxesMax));
  for (std::size_t i = 0; i < c.seats_n; ++i) {
    c.seats[i].taken = random.below(2) == 1;
    hash(c.seats[i].resume);
    c.seats[i].force_scale = random.uniform(0.1, 1);
  }
  for (std::size_t j = 0; j < c.tools_n; ++j) {
    c.tools[j].alpha[random.below(c.masters_n)] = 1;
    for (std::size_t a = 0; a < c.dof; ++a) c.tools[j].x[a] = random.uniform(-1, 1);
    for (double& x : c.tools[j].slave) x = random.uniform(-1, 1);
  }
  return c;
}

std::vector<std::byte> bytes_of(const Checkpoint& c) {
  std::vector<std::byte> out(kCheckpointMax);
  out.resize(encode_checkpoint(c, out));
  return out;
}

TEST(Checkpoint, SurvivesEncodingAndDecoding) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    const Checkpoint c = drawn(seed);
    const auto bytes = bytes_of(c);
    ASSERT_FALSE(bytes.empty());
    const auto back = decode_checkpoint(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(bytes_of(*back), bytes);
    EXPECT_EQ(back->epoch, c.epoch);
    EXPECT_EQ(back->stop, c.stop);
    EXPECT_EQ(back->tools[0].x, c.tools[0].x);
    EXPECT_EQ(back->tools[0].alpha, c.tools[0].alpha);
    EXPECT_EQ(back->seats[0].resume, c.seats[0].resume);
  }
}

TEST(Checkpoint, TheLargestFitsFourKibibytes) {
  Checkpoint c = drawn(1);
  c.masters_n = kMastersMax;
  c.tools_n = kToolsMax;
  c.seats_n = kSeatsMax;
  c.dof = kAxesMax;
  const auto bytes = bytes_of(c);
  EXPECT_EQ(bytes.size(),
            4 + 32 + 8 + 3 * 4 + 6 + kSeatsMax * (33 + 8) + kToolsMax * 8 * (kMastersMax + kAxesMax + kAxesMax) + 32);
  EXPECT_LE(bytes.size(), kCheckpointMax);
  std::vector<std::byte> less(bytes.size() - 1);
  EXPECT_EQ(encode_checkpoint(c, less), 0u);
}

TEST(Checkpoint, RejectsEveryTruncationAndEveryFlippedBit) {
  const auto bytes = bytes_of(drawn(7));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(decode_checkpoint(std::span{bytes}.first(size))) << size;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto bad = bytes;
    bad[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    ASSERT_FALSE(decode_checkpoint(bad)) << bit;
  }
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode_checkpoint(longer));
}

TEST(Checkpoint, RejectsInvalidNumbersUnderAValidDigest) {
  const auto refused = [](auto&& change) {
    Checkpoint c = drawn(3);
    change(c);
    const auto back = decode_checkpoint(bytes_of(c));
    return !back && back.error() == CheckpointError::kRange;
  };
  EXPECT_TRUE(refused([](Checkpoint& c) { c.tools[0].x[0] = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](Checkpoint& c) { c.tools[0].slave[2] = 1e308; }));
  EXPECT_TRUE(refused([](Checkpoint& c) { c.tools[0].alpha = {}; }));
  EXPECT_TRUE(refused([](Checkpoint& c) {
    c.tools[0].alpha[0] = 2;
    c.tools[0].alpha[1] = -1;
  }));
  EXPECT_TRUE(refused([](Checkpoint& c) { c.stop = static_cast<StopLatch::Level>(3); }));
}

TEST(Checkpoint, RandomBytesAreAlwaysAnError) {
  RandomStream random{11};
  std::array<std::byte, kCheckpointMax + 64> bytes{};
  for (int n = 0; n < 20'000; ++n) {
    const std::size_t size = random.below(n % 100 == 0 ? bytes.size() + 1 : 200);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(random.below(256));
    ASSERT_FALSE(decode_checkpoint(std::span{bytes}.first(size)));
  }
}

TEST(Checkpoint, IsIncompatibleWithAChangedScene) {
  SceneSpec scene = test::shipped("free_motion");
  Checkpoint c;
  c.scene = scene_hash(scene);
  c.seats_n = static_cast<std::uint8_t>(scene.seats.size());
  c.masters_n = static_cast<std::uint8_t>(scene.masters());
  c.tools_n = static_cast<std::uint8_t>(scene.tools.size());
  c.dof = static_cast<std::uint8_t>(scene.dof);
  EXPECT_EQ(incompatibility(c, scene), "");
  scene.channel.k *= 2;
  EXPECT_NE(incompatibility(c, scene), "");
}

}  // namespace
}  // namespace tandem::server
