// Texts that a user reads about the own seat during stops, transfers and device faults.
#include "client/app/client_status.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "client/app/authority_steps.h"
#include "client/app/authority_transfer_text.h"
#include "client/app/seat_screen.h"

namespace tandem::client {
namespace {

SeatSetup setup() {
  SeatSetup s;
  s.seat.name = "trainee";
  s.seat.role = Role::kTrainee;
  return s;
}

/// Three masters may have authority over the tool; the texts are those of the seat `trainee`.
struct ScreenTexts {
  ScreenTexts() : seat(setup()) {
    seat.masters = {"trainer", "trainee", "second"};
    seat.own_master = 1;
    s.session = wire::SessionState::kRunning;
    s.transfer.notice = wire::TransferNotice::kGaining;
    s.transfer.begins_s = 0.049;  // received one tick after it was sent
    words->seats = {{"trainer", AccessRole::kInstructor, true, true, true},
                    {"trainee", AccessRole::kTrainee, true, true, true},
                    {"second", AccessRole::kTrainee, true, true, true}};
    words->tools = {{"tool", {1, 0, 0}}};
  }
  std::string operator()(wire::TransferParties parties, double own_before = 0) {
    s.transfer.parties = parties;
    s.transfer.from = own_before;
    return authority_transfer_text(s, seat, words);
  }
  SeatSetup seat;
  ClientStatus s;
  std::optional<rpc::Status> words{rpc::Status{}};
};

TEST(ServerLost, TellsAnAnnouncedEndFromASilence) {
  EXPECT_EQ(server_lost_text(true, 60),
            "server lost: it ended or gave the session away, and no server has given the seat back for 60 s. Ask its "
            "operator when it serves the session again, then join again");
  EXPECT_NE(server_lost_text(false, 60).find("no news for 60 s"), std::string::npos);
}

TEST(ServerLost, GivesTheNewestReasonOfAServerThatWasReached) {
  EXPECT_EQ(server_lost_text(false, 60, "this service has no such session"),
            "server lost: a server was reached, but none has given the seat back for 60 s. Newest reason: this service "
            "has no such session. Ask its operator, then join again");
  EXPECT_EQ(server_lost_text(true, 4, "this server is draining"),
            "server lost: it ended or gave the session away, and no server has given the seat back for 4 s. Newest "
            "reason: this server is draining. Ask its operator when it serves the session again, then join again");
}

TEST(AuthorityTransfer, ReportsGiverReceiverShareStartAndDuration) {
  ScreenTexts said;
  EXPECT_EQ(said({.by = wire::TransferParties::kScene, .to = 2, .percent = 100}),
            "the scene gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 1.0 s");
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}),
            "trainer gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 1.0 s");
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 30}, 0.25),
            "trainer gives more of the tool to trainee (25 % to 30 %): begins in 50 ms, takes about 0.05 s");
  EXPECT_EQ(said({.by = wire::TransferParties::kOperator, .to = 2, .percent = 100}),
            "an operator gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 1.0 s");
  EXPECT_EQ(
      said({.by = 1, .to = 0, .percent = 15}, 0.25),
      "trainer sets new authorities over the tool (your authority 25 % to 15 %): begins in 50 ms, takes up to 1.0 s");
  said.seat.alpha_slew = 0.25;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}),
            "trainer gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 4.0 s")
      << "the scene's slew";
  said.seat.alpha_slew = std::numeric_limits<double>::infinity();
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}),
            "trainer gives the tool to trainee (0 % to 100 %): in one step in 50 ms");
}

TEST(AuthorityTransfer, ReportsAnotherSeatsPreviousShareOnlyWhereKnown) {
  ScreenTexts said;
  said.s.transfer.notice = wire::TransferNotice::kLosing;
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}, 0.75),
            "trainer takes the tool (25 % to 100 %): begins in 50 ms, takes about 0.8 s");
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 75}, 0.5),
            "trainer takes more of the tool (50 % to 75 %): begins in 50 ms, takes about 0.2 s");
  said.words->tools[0].alpha = {0.25, 0.5, 0.25};
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 75}, 0.5),
            "trainer takes more of the tool (to 75 %): begins in 50 ms, takes up to 0.8 s")
      << "a third hand has a part";
  said.words.reset();
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}, 0.5),
            "trainer takes the tool (to 100 %): begins in 50 ms, takes up to 1.0 s")
      << "the server is not heard";
  said.seat.masters.pop_back();
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}, 0.5),
            "trainer takes the tool (50 % to 100 %): begins in 50 ms, takes about 0.5 s")
      << "there is no third hand";
  said.s.session = wire::SessionState::kHeld;
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}, 0),
            "trainer takes the tool (to 100 %): begins in 50 ms, takes up to 1.0 s")
      << "no hand has authority now";
  said.seat.tools = {"left", "right"};
  EXPECT_EQ(said({.by = 24, .to = 16, .percent = 100, .tool = 1}),
            "an operator sets new authorities over the tool right (your authority to 100 %): begins in 50 ms, takes up "
            "to 1.0 s")
      << "numbers that name no seat";
}

TEST(AuthorityTransfer, LastsUntilTheAuthorityIsConstant) {
  ScreenTexts said;
  said.s.transfer.begins_s = 0;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}),
            "trainer gives the tool to trainee (0 % to 100 %): under way, takes about 1.0 s");
  EXPECT_EQ(authority_transfer_brief(said.s), "more authority under way");
  said.s.transfer.begins_s = -0.7;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}),
            "trainer gives the tool to trainee (0 % to 100 %): under way, takes about 1.0 s");
  said.s.transfer.done = true;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee (0 % to 100 %): done");
  EXPECT_EQ(authority_transfer_brief(said.s), "more authority: done");
  said.s.session = wire::SessionState::kStopped;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}),
            "trainer gives the tool to trainee (to 100 %): when the session resumes");
  EXPECT_EQ(authority_transfer_brief(said.s), "more authority when the session resumes");
  said.s.transfer.notice = wire::TransferNotice::kCancelled;
  EXPECT_EQ(said({}), "transfer canceled: a seat that it concerns has left, or has a stale link");
  said.s.transfer.notice = wire::TransferNotice::kNone;
  EXPECT_EQ(said({}), "");
}

/// A held key: `a` repeats every 0.1 s, and the server announces each step.
TEST(AuthorityTransfer, ReportsConsecutiveStepsAsOneCompleteSum) {
  ScreenTexts at;
  at.seat.own_master = 0;  // the trainer's own screen
  at.seat.seat.name = "trainer";
  at.s.transfer.notice = wire::TransferNotice::kLosing;
  AuthorityTransferNotices notes;
  std::string lines;
  double alpha = 1;
  for (int ms = 0; ms <= 4000; ms += 50) {
    const bool pressed = ms % 100 == 0 && ms < 1500;  // 15 steps
    if (pressed) {
      ++at.s.transfer.count;
      at.s.transfer.from = alpha;
      alpha -= 0.05;
      at.s.transfer.parties = {.by = 1, .to = 2, .percent = static_cast<std::uint32_t>(std::lround(100 * (1 - alpha)))};
    }
    at.s.transfer.begins_s = pressed ? 0.05 : 0;
    at.s.transfer.done = ms > 1600;
    if (ms > 2600) at.s.transfer.notice = wire::TransferNotice::kNone;
    if (const std::string line = notes.message(1e-3 * ms, at.s, at.seat, at.words); !line.empty()) lines += line + "\n";
  }
  EXPECT_EQ(lines,
            "trainer gives more of the tool to trainee (0 % to 5 %): begins in 50 ms, takes about 0.05 s\n"
            "trainer gives more of the tool to trainee (5 % to 55 %): begins in 50 ms, takes about 0.5 s\n"
            "trainer gives more of the tool to trainee (55 % to 75 %): done\n");
}

TEST(AuthorityTransfer, ReportsTheLastStepAfterItsNoticeHasEnded) {
  ScreenTexts at;
  AuthorityTransferNotices notes;
  at.s.transfer.count = 1;
  at.s.transfer.parties = {.by = 1, .to = 2, .percent = 10};
  EXPECT_NE(notes.message(0, at.s, at.seat, at.words), "");
  at.s.transfer.count = 2;
  at.s.transfer.from = 0.1;
  at.s.transfer.parties.percent = 20;
  EXPECT_EQ(notes.message(0.1, at.s, at.seat, at.words), "");
  at.s.transfer.notice = wire::TransferNotice::kNone;
  EXPECT_EQ(notes.message(5, at.s, at.seat, at.words),
            "trainer gives more of the tool to trainee (10 % to 20 %): done");
  EXPECT_EQ(notes.message(9, at.s, at.seat, at.words), "");
}

TEST(AuthoritySteps, AddUpUntilAnotherSeatDecides) {
  ClientStatus s;
  s.alpha = 1;
  s.authority_version = 7;
  AuthoritySteps steps;
  EXPECT_EQ(steps.base(s), 1);
  for (const double own : {0.95, 0.9, 0.85}) {
    steps.ask(own, s);
    EXPECT_EQ(steps.base(s), own) << "the authority in force is still 1";
  }
  s.authority_version = 10;
  s.alpha = 0.97;
  EXPECT_EQ(steps.base(s), 0.85) << "all three were granted";
  s.authority_version = 11;
  s.alpha = 0.5;
  EXPECT_EQ(steps.base(s), 0.5) << "another participant decided too";
  steps.ask(0.45, s);
  s.authority_version = 12;
  EXPECT_EQ(steps.base(s), 0.45);
  s.transfer.notice = wire::TransferNotice::kCancelled;
  EXPECT_EQ(steps.base(s), 0.5) << "the weights stay";
}

TEST(ClientStatus, ExplainsWhyHotMotorsGiveNoForceAndWhatToDo) {
  ClientStatus s;
  EXPECT_EQ(motors_text(s), "");
  s.motors.hot = true;
  EXPECT_EQ(motors_text(s), "MOTORS TOO HOT: take your hand off until they are cool");
  EXPECT_NE(io::join_items(seat_screen(s, setup(), std::nullopt)).find(motors_text(s)), std::string::npos);
  s.motors.latched = true;
  EXPECT_NE(motors_text(s).find("press b"), std::string::npos);
  s.motors.hot = false;
  EXPECT_EQ(motors_text(s), "motors were too hot three times: press b");
}

TEST(ClientReport, ReportsHotMotorsAndNothingWhereTemperatureIsUnknown) {
  ClientReport r;
  auto motors = nlohmann::json::parse(to_json(r, setup()))["motors"];
  EXPECT_EQ(motors["too_hot"], 0);
  EXPECT_TRUE(motors["heat_max"].is_null());
  r.last.motors.hot_trips = 2;
  r.last.motors.heat_max = 1.25;
  motors = nlohmann::json::parse(to_json(r, setup()))["motors"];
  EXPECT_EQ(motors["too_hot"], 2);
  EXPECT_EQ(motors["heat_max"], 1.25);
}

TEST(ClientReport, NamesEveryReasonVerdictAndRole) {
  EXPECT_STREQ(to_text(ExitReason::kDone), "done");
  EXPECT_STREQ(to_text(ExitReason::kSeatGone), "seat_gone");
  EXPECT_STREQ(to_text(ExitReason::kServerLost), "server_lost");
  EXPECT_STREQ(to_text(SeatVerdict::kPass), "pass");
  EXPECT_STREQ(to_text(SeatVerdict::kNotJudged), "not_judged");
  EXPECT_STREQ(to_text(Role::kInstructor), "INSTRUCTOR");
  EXPECT_STREQ(to_text(Role::kTrainee), "TRAINEE");
  EXPECT_STREQ(to_text(Role::kEvaluator), "EVALUATOR");
  EXPECT_STREQ(to_text(Role::kObserver), "OBSERVER");
}

/// The status at the end is that of a released seat.
TEST(ClientReport, ReportsAuthorityAndDistanceOfTheEngagedTime) {
  ClientReport r;
  r.last.alpha = 0.25;
  r.last.offset_from_leader_m = 1;
  auto j = nlohmann::json::parse(to_json(r, setup()));
  for (const char* key : {"alpha", "alpha_mean", "beside_leader_m", "beside_leader_mean_m"})
    EXPECT_TRUE(j[key].is_null()) << key << ": it was never engaged";
  r.last.engaged.add(0, 0.002);
  r.last.engaged.add(0, 0.004);
  r.last.engaged.add(0.75, std::nullopt);
  r.last.alpha = 0;
  r.last.offset_from_leader_m.reset();
  j = nlohmann::json::parse(to_json(r, setup()));
  EXPECT_DOUBLE_EQ(j["alpha"].get<double>(), 0.75);
  EXPECT_DOUBLE_EQ(j["alpha_mean"].get<double>(), 0.25);
  EXPECT_DOUBLE_EQ(j["beside_leader_m"].get<double>(), 0.004);
  EXPECT_DOUBLE_EQ(j["beside_leader_mean_m"].get<double>(), 0.003);
}

}  // namespace
}  // namespace tandem::client
