#include "netsim/engine/replay.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "netsim/profiles/decision_csv.h"
#include "tests/netsim/engine/decision_matrix.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;

Decision row(std::uint64_t index, Duration in, Duration out, Outcome outcome = Outcome::kDeliver, bool copy = false) {
  return {.in = Time{in},
          .out = Time{out},
          .index = index,
          .link = 0,
          .flow = 0,
          .size = 100,
          .direction = Direction::kUp,
          .outcome = outcome,
          .copy = copy,
          .in_flight = false,
          .corruption = {}};
}

ReplayPath path_from(const std::vector<Decision>& rows) {
  auto replay = Replay::make(rows);
  EXPECT_TRUE(replay) << replay.error();
  return {std::make_shared<const Replay>(std::move(*replay)), 0, Direction::kUp};
}

TEST(Replay, ReproducesTheLogForTheSameTraffic) {
  const std::vector<Traffic> traffic{{.seed = 1}, {.period = 700us, .size_max = 1400, .seed = 2}};
  for (const bool through_text : {false, true}) {
    Network original{21};
    original.add_link({everything(), everything()});
    PathSpec other = everything();
    other.order = ArrivalOrder::kFree;
    other.reorder.displacement = 9;
    original.add_link({other, everything()});
    auto rows = log_of(original, traffic);
    const std::string text = decision_csv(rows);
    if (through_text) {
      auto read = parse_decision_csv(text, "log.csv");
      ASSERT_TRUE(read) << to_text(read.error());
      rows = std::move(*read);
    }
    const auto made = Replay::make(rows);
    ASSERT_TRUE(made) << made.error();
    const auto replay = std::make_shared<const Replay>(*made);
    EXPECT_EQ(replay->flows(), (std::vector<std::uint32_t>{0, 1}));
    Network again{999};
    again.add_replay(replay, 0);
    again.add_replay(replay, 1);
    EXPECT_TRUE(decision_csv(log_of(again, traffic)) == text);
    for (const std::uint32_t link : {0U, 1U}) {
      for (const Direction direction : {Direction::kUp, Direction::kDown}) {
        EXPECT_EQ(again.replayed(link, direction), again.counters(link, direction).in);
      }
    }
  }
}

// Replays shared links, deferred verdicts and corruption, including datagrams undecided at the end of the log.
TEST(Replay, ReproducesLateDecisionsAndCorruption) {
  for (const bool shared : {false, true}) {
    PathSpec cut = late_decisions();
    cut.corruption.mode = CorruptionSpec::Mode::kTruncate;
    const LinkSpec link{.up = late_decisions(), .down = cut, .shared = shared};
    Network original{31};
    original.add_link(link);
    original.add_link(link);
    const std::vector<Traffic> traffic{{.size_max = 900, .seed = 1}, {.period = 1500us, .seed = 2}};
    const auto rows = log_of(original, traffic);
    const auto count = [&](const auto& is) { return std::ranges::count_if(rows, is); };
    EXPECT_GT(count([](const Decision& d) { return d.outcome == Outcome::kPushedOut; }), 50);
    EXPECT_GT(count([](const Decision& d) { return d.outcome == Outcome::kReplaced; }), 50);
    EXPECT_GT(count([](const Decision& d) { return d.outcome == Outcome::kWaiting; }), 0);
    EXPECT_GT(count([](const Decision& d) { return d.corruption.kind == Corruption::Kind::kBitFlips; }), 50);
    EXPECT_GT(count([](const Decision& d) { return d.corruption.kind == Corruption::Kind::kTruncated; }), 50);
    for (const Decision& d : rows) {
      if (d.corruption.kind != Corruption::Kind::kTruncated) continue;
      ASSERT_LT(d.corruption.length, d.size) << "the size is that of sending";
    }
    const auto read = parse_decision_csv(decision_csv(rows), "log.csv");
    ASSERT_TRUE(read) << to_text(read.error());
    const auto made = Replay::make(*read);
    ASSERT_TRUE(made) << made.error();
    const auto replay = std::make_shared<const Replay>(*made);
    Network again{1};
    again.add_replay(replay, 0);
    again.add_replay(replay, 1);
    EXPECT_EQ(difference(log_of(again, traffic), rows), "");
  }
}

TEST(Replay, ReplaysAProxyLogAsAVirtualNetwork) {
  const std::vector<Traffic> traffic{{.seed = 1}};
  ProxyCore core{{everything(), everything()}, 4};
  const auto rows = log_of(core, traffic);
  const auto made = Replay::make(rows);
  ASSERT_TRUE(made) << made.error();
  Network again{1};
  again.add_replay(std::make_shared<const Replay>(*made), 0);
  EXPECT_EQ(difference(log_of(again, traffic), rows), "");
}

TEST(Replay, ReproducesDatagramsDroppedUnderWay) {
  // The second address is dead from 60 ms on: datagrams sent to the first are dropped on arrival.
  Network original{1};
  original.add_link({.initial = link_from({.delay = 20ms}), .rebinds = {{50ms, {10ms}}}}, 0);
  const std::vector<Traffic> traffic{{.length = 200ms}};
  const auto rows = log_of(original, traffic);
  EXPECT_GT(original.counters(0, Direction::kDown).of(Outcome::kOldAddress), 5U);
  const auto made = Replay::make(rows);
  ASSERT_TRUE(made) << made.error();
  Network again{1};
  again.add_replay(std::make_shared<const Replay>(*made), 0);
  EXPECT_EQ(difference(log_of(again, traffic), rows), "");
}

TEST(Replay, UsesTheLastRecordedOutcomeForOtherTimes) {
  // Delays 5, 8 and 2 ms; the second datagram of four is lost; sending period 10 ms.
  ReplayPath path =
      path_from({row(0, 0ms, 5ms), row(1, 10ms, 10ms, Outcome::kLost), row(2, 20ms, 28ms), row(3, 30ms, 32ms)});
  const auto expect = [&](Duration sent, Outcome outcome, Duration at) {
    const PathDecision v = path.send(Time{sent});
    EXPECT_EQ(v.outcome, outcome) << sent.count();
    EXPECT_EQ(v.at, Time{at}) << sent.count();
  };
  expect(1ms, Outcome::kDeliver, 6ms);
  expect(9'999us, Outcome::kDeliver, 14'999us);
  expect(15ms, Outcome::kLost, 15ms);
  expect(29ms, Outcome::kDeliver, 37ms);
  expect(31ms, Outcome::kDeliver, 37ms);  // a delay of 2 ms would overtake
  expect(36ms, Outcome::kDeliver, 38ms);
  EXPECT_EQ(path.matched(), 0U);
}

TEST(Replay, RestartsTheRecordingAfterItsEnd) {
  // Three datagrams with a distance of 10 ms: the recording lasts 30 ms.
  ReplayPath path = path_from({row(0, 100ms, 105ms), row(1, 110ms, 110ms, Outcome::kLost), row(2, 120ms, 128ms)});
  EXPECT_EQ(path.send(Time{50ms}).at, Time{55ms});  // before the beginning: imitates the first
  EXPECT_EQ(path.send(Time{129ms}).at, Time{137ms});
  EXPECT_EQ(path.send(Time{130ms}).at, Time{137ms});  // 100 ms again: 5 ms, but not before the previous one
  EXPECT_EQ(path.send(Time{141ms}).outcome, Outcome::kLost);
  EXPECT_EQ(path.send(Time{150ms}).at, Time{158ms});
  EXPECT_EQ(path.send(Time{10'150ms + 3ms}).at, Time{10'158ms});  // 335 repetitions later
  EXPECT_EQ(path.matched(), 0U);
  ReplayPath single = path_from({row(0, 0ms, 5ms)});
  EXPECT_EQ(single.send(Time{77s}).at, Time{77'005ms});
}

TEST(Replay, MatchesADatagramByItsOwnTime) {
  ReplayPath path = path_from({row(0, 0ms, 5ms), row(1, 10ms, 90ms), row(2, 20ms, 21ms)});
  EXPECT_EQ(path.send(Time{0ms}).at, Time{5ms});
  EXPECT_EQ(path.send(Time{20ms}).at, Time{21ms});  // imitates the last earlier one, whose index is 1
  EXPECT_EQ(path.send(Time{20ms}).at, Time{21ms});  // its own fate
  EXPECT_EQ(path.matched(), 2U);
}

TEST(Replay, ReproducesCopiesAndReorderedDatagrams) {
  const std::vector<Decision> rows{row(0, 0ms, 9ms, Outcome::kHeldBack), row(1, 1ms, 6ms),
                                   row(1, 1ms, 8ms, Outcome::kDeliver, true), row(2, 2ms, 7ms),
                                   row(2, 2ms, 2ms, Outcome::kOverflow, true)};
  ReplayPath path = path_from(rows);
  PathDecision v = path.send(Time{0ms});
  EXPECT_EQ(v.outcome, Outcome::kHeldBack);
  EXPECT_EQ(v.at, Time{9ms});
  v = path.send(Time{1ms});
  EXPECT_EQ(v.at, Time{6ms});
  EXPECT_TRUE(v.copied);
  EXPECT_EQ(v.copy_delay, 2ms);
  v = path.send(Time{2ms});
  EXPECT_TRUE(v.copied);
  EXPECT_EQ(v.copy_outcome, Outcome::kOverflow);

  const auto made = Replay::make(rows);
  ASSERT_TRUE(made);
  Network network{1};
  network.add_replay(std::make_shared<const Replay>(*made), 0);
  DecisionLog log{100};
  network.log_to(&log);
  std::array<std::byte, kSlotBytes> buffer;
  for (int i = 0; i < 3; ++i) network.send(Time{i * 1ms}, 0, Direction::kUp, datagram(1, 100));
  std::string order;
  while (const auto d = network.poll_any(Time{1s}, buffer)) order += std::to_string(d->index);
  EXPECT_EQ(order, "1210");
  EXPECT_EQ(log.sorted(), rows);
  EXPECT_EQ(network.counters(0, Direction::kUp).in_flight(), 0U);
}

TEST(Replay, DeliversAllInAnUnrecordedDirection) {
  const auto made = Replay::make(std::vector{row(0, 0ms, 5ms)});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->has(0));
  EXPECT_FALSE(made->has(1));
  ReplayPath down{std::make_shared<const Replay>(*made), 0, Direction::kDown};
  EXPECT_EQ(down.send(Time{3ms}).at, Time{3ms});
  EXPECT_EQ(made->delay_max(0, Direction::kUp), 5ms);
  EXPECT_EQ(made->delay_max(0, Direction::kDown), 0ms);
}

TEST(Replay, RejectsLogsThatCannotBeReplayed) {
  const auto mistake = [](const std::vector<Decision>& rows) {
    const auto made = Replay::make(rows);
    return made ? "none" : made.error();
  };
  EXPECT_EQ(mistake({}), "the log holds no decision");
  EXPECT_EQ(mistake({row(3, 0ms, 1ms), row(3, 1ms, 2ms)}), "flow 0 up, datagram 3: is there twice");
  EXPECT_EQ(mistake({row(3, 0ms, 1ms, Outcome::kDeliver, true)}), "flow 0 up, datagram 3: a copy without its original");
  EXPECT_EQ(mistake({row(3, 0ms, 0ms, Outcome::kLost), row(3, 0ms, 1ms, Outcome::kDeliver, true)}),
            "flow 0 up, datagram 3: its copy arrived, it did not");
  EXPECT_EQ(
      mistake({row(0, 0ms, 1ms), row(0, 0ms, 1ms, Outcome::kDeliver, true), row(0, 0ms, 2ms, Outcome::kDeliver, true)}),
      "flow 0 up, datagram 0: two copies; one can be played");
}

// For any traffic, no datagram arrives before it was sent, and the order is kept.
TEST(Replay, KeepsOrderAndTimeForAnyTraffic) {
  Network original{6};
  PathSpec spec = everything();
  spec.reorder = {};
  original.add_link({spec, spec});
  const auto made = Replay::make(log_of(original, {{.length = 3s}}));
  ASSERT_TRUE(made);
  const auto replay = std::make_shared<const Replay>(*made);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ReplayPath path{replay, 0, Direction::kUp};
    RandomStream random{seed};
    Time now{}, last{};
    std::size_t lost = 0;
    for (int i = 0; i < 10'000; ++i) {
      now += Duration{static_cast<std::int64_t>(random.below(3'000'000))};
      const PathDecision v = path.send(now);
      ASSERT_GE(v.at, now);
      lost += dropped(v.outcome) ? 1 : 0;
      if (dropped(v.outcome)) continue;
      ASSERT_GE(v.at, last);
      last = v.at;
    }
    EXPECT_GT(lost, 500U);
    EXPECT_LT(lost, 5'000U);
  }
}

TEST(Replay, TakesNoHeapOnThePacketPath) {
  Network original{6};
  original.add_link({everything(), everything()});
  const auto made = Replay::make(log_of(original, {{.length = 1s}}));
  ASSERT_TRUE(made);
  Network network{1};
  network.add_replay(std::make_shared<const Replay>(*made), 0);
  const auto bytes = datagram(1);
  std::array<std::byte, kSlotBytes> buffer;
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 5'000; ++i) {
    network.send(Time{i * 400us}, 0, Direction::kUp, bytes);
    while (network.poll_any(Time{i * 400us}, buffer)) {
    }
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::netsim
