// Which seats a session waits for, before it begins and after a restart.
#include "server/session/start_condition.h"

#include <gtest/gtest.h>

#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

using test::SessionParts;

struct Waiting : SessionParts {
  using SessionParts::SessionParts;
  StartCondition start{scene, seats, present, clock};
};

TEST(StartCondition, WaitsForTheSeatsThatTheSceneRequires) {
  Waiting session("eight_seats");
  EXPECT_TRUE(session.start.required(0));
  EXPECT_FALSE(session.start.required(1)) << "an evaluator that is not required";
  EXPECT_EQ(session.start.missing(Time{}), std::vector<std::size_t>{0});
  EXPECT_FALSE(session.start.step(Time{}, false));
  EXPECT_FALSE(session.start.may_engage());
  EXPECT_FALSE(session.clock.begun());
}

TEST(StartCondition, BeginsAtOnceWithoutRequiredSeatsUnlessHandsAreDisengaged) {
  Waiting session("eight_seats", [](SceneSpec& scene) { scene.seats[0].required = false; });
  EXPECT_FALSE(session.start.step(Time{}, true)) << "a stop";
  EXPECT_TRUE(session.start.may_engage()) << "the stop itself disengages the seats";
  ASSERT_TRUE(session.start.step(Time{}, false));
  session.clock.restore(7);
  session.start.begin(Time{});
  EXPECT_TRUE(session.clock.begun());
  EXPECT_EQ(session.clock.session_tick(), 0u) << "a new session begins at 0";
}

/// contact_remote: an instructor, a trainee, and the slave of the only tool.
Checkpoint taken(const SessionParts& of, const std::vector<std::size_t>& seats, std::size_t holder) {
  Checkpoint c;
  c.begun = true;
  c.session_tick = 4321;
  for (const std::size_t i : seats) c.seats[i].taken = true;
  for (std::size_t j = 0; j < of.scene.tools.size(); ++j) c.tools[j].alpha[holder] = 1;
  return c;
}

TEST(StartCondition, WaitsAfterARestartForTakenSeatsWithAuthorityAndInstructors) {
  for (const auto& [seats, holder, trainee] :
       {std::tuple{std::vector<std::size_t>{0, 1, 2}, 0u, false}, {{0, 1, 2}, 1u, true}, {{0, 2}, 1u, false}}) {
    Waiting session("contact_remote");
    const Checkpoint from = taken(session, seats, holder);
    session.start.restore(from);
    EXPECT_TRUE(session.start.recovering());
    EXPECT_TRUE(session.start.required(0)) << "an instructor's seat, also without authority";
    EXPECT_EQ(session.start.required(1), trainee);
    Checkpoint again;
    session.start.save(again);
    EXPECT_TRUE(again.begun);
    EXPECT_EQ(again.seats[1].taken, trainee) << "a second restart waits for the same seats";
    EXPECT_TRUE(session.start.required(2)) << "the slave of a tool";
  }
}

TEST(StartCondition, ContinuesFromTheCheckpointsTick) {
  Waiting session("contact_remote");
  session.clock.restore(4321);
  session.start.restore(taken(session, {0, 1, 2}, 0));
  session.start.begin(Time{});  // an instructor resumes without the missing seats
  EXPECT_TRUE(session.clock.begun());
  EXPECT_EQ(session.clock.session_tick(), 4321u);
  EXPECT_FALSE(session.start.recovering());
  EXPECT_TRUE(session.start.may_engage());
  Checkpoint again;
  session.start.save(again);
  EXPECT_FALSE(again.seats[0].taken) << "it is not awaited any more";
}

TEST(StartCondition, EngagesNoSeatBeforeItResumesIntoAStop) {
  Waiting session("contact_remote");
  Checkpoint from = taken(session, {}, 0);
  from.stop = StopLatch::Level::kPaused;
  session.start.restore(from);
  EXPECT_EQ(session.start.stop_before(), StopLatch::Level::kPaused);
  EXPECT_TRUE(session.start.step(Time{}, false)) << "no seat was taken, so none is awaited";
  EXPECT_FALSE(session.start.may_engage());
}

TEST(StartCondition, IgnoresASessionThatHadNotBegun) {
  Waiting session("contact_remote");
  Checkpoint from = taken(session, {0, 1, 2}, 0);
  from.begun = false;
  session.start.restore(from);
  EXPECT_FALSE(session.start.recovering());
  EXPECT_TRUE(session.start.required(1)) << "as the scene says";
}

}  // namespace
}  // namespace tandem::server
