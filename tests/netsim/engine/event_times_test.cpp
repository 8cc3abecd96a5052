// Texts about networks and their events: every active parameter, and the result of every requested event.
#include "netsim/engine/event_times.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "netsim/models/link_text.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;

NetworkEvent outage(Duration at, Duration length) { return {.at = at, .outage = OutageSpec{.length = length}}; }

TEST(EventTimes, ReportEventsWithinTheElapsedTime) {
  const std::vector<NetworkEvent> events{
      outage(9s, 1s), {.at = 2s, .link = LinkSpec{}, .network = "4g"}, {.at = 1s, .rebind = Rebind{5ms}}};
  LinkSpec base;
  base.up.outages = base.down.outages = {{.start = 3s, .length = 1s}, {.length = 1s, .period = 5s}};
  base.down.outages.push_back({.length = 1s, .mean_gap = 60s});
  const auto all = event_times(base, events);
  // Directions differ, so each outage with a fixed time is listed per direction; periodic and random ones are excluded.
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(all[0].description, "new address, the old one dead after 5 ms");
  EXPECT_EQ(all[1].description, "network 4g");
  EXPECT_EQ(all[2].description, "outage of 1000 ms, up");
  EXPECT_EQ(all[3].description, "outage of 1000 ms, down");
  EXPECT_EQ(all[4].description, "outage of 1000 ms");
  base.down = base.up;
  EXPECT_EQ(event_times(base, events).size(), 4u);

  const EventTime one = event_times({}, std::vector{outage(2s, 1s)})[0];
  EXPECT_EQ(fate_of(one, 0s, 10s), EventFate::kApplied);
  EXPECT_EQ(fate_of(one, 0s, 3s), EventFate::kApplied);
  EXPECT_EQ(fate_of(one, 0s, 3s - 1ns), EventFate::kStillActive);
  EXPECT_EQ(fate_of(one, 0s, 2s), EventFate::kNotReached);
  EXPECT_EQ(fate_of(one, 3s, 10s), EventFate::kBeforeStart);
  EXPECT_EQ(fate_of(one, 3s - 1ns, 10s), EventFate::kApplied);
  EXPECT_EQ(fate_of(all[1], 5s, 10s), EventFate::kApplied) << "a network stays";
  EXPECT_EQ(fate_of(all[0], 5s, 10s), EventFate::kApplied) << "an address that changed stays changed";
}

TEST(EventTimes, DescribeLengthModeDirectionAndClients) {
  NetworkEvent event = outage(1s, 400ms);
  event.outage->mode = OutageSpec::Mode::kHold;
  event.direction = Direction::kUp;
  event.clients = {"trainee"};
  EXPECT_EQ(event_text(event), "outage of 400 ms, held, up, for trainee");
  event.clients = {"1", "2"};
  EXPECT_EQ(event_text(event), "outage of 400 ms, held, up, for client 1 and client 2");
}

TEST(LinkText, DescribesOnlyTheActiveModels) {
  EXPECT_EQ(path_text({}), "perfect");
  EXPECT_EQ(
      link_text(
          link_from({.delay = 20ms, .jitter = 5ms, .loss = 0.02, .duplicate = 0.01, .reorder = 0.03, .outages = {}}),
          "  "),
      "  each direction: loss 2 %; delay 20 ms; jitter uniform 0 to 5 ms; reordered 3 % by 3; duplicates 1 %\n");
  LinkSpec link;
  link.up.loss.periods = BadPeriodsSpec{.good_mean = 1s, .bad_mean = 50ms, .loss_good = 0, .loss_bad = 0.5};
  link.up.rate = {.bits_per_s = 2'000'000, .queue_wait = 100ms, .codel = CoDelSpec{}};
  link.down.outages = {{.start = 5s, .length = 500ms, .period = 3s, .mode = OutageSpec::Mode::kHold}};
  link.down.stall = {.rate_per_s = 0.5, .length_min = 10ms, .cap = 200ms};
  link.shared = true;
  EXPECT_EQ(link_text(link, ""),
            "up: bad periods of 50 ms between good ones of 1000 ms, loss 50 / 0 %; rate 2000 kbit/s, queue of 100 ms, "
            "CoDel 5 / 100 ms\n"
            "down: outage of 500 ms from 5 s, every 3 s, held; stalls 0.5 per s of at least 10, at most 200 ms\n"
            "shared by all clients\n");
}

/// Each model alone: the text must mention every active model.
TEST(LinkText, OmitsNoModel) {
  const std::vector<PathSpec> each{{.outages = {{.start = 1s, .length = 1ms}}},
                                   {.loss = {.probability = 0.1}},
                                   {.loss = {.gilbert_elliott = GilbertElliottSpec{.p = 0.1}}},
                                   {.loss = {.four_state = FourStateSpec{.p13 = 0.1}}},
                                   {.loss = {.bursts = LossBurstsSpec{.rate_per_s = 1}}},
                                   {.loss = {.pattern = LossPatternSpec{.every = 3}}},
                                   {.loss = {.congestion = CongestionLossSpec{.in_stall = 1}}},
                                   {.loss = {.trace = std::make_shared<LossTrace>()}},
                                   {.rate = {.bits_per_s = 1000}},
                                   {.rate = {.trace = std::make_shared<CapacityTrace>()}},
                                   {.floor = 1ms},
                                   {.trace = std::make_shared<DelayTrace>()},
                                   {.body = {.kind = BodySpec::Kind::kGamma, .scale = 1ms, .cap = 9ms}},
                                   {.regimes = {{.mean = 1s}, {.mean = 2s}}},
                                   {.boundary = {.period = 15s}},
                                   {.stall = {.rate_per_s = 1, .length_min = 1ms, .cap = 2ms}},
                                   {.slots = {.period = 1ms}},
                                   {.order = ArrivalOrder::kFree},
                                   {.reorder = {.probability = 0.1}},
                                   {.duplicate = {.probability = 0.1}},
                                   {.corruption = {.probability = 0.1}},
                                   {.mtu = {.bytes = 500}}};
  std::vector<std::string> words;
  for (const PathSpec& path : each) {
    words.push_back(path_text(path));
    EXPECT_NE(words.back(), "perfect") << words.size();
  }
  std::ranges::sort(words);
  EXPECT_EQ(std::ranges::adjacent_find(words), words.end()) << "two models read alike";
}

}  // namespace
}  // namespace tandem::netsim
