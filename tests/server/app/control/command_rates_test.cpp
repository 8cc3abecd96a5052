// Rate limits of one connection, and counters of the control plane's events.
#include "server/app/control/command_rates.h"

#include <gtest/gtest.h>

#include <vector>

#include "server/app/control/control_event.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using rpc::Kind;

constexpr Time kStart = Time{} + 1h;

int accepted(CommandRates& rates, Kind kind, Time now, int tries = 1000) {
  int count = 0;
  for (int i = 0; i < tries; ++i) count += rates.take(kind, now) ? 1 : 0;
  return count;
}

TEST(CommandRates, AcceptTwentyAtOnceAndTenPerSecond) {
  CommandRates rates;
  EXPECT_EQ(accepted(rates, Kind::kStatusRequest, kStart), 20);
  EXPECT_EQ(accepted(rates, Kind::kStatusRequest, kStart + 1s), 10);
}

TEST(CommandRates, DelayNoStopByOtherRequests) {
  CommandRates rates;
  static_cast<void>(accepted(rates, Kind::kStatusRequest, kStart));
  static_cast<void>(accepted(rates, Kind::kSetAuthority, kStart));
  EXPECT_FALSE(rates.take(Kind::kResumeSession, kStart)) << "shares the limit of the other requests";
  EXPECT_EQ(accepted(rates, Kind::kStopSession, kStart, 10) + accepted(rates, Kind::kPauseSession, kStart), 20)
      << "stops and pauses share one limit";
}

TEST(CommandRates, AcceptMoreChangesOfAuthority) {
  CommandRates rates;
  EXPECT_EQ(accepted(rates, Kind::kSetAuthority, kStart), 120);
  EXPECT_EQ(accepted(rates, Kind::kSetAuthority, kStart + 1s), 60);
}

TEST(ControlEvents, CountByKindAndPassEachOn) {
  std::vector<ControlEventRecord> passed;
  ControlEvents events([&](const ControlEventRecord& e) { passed.push_back(e); });
  events.record(ControlEvent::kRefused, "10.0.0.1:7", "desk", "no");
  events.record(ControlEvent::kRefused, "10.0.0.2:7");
  EXPECT_EQ(events.count(ControlEvent::kRefused), 2U);
  EXPECT_EQ(events.count(ControlEvent::kAccepted), 0U);
  ASSERT_EQ(passed.size(), 2U);
  EXPECT_EQ(passed[0].workstation, "desk");
  EXPECT_EQ(passed[0].detail, "no");
  ControlEvents silent;
  silent.record(ControlEvent::kIdle, "10.0.0.1:7");
  EXPECT_EQ(silent.count(ControlEvent::kIdle), 1U);
}

}  // namespace
}  // namespace tandem::server
