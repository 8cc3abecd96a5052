// Outages that keep only the newest datagram, that all clients share, or that lose datagrams at their start.
#include <gtest/gtest.h>

#include "netsim/engine/network.h"
#include "netsim/profiles/profile_loader.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

PathSpec holding(OutageSpec::Mode mode) {
  PathSpec spec;
  spec.outages = {{.start = 100ms, .length = 50ms, .period = 200ms, .mode = mode}};
  spec.floor = 10ms;
  return spec;
}

TEST(OutageHoldLast, DeliversOnlyTheNewestAtItsEnd) {
  // Down in [100, 150): of 100 ... 149 only 149 arrives, at 150 + 10, and before 150 itself.
  Network network{1};
  network.add_link({holding(OutageSpec::Mode::kHoldLast), {}});
  std::array<std::byte, kSlotBytes> buffer;
  std::vector<std::pair<std::uint64_t, Time>> out;
  for (int ms = 0; ms < 260; ++ms) {
    const Outcome outcome = network.send(Time{ms * 1ms}, 0, Direction::kUp, datagram(1));
    EXPECT_EQ(outcome, ms >= 100 && ms < 150 ? Outcome::kWaiting : Outcome::kDeliver) << ms;
    const auto& c = network.counters(0, Direction::kUp);
    EXPECT_EQ(c.of(Outcome::kReplaced), static_cast<std::uint64_t>(std::clamp(ms - 100, 0, 49))) << ms;
    while (const auto d = network.poll(Time{ms * 1ms}, 0, Direction::kUp, buffer)) out.emplace_back(d->index, d->at);
  }
  std::vector<std::pair<std::uint64_t, Time>> expected;
  for (int ms = 0; ms < 250; ++ms) {
    if (ms >= 100 && ms < 149) continue;
    expected.emplace_back(ms, ms == 149 ? Time{160ms} : Time{ms * 1ms + 10ms});
  }
  EXPECT_EQ(out, expected);
}

TEST(OutageHoldLast, WakesItsDriverAtTheEnd) {
  Network network{1};
  network.add_link({holding(OutageSpec::Mode::kHoldLast), {}});
  network.send(Time{120ms}, 0, Direction::kUp, datagram(1));
  EXPECT_EQ(network.next_due(), Time{150ms});
  std::array<std::byte, kSlotBytes> buffer;
  EXPECT_FALSE(network.poll(Time{150ms}, 0, Direction::kUp, buffer));
  EXPECT_EQ(network.next_due(), Time{160ms});
  const auto d = network.poll(Time{160ms}, 0, Direction::kUp, buffer);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->sent, Time{120ms});
}

TEST(OutageHoldLast, TakesPrecedenceOverHoldButNotOverDrop) {
  const auto states = [](std::vector<OutageSpec> outages) {
    OutageGate gate{outages};
    return gate.enter(Time{1ms}, 1).state;
  };
  const OutageSpec drop{.length = 10ms}, hold{.length = 10ms, .mode = OutageSpec::Mode::kHold},
      last{.length = 10ms, .mode = OutageSpec::Mode::kHoldLast};
  EXPECT_EQ(states({hold, last}), OutageGate::State::kNewest);
  EXPECT_EQ(states({last, drop}), OutageGate::State::kDropped);
}

TEST(OutageHoldLast, HoldsWhileAnotherOutageBegins) {
  PathSpec spec;
  spec.outages = {{.start = 10ms, .length = 10ms, .mode = OutageSpec::Mode::kHoldLast},
                  {.start = 15ms, .length = 15ms, .mode = OutageSpec::Mode::kHoldLast}};
  Path path = path_of(spec);
  EXPECT_EQ(path.send(Time{12ms}, 1).outcome, Outcome::kWaiting);
  EXPECT_EQ(path.next_resolve(), Time{30ms});
  EXPECT_EQ(path.send(Time{25ms}, 1).outcome, Outcome::kWaiting);
  const auto first = path.resolve(Time{25ms});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->decision.outcome, Outcome::kReplaced);
  EXPECT_EQ(first->decision.index, 0U);
  EXPECT_FALSE(path.resolve(Time{30ms - 1ns}));
  const auto second = path.resolve(Time{30ms});
  ASSERT_TRUE(second);
  EXPECT_EQ(second->decision.at, Time{30ms});
}

/// Returns which of `n` datagrams, one per millisecond, fell into an outage.
std::vector<bool> down(Path path, std::size_t n) {
  std::vector<bool> all;
  for (std::size_t i = 0; i < n; ++i) {
    all.push_back(path.send(Time{static_cast<std::int64_t>(i) * 1ms}, kSize).outcome == Outcome::kOutage);
  }
  return all;
}

TEST(OutageScope, CoversAllLinksTogetherOrEachSeparately) {
  PathSpec spec;
  spec.outages = {{.length = 100ms, .mean_gap = 2s, .length_max = 300ms}};
  const auto of = [&](std::uint64_t seed, std::uint64_t link, Direction direction) {
    return down(Path{spec, Path::keys_for(seed, link, direction)}, 200'000);
  };
  EXPECT_EQ(of(1, 0, Direction::kUp), of(1, 0, Direction::kDown));
  EXPECT_NE(of(1, 0, Direction::kUp), of(1, 1, Direction::kUp));
  const auto own = of(1, 0, Direction::kUp);
  spec.outages[0].scope = OutageSpec::Scope::kAll;
  const auto all = of(1, 0, Direction::kUp);
  EXPECT_NE(all, own);
  EXPECT_EQ(all, of(1, 0, Direction::kDown));
  EXPECT_EQ(all, of(1, 1, Direction::kUp));
  EXPECT_EQ(all, of(1, 77, Direction::kDown));
  EXPECT_NE(all, of(2, 0, Direction::kUp));
}

TEST(OutageScope, DrawsTheLengthOfScheduledOutages) {
  // Every 500 ms, U(100, 300) ms long: lengths within a run differ, their mean is 200 ms, the start is exact.
  PathSpec spec;
  spec.outages = {{.start = 1s, .length = 100ms, .period = 500ms, .length_max = 300ms}};
  const auto of = [&](std::uint64_t link) {
    return down(Path{spec, Path::keys_for(1, link, Direction::kUp)}, 1'000'000);
  };
  const auto own = of(0);
  double sum = 0, longest = 0, shortest = 1e9;
  for (std::size_t i = 1000; i + 500 <= own.size(); i += 500) {
    std::size_t length = 0;
    while (length < 500 && own[i + length]) ++length;
    for (std::size_t k = length; k < 500; ++k) ASSERT_FALSE(own[i + k]) << i + k;
    const auto ms = static_cast<double>(length);
    sum += ms;
    longest = std::max(longest, ms);
    shortest = std::min(shortest, ms);
  }
  const double outages = 999'000 / 500.0;
  EXPECT_NEAR(sum / outages, 200.5, 5 * 57.7 / std::sqrt(outages));
  EXPECT_NEAR(shortest, 100, 3);
  EXPECT_NEAR(longest, 300, 3);
  EXPECT_NE(own, of(1));
  spec.outages[0].scope = OutageSpec::Scope::kAll;
  EXPECT_EQ(of(0), of(1));
}

TEST(OutageLossAtStart, LosesDatagramsRightAfterTheStartAndHoldsTheRest) {
  PathSpec spec = holding(OutageSpec::Mode::kHold);
  spec.outages[0].loss_at_start = 20ms;
  const auto all = decisions(path_of(spec), 400);
  for (int ms = 0; ms < 400; ++ms) {
    const int into = (ms - 100 + 200) % 200;
    const PathDecision& v = all[static_cast<std::size_t>(ms)];
    ASSERT_EQ(v.outcome == Outcome::kOutage, ms >= 100 && into < 20) << ms;
    if (ms >= 100 && into >= 20 && into < 50) {
      ASSERT_EQ(v.at, Time{(ms - into + 50) * 1ms + 10ms}) << ms;
    }
  }
}

TEST(OutageLossAtStart, IsTiedToRandomMoments) {
  // A run of exactly 20 lost datagrams precedes every run of held ones.
  PathSpec spec;
  spec.outages = {
      {.length = 50ms, .mode = OutageSpec::Mode::kHold, .mean_gap = 20s, .length_max = 250ms, .loss_at_start = 20ms}};
  const auto all = decisions(path_of(spec), 2'000'000);
  std::size_t outages = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool held = all[i].outcome == Outcome::kDeliver && all[i].at > Time{static_cast<std::int64_t>(i) * 1ms};
    const bool before = all[i - 1].outcome == Outcome::kOutage;
    if (!held || !before) continue;
    ++outages;
    std::size_t lost = 0;
    while (lost < i && all[i - 1 - lost].outcome == Outcome::kOutage) ++lost;
    ASSERT_EQ(lost, 20U) << i;
  }
  EXPECT_EQ(count_of(all, Outcome::kOutage), 20 * outages);
  EXPECT_NEAR(static_cast<double>(outages), 100, 40);
}

TEST(OutageModes, AreReadFromAProfileAndContradictionsAreNamed) {
  const auto profile = parse_profile(R"(
    version: 1 both {}
    outage { mean_gap_s: 20 length_ms: 50 mode: HOLD_LAST scope: ALL_LINKS loss_at_start_ms: 20 direction: UP })",
                                     "p.textproto");
  ASSERT_TRUE(profile) << to_text(profile.error());
  ASSERT_EQ(profile->link.up.outages.size(), 1U);
  EXPECT_TRUE(profile->link.down.outages.empty());
  const OutageSpec& outage = profile->link.up.outages[0];
  EXPECT_EQ(outage.mode, OutageSpec::Mode::kHoldLast);
  EXPECT_EQ(outage.scope, OutageSpec::Scope::kAll);
  EXPECT_EQ(outage.loss_at_start, 20ms);
  const auto expect = [](std::string_view keys, std::string_view message) {
    const auto bad = parse_profile("version: 1 both {}\noutage { " + std::string(keys) + " }\n", "p.textproto");
    ASSERT_FALSE(bad) << keys;
    EXPECT_NE(to_text(bad.error()).find(message), std::string::npos) << to_text(bad.error());
  };
  expect("start_s: 1 length_ms: 5 scope: ALL_LINKS",
         "p.textproto:2:41: outage[0].scope = ALL_LINKS: needs mean_gap_s or length_max_ms");
  expect("start_s: 1 length_ms: 5 loss_at_start_ms: 6", "outage[0].loss_at_start_ms = 6: is longer than the outage");
  expect("start_s: 1 length_ms: 5 mode: HOLD_LAST hold_bytes: 9", "hold_bytes = 9: needs mode: HOLD");
  expect("start_s: 1 length_ms: 5 mode: HOLDLAST", "p.textproto:2:");
  expect("start_s: 1 length_ms: 0", "p.textproto:2:32: outage[0].length_ms = 0");
  expect("start_s: -1 length_ms: 5", "p.textproto:2:19: outage[0].start_s = -1");
}

}  // namespace
}  // namespace tandem::netsim
