// Hands in contact while their server may not act (ARCHITECTURE.md, invariant 180).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using test::SessionFixture;

/// Largest force of all hands [N], and largest change of one from a tick to the next.
struct Felt {
  double force = 0, step = 0;
};

Felt run(SessionFixture& fixture, Duration length) {
  Felt felt;
  std::vector<double> before;
  for (const auto& seat : fixture.seats) before.push_back(seat.core->effort()[0]);
  for (const Time end = fixture.now + length; fixture.now < end;) {
    fixture.tick([] {});
    for (std::size_t i = 0; i < fixture.seats.size(); ++i) {
      const double force = fixture.seats[i].core->effort()[0];
      felt.force = std::max(felt.force, std::abs(force));
      felt.step = std::max(felt.step, std::abs(force - std::exchange(before[i], force)));
    }
  }
  return felt;
}

TEST(MayAct, ReleasesHandsInContactAsAStopDoesAndEngagesThemAgain) {
  SessionFixture fixture("contact");
  const Felt before = run(fixture, 6s);
  ASSERT_GT(before.force, 0.5) << "the hands feel something";
  ASSERT_EQ(fixture.session->state(), wire::SessionState::kRunning);

  SessionFixture stopped("contact");  // the twin, which a participant stops at the same time
  run(stopped, 6s);
  ASSERT_TRUE(stopped.session->stop_control().request(stopped.now, {AccessRole::kOperator}));
  fixture.session->lifecycle().set_may_act(false);
  for (int ms = 0; ms < 2000; ++ms) {
    fixture.tick([] {});
    stopped.tick([] {});
    for (std::size_t i = 0; i < fixture.seats.size(); ++i)
      ASSERT_EQ(fixture.seats[i].core->effort()[0], stopped.seats[i].core->effort()[0]) << ms << " ms, seat " << i;
  }
  EXPECT_EQ(fixture.session->state(), wire::SessionState::kHeld);
  EXPECT_LT(run(fixture, 100ms).force, 0.1) << "the damping of the gate alone";

  fixture.session->lifecycle().set_may_act(true);
  const Felt after = run(fixture, 6s);
  EXPECT_EQ(fixture.session->state(), wire::SessionState::kRunning);
  EXPECT_GT(after.force, 0.5) << "the hands are engaged again";
  EXPECT_LE(after.step, before.step + 0.05) << "without a step that the lesson does not have";
}

}  // namespace
}  // namespace tandem::server
