// Fixture for other projects: its guarantees, and its output when a test fails.
#include <cstdlib>

#include "netsim/testing/network_test.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;

struct Fixture : NetworkTest {
  /// Returns a digest of all deliveries of 5 s at 1 kHz.
  std::uint64_t digest_of(std::string_view profile) {
    use_profile(profile);
    test::Digest digest;
    run_for(5s, 1ms, [&] {
      digest.add(static_cast<std::uint64_t>(send(Direction::kUp, "tick")));
      while (const auto got = receive(Direction::kUp)) {
        digest.add(got->index);
        digest.add(static_cast<std::uint64_t>(got->at.time_since_epoch().count()));
      }
    });
    return digest.value();
  }
};

TEST_F(Fixture, CarriesOwnBytesBothWaysInVirtualTime) {
  use_numbers({.delay = 20ms});
  EXPECT_EQ(send(Direction::kUp, "ping"), Outcome::kDeliver);
  advance(20ms - 1ns);
  EXPECT_FALSE(receive(Direction::kUp));
  advance(1ns);
  const auto ping = receive(Direction::kUp);
  ASSERT_TRUE(ping);
  EXPECT_EQ(ping->text(), "ping");
  EXPECT_EQ(ping->delay(), 20ms);
  EXPECT_EQ(send(Direction::kDown, "pong"), Outcome::kDeliver);
  EXPECT_FALSE(receive(Direction::kUp));
  ASSERT_TRUE(advance_to_next());
  EXPECT_EQ(now(), Time{40ms});
  EXPECT_EQ(receive(Direction::kDown)->text(), "pong");
  EXPECT_FALSE(advance_to_next());
  EXPECT_EQ(counters(Direction::kDown).out, 1U);
}

TEST_F(Fixture, RunsItsBodyAtEveryStepAndLeavesTheClockAtTheEnd) {
  int calls = 0;
  run_for(10ms, 3ms, [&] { EXPECT_EQ(now(), Time{3ms * calls++}); });
  EXPECT_EQ(calls, 4);  // 0, 3, 6, 9 ms
  EXPECT_EQ(now(), Time{10ms});
}

TEST_F(Fixture, DrawsIndependentlyPerLink) {
  use_numbers({.loss = 0.5});
  EXPECT_EQ(add_link(), 1U);
  int differ = 0;
  for (int i = 0; i < 100; ++i) differ += send(Direction::kUp, "a", 0) != send(Direction::kUp, "a", 1) ? 1 : 0;
  EXPECT_GT(differ, 20);
}

TEST_F(Fixture, GivesTheSameNetworkForTheSameSeedOnly) {
  const auto one = digest_of("wifi-busy");
  EXPECT_EQ(digest_of("wifi-busy"), one);
  use_seed(2);
  EXPECT_NE(digest_of("wifi-busy"), one);
}

TEST_F(Fixture, RunsEverySeedOnce) {
  std::vector<std::uint64_t> seen;
  for_seeds(4, [&] { seen.push_back(seed()); });
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{1, 2, 3, 4}));
}

TEST_F(Fixture, RunsOnlyTheSeedOfTheEnvironment) {
  ASSERT_EQ(setenv("TANDEM_SEED", "77", 1), 0);
  struct Inner : Fixture {
    void TestBody() override {
      std::vector<std::uint64_t> seen;
      for_seeds(4, [&] { seen.push_back(seed()); });
      EXPECT_EQ(seen, (std::vector<std::uint64_t>{77}));
      use_seed(5);
      EXPECT_EQ(seed(), 77U);
    }
  } inner;
  inner.TestBody();
  ASSERT_EQ(setenv("TANDEM_SEED", "7x", 1), 0);
  EXPECT_THROW(Inner{}, std::invalid_argument);
  ASSERT_EQ(unsetenv("TANDEM_SEED"), 0);
}

TEST_F(Fixture, ReportsHowToRepeatATest) {
  use_seed(9);
  use_profile("4g");
  const std::string text = replay();
  EXPECT_NE(text.find("network 4g version"), std::string::npos) << text;
  EXPECT_NE(text.find("TANDEM_SEED=9 "), std::string::npos) << text;
  EXPECT_NE(text.find("--gtest_filter=Fixture.ReportsHowToRepeatATest\n"), std::string::npos) << text;
}

TEST_F(Fixture, RejectsInvalidNamesAndTexts) {
  EXPECT_THROW(use_profile("wifi-bussy"), std::invalid_argument);
  EXPECT_THROW(use_profile_text("version: 1 both { floor_ms: -1 }"), std::invalid_argument);
  EXPECT_THROW(run_scene("no_such_scene", "ideal"), std::runtime_error);
  EXPECT_THROW(run_scene({.scene = "free_motion", .duration_s = -1}), std::runtime_error);
  use_profile_text("version: 1 both { floor_ms: 3 }", "mine.textproto");
  send(Direction::kUp, "x");
  ASSERT_TRUE(advance_to_next());
  EXPECT_EQ(now(), Time{3ms});
}

TEST_F(Fixture, RunsReproducibleSessions) {
  const SceneRun run{.scene = "free_motion", .profile = "wifi-good", .seed = 7, .duration_s = 2};
  const auto report = run_scene(run);
  EXPECT_TRUE(report.passed);
  EXPECT_EQ(report.seed, 7U);
  ASSERT_GE(report.seats.size(), 2U);
  EXPECT_GT(report.seats[0].link.rtt_p50_ms, 3);
  EXPECT_EQ(run_scene(run).trace_hash, report.trace_hash);
  EXPECT_NE(run_scene({.scene = "free_motion", .profile = "wifi-good", .seed = 8, .duration_s = 2}).trace_hash,
            report.trace_hash);
  EXPECT_NE(
      replay().find("tandem-netsim run free_motion --profile wifi-good --seed 7 --duration 2 --trace trace.csv\n"),
      std::string::npos)
      << replay();
}

}  // namespace
}  // namespace tandem::netsim
