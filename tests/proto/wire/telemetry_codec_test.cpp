// TELEMETRY and WATCH: golden bytes, the protobuf library as a second reader, unknown values, hostile bytes.
#include "proto/wire/telemetry_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "proto/schema/wire.pb.h"
#include "tests/proto/wire/wire_samples.h"
#include "tests/support/alloc_guard.h"

namespace tandem::wire {
namespace {

using Bytes = std::vector<std::byte>;

double positive(RandomStream& random, double limit) { return std::abs(samples::single(random, limit)); }

SessionTelemetry sample(RandomStream& random, const TelemetryLayout& l) {
  SessionTelemetry t;
  t.session_tick = static_cast<std::uint32_t>(random.bits());
  t.state = static_cast<SessionState>(random.below(7));
  t.shed_level = static_cast<std::uint32_t>(random.below(kShedLevelMax + 1));
  t.authority_version = static_cast<std::uint32_t>(random.bits());
  t.stops = static_cast<std::uint32_t>(random.bits());
  for (std::size_t i = 0; i < l.seats; ++i) {
    WatchedSeatState& s = t.seats[i];
    s.taken = random.below(2) == 1;
    s.heard = random.below(2) == 1;
    s.engaged = random.below(2) == 1;
    s.stopped = random.below(2) == 1;
    s.gate = static_cast<GateState>(random.below(7));
    if (i >= l.masters) continue;
    for (double& v : s.x) v = samples::single(random, kPositionMaxM);
    for (double& v : s.f) v = samples::single(random, 50);
  }
  for (std::size_t j = 0; j < l.tools; ++j) {
    WatchedToolState& s = t.tools[j];
    s.touching = random.below(2) == 1;
    s.braked = random.below(2) == 1;
    for (double& v : s.x) v = samples::single(random, kPositionMaxM);
    for (double& v : s.f) v = samples::single(random, 50);
    s.depth = samples::single(random, 0.1);
  }
  t.link.seat = static_cast<std::uint32_t>(random.below(l.seats));
  t.link.rtt_p50_ms = positive(random, 100);
  t.link.loss_up_percent = positive(random, 100);
  t.link.gap_up_ms = positive(random, 1000);
  t.link.loss_down_percent = positive(random, 100);
  t.link.gap_down_ms = positive(random, 1000);
  t.link.age_p99_ms = positive(random, 1000);
  t.link.margin_min_j = samples::single(random, 1);
  t.link.gate_trips = static_cast<std::uint32_t>(random.bits());
  t.link.late_ticks = static_cast<std::uint32_t>(random.bits());
  t.authority.tool = static_cast<std::uint32_t>(random.below(l.tools));
  if (random.below(2) == 1) {
    t.authority.transfer_ticks = 1 + static_cast<std::uint32_t>(random.below(kTransferNoticeTicks));
    t.authority.transfer_by =
        random.below(2) == 1 ? TransferParties::kOperator : static_cast<std::uint32_t>(random.below(l.seats + 1));
  }
  for (std::size_t k = 0; k < l.masters; ++k) {
    t.authority.wanted[k] = positive(random, 1);
    t.authority.applied[k] = positive(random, 1);
  }
  return t;
}

Bytes encoded(const TelemetryCodec& codec, const SessionTelemetry& t, const Preamble& preamble = {}) {
  Bytes out(kPlaintextMax);
  out.resize(codec.encode(preamble, t, out));
  return out;
}

/// Equal in single precision, where NaN equals NaN.
void expect_same(double got, double sent) {
  if (std::isnan(sent)) {
    EXPECT_TRUE(std::isnan(got));
  } else {
    EXPECT_EQ(static_cast<float>(got), static_cast<float>(sent));
  }
}
template <std::size_t N>
void expect_same(const std::array<double, N>& got, const std::array<double, N>& sent, std::size_t count = N) {
  for (std::size_t k = 0; k < count; ++k) expect_same(got[k], sent[k]);
}
void expect_same(const WatchedLink& got, const WatchedLink& sent) {
  EXPECT_EQ(got.seat, sent.seat);
  expect_same(got.rtt_p50_ms, sent.rtt_p50_ms);
  expect_same(got.loss_up_percent, sent.loss_up_percent);
  expect_same(got.gap_up_ms, sent.gap_up_ms);
  expect_same(got.loss_down_percent, sent.loss_down_percent);
  expect_same(got.gap_down_ms, sent.gap_down_ms);
  expect_same(got.age_p99_ms, sent.age_p99_ms);
  expect_same(got.margin_min_j, sent.margin_min_j);
  EXPECT_EQ(got.gate_trips, sent.gate_trips);
  EXPECT_EQ(got.late_ticks, sent.late_ticks);
}
void expect_same(const SessionTelemetry& got, const SessionTelemetry& sent, const TelemetryLayout& l) {
  EXPECT_EQ(got.session_tick, sent.session_tick);
  EXPECT_EQ(got.state, sent.state);
  EXPECT_EQ(got.shed_level, sent.shed_level);
  EXPECT_EQ(got.authority_version, sent.authority_version);
  EXPECT_EQ(got.stops, sent.stops);
  for (std::size_t i = 0; i < l.seats; ++i) {
    EXPECT_EQ(got.seats[i].taken, sent.seats[i].taken);
    EXPECT_EQ(got.seats[i].heard, sent.seats[i].heard);
    EXPECT_EQ(got.seats[i].engaged, sent.seats[i].engaged);
    EXPECT_EQ(got.seats[i].stopped, sent.seats[i].stopped);
    EXPECT_EQ(got.seats[i].gate, sent.seats[i].gate);
    expect_same(got.seats[i].x, sent.seats[i].x);
    expect_same(got.seats[i].f, sent.seats[i].f);
  }
  for (std::size_t j = 0; j < l.tools; ++j) {
    EXPECT_EQ(got.tools[j].touching, sent.tools[j].touching);
    EXPECT_EQ(got.tools[j].braked, sent.tools[j].braked);
    expect_same(got.tools[j].x, sent.tools[j].x);
    expect_same(got.tools[j].f, sent.tools[j].f);
    expect_same(got.tools[j].depth, sent.tools[j].depth);
  }
  expect_same(got.link, sent.link);
  EXPECT_EQ(got.authority.tool, sent.authority.tool);
  EXPECT_EQ(got.authority.transfer_ticks, sent.authority.transfer_ticks);
  EXPECT_EQ(got.authority.transfer_by, sent.authority.transfer_by);
  expect_same(got.authority.wanted, sent.authority.wanted, l.masters);
  expect_same(got.authority.applied, sent.authority.applied, l.masters);
}

constexpr TelemetryLayout kLargest{kSeatsMax, kMastersMax, kToolsMax};
const std::array<TelemetryLayout, 4> kLayouts{{{1, 1, 1}, {3, 2, 1}, {8, 7, 4}, kLargest}};

TEST(TelemetryCodec, RoundTripsEveryScene) {
  for (const TelemetryLayout& layout : kLayouts) {
    const TelemetryCodec codec(layout);
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      SCOPED_TRACE(seed);
      RandomStream random(seed);
      const SessionTelemetry sent = sample(random, layout);
      const Preamble preamble = samples::preamble(random);
      const Bytes bytes = encoded(codec, sent, preamble);
      ASSERT_EQ(bytes.size(), telemetry_size(layout));
      const auto got = codec.decode_telemetry(bytes);
      ASSERT_TRUE(got);
      EXPECT_EQ(got->preamble.tick, preamble.tick);
      expect_same(got->message, sent, layout);
    }
  }
}

/// By hand, from wire.proto: preamble, four words, flags, the hand, the tool, the link, the authority.
TEST(TelemetryCodec, HasTheSizeComputedByHand) {
  EXPECT_EQ(telemetry_size({1, 1, 1}),
            16u + 4 * 5 + (2 + 4) + (2 + 14 + 14) + (2 + 5 + 14 + 14 + 5) + (2 + 11 * 5) + (2 + 2 * 5 + 2 * (2 + 4)));
  EXPECT_EQ(telemetry_size({3, 2, 1}), 16u + 20 + 14 + 2 * 30 + 40 + 57 + (2 + 10 + 2 * 10));
  EXPECT_LE(telemetry_size(kLargest), kPlaintextMax);
}

TEST(TelemetryCodec, HasTheGoldenBytesOfOneSeat) {
  SessionTelemetry t;
  t.session_tick = 0x01020304;
  t.state = SessionState::kRunning;
  t.shed_level = 2;
  t.authority_version = 5;
  t.stops = 6;
  t.seats[0] = {true, true, true, false, GateState::kActive, {1, -2, 0.5}, {0, 0, 4}};
  t.tools[0] = {true, false, {1, 0, 0}, {-8, 0, 0}, 0.25};
  const Bytes bytes = encoded(TelemetryCodec({1, 1, 1}), t);
  constexpr std::array<unsigned, 68> kGolden{
      0x0d, 4, 3, 2,    1,    0x15, 1,  2,    0,    0,    0x1d, 5,    0,    0,  0, 0x25, 6,
      0,    0, 0, 0x2a, 4,    0x77, 0,  0,    0,    0x32, 28,   0x0a, 12,   0,  0, 0x80, 0x3f,
      0,    0, 0, 0xc0, 0,    0,    0,  0x3f, 0x12, 12,   0,    0,    0,    0,  0, 0,    0,
      0,    0, 0, 0x80, 0x40, 0x3a, 38, 0x0d, 5,    0,    0,    0,    0x12, 12, 0, 0,    0x80};
  ASSERT_GT(bytes.size(), kPreambleSize + kGolden.size());
  for (std::size_t k = 0; k < kGolden.size(); ++k)
    EXPECT_EQ(std::to_integer<unsigned>(bytes[kPreambleSize + k]), kGolden[k]) << k;
}

TEST(TelemetryCodec, MatchesTheProtobufLibrary) {
  for (const TelemetryLayout& layout : kLayouts)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      RandomStream random(seed);
      const SessionTelemetry sent = sample(random, layout);
      const Bytes bytes = encoded(TelemetryCodec(layout), sent);
      const auto body = std::span(bytes).subspan(kPreambleSize);
      pb::SessionTelemetry theirs;
      ASSERT_TRUE(theirs.ParseFromArray(body.data(), static_cast<int>(body.size())));
      std::string again;
      ASSERT_TRUE(theirs.SerializeToString(&again));
      EXPECT_TRUE(std::ranges::equal(again, body, [](char a, std::byte b) { return static_cast<std::byte>(a) == b; }));
      ASSERT_EQ(static_cast<std::size_t>(theirs.seat_flags_size()), layout.seats);
      ASSERT_EQ(static_cast<std::size_t>(theirs.hand_size()), layout.masters);
      ASSERT_EQ(static_cast<std::size_t>(theirs.tool_size()), layout.tools);
      const WatchedSeatState& last = sent.seats[layout.masters - 1];
      const pb::WatchedHand& seat = theirs.hand(static_cast<int>(layout.masters) - 1);
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(static_cast<double>(seat.x(k)), last.x[static_cast<std::size_t>(k)]);
        EXPECT_EQ(static_cast<double>(seat.f(k)), last.f[static_cast<std::size_t>(k)]);
      }
      EXPECT_EQ(theirs.session_tick(), sent.session_tick);
      EXPECT_EQ(static_cast<double>(theirs.link().margin_min()), sent.link.margin_min_j);
      EXPECT_EQ(theirs.link().late_ticks(), sent.link.late_ticks);
      EXPECT_EQ(theirs.authority().wanted_size(), static_cast<int>(layout.masters));
    }
}

TEST(TelemetryCodec, GivesNaNForWhatIsNotKnown) {
  const TelemetryLayout layout{2, 2, 1};
  const TelemetryCodec codec(layout);
  RandomStream random(3);
  const SessionTelemetry whole = sample(random, layout);
  std::vector<SessionTelemetry> cases(5, whole);
  cases[0].seats[1].x = cases[0].seats[1].f = {kUnknown, kUnknown, kUnknown};
  cases[1].tools[0].x = cases[1].tools[0].f = {kUnknown, kUnknown, kUnknown};
  cases[1].tools[0].depth = kUnknown;
  cases[2].link.rtt_p50_ms = kUnknown;
  cases[3].link.loss_up_percent = cases[3].link.gap_up_ms = kUnknown;
  cases[4].link.loss_down_percent = cases[4].link.gap_down_ms = cases[4].link.age_p99_ms = cases[4].link.margin_min_j =
      kUnknown;
  for (const SessionTelemetry& sent : cases) {
    const auto got = codec.decode_telemetry(encoded(codec, sent));
    ASSERT_TRUE(got);
    expect_same(got->message, sent, layout);
  }
  SessionTelemetry part = whole;  // one NaN, from a device: the whole reading counts as unknown
  part.seats[0].f[1] = std::numeric_limits<double>::infinity();
  const auto got = codec.decode_telemetry(encoded(codec, part));
  ASSERT_TRUE(got);
  EXPECT_TRUE(std::isnan(got->message.seats[0].x[0]) && std::isnan(got->message.seats[0].f[0]));
}

// Finds the flag by what its absence changes, not by its place: the bytes with and without a value differ in the flag.
TEST(TelemetryCodec, RejectsAValueThatIsSaidToBeUnknown) {
  const TelemetryLayout layout{2, 2, 1};
  const TelemetryCodec codec(layout);
  RandomStream random(5);
  SessionTelemetry whole = sample(random, layout);
  whole.link.rtt_p50_ms = 12;
  whole.link.loss_up_percent = whole.link.gap_up_ms = 3;
  whole.link.loss_down_percent = whole.link.gap_down_ms = whole.link.age_p99_ms = whole.link.margin_min_j = 4;
  whole.seats[1].x = whole.seats[1].f = whole.tools[0].x = whole.tools[0].f = {1, 1, 1};
  whole.tools[0].depth = 1;
  std::vector<SessionTelemetry> unknown(5, whole), zeros(5, whole);
  const std::array<double, 3> nan{kUnknown, kUnknown, kUnknown}, zero{};
  unknown[0].seats[1].x = unknown[0].seats[1].f = nan;
  zeros[0].seats[1].x = zeros[0].seats[1].f = zero;
  unknown[1].tools[0].x = unknown[1].tools[0].f = nan, unknown[1].tools[0].depth = kUnknown;
  zeros[1].tools[0].x = zeros[1].tools[0].f = zero, zeros[1].tools[0].depth = 0;
  unknown[2].link.rtt_p50_ms = kUnknown, zeros[2].link.rtt_p50_ms = 0;
  unknown[3].link.loss_up_percent = unknown[3].link.gap_up_ms = kUnknown;
  zeros[3].link.loss_up_percent = zeros[3].link.gap_up_ms = 0;
  unknown[4].link.loss_down_percent = unknown[4].link.gap_down_ms = unknown[4].link.age_p99_ms =
      unknown[4].link.margin_min_j = kUnknown;
  zeros[4].link.loss_down_percent = zeros[4].link.gap_down_ms = zeros[4].link.age_p99_ms = zeros[4].link.margin_min_j =
      0;
  const Preamble preamble = samples::preamble(random);
  const Bytes good = encoded(codec, whole, preamble);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    const Bytes without = encoded(codec, unknown[k], preamble), zero_known = encoded(codec, zeros[k], preamble);
    Bytes lies = good;
    std::size_t flags = 0;
    for (std::size_t at = 0; at < lies.size(); ++at)
      if (without[at] != zero_known[at]) lies[at] = without[at], ++flags;
    ASSERT_EQ(flags, 1u) << k;
    const auto got = codec.decode_telemetry(lies);
    ASSERT_FALSE(got) << k;
    EXPECT_EQ(got.error(), DecodeError::kOutOfRange) << k;
  }
}

TEST(TelemetryCodec, RejectsValuesOutOfRange) {
  const TelemetryLayout layout{2, 2, 1};
  const TelemetryCodec codec(layout);
  RandomStream random(4);
  const SessionTelemetry good = sample(random, layout);
  std::vector<SessionTelemetry> bad(12, good);
  bad[0].seats[0].x[2] = 2 * kPositionMaxM;
  bad[1].seats[1].f[0] = -2 * kEffortMax;
  bad[2].tools[0].depth = 2 * kPositionMaxM;
  bad[3].link.seat = 2;
  bad[4].link.loss_up_percent = 101;
  bad[5].link.rtt_p50_ms = -1;
  bad[6].authority.tool = 1;
  bad[7].authority.wanted[0] = 1.5;
  bad[8].authority.applied[0] = -0.5;
  bad[9].authority.transfer_ticks = kTransferNoticeTicks + 1;
  bad[10].shed_level = kShedLevelMax + 1;
  bad[11].authority.transfer_ticks = 1;
  bad[11].authority.transfer_by = 3;
  for (std::size_t k = 0; k < bad.size(); ++k) {
    const auto got = codec.decode_telemetry(encoded(codec, bad[k]));
    ASSERT_FALSE(got) << k;
    EXPECT_EQ(got.error(), DecodeError::kOutOfRange) << k;
  }
  bad[11].authority.transfer_ticks = 0;
  bad[11].authority.transfer_by = 1;
  EXPECT_FALSE(codec.decode_telemetry(encoded(codec, bad[11]))) << "an origin without a change";
}

TEST(TelemetryCodec, RejectsPrefixesExtensionsAndOtherScenes) {
  const TelemetryLayout layout{3, 2, 1};
  const TelemetryCodec codec(layout);
  RandomStream random(5);
  const Bytes bytes = encoded(codec, sample(random, layout));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(codec.decode_telemetry(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))));
  Bytes longer = bytes;
  longer.resize(bytes.size() + 1);
  EXPECT_FALSE(codec.decode_telemetry(longer));
  for (const TelemetryLayout& other : kLayouts) {
    if (other == layout) continue;
    EXPECT_FALSE(TelemetryCodec(other).decode_telemetry(bytes));
  }
}

TEST(TelemetryCodec, GivesAnErrorOrAMessageInRangeForEveryFlippedByte) {
  const TelemetryLayout layout{2, 2, 1};
  const TelemetryCodec codec(layout);
  RandomStream random(6);
  const Bytes bytes = encoded(codec, sample(random, layout));
  const auto in_range = [](double v, double limit) { return std::isnan(v) || std::abs(v) <= limit; };
  std::size_t accepted = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (int value = 0; value < 256; ++value) {
      Bytes changed = bytes;
      changed[at] = static_cast<std::byte>(value);
      const auto got = codec.decode_telemetry(changed);
      if (!got) continue;
      ++accepted;
      for (const WatchedSeatState& s : got->message.seats)
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_TRUE(in_range(s.x[k], kPositionMaxM) && in_range(s.f[k], kEffortMax) && s.gate <= GateState::kFault);
      ASSERT_LT(got->message.link.seat, layout.seats);
      ASSERT_LT(got->message.authority.tool, layout.tools);
      for (const double w : got->message.authority.wanted) ASSERT_TRUE(w >= 0 && w <= 1);
    }
  EXPECT_GT(accepted, bytes.size()) << "values may change within their range";
}

TEST(TelemetryCodec, DecodesNoiseWithoutHeap) {
  const TelemetryCodec codec({3, 2, 1});
  Bytes noise(telemetry_size({3, 2, 1})), watch(kWatchSize);
  RandomStream random(7);
  const test::AllocGuard guard;
  int accepted = 0;
  for (int round = 0; round < 20'000; ++round) {
    for (std::byte& b : noise) b = static_cast<std::byte>(random.bits());
    for (std::byte& b : watch) b = static_cast<std::byte>(random.bits());
    accepted += codec.decode_telemetry(noise) ? 1 : 0;
    accepted += codec.decode_watch(watch) ? 1 : 0;
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_EQ(accepted, 0);
}

TEST(TelemetryCodec, KeepsAWatchAtItsSize) {
  const TelemetryCodec codec({1, 1, 1});
  Bytes bytes(kPlaintextMax);
  bytes.resize(codec.encode(Preamble{7, 8, 9}, WatchMessage{}, bytes));
  ASSERT_EQ(bytes.size(), kWatchSize);
  ASSERT_EQ(kWatchSize, 16u + 2 + 64);
  pb::Watch theirs;
  ASSERT_TRUE(theirs.ParseFromArray(bytes.data() + kPreambleSize, static_cast<int>(kWatchSize - kPreambleSize)));
  EXPECT_EQ(theirs.padding(), std::string(64, '\0'));
  ASSERT_TRUE(codec.decode_watch(bytes));
  EXPECT_EQ(codec.decode_watch(bytes)->preamble.tick, 9u);
  for (std::size_t at = kPreambleSize; at < bytes.size(); ++at) {
    Bytes changed = bytes;
    changed[at] ^= std::byte{1};
    EXPECT_FALSE(codec.decode_watch(changed)) << at;
  }
  EXPECT_EQ(codec.encode({}, WatchMessage{}, std::span(bytes).first(kWatchSize - 1)), 0u);
}

}  // namespace
}  // namespace tandem::wire
