// Queues other than tail drop: recorded capacity, datagram limits, CoDel; also corruption, MTU, random outages.
#include "netsim/models/capacity.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "netsim/engine/network.h"
#include "netsim/profiles/capacity_csv.h"
#include "netsim/profiles/profile_loader.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;

/// Returns the up direction of a recording in mahimahi's form, without overhead, so that bytes are easy to count.
PathSpec recorded(std::string_view lines) {
  const auto link = parse_capacity(lines, "c.trace");
  if (!link) {
    ADD_FAILURE() << to_text(link.error());
    return {};
  }
  PathSpec spec = link->up;
  spec.rate.overhead_bytes = 0;
  return spec;
}

TEST(Capacity, SendsOnlyWhenThereIsAnOpportunity) {
  // Opportunities at 2, 2 and 5 ms; the recording is 6 ms long.
  Path path = path_of(recorded("2\n2\n5\n"));
  EXPECT_EQ(path.send(Time{}, 1500).at, Time{2ms});
  EXPECT_EQ(path.send(Time{}, 1500).at, Time{2ms});
  EXPECT_EQ(path.send(Time{}, 1500).at, Time{5ms});
  EXPECT_EQ(path.send(Time{}, 1500).at, Time{8ms});  // the recording repeats
}

TEST(Capacity, CarriesPartsOfDatagramsAndLosesUnusedCapacity) {
  Path parts = path_of(recorded("2\n5\n"));
  EXPECT_EQ(parts.send(Time{}, 1000).at, Time{2ms});
  EXPECT_EQ(parts.send(Time{}, 1000).at, Time{5ms});  // 500 at 2 ms, 500 at 5 ms
  EXPECT_EQ(parts.send(Time{}, 1000).at, Time{5ms});
  Path late = path_of(recorded("2\n5\n"));
  EXPECT_EQ(late.send(Time{2'400us}, 1000).at, Time{2'400us});  // still within its millisecond
  EXPECT_EQ(late.send(Time{2'500us}, 500).at, Time{2'500us});
  EXPECT_EQ(late.send(Time{2'600us}, 1).at, Time{5ms});
  EXPECT_EQ(late.send(Time{6ms + 3ms}, 1).at, Time{6ms + 5ms});
  EXPECT_EQ(late.send(Time{6h + 5'900us}, 1).at, Time{6h + 5'900us});
}

TEST(Capacity, RespectsItsLimits) {
  PathSpec bytes = recorded("9\n");
  bytes.rate.queue_bytes = 1000;
  Path b = path_of(bytes);
  EXPECT_EQ(b.send(Time{}, 600).outcome, Outcome::kDeliver);
  EXPECT_EQ(b.send(Time{}, 400).outcome, Outcome::kDeliver);
  EXPECT_EQ(b.send(Time{}, 1).outcome, Outcome::kQueueFull);
  EXPECT_EQ(b.send(Time{9ms}, 500).outcome, Outcome::kDeliver);  // the earlier datagrams have left
  PathSpec wait = recorded("9\n");
  wait.rate.queue_wait = 5ms;
  Path w = path_of(wait);
  EXPECT_EQ(w.send(Time{3ms}, 1).outcome, Outcome::kQueueFull);
  EXPECT_EQ(w.send(Time{4ms}, 1).at, Time{9ms});
}

TEST(Capacity, ReportsTheLineOfMistakes) {
  const auto text = [](std::string_view trace) {
    const auto link = parse_capacity(trace, "c.trace");
    return link ? std::string("none") : to_text(link.error());
  };
  EXPECT_NE(text("1\n3\n2\n").find("c.trace:3:1: t_ms = 2: time goes back"), std::string::npos) << text("1\n3\n2\n");
  EXPECT_NE(text("1\nx\n").find("c.trace:2:1: t_ms = x: must be a whole number"), std::string::npos) << text("1\nx\n");
  EXPECT_NE(text(""), "none");
  const std::string head = "direction[up|down],t_ms[ms],opportunities[count]\n";
  EXPECT_EQ(text(head + "up,1,1\ndown,1,2\n"), "none");
  EXPECT_NE(text(head + "up,1,1\n").find("holds no opportunity down"), std::string::npos);
  EXPECT_NE(text(head + "up,1,1\nup,1,1\n").find("c.trace:3:2: t_ms = 1: time does not go on"), std::string::npos);
  EXPECT_NE(text(head + "left,1,0\n").find("c.trace:2:3: opportunities = 0"), std::string::npos);
  EXPECT_NE(text("a[1],b[1]\n1,2\n").find("needs the columns"), std::string::npos);
}

// Reference results from the description of the trace: one datagram per millisecond, queueing delay in milliseconds.
struct Answer {
  Direction direction;
  std::size_t size;
  double p50, p90, p99, longest;  ///< 0: not stated
};
constexpr Answer kAnswers[] = {{Direction::kUp, 92, 2, 21, 944, 1743},
                               {Direction::kDown, 92, 2, 30, 573, 1446},
                               {Direction::kUp, 256, 3, 1065, 0, 3264},
                               {Direction::kDown, 256, 5, 1147, 0, 2720}};

void expect_answer(const std::vector<double>& ms, const Answer& answer) {
  EXPECT_NEAR(quantile(ms, 0.5), answer.p50, 1);
  EXPECT_NEAR(quantile(ms, 0.9), answer.p90, 1);
  if (answer.p99 > 0) {
    EXPECT_NEAR(quantile(ms, 0.99), answer.p99, 1);
  }
  EXPECT_NEAR(quantile(ms, 1), answer.longest, 1);
}

constexpr const char* kNoRecordings =
    "TANDEM_TRACES, the folder of the shared recordings, is not set (./test --traces DIR)";

/// Returns the recorded capacity of an LTE link; empty, with a test failure, if the file is unreadable.
std::optional<LinkSpec> recorded_lte() {
  std::ifstream file(std::string(std::getenv("TANDEM_TRACES")) + "/net_lte_verizon_capacity_updown.csv",
                     std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  auto link = parse_capacity(text.str(), "net_lte_verizon_capacity_updown.csv");
  if (link) return std::move(*link);
  ADD_FAILURE() << to_text(link.error());
  return std::nullopt;
}

TEST(Capacity, MatchesTheReferenceForTheRecordedLteLink) {
  if (std::getenv("TANDEM_TRACES") == nullptr) GTEST_SKIP() << kNoRecordings;
  const auto link = recorded_lte();
  if (!link) return;
  for (const Answer& answer : kAnswers) {
    SCOPED_TRACE(std::string(name(answer.direction)) + " " + std::to_string(answer.size));
    PathSpec spec = (*link)[answer.direction];
    spec.rate.overhead_bytes = 0;
    // The reference stops at the end of the recording; datagrams still queued at that time do not count.
    const auto length = static_cast<std::size_t>(spec.rate.trace->period / 1ms);
    std::vector<double> ms;
    const auto all = decisions(path_of(spec), length, 1ms, answer.size);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].at < Time{spec.rate.trace->period}) ms.push_back(seconds(all[i].at - Time{i * 1ms}) * 1e3);
    }
    expect_answer(ms, answer);
  }
}

/// Returns the profile with a recording. Floor and overhead are removed, so that results compare with the reference.
LinkSpec trace_profile(const LinkSpec& recorded, std::optional<Duration> queue) {
  auto profile = shipped_profile("4g-trace");
  if (!profile) {
    ADD_FAILURE() << to_text(profile.error());
    return {};
  }
  EXPECT_EQ(profile->capacity_file, std::string());
  EXPECT_TRUE(supply_capacity(profile->link, recorded));
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    EXPECT_EQ(profile->link[direction].floor, 20ms);
    EXPECT_EQ(profile->link[direction].rate.queue_wait, Duration{1s});
    profile->link[direction].rate.overhead_bytes = 0;
    profile->link[direction].rate.queue_wait = queue;
  }
  return profile->link;
}

/// Returns queueing delays in ms through a Network, one datagram per millisecond, of those out by the recording's end.
std::vector<double> queueing(const LinkSpec& link, Direction direction, std::size_t size,
                             std::uint64_t* full = nullptr) {
  Network network{1};
  network.add_link(link);
  const auto bytes = datagram(1, size);
  std::array<std::byte, kSlotBytes> buffer;
  std::vector<double> ms;
  const Duration length = link[direction].rate.trace->period;
  const auto drain = [&](Time now) {
    while (const auto d = network.poll(now, 0, direction, buffer)) ms.push_back(seconds(d->at - d->sent - 20ms) * 1e3);
  };
  for (Time now{}; now < Time{length}; now += 1ms) {
    network.send(now, 0, direction, bytes);
    drain(now);
  }
  drain(Time{length} + 20ms - 1ns);
  if (full != nullptr) *full = network.counters(0, direction).of(Outcome::kQueueFull);
  return ms;
}

TEST(FourGTrace, MatchesTheReferenceThroughTheWholePath) {
  if (std::getenv("TANDEM_TRACES") == nullptr) GTEST_SKIP() << kNoRecordings;
  const auto recorded = recorded_lte();
  if (!recorded) return;
  for (const Answer& answer : kAnswers) {
    SCOPED_TRACE(std::string(name(answer.direction)) + " " + std::to_string(answer.size));
    expect_answer(queueing(trace_profile(*recorded, std::nullopt), answer.direction, answer.size), answer);
    // With the queue of the profile no datagram waits longer than 1 s; datagrams with a longer wait are dropped.
    std::uint64_t full = 0;
    const auto limited = queueing(trace_profile(*recorded, Duration{1s}), answer.direction, answer.size, &full);
    EXPECT_LE(quantile(limited, 1), 1000);
    EXPECT_EQ(full > 0, answer.longest > 1000);
  }
}

TEST(FourGTrace, ReplaysASyntheticTraceToTheMillisecond) {
  // One opportunity every 2 ms, except in [500, 900). 92 bytes per millisecond are 184 of 1500. Outside the gap a
  // datagram waits for the next even millisecond; inside it waits until 900, where 16 fit into an opportunity.
  std::string text;
  for (int ms = 0; ms < 2000; ms += 2) {
    if (ms < 500 || ms >= 900) text += std::to_string(ms) + "\n";
  }
  const auto recorded = parse_capacity(text, "look-alike");
  ASSERT_TRUE(recorded);
  std::uint64_t full = 0;
  const auto ms = queueing(trace_profile(*recorded, Duration{1s}), Direction::kUp, 92, &full);
  EXPECT_EQ(full, 0U);
  ASSERT_GT(ms.size(), 1990U);
  EXPECT_EQ(ms[0], 0);
  EXPECT_EQ(ms[1], 1);
  EXPECT_EQ(quantile(ms, 1), 401);  // the datagram sent at 499 ms
  // With a queue of 100 ms, datagrams with a longer wait are dropped: 300 of the gap and a few after it.
  const auto shorter = queueing(trace_profile(*recorded, Duration{100ms}), Direction::kUp, 92, &full);
  EXPECT_EQ(quantile(shorter, 1), 100);
  EXPECT_NEAR(static_cast<double>(full), 301, 2);
}

TEST(FourGTrace, CannotBePlayedWithoutARecording) {
  const auto profile = shipped_profile("4g-trace");
  ASSERT_TRUE(profile);
  EXPECT_THROW(Path(profile->link.up, RandomKey{1}), std::invalid_argument);
  const auto found = problems(profile->link.up);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].key, "rate.trace");
  for (const EmbeddedFile& complete : complete_profiles()) EXPECT_NE(complete.name, "4g-trace");
  EXPECT_EQ(complete_profiles().size() + 1, shipped_profiles().size());
}

TEST(FourGTrace, ReadsTheFileNameFromAUserProfile) {
  const auto profile = parse_profile(R"(version: 1
    both { rate { capacity { file: "lte.trace" } queue_bytes: 3000 drop: HEAD } })",
                                     "dir/p.textproto");
  ASSERT_TRUE(profile) << to_text(profile.error());
  EXPECT_EQ(profile->capacity_file, "lte.trace");
  EXPECT_TRUE(profile->link.up.rate.recorded);
  EXPECT_EQ(profile->link.up.rate.queue_bytes, 3000U);
}

TEST(LinkRate, CountsDatagramsInItsQueue) {
  // 100 bytes at 800 kbit/s take 1 ms each; the limit is three datagrams.
  LinkRate rate{{.bits_per_s = 800'000, .overhead_bytes = 0, .queue_datagrams = 3}};
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(rate.serve(Time{}, 100));
  EXPECT_FALSE(rate.serve(Time{1ms - 1ns}, 1));
  EXPECT_EQ(rate.serve(Time{1ms}, 100), Time{4ms});
  EXPECT_FALSE(rate.serve(Time{1ms}, 1));
}

TEST(CoDel, DropsAtTheTimesOfItsControlLaw) {
  // Constant waits of 10 ms: the first drop comes after one interval, the next after 100/sqrt(1), 100/sqrt(2), ... ms.
  CoDel codel{{.target = 5ms, .interval = 100ms}};
  std::vector<int> drops;
  for (int ms = 0; ms < 400; ++ms) {
    if (codel.drops(Time{ms * 1ms}, 10ms)) drops.push_back(ms);
  }
  EXPECT_EQ(drops, (std::vector<int>{100, 200, 271, 329, 379}));
  EXPECT_FALSE(codel.drops(Time{400ms}, 4ms));  // below the target: the interval restarts
  EXPECT_FALSE(codel.drops(Time{401ms}, 10ms));
  EXPECT_FALSE(codel.drops(Time{500ms}, 10ms));
  EXPECT_TRUE(codel.drops(Time{501ms}, 10ms));
}

TEST(CoDel, KeepsTheWaitLowWhereATailDropDoesNot) {
  PathSpec spec;
  spec.rate = {.bits_per_s = 1'000'000, .queue_wait = 1s};  // 1.248 ms of work every 1 ms
  const double tail = quantile(delays(decisions(path_of(spec), 100'000)), 0.5);
  spec.rate.codel = CoDelSpec{};
  const auto all = decisions(path_of(spec), 100'000);
  EXPECT_GT(tail, 900e6);
  EXPECT_LT(quantile(delays(all), 0.5), 300e6);
  EXPECT_NEAR(static_cast<double>(count_of(all, Outcome::kQueueFull)) / 100'000, 1 - 1 / 1.248, 0.02);
}

TEST(Path, DropsDatagramsAboveTheMtuAndCorruptedOnes) {
  PathSpec mtu;
  mtu.mtu.bytes = 528;
  EXPECT_EQ(path_of(mtu).send(Time{}, 500).outcome, Outcome::kDeliver);
  EXPECT_EQ(path_of(mtu).send(Time{}, 501).outcome, Outcome::kAboveMtu);
  PathSpec damage;
  damage.corruption.probability = 0.03;
  const auto all = decisions(path_of(damage), 300'000);
  EXPECT_TRUE(binomial_fits(count_of(all, Outcome::kCorrupted), all.size(), 0.03));
  damage.loss.probability = mtu.loss.probability = 0.1;
  const auto a = decisions(path_of(damage), 20'000), b = decisions(path_of(mtu), 20'000);
  EXPECT_EQ(count_of(a, Outcome::kLost), count_of(b, Outcome::kLost));
}

TEST(Outages, AreEqualInBothDirectionsAtRandomMoments) {
  PathSpec spec;
  spec.outages = {{.length = 100ms, .mean_gap = 2s, .length_max = 300ms}};
  Path up{spec, Path::keys_for(3, 0, Direction::kUp)};
  Path down{spec, Path::keys_for(3, 0, Direction::kDown)};
  Path other{spec, Path::keys_for(3, 1, Direction::kUp)};
  constexpr std::size_t n = 4'000'000;
  std::size_t lost = 0, differs = 0, run = 0, longest = 0, shortest = n;
  for (std::size_t i = 0; i < n; ++i) {
    const Time now{static_cast<std::int64_t>(i) * 1ms};
    const bool gone = up.send(now, kSize).outcome == Outcome::kOutage;
    ASSERT_EQ(down.send(now, kSize).outcome == Outcome::kOutage, gone);
    differs += (other.send(now, kSize).outcome == Outcome::kOutage) != gone ? 1 : 0;
    lost += gone ? 1 : 0;
    if (!gone && run > 0) shortest = std::min(shortest, run);
    run = gone ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  EXPECT_NEAR(static_cast<double>(lost) / n, 1 - std::exp(-0.2 / 2), 0.01);
  EXPECT_GE(shortest, 99U);
  EXPECT_GT(longest, 290U);
  EXPECT_GT(differs, n / 20);
}

TEST(Capacity, TakesNoHeap) {
  PathSpec spec = recorded("2\n2\n5\n");
  spec.rate.queue_datagrams = 50;
  spec.rate.codel = CoDelSpec{};
  spec.outages = {{.length = 10ms, .mode = OutageSpec::Mode::kHold, .mean_gap = 1s, .length_max = 300ms}};
  Path path = path_of(spec);
  const tandem::test::AllocGuard guard;
  for (std::int64_t i = 0; i < 50'000; ++i) static_cast<void>(path.send(Time{i * 300us}, kSize));
  EXPECT_EQ(guard.count(), 0U);
}

TEST(Capacity, LimitsAreReadFromAProfile) {
  const auto profile = parse_profile(R"(
    version: 1
    both {
      rate { rate_bit_s: 1e6 queue_datagrams: 50 codel { target_ms: 10 } }
      corrupted_percent: 2 mtu_bytes: 600
    }
    outage { mean_gap_s: 20 length_ms: 50 length_max_ms: 250 mode: HOLD })",
                                     "p.textproto");
  ASSERT_TRUE(profile) << to_text(profile.error());
  const PathSpec& up = profile->link.up;
  EXPECT_EQ(up.rate.queue_datagrams, 50U);
  EXPECT_EQ(up.rate.codel, (CoDelSpec{10ms, 100ms}));
  EXPECT_EQ(up.corruption.probability, 0.02);
  EXPECT_EQ(up.mtu.bytes, 600U);
  ASSERT_EQ(up.outages.size(), 1U);
  EXPECT_EQ(up.outages[0].mean_gap, 20s);
  EXPECT_EQ(up.outages[0].length_max, 250ms);
  const auto expect = [](std::string_view text, std::string_view message) {
    const auto bad = parse_profile("version: 1\n" + std::string(text) + "\n", "p.textproto");
    ASSERT_FALSE(bad) << text;
    EXPECT_NE(to_text(bad.error()).find(message), std::string::npos) << to_text(bad.error());
  };
  expect("both {} outage { length_ms: 5 }", "p.textproto:2:9: outage[0]: needs exactly one of");
  expect("both {} outage { mean_gap_s: 5 length_ms: 5 length_max_ms: 4 }",
         "p.textproto:2:60: outage[0].length_max_ms = 4");
  expect("both { rate { rate_bit_s: 1e6 queue_datagrams: 0 } }", "p.textproto:2:48: both.rate.queue_datagrams = 0");
  expect("both { rate { rate_bit_s: 1e6 codel { target_ms: 200 } } }", "p.textproto:2:31: both.rate.codel");
  PathSpec bad;
  bad.rate.queue_datagrams = 4;
  bad.rate.codel = CoDelSpec{5ms, 5ms};
  std::string keys;
  for (const SpecError& problem : problems(bad)) keys += problem.key + " ";
  EXPECT_EQ(keys, "rate.codel.interval rate.queue_datagrams rate.codel ");
}

}  // namespace
}  // namespace tandem::netsim
