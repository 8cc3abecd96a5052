// Corruption of bytes on the link, and fragmented datagrams.
#include "netsim/models/corruption.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <set>

#include "netsim/engine/network.h"
#include "netsim/profiles/profile_loader.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Mode = CorruptionSpec::Mode;

std::size_t different_bits(std::span<const std::byte> a, std::span<const std::byte> b) {
  std::size_t bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    bits += static_cast<std::size_t>(std::popcount(std::to_integer<unsigned>(a[i] ^ b[i])));
  return bits;
}

TEST(Corruption, FlipsTheGivenNumberOfBitsAtDrawnPlaces) {
  for (const std::size_t size : {1U, 2U, 16U, 1500U}) {
    for (const std::uint32_t bits : {1U, 2U, 7U, 64U}) {
      const auto whole = datagram(0x0123456789abcdef, size);
      for (std::uint64_t seed = 0; seed < 200; ++seed) {
        auto bytes = whole;
        EXPECT_EQ(apply_corruption({.kind = Corruption::Kind::kBitFlips, .bits = bits, .seed = seed}, bytes), size);
        ASSERT_EQ(different_bits(whole, bytes), std::min<std::size_t>(bits, 8 * size)) << size << " " << bits;
      }
    }
  }
  std::vector<std::byte> nothing;
  EXPECT_EQ(apply_corruption({.kind = Corruption::Kind::kBitFlips, .bits = 3, .seed = 1}, nothing), 0U);
}

TEST(Corruption, FlipsEveryBitWithEqualProbability) {
  // Flips 3 of 64 bits, n times: every position occurs n 3/64 times, within 5 sigma.
  constexpr int n = 64'000;
  std::array<int, 64> hits{};
  for (int seed = 0; seed < n; ++seed) {
    std::vector<std::byte> bytes(8);
    apply_corruption({.kind = Corruption::Kind::kBitFlips, .bits = 3, .seed = static_cast<std::uint64_t>(seed)}, bytes);
    for (std::size_t i = 0; i < 64; ++i) {
      hits[i] += std::to_integer<unsigned>(bytes[i / 8] >> (i % 8) & std::byte{1}) != 0 ? 1 : 0;
    }
  }
  for (const int hit : hits) EXPECT_TRUE(binomial_fits(static_cast<std::size_t>(hit), n, 3.0 / 64));
}

/// Returns index and bytes of the datagrams delivered by a link with this corruption.
std::vector<std::pair<std::uint64_t, std::vector<std::byte>>> through(const PathSpec& spec, int count,
                                                                      PathCounters* counters = nullptr) {
  Network network{9};
  network.add_link({spec, {}});
  std::array<std::byte, kSlotBytes> buffer;
  std::vector<std::pair<std::uint64_t, std::vector<std::byte>>> out;
  for (int i = 0; i < count; ++i) {
    network.send(Time{i * 1ms}, 0, Direction::kUp, datagram(static_cast<std::uint64_t>(i)));
    while (const auto d = network.poll(Time{i * 1ms}, 0, Direction::kUp, buffer)) {
      out.emplace_back(d->index, std::vector<std::byte>(buffer.begin(), buffer.begin() + static_cast<long>(d->size)));
    }
  }
  if (counters != nullptr) *counters = network.counters(0, Direction::kUp);
  return out;
}

TEST(Corruption, DeliversAndCountsBitFlips) {
  constexpr int n = 20'000;
  PathSpec spec;
  spec.corruption = {.probability = 0.2, .mode = Mode::kBitFlips, .bits = 3};
  PathCounters counters;
  const auto out = through(spec, n, &counters);
  ASSERT_EQ(out.size(), static_cast<std::size_t>(n));
  std::size_t hit = 0;
  std::set<std::vector<std::byte>> patterns;
  for (const auto& [index, bytes] : out) {
    const auto whole = datagram(index);
    const std::size_t bits = different_bits(whole, bytes);
    ASSERT_TRUE(bits == 0 || bits == 3) << bits;
    if (bits == 0) continue;
    ++hit;
    auto pattern = bytes;
    for (std::size_t i = 0; i < pattern.size(); ++i) pattern[i] ^= whole[i];
    patterns.insert(pattern);
  }
  EXPECT_TRUE(binomial_fits(hit, n, 0.2));
  EXPECT_EQ(counters.flipped, hit);
  EXPECT_EQ(counters.dropped(), 0U);
  EXPECT_GT(patterns.size(), hit * 99 / 100);  // positions differ between datagrams
  EXPECT_EQ(out, through(spec, n));            // and depend only on the seed
}

TEST(Corruption, TruncatesToADrawnLength) {
  constexpr int n = 20'000;
  PathSpec spec;
  spec.corruption = {.probability = 0.3, .mode = Mode::kTruncate};
  PathCounters counters;
  std::vector<double> lengths;
  std::uint64_t bytes_out = 0;
  for (const auto& [index, bytes] : through(spec, n, &counters)) {
    const auto whole = datagram(index);
    ASSERT_TRUE(std::equal(bytes.begin(), bytes.end(), whole.begin()));
    bytes_out += bytes.size();
    if (bytes.size() < kSize) lengths.push_back(static_cast<double>(bytes.size()));
  }
  EXPECT_TRUE(binomial_fits(lengths.size(), n, 0.3));
  EXPECT_EQ(counters.truncated, lengths.size());
  EXPECT_EQ(counters.bytes_out, bytes_out);
  // Uniform in 0 ... 127: mean 63.5, sd 36.9.
  double sum = 0;
  for (const double length : lengths) sum += length;
  EXPECT_NEAR(sum / static_cast<double>(lengths.size()), 63.5,
              5 * 36.9 / std::sqrt(static_cast<double>(lengths.size())));
  EXPECT_EQ(quantile(lengths, 0), 0);
  EXPECT_EQ(quantile(lengths, 1), 127);
}

TEST(Corruption, HitsTheSameDatagramsInEveryMode) {
  PathSpec spec;
  spec.corruption.probability = 0.1;
  const auto dropped_ones = decisions(path_of(spec), 5000);
  spec.corruption.mode = Mode::kBitFlips;
  const auto flipped = decisions(path_of(spec), 5000);
  for (std::size_t i = 0; i < 5000; ++i) {
    ASSERT_EQ(dropped_ones[i].outcome == Outcome::kCorrupted,
              flipped[i].corruption.kind == Corruption::Kind::kBitFlips);
  }
  spec.corruption.probability = 1;
  spec.duplicate = {.probability = 1, .delay_max = Duration{}};
  const auto out = through(spec, 100);
  ASSERT_EQ(out.size(), 200U);
  for (std::size_t i = 0; i < out.size(); i += 2) EXPECT_EQ(out[i].second, out[i + 1].second);
}

TEST(Corruption, TakesNoHeap) {
  Network network{5};
  PathSpec spec;
  spec.corruption = {.probability = 0.5, .mode = Mode::kBitFlips, .bits = 64};
  spec.mtu = {.bytes = 60, .above = MtuSpec::Above::kFragment};
  spec.rate = {.bits_per_s = 1'000'000, .queue_wait = 10ms};
  network.add_link({spec, spec});
  const auto bytes = datagram(1);
  std::array<std::byte, kSlotBytes> buffer;
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 10'000; ++i) {
    network.send(Time{i * 5ms}, 0, Direction::kUp, bytes);
    while (network.poll(Time{i * 5ms}, 0, Direction::kUp, buffer)) {
    }
  }
  EXPECT_EQ(guard.count(), 0U);
}

/// 72 payload bytes per fragment.
PathSpec fragmenting() {
  PathSpec spec;
  spec.mtu = {.bytes = 100, .above = MtuSpec::Above::kFragment};
  spec.rate = {.bits_per_s = 800'000};  // 10 us per byte
  return spec;
}

TEST(Fragments, PayTheirOverheadEach) {
  // 200 bytes: fragments of 72, 72 and 56 plus three times 28 are 284 bytes, 2840 us. 72 bytes: 1000 us. 0 bytes: 280
  // us.
  Path path = path_of(fragmenting());
  EXPECT_EQ(path.send(Time{}, 200).at, Time{2840us});
  EXPECT_EQ(path.send(Time{10ms}, 72).at, Time{11ms});
  EXPECT_EQ(path.send(Time{20ms}, 73).at, Time{20ms + 1000us + 290us});
  EXPECT_EQ(path.send(Time{30ms}, 0).at, Time{30'280us});
}

TEST(Fragments, DropTheDatagramIfOneFindsNoRoom) {
  // 200 bytes of queue: two fragments of 100 bytes fit, the third does not. The two still use the link.
  PathSpec spec = fragmenting();
  spec.rate.queue_bytes = 200;
  Path path = path_of(spec);
  EXPECT_EQ(path.send(Time{}, 200).outcome, Outcome::kQueueFull);
  EXPECT_EQ(path.send(Time{1ms}, 72).at, Time{3ms});
  spec.rate.queue_bytes = 284;
  EXPECT_EQ(path_of(spec).send(Time{}, 200).at, Time{2840us});
}

TEST(Fragments, LoseTheDatagramIfOneIsLost) {
  // Three fragments, each lost with 10 %: 27.1 % of the datagrams are lost. Corruption with 10 %: the same.
  const std::size_t n = tandem::test::draws(300'000, 1'000'000, 1'000'000);
  PathSpec spec;
  spec.mtu = {.bytes = 100, .above = MtuSpec::Above::kFragment};
  spec.loss.probability = 0.1;
  const auto lost = decisions(path_of(spec), n, 1ms, 200);
  EXPECT_TRUE(binomial_fits(count_of(lost, Outcome::kLost), n, 1 - 0.9 * 0.9 * 0.9));
  spec.loss.probability = 0;
  spec.corruption.probability = 0.1;
  const auto hit = decisions(path_of(spec), n, 1ms, 200);
  EXPECT_TRUE(binomial_fits(count_of(hit, Outcome::kCorrupted), n, 1 - 0.9 * 0.9 * 0.9));
  // Packet counts include fragments: of every six packets, the fourth is the first of the second datagram.
  spec.corruption = {};
  spec.loss.pattern = LossPatternSpec{.indices = {0, 5, 6}};
  const auto by_number = decisions(path_of(spec), 4, 1ms, 200);
  EXPECT_EQ(by_number[0].outcome, Outcome::kLost);
  EXPECT_EQ(by_number[1].outcome, Outcome::kLost);
  EXPECT_EQ(by_number[2].outcome, Outcome::kLost);
  EXPECT_EQ(by_number[3].outcome, Outcome::kDeliver);
}

TEST(Fragments, ArriveWithTheLastFragment) {
  // Each fragment has its own delay; the datagram has the maximum of three. The maximum of three U(0, 1) has mean 3/4.
  const std::size_t n = tandem::test::draws(100'000, 1'000'000, 1'000'000);
  PathSpec spec;
  spec.mtu = {.bytes = 100, .above = MtuSpec::Above::kFragment};
  spec.body = {.kind = BodySpec::Kind::kUniform, .high = 100ms};
  spec.order = ArrivalOrder::kFree;
  const auto ns = delays(decisions(path_of(spec), n, 1ms, 200));
  double sum = 0;
  for (const double d : ns) sum += d / 100e6;
  EXPECT_NEAR(sum / static_cast<double>(n), 0.75, 5 * 0.194 / std::sqrt(static_cast<double>(n)));
}

TEST(Fragments, LeaveDatagramsBelowTheMtuUnchanged) {
  PathSpec spec = everything();
  const auto without = decisions(path_of(spec), 5000);
  spec.mtu = {.bytes = kSize + 28, .above = MtuSpec::Above::kFragment};
  const auto with = decisions(path_of(spec), 5000);
  for (std::size_t i = 0; i < with.size(); ++i) {
    ASSERT_EQ(with[i].outcome, without[i].outcome);
    ASSERT_EQ(with[i].at, without[i].at);
  }
}

TEST(Fragments, StayTogetherWhereTheHeadIsDropped) {
  PathSpec spec = fragmenting();
  spec.rate.queue_datagrams = 2;
  spec.rate.drop = RateSpec::Drop::kHead;
  Path path = path_of(spec);
  std::vector<std::pair<std::uint64_t, Outcome>> fates;
  std::vector<Time> times;
  const auto settle = [&](Time now) {
    while (const auto s = path.resolve(now)) {
      fates.emplace_back(s->decision.index, s->decision.outcome);
      times.push_back(s->decision.at);
    }
  };
  for (int i = 0; i < 3; ++i) path.send(Time{}, 200), settle(Time{});
  settle(Time{1s});
  EXPECT_EQ(fates, (std::vector<std::pair<std::uint64_t, Outcome>>{
                       {0, Outcome::kDeliver}, {1, Outcome::kPushedOut}, {2, Outcome::kDeliver}}));
  EXPECT_EQ(times, (std::vector<Time>{Time{2840us}, Time{}, Time{5680us}}));
}

TEST(Fragments, AreReadFromAProfileWithContradictionsNamed) {
  const auto profile = parse_profile(R"(
    version: 1
    both {
      rate { rate_bit_s: 1e6 queue_bytes: 5000 drop: HEAD }
      corrupted_percent: 2 corruption: BIT_FLIPS corrupted_bits: 3
      mtu_bytes: 600 above_mtu: FRAGMENT
    })",
                                     "p.textproto");
  ASSERT_TRUE(profile) << to_text(profile.error());
  const PathSpec& up = profile->link.up;
  EXPECT_EQ(up.rate.drop, RateSpec::Drop::kHead);
  EXPECT_EQ(up.corruption, (CorruptionSpec{0.02, Mode::kBitFlips, 3}));
  EXPECT_EQ(up.mtu, (MtuSpec{600, MtuSpec::Above::kFragment}));
  const auto expect = [](std::string_view text, std::string_view message) {
    const auto bad = parse_profile("version: 1\nboth { " + std::string(text) + " }\n", "p.textproto");
    ASSERT_FALSE(bad) << text;
    EXPECT_NE(to_text(bad.error()).find(message), std::string::npos) << to_text(bad.error());
  };
  expect("corruption: TRUNCATE", "p.textproto:2:20: both.corruption = TRUNCATE: needs corrupted_percent");
  expect("corrupted_percent: 1 corrupted_bits: 2", "both.corrupted_bits = 2: needs corruption: BIT_FLIPS");
  expect("corrupted_percent: 1 corruption: BIT_FLIPS corrupted_bits: 65", "both.corrupted_bits = 65");
  expect("above_mtu: FRAGMENT", "both.above_mtu = FRAGMENT: needs mtu_bytes");
  expect("rate { rate_bit_s: 1e6 overhead_bytes: 100 } mtu_bytes: 100", "both.mtu_bytes = 100: leaves no room");
  expect("mtu_bytes: 35 above_mtu: FRAGMENT", "both.mtu_bytes = 35: leaves no room");
  expect("rate { rate_bit_s: 1e6 drop: HEAD }", "both.rate.drop = HEAD: needs a limit");
  expect("rate { rate_bit_s: 1e6 queue_ms: 9 drop: HEAD codel {} }", "both.rate.codel");
}

}  // namespace
}  // namespace tandem::netsim
