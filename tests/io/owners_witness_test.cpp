// The witness of servers that engage hands, with samples and pages whose answers are known.
#include "tests/io/owners_witness.h"

#include <gtest/gtest.h>

namespace tandem::test {
namespace {

using std::chrono::milliseconds;

/// A sample that took 2 ms. @param ms  when it was asked for
OwnersWitness::Seen sample(int ms, std::size_t engaged) {
  OwnersWitness::Seen seen;
  seen.asked = std::chrono::steady_clock::time_point(milliseconds(ms));
  seen.answered = seen.asked + milliseconds(2);
  seen.engaged = engaged;
  return seen;
}

TEST(OwnersWitness, CountsTimesAtWhichTwoServersEngageHands) {
  EXPECT_EQ(OwnersWitness::overlaps({{"a", {sample(0, 2), sample(25, 2)}}, {"b", {sample(10, 1)}}}), 1U);
  EXPECT_EQ(OwnersWitness::overlaps({{"a", {sample(0, 2), sample(25, 2)}}, {"b", {sample(10, 0), sample(30, 2)}}}), 0U)
      << "one after the other";
  EXPECT_EQ(OwnersWitness::overlaps({{"a", {sample(0, 2), sample(5000, 2)}}, {"b", {sample(10, 2)}}}), 0U)
      << "a server that stood still between its samples";
}

TEST(OwnersWitness, ReadsEngagedHandsOfTakenSeatsFromFreshReports) {
  const auto page = [](const char* gate, const char* taken, const char* age) {
    return std::string("# TYPE tandem_seat_taken gauge\ntandem_seat_taken{session=\"lab\",seat=\"x\"} ") + taken +
           "\ntandem_gate_state{session=\"lab\",seat=\"x\"} " + gate +
           "\ntandem_loop_age_seconds{session=\"lab\",seat=\"x\"} " + age + "\n";
  };
  const auto active = OwnersWitness::read(page("3", "1", "0.002"));
  EXPECT_TRUE(active.answers && active.acts());
  EXPECT_EQ(active.active, 1U);
  const auto ramps = OwnersWitness::read(page("2", "1", "0.002"));
  EXPECT_TRUE(ramps.acts());
  EXPECT_EQ(ramps.active, 0U);
  EXPECT_FALSE(OwnersWitness::read(page("4", "1", "0.002")).acts());
  EXPECT_FALSE(OwnersWitness::read(page("3", "0", "0.002")).acts()) << "a seat that is free";
  EXPECT_FALSE(OwnersWitness::read(page("3", "1", "0.6")).acts()) << "the last report of a silent client";
  EXPECT_FALSE(OwnersWitness::read("").answers);
}

}  // namespace
}  // namespace tandem::test
