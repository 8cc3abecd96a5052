#include "netsim/models/outages.h"

#include <gtest/gtest.h>

#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;
using State = OutageGate::State;

TEST(Outage, DropsInItsHalfOpenWindowAndInEveryPeriod) {
  PathSpec spec;
  spec.outages = {{.start = 100ms, .length = 50ms, .period = 300ms}};
  Path path = path_of(spec);
  for (int ms = 0; ms < 3000; ++ms) {
    const bool down = ms >= 100 && (ms - 100) % 300 < 50;
    ASSERT_EQ(path.send(Time{ms * 1ms}, kSize).outcome == Outcome::kOutage, down) << ms;
  }
}

TEST(Outage, OccursOnceWithoutAPeriod) {
  OutageGate gate{{{.start = 1s, .length = 1ms}}};
  EXPECT_EQ(gate.enter(Time{1s - 1ns}, 1).state, State::kUp);
  EXPECT_EQ(gate.enter(Time{1s}, 1).state, State::kDropped);
  EXPECT_EQ(gate.enter(Time{1s + 1ms - 1ns}, 1).state, State::kDropped);
  EXPECT_EQ(gate.enter(Time{1s + 1ms}, 1).state, State::kUp);
  EXPECT_EQ(gate.enter(Time{1h}, 1).state, State::kUp);
}

TEST(Outage, HoldReleasesEverythingAtItsEnd) {
  // The delay is a sawtooth: 400, 399, ... 1 ms, all released at one time, then none.
  PathSpec spec;
  spec.outages = {{.start = 1s, .length = 400ms, .mode = OutageSpec::Mode::kHold}};
  spec.floor = 10ms;
  const auto all = decisions(path_of(spec), 2000);
  for (int ms = 0; ms < 2000; ++ms) {
    const bool held = ms >= 1000 && ms < 1400;
    ASSERT_EQ(all[static_cast<std::size_t>(ms)].at, Time{(held ? 1400 : ms) * 1ms + 10ms}) << ms;
  }
}

TEST(Outage, DropsDatagramsThatDoNotFitInHold) {
  OutageGate gate{
      {{.start = Duration{}, .length = 100ms, .period = 200ms, .mode = OutageSpec::Mode::kHold, .hold_bytes = 300}}};
  EXPECT_EQ(gate.enter(Time{}, 200).at, Time{100ms});
  EXPECT_EQ(gate.enter(Time{1ms}, 101).state, State::kHoldFull);
  EXPECT_EQ(gate.enter(Time{2ms}, 100).at, Time{100ms});
  EXPECT_EQ(gate.enter(Time{3ms}, 1).state, State::kHoldFull);
  EXPECT_EQ(gate.enter(Time{100ms}, 500).at, Time{100ms});  // up
  EXPECT_EQ(gate.enter(Time{200ms}, 300).at, Time{300ms});  // the next outage holds again
}

TEST(Outage, KeepsDatagramsHeldWhileAnotherOutageBegins) {
  OutageGate gate{{{.start = Duration{}, .length = 100ms, .mode = OutageSpec::Mode::kHold},
                   {.start = 50ms, .length = 100ms, .mode = OutageSpec::Mode::kHold},
                   {.start = 150ms, .length = 10ms}}};
  EXPECT_EQ(gate.enter(Time{}, 1).at, Time{160ms});
  EXPECT_EQ(gate.enter(Time{155ms}, 1).state, State::kDropped);
}

TEST(Outage, KeepsHoldLastUntilTheLinkIsUp) {
  // Otherwise a datagram held after 50 ms would be decided before the newest one, and overtake it.
  OutageGate gate{{{.start = Duration{}, .length = 50ms, .mode = OutageSpec::Mode::kHoldLast},
                   {.start = 30ms, .length = 70ms, .mode = OutageSpec::Mode::kHold}}};
  for (const int ms : {10, 40, 60, 99}) {
    const auto passage = gate.enter(Time{ms * 1ms}, 1);
    EXPECT_EQ(passage.state, State::kNewest) << ms;
    EXPECT_EQ(passage.at, Time{100ms}) << ms;
  }
  EXPECT_EQ(gate.enter(Time{100ms}, 1).state, State::kUp);
  // In the reverse case the hold came first and keeps its datagrams.
  OutageGate hold{{{.start = Duration{}, .length = 50ms, .mode = OutageSpec::Mode::kHold},
                   {.start = 30ms, .length = 70ms, .mode = OutageSpec::Mode::kHoldLast}}};
  EXPECT_EQ(hold.enter(Time{10ms}, 1).state, State::kUp);
  EXPECT_EQ(hold.enter(Time{40ms}, 1).state, State::kNewest);
}

TEST(Outage, PrefersDropOverHold) {
  OutageGate gate{
      {{.start = Duration{}, .length = 10ms, .mode = OutageSpec::Mode::kHold}, {.start = Duration{}, .length = 5ms}}};
  EXPECT_EQ(gate.enter(Time{1ms}, 1).state, State::kDropped);
  EXPECT_EQ(gate.enter(Time{6ms}, 1).at, Time{10ms});
}

TEST(Outage, BoundsTheWorkOfSchedulesWithoutGaps) {
  // Two alternating outages without a gap: the link is never up, and the query must still return.
  OutageGate gate{{{.start = Duration{}, .length = 60ms, .period = 100ms, .mode = OutageSpec::Mode::kHold},
                   {.start = 50ms, .length = 60ms, .period = 100ms, .mode = OutageSpec::Mode::kHold}}};
  EXPECT_GT(gate.enter(Time{1h}, 1).at, Time{1h});
}

}  // namespace
}  // namespace tandem::netsim
