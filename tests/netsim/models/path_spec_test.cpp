#include "netsim/models/path_spec.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "netsim/engine/network.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string keys(const PathSpec& spec) {
  std::string text;
  for (const SpecError& problem : problems(spec)) text += problem.key + " ";
  return text;
}

TEST(PathSpec, AcceptsTheDefaultAndAllModels) {
  EXPECT_EQ(keys({}), "");
  EXPECT_EQ(keys(everything()), "");
}

TEST(PathSpec, EveryMistakeIsNamed) {
  PathSpec spec;
  spec.outages = {{.start = -1s, .length = 0s}, {.start = 1s, .length = 2s, .period = 2s}};
  spec.loss.probability = kNan;
  spec.loss.periods = BadPeriodsSpec{.good_mean = 0s, .bad_mean = -1s, .loss_good = -0.1, .loss_bad = 1.1};
  spec.rate = {.bits_per_s = 1};
  spec.floor = 61s;
  spec.body = {.kind = BodySpec::Kind::kLogNormal, .shape = kNan, .tau = 1ns};
  spec.stall = {.rate_per_s = 1, .length_min = 50ms, .alpha = 0, .cap = 10ms};
  spec.reorder = {.probability = 2, .displacement = 0, .hold_limit = Duration{}};
  spec.duplicate = {.probability = std::numeric_limits<double>::infinity(), .delay_max = -1s};
  EXPECT_EQ(
      keys(spec),
      "outages[0].start outages[0].length outages[1].period loss.probability loss.periods.good_mean "
      "loss.periods.bad_mean loss.periods.loss_good loss.periods.loss_bad rate.bits_per_s floor body.tau body.scale "
      "body.cap body.shape stall.alpha stall.cap reorder.probability reorder.displacement reorder.hold_limit "
      "duplicate.probability duplicate.delay_max ");
}

TEST(PathSpec, ContradictionsAreNamed) {
  PathSpec queue;
  queue.rate.queue_bytes = 1000;
  queue.rate.queue_wait = 5ms;
  EXPECT_EQ(keys(queue), "rate.queue_bytes rate.queue_wait ");
  PathSpec uniform;
  uniform.body = {.kind = BodySpec::Kind::kUniform, .low = 5ms, .high = 4ms};
  EXPECT_EQ(keys(uniform), "body.low ");
  PathSpec stalled;
  stalled.stall = {.rate_per_s = 100, .length_min = 1ms, .alpha = 1, .cap = 1s};
  EXPECT_EQ(keys(stalled), "stall.rate_per_s ");
  PathSpec trace;
  trace.trace = std::make_shared<DelayTrace>(DelayTrace{{{0s, 1ms}, {2s, 61s}, {2s, 1ms}}, 1s});
  EXPECT_EQ(keys(trace), "trace.steps[1].delay trace.steps[2].at trace.period ");
}

TEST(PathSpec, RejectsANegativeJitterOrDelayOfASimpleNetwork) {
  EXPECT_EQ(keys(link_from({.jitter = -1ms}).up), "body.high body.low ");
  EXPECT_EQ(keys(link_from({.delay = -1ms}).up), "floor ");
  EXPECT_EQ(keys(link_from({.delay = 1ms, .jitter = 1ms}).up), "");
}

TEST(PathSpec, RejectsSpecsThatCannotBeSimulated) {
  PathSpec bad;
  bad.loss.probability = 1.5;
  EXPECT_THROW(path_of(bad), std::invalid_argument);
  Network network{1};
  EXPECT_THROW(network.add_link({PathSpec{}, bad}), std::invalid_argument);
  EXPECT_EQ(network.links(), 0U);
}

TEST(PathSpec, LongestDelayIsTheSumOfItsParts) {
  EXPECT_EQ(delay_max({}), Duration{});
  // floor 5, body 60, stall 200, reorder 50, copy 2, hold 100
  EXPECT_EQ(delay_max(everything()), 417ms);
}

TEST(PathSpec, EqualRecordingsAreEqualWhereverTheyWereRead) {
  const auto delays = [](Duration delay) {
    return PathSpec{.trace = std::make_shared<DelayTrace>(DelayTrace{{{0s, delay}}, 1s})};
  };
  EXPECT_EQ(delays(2ms), delays(2ms));
  EXPECT_NE(delays(2ms), delays(3ms));
  EXPECT_NE(delays(2ms), PathSpec{});
  const auto capacity = [](std::uint64_t opportunities) {
    return RateSpec{.trace = std::make_shared<CapacityTrace>(CapacityTrace{{{0, opportunities}}, 60ms})};
  };
  EXPECT_EQ(capacity(2), capacity(2));
  EXPECT_NE(capacity(2), capacity(3));
  EXPECT_NE(capacity(2), RateSpec{});
}

}  // namespace
}  // namespace tandem::netsim
