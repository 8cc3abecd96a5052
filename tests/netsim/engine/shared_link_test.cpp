// Several clients on one link: common time processes, separate draws for each client.
#include <gtest/gtest.h>

#include <map>

#include "netsim/engine/network.h"
#include "netsim/profiles/profile_loader.h"
#include "netsim/proxy/proxy_core.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Buffer = std::array<std::byte, kSlotBytes>;

LinkSpec shared(const PathSpec& spec) { return {spec, spec, true}; }

TEST(SharedLink, ServesDatagramsOfAllClientsInTurn) {
  // 1 ms per datagram; three clients send one each at the same time.
  PathSpec spec;
  spec.rate = {.bits_per_s = 8'000 * (kSize + 28)};
  Network network{1};
  for (int client = 0; client < 3; ++client) network.add_link(shared(spec));
  EXPECT_EQ(network.links(), 3U);
  for (const std::uint32_t client : {2U, 0U, 1U}) network.send(Time{}, client, Direction::kUp, datagram(client));
  Buffer buffer;
  std::vector<std::pair<std::uint32_t, Time>> out;
  while (const auto d = network.poll_any(Time{1s}, buffer)) {
    EXPECT_EQ(std::to_integer<std::uint32_t>(buffer[0]), d->link);
    EXPECT_EQ(d->index, 0U);
    out.emplace_back(d->link, d->at);
  }
  EXPECT_EQ(out, (std::vector<std::pair<std::uint32_t, Time>>{{2, Time{1ms}}, {0, Time{2ms}}, {1, Time{3ms}}}));
}

TEST(SharedLink, SharesAFullQueueAmongAllClients) {
  PathSpec spec;
  spec.rate = {.bits_per_s = 8'000 * (kSize + 28), .queue_datagrams = 2};
  Network network{1};
  network.add_link(shared(spec));
  network.add_link(shared(spec));
  EXPECT_EQ(network.send(Time{}, 0, Direction::kUp, datagram(1)), Outcome::kDeliver);
  EXPECT_EQ(network.send(Time{}, 0, Direction::kUp, datagram(1)), Outcome::kDeliver);
  EXPECT_EQ(network.send(Time{}, 1, Direction::kUp, datagram(1)), Outcome::kQueueFull);
  EXPECT_EQ(network.send(Time{}, 1, Direction::kDown, datagram(1)), Outcome::kDeliver);
  EXPECT_EQ(network.counters(1, Direction::kUp).of(Outcome::kQueueFull), 1U);
}

TEST(SharedLink, DropsAnotherClientsOldestAtTheHead) {
  PathSpec spec;
  spec.rate = {.bits_per_s = 8'000 * (kSize + 28), .queue_datagrams = 2};
  spec.rate.drop = RateSpec::Drop::kHead;
  Network network{1};
  network.add_link(shared(spec));
  network.add_link(shared(spec));
  for (int i = 0; i < 2; ++i) network.send(Time{}, 0, Direction::kUp, datagram(1));
  EXPECT_EQ(network.counters(0, Direction::kUp).in_flight(), 2U);
  network.send(Time{}, 1, Direction::kUp, datagram(1));
  EXPECT_EQ(network.counters(0, Direction::kUp).of(Outcome::kPushedOut), 1U);
  EXPECT_EQ(network.counters(0, Direction::kUp).in_flight(), 1U);
  EXPECT_EQ(network.counters(1, Direction::kUp).in_flight(), 1U);
  Buffer buffer;
  EXPECT_EQ(network.next_due(1, Direction::kUp), Time{1ms});  // its sending begins
  EXPECT_FALSE(network.poll(Time{2ms - 1ns}, 1, Direction::kUp, buffer));
  const auto d = network.poll(Time{2ms}, 1, Direction::kUp, buffer);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->at, Time{2ms});
}

TEST(SharedLink, KeepsOrderAcrossItsClients) {
  PathSpec spec = everything();
  spec.reorder = {};
  spec.duplicate = {};
  Network network{3};
  for (int client = 0; client < 3; ++client) network.add_link(shared(spec));
  Buffer buffer;
  std::vector<std::pair<Time, Time>> out;  // sent, at
  for (int i = 0; i < 20'000; ++i) {
    network.send(Time{i * 1ms}, static_cast<std::uint32_t>(i % 3), Direction::kUp, datagram(1));
    while (const auto d = network.poll_any(Time{i * 1ms}, buffer)) out.emplace_back(d->sent, d->at);
  }
  ASSERT_GT(out.size(), 10'000U);
  for (std::size_t i = 1; i < out.size(); ++i) {
    ASSERT_GE(out[i].second, out[i - 1].second);
    if (out[i].second != out[i - 1].second) {
      ASSERT_GT(out[i].first, out[i - 1].first);
    }
  }
}

TEST(SharedLink, SharesBadPeriodsOutagesAndStalls) {
  // All models that are time processes, without queue or order, which would also couple the clients.
  PathSpec spec;
  spec.outages = {{.length = 50ms, .mean_gap = 3s, .length_max = 200ms}};
  spec.loss.periods = BadPeriodsSpec{.good_mean = 500ms, .bad_mean = 50ms, .loss_good = 0, .loss_bad = 1};
  spec.body = {.kind = BodySpec::Kind::kLogNormal, .scale = 4ms, .shape = 0.8, .cap = 60ms, .tau = 20ms};
  spec.stall = {.rate_per_s = 1, .length_min = 10ms, .alpha = 1.5, .cap = 200ms};
  spec.order = ArrivalOrder::kFree;
  Path path{spec, Path::shared_keys(5, 0, Direction::kUp)};
  path.set_flow(0, 10);
  path.set_flow(1, 20);
  Path alone{spec, Path::shared_keys(5, 0, Direction::kUp)};
  std::size_t lost = 0;
  for (int i = 0; i < 50'000; ++i) {
    const PathDecision a = path.send(Time{i * 1ms}, 0, kSize), b = path.send(Time{i * 1ms}, 1, kSize);
    ASSERT_EQ(a.outcome, b.outcome) << i;
    ASSERT_EQ(a.at, b.at) << i;
    ASSERT_EQ(a.index, static_cast<std::uint64_t>(i));
    lost += dropped(a.outcome) ? 1 : 0;
    const PathDecision c = alone.send(Time{i * 1ms}, kSize);
    ASSERT_EQ(a.outcome, c.outcome) << i;
    ASSERT_EQ(a.at, c.at) << i;
  }
  EXPECT_GT(lost, 1000U);
}

/// Returns a link whose draws are all per datagram.
PathSpec drawn() {
  PathSpec spec;
  spec.loss = {.probability = 0.1,
               .periods = BadPeriodsSpec{.good_mean = 500ms, .bad_mean = 100ms, .loss_good = 0.05, .loss_bad = 0.5}};
  spec.loss.gilbert_elliott = GilbertElliottSpec{.p = 0.01, .r = 0.3};
  spec.loss.pattern = LossPatternSpec{.lost = 2, .of = 17};
  spec.body = {.kind = BodySpec::Kind::kUniform, .high = 20ms};
  spec.order = ArrivalOrder::kFree;
  spec.duplicate = {.probability = 0.2, .delay_max = 3ms};
  spec.corruption = {.probability = 0.1, .mode = CorruptionSpec::Mode::kBitFlips};
  return spec;
}

TEST(SharedLink, KeepsTheDrawsOfAClientDespiteOthers) {
  const auto run = [](std::uint32_t others, std::size_t size) {
    Path path{drawn(), Path::shared_keys(5, 0, Direction::kUp)};
    path.set_flow(0, 42);
    for (std::uint32_t i = 1; i <= others; ++i) path.set_flow(i, 100 + i);
    Digest digest;
    for (int i = 0; i < 20'000; ++i) {
      for (std::uint32_t other = 1; other <= others; ++other) path.send(Time{i * 1ms}, other, size);
      const PathDecision v = path.send(Time{i * 1ms}, 0, kSize);
      digest.add(v);
      digest.add(v.corruption.seed);
    }
    return digest.value();
  };
  const std::uint64_t alone = run(0, 1);
  EXPECT_EQ(run(1, 64), alone);
  EXPECT_EQ(run(5, 999), alone);
}

TEST(SharedLink, DrawsIndependentlyPerClient) {
  constexpr std::size_t n = 200'000;
  PathSpec spec;
  spec.loss.probability = 0.5;
  Path path{spec, Path::shared_keys(1, 0, Direction::kUp)};
  const std::array<std::uint64_t, 4> names{0, 1, (1U << 23) - 1, ~std::uint64_t{0}};
  for (std::uint32_t flow = 0; flow < names.size(); ++flow) path.set_flow(flow, names[flow]);
  std::array<std::vector<double>, 4> x;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint32_t flow = 0; flow < names.size(); ++flow) {
      x[flow].push_back(path.send(Time{}, flow, kSize).outcome == Outcome::kLost ? 1 : -1);
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k) sum += x[i][k] * x[j][k];
      EXPECT_LT(std::abs(sum / n), 4.9 / std::sqrt(static_cast<double>(n))) << i << " " << j;
    }
  }
}

TEST(SharedLink, SeparatesLinksOfDifferentSpecs) {
  PathSpec spec;
  spec.rate = {.bits_per_s = 8'000 * (kSize + 28)};
  PathSpec other = spec;
  other.floor = 1ms;
  Network network{1};
  network.add_link(shared(spec));
  network.add_link(shared(other));
  network.add_link({spec, spec});
  network.add_link(shared(spec));
  for (std::uint32_t client = 0; client < 4; ++client) network.send(Time{}, client, Direction::kUp, datagram(1));
  EXPECT_EQ(network.next_due(0, Direction::kUp), Time{1ms});
  EXPECT_EQ(network.next_due(1, Direction::kUp), Time{2ms});
  EXPECT_EQ(network.next_due(2, Direction::kUp), Time{1ms});
  EXPECT_EQ(network.next_due(3, Direction::kUp), Time{2ms});
}

TEST(SharedLink, HoldLastKeepsTheNewestOfEveryClient) {
  PathSpec spec;
  spec.outages = {{.start = 10ms, .length = 10ms, .mode = OutageSpec::Mode::kHoldLast}};
  Network network{1};
  network.add_link(shared(spec));
  network.add_link(shared(spec));
  for (int ms = 10; ms < 20; ++ms) network.send(Time{ms * 1ms}, ms % 2 == 0 ? 0 : 1, Direction::kUp, datagram(1));
  Buffer buffer;
  std::vector<std::pair<std::uint32_t, Time>> out;
  while (const auto d = network.poll_any(Time{20ms}, buffer)) out.emplace_back(d->link, d->sent);
  EXPECT_EQ(out, (std::vector<std::pair<std::uint32_t, Time>>{{0, Time{18ms}}, {1, Time{19ms}}}));
}

PathSpec crowded() {
  PathSpec spec = everything();
  spec.rate = {.bits_per_s = 2'500'000, .queue_bytes = 6000};
  spec.rate.drop = RateSpec::Drop::kHead;
  spec.outages.push_back({.length = 20ms, .mode = OutageSpec::Mode::kHoldLast, .mean_gap = 700ms, .length_max = 90ms});
  return spec;
}

TEST(SharedLink, DecidesAlikeInProxyAndVirtualNetwork) {
  const LinkSpec link = shared(crowded());
  Network network{11};
  ProxyCore core{link, 11};
  for (std::uint64_t client = 0; client < 3; ++client) {
    network.add_link(link, client);
    ASSERT_EQ(core.add_client(), client);
  }
  Buffer buffer;
  Digest virtual_one, live;
  for (int i = 0; i < 20'000; ++i) {
    const Time now{i * 400us};
    const auto client = static_cast<std::uint32_t>(i % 3);
    const auto bytes = datagram(static_cast<std::uint64_t>(i), 40 + static_cast<std::size_t>(i % 200));
    const Direction direction = i % 2 == 0 ? Direction::kUp : Direction::kDown;
    ASSERT_EQ(network.send(now, client, direction, bytes), core.ingress(now, client, direction, bytes));
    if (i % 5 != 0) continue;
    // Compares per client: at equal times the two drivers may process clients in different orders.
    for (std::uint32_t c = 0; c < 3; ++c) {
      for (const Direction d : {Direction::kUp, Direction::kDown}) {
        while (const auto got = network.poll(now, c, d, buffer)) {
          virtual_one.add(got->index * 1000 + c);
          virtual_one.add(static_cast<std::uint64_t>(got->at.time_since_epoch().count()));
        }
      }
    }
    std::array<std::vector<DelayQueue::Item>, 6> taken;
    while (const auto egress = core.take(now)) {
      taken[egress->client * 2 + static_cast<std::size_t>(egress->direction)].push_back(egress->item);
      core.done(*egress);
    }
    for (std::size_t k = 0; k < taken.size(); ++k) {
      for (const auto& item : taken[k]) {
        live.add(item.index * 1000 + k / 2);
        live.add(static_cast<std::uint64_t>(item.at.time_since_epoch().count()));
      }
    }
  }
  EXPECT_EQ(virtual_one.value(), live.value());
  for (std::uint32_t c = 0; c < 3; ++c) {
    for (const Direction d : {Direction::kUp, Direction::kDown}) {
      EXPECT_EQ(network.counters(c, d).by_outcome, core.counters(c, d).by_outcome);
    }
  }
  EXPECT_GT(core.total(Direction::kUp).of(Outcome::kPushedOut), 0U);
  EXPECT_GT(core.total(Direction::kUp).of(Outcome::kReplaced), 0U);
}

TEST(SharedLink, KeepsNothingOfAClientThatLeft) {
  const LinkSpec link = shared(crowded());
  ProxyCore core{link, 11};
  RandomStream random{1};
  std::vector<std::uint32_t> present;
  for (int i = 0; i < 30'000; ++i) {
    const Time now{i * 400us};
    if (random.below(200) == 0 && present.size() < 5) present.push_back(*core.add_client());
    if (random.below(400) == 0 && !present.empty()) {
      core.remove_client(present.back());
      present.pop_back();
    }
    for (const std::uint32_t client : present) core.ingress(now, client, Direction::kUp, datagram(1));
    while (const auto egress = core.take(now)) core.done(*egress);
  }
  while (const auto egress = core.take(Time{1h})) core.done(*egress);
  const PathCounters total = core.total(Direction::kUp);
  EXPECT_EQ(total.in_flight(), 0U);
  EXPECT_GT(total.of(Outcome::kClientGone), 0U);
  EXPECT_EQ(core.next_due(), std::nullopt);
}

TEST(SharedLink, ConservesDatagramsAtEveryInstantAndTakesNoHeap) {
  Network network{6};
  for (int client = 0; client < 3; ++client) network.add_link(shared(crowded()));
  Buffer buffer;
  const auto bytes = datagram(1);
  RandomStream random{2};
  std::array<std::uint64_t, 3> in{}, out{};
  std::size_t wrong = 0;
  const tandem::test::AllocGuard guard;
  Time now{};
  for (int i = 0; i < 20'000; ++i) {
    now += Duration{static_cast<std::int64_t>(random.below(700'000))};
    const auto client = static_cast<std::uint32_t>(random.below(3));
    network.send(now, client, Direction::kUp, bytes);
    ++in[client];
    if (random.below(4) == 0) {
      while (const auto d = network.poll_any(now, buffer)) ++out[d->link];
    }
    for (std::uint32_t c = 0; c < 3; ++c) {
      const PathCounters& counters = network.counters(c, Direction::kUp);
      if (counters.in != in[c] || counters.out != out[c] || counters.in_flight() > counters.in + counters.copies)
        ++wrong;
    }
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(wrong, 0U);
  while (const auto d = network.poll_any(now + 1h, buffer)) ++out[d->link];
  for (std::uint32_t c = 0; c < 3; ++c) EXPECT_EQ(network.counters(c, Direction::kUp).in_flight(), 0U);
}

TEST(SharedLink, ChangesForAllItsClientsAtOnce) {
  PathSpec spec;
  spec.rate = {.bits_per_s = 8'000 * (kSize + 28), .queue_datagrams = 3};
  spec.rate.drop = RateSpec::Drop::kHead;
  ProxyCore core{shared(spec), 1};
  core.add_client();
  core.add_client();
  for (const std::uint32_t client : {0U, 1U, 0U}) core.ingress(Time{}, client, Direction::kUp, datagram(1));
  PathSpec fast;
  fast.floor = 1ms;
  EXPECT_THROW(static_cast<void>(core.links().prepare_change({fast, fast}, {}, false)), std::invalid_argument);
  auto change = core.links().prepare_change({fast, fast}, {}, true);
  core.change(Time{500us}, change);
  core.ingress(Time{600us}, 1, Direction::kUp, datagram(1));
  std::vector<std::pair<std::uint32_t, Time>> out;
  while (const auto egress = core.take(Time{1s})) {
    out.emplace_back(egress->client, egress->item.at);
    core.done(*egress);
  }
  // Queued datagrams are served as decided before; later ones do not arrive earlier.
  EXPECT_EQ(out, (std::vector<std::pair<std::uint32_t, Time>>{
                     {0, Time{1ms}}, {1, Time{2ms}}, {0, Time{3ms}}, {1, Time{3ms}}}));
}

TEST(SharedLink, IsReadFromAProfile) {
  const auto profile = parse_profile("version: 1 shared: true both { floor_ms: 1 }", "p.textproto");
  ASSERT_TRUE(profile) << to_text(profile.error());
  EXPECT_TRUE(profile->link.shared);
  EXPECT_FALSE(parse_profile("version: 1 both {}", "p.textproto")->link.shared);
}

TEST(SharedLink, ClientsWithEqualRecordingsShareOneLink) {
  const auto shared = [](bool first_lost) {
    PathSpec path;
    path.loss.trace = std::make_shared<LossTrace>(LossTrace{{first_lost, false}, {}});
    return LinkSpec{.up = path, .down = path, .shared = true};
  };
  Network network{1};
  DecisionLog log{3};
  network.log_to(&log);
  for (const bool first_lost : {false, false, true}) network.add_link(shared(first_lost));
  const std::array<std::byte, 8> bytes{};
  for (std::uint32_t client = 0; client < 3; ++client) network.send(Time{}, client, Direction::kUp, bytes);
  network.log_in_flight();
  std::map<std::uint32_t, std::uint32_t> link_of;
  for (const Decision& d : log.rows()) link_of[d.flow] = d.link;
  EXPECT_EQ(link_of, (std::map<std::uint32_t, std::uint32_t>{{0, 0}, {1, 0}, {2, 2}}));
}

}  // namespace
}  // namespace tandem::netsim
