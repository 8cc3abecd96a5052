#include "netsim/engine/decision_log.h"

#include <gtest/gtest.h>

#include <map>

#include "netsim/engine/network.h"
#include "netsim/profiles/decision_csv.h"
#include "tests/netsim/engine/decision_matrix.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;

constexpr Decision kSample{.in = Time{1'000'000ns},
                           .out = Time{23'110'893ns},
                           .index = 7,
                           .link = 1,
                           .flow = 2,
                           .size = 138,
                           .direction = Direction::kDown,
                           .outcome = Outcome::kDeliver,
                           .copy = false,
                           .in_flight = false,
                           .corruption = {}};

TEST(DecisionLog, FormatsARowAsDocumented) {
  std::string text;
  append_csv(kSample, text);
  Decision row = kSample;
  row.copy = true;
  row.in_flight = true;
  append_csv(row, text);
  row = kSample;
  row.outcome = Outcome::kLost;
  row.out = row.in;
  append_csv(row, text);
  row = kSample;
  row.outcome = Outcome::kHeldBack;
  append_csv(row, text);
  row.corruption = {.kind = Corruption::Kind::kBitFlips, .bits = 3, .seed = 99};
  append_csv(row, text);
  row = kSample;
  row.corruption = {.kind = Corruption::Kind::kTruncated, .length = 57};
  append_csv(row, text);
  EXPECT_EQ(text,
            "1000000,1,down,2,7,138,delivered,23110893,-\n"
            "1000000,1,down,2,7,138,copy waiting,23110893,-\n"
            "1000000,1,down,2,7,138,dropped,1000000,lost\n"
            "1000000,1,down,2,7,138,delivered,23110893,reordered\n"
            "1000000,1,down,2,7,138,delivered,23110893,reordered; flipped 3 99\n"
            "1000000,1,down,2,7,138,delivered,23110893,cut 57\n");
  EXPECT_EQ(decision_csv_header(),
            "t_in_ns[ns],link[1],dir[1],flow[1],idx[1],size[B],verdict[1],t_out_ns[ns],cause[1]\n");
}

TEST(DecisionLog, RoundTripsEveryDecisionAsText) {
  std::vector<Decision> rows;
  for (std::size_t outcome = 0; outcome < kOutcomes; ++outcome) {
    for (const bool copy : {false, true}) {
      for (const bool under_way : {false, true}) {
        Decision row = kSample;
        row.outcome = static_cast<Outcome>(outcome);
        if (under_way && dropped(row.outcome)) continue;
        if (!under_way && row.outcome == Outcome::kWaiting) continue;
        row.copy = copy;
        row.in_flight = under_way;
        row.index = rows.size();
        if (rows.size() % 3 == 1)
          row.corruption = {.kind = Corruption::Kind::kBitFlips, .bits = 3, .seed = ~std::uint64_t{0}};
        if (rows.size() % 3 == 2) row.corruption = {.kind = Corruption::Kind::kTruncated, .length = 57};
        row.direction = static_cast<Direction>(rows.size() % 2);
        rows.push_back(row);
      }
    }
  }
  sort_decisions(rows);
  const auto read = parse_decision_csv(decision_csv(rows), "log.csv");
  ASSERT_TRUE(read) << to_text(read.error());
  EXPECT_EQ(*read, rows);
  EXPECT_EQ(decision_hash(*read), decision_hash(rows));
}

TEST(DecisionLog, ReportsThePlaceOfMistakes) {
  const std::string header{decision_csv_header()};
  const auto mistakes = [&](const std::string& row) {
    const auto read = parse_decision_csv(header + row, "log.csv");
    return read ? "none" : to_text(read.error());
  };
  EXPECT_EQ(mistakes("0,0,up,0,0,10,delivered,5,-\n"), "none");
  EXPECT_NE(mistakes("").find("holds no decision"), std::string::npos);
  EXPECT_EQ(mistakes("0,0,up,0,0,10,delivered,5,-\n0,0,left,0,0,10,delivered,5,-\n"),
            "log.csv:3:3: dir = left: must be up or down\n");
  EXPECT_NE(mistakes("-1,0,up,0,0,10,delivered,5,-\n").find("t_in_ns = -1: must be a whole number"), std::string::npos);
  EXPECT_NE(mistakes("9,0,up,0,0,10,delivered,5,-\n").find("t_out_ns = 5: is before t_in_ns"), std::string::npos);
  EXPECT_NE(mistakes("0,0,up,0,0,10,kept,5,-\n").find("verdict = kept: must be delivered"), std::string::npos);
  EXPECT_NE(mistakes("0,0,up,0,0,10,dropped,5,losst\n").find("did you mean lost?"), std::string::npos);
  EXPECT_NE(mistakes("0,0,up,0,0,10,dropped,5,-\n").find("cause = -: does not go with this verdict"),
            std::string::npos);
  EXPECT_NE(mistakes("0,0,up,0,0,10,delivered,5,lost\n").find("does not go with this verdict"), std::string::npos);
  EXPECT_NE(mistakes("0,0,up,5000000000,0,10,delivered,5,-\n").find("flow"), std::string::npos);
  EXPECT_NE(mistakes("0,0,up,0,0,10,delivered,5,-\n0,0,up,0,0,10,delivered,5,-\n").find("holds this datagram twice"),
            std::string::npos);
  EXPECT_NE(to_text(parse_decision_csv("t_in_ns[ns],link[1]\n1,2\n", "x.csv").error()).find("this column"),
            std::string::npos);
  EXPECT_FALSE(parse_decision_csv("", "x.csv"));
}

// Every prefix and every flipped byte of a log is parsed or rejected, without any other effect.
TEST(DecisionLog, RejectsHostileText) {
  std::vector<Decision> rows{kSample};
  const std::string text = decision_csv(rows);
  for (std::size_t i = 0; i < text.size(); ++i) {
    static_cast<void>(parse_decision_csv(text.substr(0, i), "x.csv"));
    for (int bit = 0; bit < 8; ++bit) {
      std::string changed = text;
      changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
      static_cast<void>(parse_decision_csv(changed, "x.csv"));
    }
  }
}

TEST(DecisionLog, YieldsTheWholeLogInOrderInPieces) {
  const auto run = [](bool in_pieces) {
    Network network{3};
    network.add_link({everything(), everything()});
    DecisionLog log{100'000};
    network.log_to(&log);
    std::array<std::byte, kSlotBytes> buffer;
    std::vector<Decision> all;
    const auto take = [&](Time until) {
      const auto piece = log.take_before(until);
      all.insert(all.end(), piece.begin(), piece.end());
    };
    for (int i = 0; i < 5'000; ++i) {
      const Time now{i * 1ms};
      network.send(now, 0, static_cast<Direction>(i % 2), datagram(1));
      while (network.poll_any(now, buffer)) {
      }
      if (in_pieces && i % 100 == 0) take(network.oldest_in_flight().value_or(now));
    }
    network.log_in_flight();
    if (!in_pieces) return log.sorted();
    take(Time::max());
    return all;
  };
  EXPECT_EQ(difference(run(true), run(false)), "");
}

TEST(DecisionLog, HoldsTheOutcomeOfEveryDatagramAndCopyOnce) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Network network{seed};
    network.add_link({everything(), everything()});
    const auto rows = log_of(network, {{.length = 10s, .seed = seed}});
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      const PathCounters& counters = network.counters(0, direction);
      std::uint64_t in = 0, copies = 0, out = 0, lost = 0, waiting = 0, held_back = 0;
      std::map<std::pair<std::uint64_t, bool>, int> seen;
      for (const Decision& d : rows) {
        if (d.direction != direction) continue;
        (d.copy ? copies : in) += 1;
        (d.in_flight ? waiting : dropped(d.outcome) ? lost : out) += 1;
        if (!d.copy && d.outcome == Outcome::kHeldBack) ++held_back;
        EXPECT_GE(d.out, d.in);
        EXPECT_EQ((++seen[{d.index, d.copy}]), 1);
      }
      EXPECT_EQ(in, counters.in);
      EXPECT_EQ(copies, counters.copies);
      EXPECT_EQ(out, counters.out);
      EXPECT_EQ(lost, counters.dropped());
      EXPECT_EQ(waiting, counters.in_flight());
      EXPECT_EQ(held_back, counters.of(Outcome::kHeldBack));
      EXPECT_GT(copies, 50U);
      EXPECT_GT(held_back, 50U);
    }
  }
}

// Deliveries and log are two independent records of the same decisions.
TEST(DecisionLog, MatchesWhatTheReceiverGot) {
  Network network{8};
  network.add_link({everything(), everything()});
  DecisionLog log{50'000};
  network.log_to(&log);
  std::array<std::byte, kSlotBytes> buffer;
  std::vector<std::tuple<Time, Time, std::uint64_t>> seen, told;
  for (int i = 0; i < 15'000; ++i) {
    const Time now{i * 1ms};
    if (i < 10'000) network.send(now, 0, Direction::kUp, datagram(1));
    while (const auto d = network.poll(now, 0, Direction::kUp, buffer)) seen.emplace_back(d->sent, d->at, d->index);
  }
  for (const Decision& d : log.rows()) {
    if (!dropped(d.outcome)) told.emplace_back(d.in, d.out, d.index);
  }
  EXPECT_TRUE(seen == told);
  EXPECT_GT(seen.size(), 7'000U);
}

TEST(DecisionLog, IsIndependentOfThePollTimes) {
  const auto run = [](int every) {
    Network network{3};
    network.add_link({everything(), everything()});
    DecisionLog log{50'000};
    network.log_to(&log);
    std::array<std::byte, kSlotBytes> buffer;
    for (int i = 0; i < 10'000; ++i) {
      network.send(Time{i * 1ms}, 0, Direction::kUp, datagram(1));
      while (i % every == 0 && network.poll_any(Time{i * 1ms}, buffer)) {
      }
    }
    while (network.poll_any(Time{20s}, buffer)) {
    }
    return log.sorted();
  };
  EXPECT_EQ(difference(run(1), run(500)), "");
}

TEST(DecisionLog, RunsWithoutHeapAndCountsDroppedRows) {
  Network network{5};
  network.add_link({everything(), everything()});
  DecisionLog log{1'000};
  network.log_to(&log);
  const auto bytes = datagram(1);
  std::array<std::byte, kSlotBytes> buffer;
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 5'000; ++i) {
    network.send(Time{i * 1ms}, 0, Direction::kUp, bytes);
    while (network.poll_any(Time{i * 1ms}, buffer)) {
    }
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(log.rows().size(), 1'000U);
  const PathCounters& c = network.counters(0, Direction::kUp);
  EXPECT_EQ(log.missed(), c.in + c.copies - c.in_flight() - 1'000);
}

// ---- Through the live proxy's core, and with other clients

TEST(Determinism, TwoRunsGiveTheSameLogByteForByte) {
  for (const char* name : {"everything", "script", "replay of other traffic", "proxy"}) {
    for (const MatrixEntry& entry : decision_matrix()) {
      if (entry.name != name) continue;
      EXPECT_EQ(difference(entry.log(), entry.log()), "") << name;
    }
  }
}

TEST(Determinism, IgnoresAnotherFlow) {
  const auto flow_zero = [](const std::vector<Traffic>& traffic) {
    Network network{11};
    for (std::size_t i = 0; i < traffic.size(); ++i) network.add_link({everything(), everything()});
    return of_flow(log_of(network, traffic), 0);
  };
  const Traffic own{.seed = 4};
  const auto alone = flow_zero({own});
  EXPECT_GT(alone.size(), 10'000U);
  EXPECT_EQ(difference(flow_zero({own, {.seed = 5}}), alone), "");
  EXPECT_EQ(
      difference(flow_zero({own, {.period = 3ms, .size_max = 1400, .seed = 6}, {.period = 400us, .seed = 7}}), alone),
      "");
}

TEST(Determinism, ProxyAndVirtualNetworkWriteTheSameLog) {
  const std::vector<Traffic> traffic{{.seed = 1}, {.period = 700us, .seed = 2}, {.size_max = 1200, .seed = 3}};
  const NetworkEvent events[] = {{.at = 1s, .link = link_from({.delay = 20ms, .jitter = 5ms, .loss = 0.1})},
                                 {.at = 2s, .clients = {"2"}, .outage = OutageSpec{.length = 300ms}},
                                 {.at = 2s, .clients = {"1"}, .rebind = Rebind{10ms}},
                                 {.at = 3s, .link = LinkSpec{everything(), everything()}}};
  Network network{77};
  for (std::uint64_t i = 0; i < traffic.size(); ++i) {
    network.add_link(schedule_for({everything(), everything()}, events, std::to_string(i + 1)), i);
  }
  ProxyCore core{{everything(), everything()}, 77, {std::begin(events), std::end(events)}};
  const auto simulated = log_of(network, traffic);
  EXPECT_GT(simulated.size(), 30'000U);
  EXPECT_EQ(difference(log_of(core, traffic), simulated), "");
}

TEST(Determinism, CoversDistinctDecisionsForEveryMatrixEntry) {
  std::map<std::uint64_t, std::string> hashes;
  for (const MatrixEntry& entry : decision_matrix()) {
    const auto rows = entry.log();
    EXPECT_GT(rows.size(), 10'000U) << entry.name;
    hashes.emplace(decision_hash(rows), entry.name);
  }
  // `ideal` and other profiles without delay may agree; most must differ.
  EXPECT_GT(hashes.size(), 25U);
}

}  // namespace
}  // namespace tandem::netsim
