// The author and the reason of a stop stay the same when its session is restored by a next server.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "server/session/session_command.h"
#include "server/session/session_snapshot.h"
#include "server/session/stop_text.h"
#include "tests/server/session/session_fixture.h"

namespace tandem::server {
namespace {

using namespace test;

constexpr std::uint32_t kAll = ~0U;
constexpr std::uint8_t kTrainee = 1;

rpc::StatusStop newest(Session& session, Time now) {
  const SessionCommand look{rpc::StatusRequest{}, AccessRole::kOperator};
  const CommandOutcome outcome = execute_command(session, now, look);
  return latest_stop(outcome.stop_latch, session.scene(), outcome.stop_age, kAll).value_or(rpc::StatusStop{});
}

/// The session that the next server makes of a snapshot.
Session restored(const SessionSnapshot& kept, const SceneSpec& scene, Time saved_at) {
  AxisArray scale;
  scale.fill(1);
  return {scene, std::vector<std::unique_ptr<hal::SteppedDevice>>(scene.tools.size()), scale, kept.checkpoint,
          saved_at};
}

SessionCommand order(rpc::Body body) {
  SessionCommand command{std::move(body), AccessRole::kOperator};
  command.workstation = "office";
  command.person = "ann";
  return command;
}

TEST(KeptStop, HasTheSameAuthorReasonAndAgeAfterAMoveAndARestart) {
  const auto by_console = [](Session& s, Time now) {
    static_cast<void>(execute_command(s, now, order(rpc::StopSession{{}, "fire drill"})));
  };
  const auto by_seat = [](Session& s, Time now) {
    static_cast<void>(s.stop_control().request(now, requester_at(kTrainee, AccessRole::kTrainee)));
  };
  const auto by_fault = [](Session& s, Time now) { s.stop_control().stop_for_fault(now); };
  for (const auto& stop : std::vector<void (*)(Session&, Time)>{by_console, by_seat, by_fault})
    for (const bool moves : {false, true}) {
      SCOPED_TRACE(moves ? "move" : "restart");
      SessionFixture rig("free_motion");
      rig.run(2s);
      stop(*rig.session, rig.now);
      rig.run(1s);
      rpc::StatusStop before = newest(*rig.session, rig.now);
      if (before.seat == "trainee") before.person = "bea";  // as the control plane adds
      if (moves) rig.session->end(wire::CloseReason::kServerReturns);
      SessionSnapshot kept;
      kept.name = "lab";
      kept.persons = {"", "bea"};
      set_checkpoint(kept, rig.session->checkpoint());
      const SessionSnapshot snapshot = decode_snapshot(encode_snapshot(kept)).value();
      EXPECT_EQ(snapshot.checkpoint.handed_over, moves);

      Session next = restored(snapshot, rig.session->scene(), rig.now);
      rpc::StatusStop waiting = newest(next, rig.now);
      EXPECT_EQ(waiting.why, before.why);
      EXPECT_EQ(waiting.ends, "") << "the waiting session is not stopped yet";
      ASSERT_EQ(next.stop_control().resume(rig.now, {AccessRole::kOperator}, next.stop_control().latch().stops()),
                CommandResult::kDone);
      rpc::StatusStop after = newest(next, rig.now);
      EXPECT_NEAR(after.ago_s, before.ago_s, 0.01);
      EXPECT_GT(after.number, std::exchange(before.number, after.number));
      after.ago_s = before.ago_s;
      EXPECT_EQ(after, before);
      EXPECT_EQ(next.stop_control().resume(rig.now, {AccessRole::kOperator}, after.number), CommandResult::kDone);

      // Once more, by the server that restored it; another person has the seat by now.
      kept.persons[kTrainee] = "eve";
      set_checkpoint(kept, next.checkpoint());
      Session third = restored(decode_snapshot(encode_snapshot(kept)).value(), rig.session->scene(), rig.now);
      EXPECT_EQ(newest(third, rig.now).person, before.person) << "also of a stop that is over";
    }
}

}  // namespace
}  // namespace tandem::server
