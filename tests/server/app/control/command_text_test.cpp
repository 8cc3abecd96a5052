// Replies, audit lines and messages about commands, from plain results.
#include "server/app/control/command_text.h"

#include <gtest/gtest.h>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::server {
namespace {

using rpc::ErrorCode;
using Result = CommandOutcome::Result;

const std::string kWho = "desk-1 (instructor)";

class CommandText : public ::testing::Test {
 protected:
  CommandText() {
    outcome.result = Result::kDone;
    outcome.stops = 3;
    outcome.tick = 40;
    outcome.authority_version = 6;
    outcome.masters = 2;
    outcome.tools = 1;
    outcome.before[0] = 1;
    outcome.alpha[0][0] = 0.25;
    outcome.alpha[0][1] = 0.75;
  }
  rpc::ErrorReply error(const rpc::Body& command, Result result, AccessRole role = AccessRole::kInstructor) {
    outcome.result = result;
    const rpc::Body reply = command_reply(command, role, outcome, seats);
    EXPECT_TRUE(std::holds_alternative<rpc::ErrorReply>(reply));
    return std::get<rpc::ErrorReply>(reply);
  }
  std::string detail(const rpc::Body& command) { return audit_detail(kWho, {command}, outcome, scene); }

  SceneSpec scene = *parse_scene(find_shipped_scene("free_motion")->text, "free_motion.textproto");
  SeatCatalogue seats{scene, AxisArray{}};
  CommandOutcome outcome;
};

TEST_F(CommandText, RepliesOkOrTheAuthorityInForce) {
  const auto reply = [&](const rpc::Body& command) {
    return command_reply(command, AccessRole::kInstructor, outcome, seats);
  };
  EXPECT_EQ(reply(rpc::StopSession{}), rpc::Body{rpc::Ok{}});
  const rpc::SetAuthority wanted{{}, 0, 5, {0.5, 0.5}};
  EXPECT_EQ(reply(wanted), (rpc::Body{rpc::AuthorityReply{true, 0, 6, {0.25, 0.75}}}));
  outcome.result = Result::kOutdated;
  EXPECT_EQ(reply(wanted), (rpc::Body{rpc::AuthorityReply{false, 0, 6, {0.25, 0.75}}})) << "with the version to repeat";
}

TEST_F(CommandText, NamesTheErrorOfEachResult) {
  const rpc::Body resume = rpc::ResumeSession{{}, 2}, remove = rpc::RemoveParticipant{{}, "trainee", ""};
  EXPECT_EQ(error(resume, Result::kNothingToDo).code, ErrorCode::kOutdated);
  EXPECT_EQ(error(remove, Result::kNothingToDo).text, "no client is on seat trainee");
  EXPECT_EQ(error(resume, Result::kOutdated).text,
            "stop 2 is not the newest: stop 3 followed; check its reason, then resume that stop");
  EXPECT_EQ(error(rpc::ResumeSession{{}, 4}, Result::kOutdated).text, "there is no stop 4; the newest is stop 3");
  EXPECT_EQ(error(remove, Result::kNoSuchSeat).text, "no seat of this name; seats: " + seats.seat_names());
  EXPECT_EQ(error(remove, Result::kNoSuchSeat).code, ErrorCode::kNoSeat);
  EXPECT_EQ(error(resume, Result::kSeatLost).text, "this connection no longer holds its seat");
  EXPECT_EQ(error(resume, Result::kForbidden).text, "your role may not do this");
  const rpc::Body authority = rpc::SetAuthority{};
  EXPECT_EQ(error(authority, Result::kInvalid).code, ErrorCode::kBadFrame);
  EXPECT_EQ(error(authority, Result::kStaleLink).code, ErrorCode::kNotNow);
  EXPECT_EQ(error(authority, Result::kForbidden).text, "evaluators and observers get no authority");
  EXPECT_EQ(error(authority, Result::kForbidden, AccessRole::kTrainee).text,
            "you may only give your own authority back to an instructor");
}

TEST_F(CommandText, NamesTheRolesThatMayEndAStop) {
  static_cast<void>(outcome.stop_latch.request(Time{}, AccessRole::kOperator, StopLatch::kNoSeat));
  EXPECT_EQ(error(rpc::ResumeSession{{}, 1}, Result::kForbidden).text,
            "you may not end this stop; it can be ended by: an instructor (key r) or an operator (`tandem-client "
            "control resume`)");
}

TEST_F(CommandText, WritesOneAuditLinePerCommand) {
  EXPECT_EQ(detail(rpc::StopSession{{}, "fire"}), kWho + " stop 3 tick 40: fire");
  EXPECT_EQ(detail(rpc::PauseSession{{}, ""}), kWho + " stop 3 tick 40");
  EXPECT_EQ(detail(rpc::ResumeSession{{}, 3}), kWho + " stop 3 tick 40");
  EXPECT_EQ(detail(rpc::RemoveParticipant{{}, "trainee", "pushes"}), kWho + " trainee tick 40: pushes");
  EXPECT_EQ(detail(rpc::SetAuthority{{}, 0, 5, {0.25, 0.75}}),
            kWho + " tool version 6 tick 40: trainer 1.000 to 0.250, trainee 0.000 to 0.750");
  outcome.result = Result::kForbidden;
  EXPECT_EQ(detail(rpc::SetAuthority{{}, 0, 5, {0.25, 0.75}}), kWho + " tool version 6 tick 40: may not authority");
  EXPECT_EQ(detail(rpc::StopSession{{}, "fire"}), kWho + " stop 3 tick 40: may not stop: fire");
}

TEST_F(CommandText, ReportsAllButAuthorityToTheOperator) {
  EXPECT_EQ(operator_message(kWho, rpc::StopSession{{}, "fire"}), "STOPPED by desk-1 (instructor): fire");
  EXPECT_EQ(operator_message(kWho, rpc::PauseSession{}), "PAUSED by desk-1 (instructor)");
  EXPECT_EQ(operator_message(kWho, rpc::ResumeSession{}), "RESUMED by desk-1 (instructor)");
  EXPECT_EQ(operator_message(kWho, rpc::RemoveParticipant{{}, "trainee", ""}),
            "trainee REMOVED by desk-1 (instructor)");
  EXPECT_EQ(operator_message(kWho, rpc::SetAuthority{}), "");
  EXPECT_EQ(operator_message(kWho, rpc::StatusRequest{}), "");
}

}  // namespace
}  // namespace tandem::server
