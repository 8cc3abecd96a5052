#include "hal/drivers/spacemouse/spacemouse_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/base/rng.h"
#include "hal/drivers/spacemouse/products.h"
#include "hal/drivers/spacemouse/spacemouse_motion.h"
#include "tests/common/base/counts.h"

namespace tandem::hal::spacemouse {
namespace {

using namespace std::chrono_literals;
using Three = std::array<std::int16_t, 3>;

SpaceMouseReport parsed(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int v : values) bytes.push_back(static_cast<std::byte>(v));
  const auto report = parse_spacemouse_report(bytes);
  EXPECT_TRUE(report.has_value());
  return report.value_or(SpaceMouseReport{});
}

TEST(SpaceMouseReport, MatchesHandComputedValues) {
  const SpaceMouseReport shift = parsed({1, 0x5E, 0x01, 0xA2, 0xFE, 0, 0x80});
  EXPECT_EQ(shift.translation, (Three{350, -350, -32768}));
  EXPECT_FALSE(shift.rotation || shift.buttons || shift.battery_percent);
  EXPECT_EQ(parsed({2, 1, 0, 2, 0, 3, 0}).rotation, (Three{1, 2, 3}));
  const SpaceMouseReport both = parsed({1, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 0xFF, 0xFF});
  EXPECT_EQ(both.translation, (Three{1, 2, 3}));
  EXPECT_EQ(both.rotation, (Three{4, 5, -1}));
  EXPECT_EQ(parsed({3, 0x03, 0x80}).buttons, 0x8003u);
  EXPECT_EQ(parsed({3, 1, 0, 0, 0x80}).buttons, 0x80000001u);
  EXPECT_EQ(parsed({0x17, 93, 1}).battery_percent, 93);
  EXPECT_EQ(parsed({0x42, 1, 2, 3}), SpaceMouseReport{}) << "an unknown id reports nothing";
}

TEST(SpaceMouseReport, ButtonsOfTheEnterpriseAreNumberedAsSpacenavdDoes) {
  // spacenavd bac572a, src/dev.c, bnhack_sment: the kernel's code (255 + usage) and its number for it.
  const std::vector<std::pair<int, unsigned>> theirs{
      {256, 12}, {257, 13}, {258, 14}, {260, 15}, {261, 16}, {264, 17}, {266, 30}, {268, 0},
      {269, 1},  {270, 2},  {271, 3},  {272, 4},  {273, 5},  {274, 6},  {275, 7},  {276, 8},
      {277, 9},  {278, 18}, {279, 19}, {280, 20}, {281, 21}, {282, 22}, {291, 23}, {292, 24},
      {332, 10}, {333, 11}, {358, 27}, {359, 28}, {360, 29}, {430, 25}, {431, 26}};
  std::uint32_t all = 0;
  for (int usage = 0; usage < 65536; ++usage) {
    const auto known = std::ranges::find(theirs, usage + 255, &std::pair<int, unsigned>::first);
    const auto ours = enterprise_button(static_cast<std::uint16_t>(usage));
    ASSERT_EQ(ours.has_value(), known != theirs.end()) << usage;
    if (!ours) continue;
    EXPECT_EQ(*ours, known->second) << usage;
    all |= 1U << *ours;
  }
  EXPECT_EQ(all, 0x7fffffffU) << "31 buttons, each once";
  EXPECT_EQ(parsed({0x1C, 13, 0, 78, 0, 176, 0, 0, 0, 0, 0, 0, 0}).buttons, 1U << 0 | 1U << 11 | 1U << 26);
  EXPECT_EQ(parsed({0x1C, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}).buttons, 0u) << "all were released";
  EXPECT_EQ(parsed({0x1C, 0xff, 0xff, 13, 1, 0, 0, 0, 0, 0, 0, 0, 0}).buttons, 0u) << "unknown usages";
  EXPECT_EQ(parsed({0x1D, 13, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), SpaceMouseReport{}) << "its meaning is not confirmed";
}

TEST(SpaceMouseReport, RejectsKnownIdsOfOtherLengths) {
  for (const int id : {1, 2, 3, 0x17, 0x1C}) {
    for (std::size_t n = 1; n <= 64; ++n) {
      std::vector<std::byte> bytes(n);
      bytes[0] = static_cast<std::byte>(id);
      const bool right = id == 1      ? n == 7 || n == 13
                         : id == 2    ? n == 7
                         : id == 3    ? n >= 3 && n <= 5
                         : id == 0x1C ? n == 13
                                      : n >= 3;
      EXPECT_EQ(parse_spacemouse_report(bytes).has_value(), right) << id << " " << n;
    }
  }
  EXPECT_FALSE(parse_spacemouse_report({}).has_value());
}

TEST(SpaceMouseReport, GivesABoundedVelocityOrAnErrorForAnyBytes) {
  const std::size_t n = test::draws(300'000, 10'000'000, 30'000'000);
  std::printf("[ reports  ] %zu\n", n);
  RandomStream r(2);
  SpaceMouseMotion motion;
  std::array<std::byte, 16> bytes;
  std::size_t read = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < bytes.size(); k += 8) {
      const std::uint64_t word = r.bits();
      for (std::size_t b = 0; b < 8; ++b) bytes[k + b] = static_cast<std::byte>(word >> (8 * b));
    }
    constexpr std::array<int, 5> kIds{1, 2, 3, 0x17, 0x99};
    if (r.below(8) != 0) bytes[0] = static_cast<std::byte>(kIds[r.below(5)]);
    const std::size_t size = r.below(4) == 0 ? r.below(17) : std::array<std::size_t, 4>{3, 5, 7, 13}[r.below(4)];
    const auto report = parse_spacemouse_report(std::span(bytes).first(size));
    if (!report) continue;
    const Time at = Time{} + static_cast<std::int64_t>(i) * 1ms;
    if (report->translation) motion.update_translation(at, *report->translation);
    if (report->rotation) motion.update_rotation(at, *report->rotation);
    ++read;
    ASSERT_LE(motion.velocity(at + 20ms).cwiseAbs().maxCoeff(), 0.1);
    ASSERT_LE(motion.angular_velocity(at + 20ms).cwiseAbs().maxCoeff(), 0.5);
  }
  EXPECT_GT(read, n / 4);
}

TEST(SpaceMouseMotion, ScalesClampsAndConvertsTheVendorsFrame) {
  SpaceMouseMotion motion;
  motion.update_translation(Time{}, {350, 175, -35});  // right, towards the user, up
  const Vec3 v = motion.velocity(Time{});
  EXPECT_NEAR(v[0], 0.1, 1e-15);
  EXPECT_NEAR(v[1], -0.05, 1e-15) << "ours is away from the user";
  EXPECT_NEAR(v[2], 0.01, 1e-15) << "the maker's z is down";
  motion.update_translation(Time{}, {500, -500, 32767});  // real units exceed the range of their descriptor
  EXPECT_EQ(motion.velocity(Time{}), Vec3(0.1, 0.1, -0.1));
  motion.update_rotation(Time{}, {350, 350, 350});
  EXPECT_EQ(motion.angular_velocity(Time{}), Vec3(0.5, -0.5, -0.5));
  SpaceMouseSpec reversed;
  reversed.sign = {-1, 1, 1, 1, 1, -1};
  SpaceMouseMotion other(reversed);
  other.update_translation(Time{}, {350, 350, 350});
  other.update_rotation(Time{}, {350, 350, 350});
  EXPECT_EQ(other.velocity(Time{}), Vec3(-0.1, -0.1, -0.1));
  EXPECT_EQ(other.angular_velocity(Time{}), Vec3(0.5, -0.5, 0.5));
}

// Expected values from spacenavd (bac572a, src/dev.c).
// For products with DF_SWAPYZ | DF_INVYZ it exchanges counts 1 with 2 and 4 with 5 and negates these; others are
// unchanged.
// Its axes are then: x right, y up, z away from the user, and the rotations about them.
TEST(SpaceMouseMotion, MatchesSpacenavdForEveryKnownProduct) {
  const std::array<int, 6> counts{35, 70, 105, 140, 175, 210}, swapped{35, -105, -70, 140, -210, -175};
  std::size_t upright = 0;
  for (const Product& product : kProducts) {
    const bool passes_on = product.vendor == 0x046D &&
                           (product.product == 0xC603 || product.product == 0xC606 || product.product == 0xC640);
    upright += passes_on ? 1 : 0;
    const std::array<int, 6>& theirs = passes_on ? counts : swapped;
    SCOPED_TRACE(product.name);
    SpaceMouseMotion motion({}, axes_of(product.vendor, product.product));
    motion.update_translation(Time{}, {35, 70, 105});
    motion.update_rotation(Time{}, {140, 175, 210});
    const Vec3 v = 3500 * motion.velocity(Time{}), w = 700 * motion.angular_velocity(Time{});
    EXPECT_LT((v - Vec3(theirs[0], theirs[2], theirs[1])).norm(), 1e-9) << v.transpose();
    EXPECT_LT((w - Vec3(theirs[3], theirs[5], theirs[4])).norm(), 1e-9) << w.transpose();
  }
  EXPECT_EQ(upright, 3u);
}

TEST(SpaceMouseMotion, HoldsThenFadesToZeroInSilence) {
  SpaceMouseMotion motion;
  EXPECT_TRUE(motion.stale(Time{})) << "nothing was ever said";
  EXPECT_EQ(motion.velocity(Time{}), Vec3::Zero());
  motion.update_translation(Time{}, {350, 0, 0});
  EXPECT_TRUE(motion.stale(Time{})) << "nothing of its turning yet";
  motion.update_rotation(Time{} + 8ms, {0, 0, 350});
  const auto vx = [&](Duration t) { return motion.velocity(Time{} + t)[0]; };
  EXPECT_EQ(vx(50ms), 0.1);
  EXPECT_FALSE(motion.stale(Time{} + 50ms));
  EXPECT_TRUE(motion.stale(Time{} + 51ms));
  EXPECT_NEAR(vx(75ms), 0.05, 1e-12);
  EXPECT_EQ(vx(100ms), 0.0);
  EXPECT_EQ(vx(1h), 0.0);
  EXPECT_EQ(motion.angular_velocity(Time{} + 58ms)[2], -0.5) << "each triple by its own last word";
  EXPECT_NEAR(motion.angular_velocity(Time{} + 83ms)[2], -0.25, 1e-12);
  double before = 0.1;
  for (Duration t{}; t < 200ms; t += 1ms) {
    EXPECT_LE(vx(t), before) << "never grows by itself";
    EXPECT_LT(before - vx(t), 0.0021);
    before = vx(t);
  }
}

TEST(SpaceMouseProducts, ExcludeOrdinaryMiceOfTheVendor) {
  EXPECT_EQ(product_name(0x046D, 0xC626), "SpaceNavigator");
  EXPECT_TRUE(is_spacemouse(0x046D, 0xC626, 1, 8));
  EXPECT_TRUE(is_spacemouse(0x256F, 0xC635, 1, 8));
  EXPECT_TRUE(is_spacemouse(0x256F, 0xCFFF, 1, 8)) << "newer than the list, and says so";
  EXPECT_FALSE(is_spacemouse(0x046D, 0xC52B, 1, 8)) << "Logitech makes other things";
  EXPECT_FALSE(is_spacemouse(0x046D, 0xC626, 1, 2)) << "its mouse or keyboard interface";
  for (const auto pid : kExcluded) {
    EXPECT_FALSE(is_spacemouse(0x256F, pid, 1, 8)) << std::hex << pid;
    EXPECT_TRUE(product_name(0x256F, pid).empty());
  }
}

}  // namespace
}  // namespace tandem::hal::spacemouse
