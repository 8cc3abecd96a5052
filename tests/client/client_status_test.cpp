// What a person reads of his seat while something happens to his hand.
#include "client/app/client_status.h"

#include "client/app/authority_steps.h"
#include "client/app/handover_text.h"
#include "client/app/seat_screen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace tandem::client {
namespace {

SeatSetup setup() {
  SeatSetup s;
  s.seat.name = "trainee";
  s.seat.role = Role::kTrainee;
  return s;
}

/// Three hands may hold the tool; `trainee` reads it.
struct Told {
  Told() : seat(setup()) {
    seat.masters = {"trainer", "trainee", "second"};
    seat.own_master = 1;
    s.session = wire::SessionState::kRunning;
    s.handover = wire::Handover::kComes;
    s.handover_s = 0.049;  // heard a tick after it was said
    words->seats = {{"trainer", AccessRole::kInstructor, true, true, true}, {"trainee", AccessRole::kTrainee, true, true, true}, {"second", AccessRole::kTrainee, true, true, true}};
    words->tools = {{"tool", {1, 0, 0}}};
  }
  std::string operator()(wire::HandoverParties parties, double own_before = 0) {
    s.handover_parties = parties;
    s.handover_from = own_before;
    return handover_text(s, seat, words);
  }
  SeatSetup seat;
  ClientStatus s;
  std::optional<control::Status> words{control::Status{}};
};

TEST(Handover, SaysWhoGivesToWhomHowMuchWhenItBeginsAndHowLongItTakes) {
  Told said;
  EXPECT_EQ(said({.by = wire::HandoverParties::kScene, .to = 2, .percent = 100}), "the scene gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 1.0 s");
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 1.0 s");
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 30}, 0.25), "trainer gives more of the tool to trainee (25 % to 30 %): begins in 50 ms, takes about 0.05 s");
  EXPECT_EQ(said({.by = wire::HandoverParties::kOperator, .to = 2, .percent = 100}), "an operator gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 1.0 s");
  EXPECT_EQ(said({.by = 1, .to = 0, .percent = 15}, 0.25), "trainer sets new parts of the tool (your part 25 % to 15 %): begins in 50 ms, takes up to 1.0 s");
  said.seat.alpha_slew = 0.25;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 4.0 s") << "the scene's slew";
  said.seat.alpha_slew = std::numeric_limits<double>::infinity();
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee (0 % to 100 %): in one step in 50 ms");
}

TEST(Handover, OfAnotherHandNamesItsPartBeforeOnlyWhereThatIsKnown) {
  Told said;
  said.s.handover = wire::Handover::kGoes;
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}, 0.75), "trainer takes the tool (25 % to 100 %): begins in 50 ms, takes about 0.8 s");
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 75}, 0.5), "trainer takes more of the tool (50 % to 75 %): begins in 50 ms, takes about 0.2 s");
  said.words->tools[0].alpha = {0.25, 0.5, 0.25};
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 75}, 0.5), "trainer takes more of the tool (to 75 %): begins in 50 ms, takes up to 0.8 s") << "a third hand has a part";
  said.words.reset();
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}, 0.5), "trainer takes the tool (to 100 %): begins in 50 ms, takes up to 1.0 s") << "the server is not heard";
  said.seat.masters.pop_back();
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}, 0.5), "trainer takes the tool (50 % to 100 %): begins in 50 ms, takes about 0.5 s") << "there is no third hand";
  said.s.session = wire::SessionState::kHeld;
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}, 0), "trainer takes the tool (to 100 %): begins in 50 ms, takes up to 1.0 s") << "nobody has a part now";
  said.seat.tools = {"left", "right"};
  EXPECT_EQ(said({.by = 24, .to = 16, .percent = 100, .tool = 1}), "an operator sets new parts of the tool right (your part to 100 %): begins in 50 ms, takes up to 1.0 s") << "numbers that name nobody";
}

TEST(Handover, IsUnderWayUntilTheWeightStandsStill) {
  Told said;
  said.s.handover_s = 0;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee (0 % to 100 %): under way, takes about 1.0 s");
  EXPECT_EQ(handover_brief(said.s), "more weight under way");
  said.s.handover_s = -0.7;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee (0 % to 100 %): under way, takes about 1.0 s");
  said.s.handover_done = true;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee (0 % to 100 %): done");
  EXPECT_EQ(handover_brief(said.s), "more weight: done");
  said.s.session = wire::SessionState::kStopped;
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee (to 100 %): when the session goes on");
  EXPECT_EQ(handover_brief(said.s), "more weight when the session goes on");
  said.s.handover = wire::Handover::kCalledOff;
  EXPECT_EQ(said({}), "hand-over called off: somebody it concerns is gone, or was not heard from in time");
  said.s.handover = wire::Handover::kNone;
  EXPECT_EQ(said({}), "");
}

/// A key that is held: `a` every 0.1 s, each step announced by the server.
TEST(Handover, StepsThatFollowEachOtherAreToldAsOneSumAndNoneIsLeftOut) {
  Told at;
  at.seat.own_master = 0;  // the trainer's own screen
  at.seat.seat.name = "trainer";
  at.s.handover = wire::Handover::kGoes;
  HandoverNotes notes;
  std::string told;
  double alpha = 1;
  for (int ms = 0; ms <= 4000; ms += 50) {
    const bool pressed = ms % 100 == 0 && ms < 1500;  // 15 steps
    if (pressed) {
      ++at.s.handovers;
      at.s.handover_from = alpha;
      alpha -= 0.05;
      at.s.handover_parties = {.by = 1, .to = 2, .percent = static_cast<std::uint32_t>(std::lround(100 * (1 - alpha)))};
    }
    at.s.handover_s = pressed ? 0.05 : 0;
    at.s.handover_done = ms > 1600;
    if (ms > 2600) at.s.handover = wire::Handover::kNone;
    if (const std::string line = notes.say(1e-3 * ms, at.s, at.seat, at.words); !line.empty()) told += line + "\n";
  }
  EXPECT_EQ(told,
            "trainer gives more of the tool to trainee (0 % to 5 %): begins in 50 ms, takes about 0.05 s\n"
            "trainer gives more of the tool to trainee (5 % to 55 %): begins in 50 ms, takes about 0.5 s\n"
            "trainer gives more of the tool to trainee (55 % to 75 %): done\n");
}

TEST(Handover, TheLastStepIsToldAlsoWhenItIsNotShownAnyMore) {
  Told at;
  HandoverNotes notes;
  at.s.handovers = 1;
  at.s.handover_parties = {.by = 1, .to = 2, .percent = 10};
  EXPECT_NE(notes.say(0, at.s, at.seat, at.words), "");
  at.s.handovers = 2;
  at.s.handover_from = 0.1;
  at.s.handover_parties.percent = 20;
  EXPECT_EQ(notes.say(0.1, at.s, at.seat, at.words), "");
  at.s.handover = wire::Handover::kNone;
  EXPECT_EQ(notes.say(5, at.s, at.seat, at.words), "trainer gives more of the tool to trainee (10 % to 20 %): done");
  EXPECT_EQ(notes.say(9, at.s, at.seat, at.words), "");
}

TEST(AuthoritySteps, AddUpToWhatWasAskedAsLongAsNobodyElseDecided) {
  ClientStatus s;
  s.alpha = 1;
  s.authority_version = 7;
  AuthoritySteps steps;
  EXPECT_EQ(steps.base(s), 1);
  for (const double own : {0.95, 0.9, 0.85}) {
    steps.ask(own, s);
    EXPECT_EQ(steps.base(s), own) << "what is felt is 1 as yet";
  }
  s.authority_version = 10;
  s.alpha = 0.97;
  EXPECT_EQ(steps.base(s), 0.85) << "all three were granted";
  s.authority_version = 11;
  s.alpha = 0.5;
  EXPECT_EQ(steps.base(s), 0.5) << "somebody else decided too";
  steps.ask(0.45, s);
  s.authority_version = 12;
  EXPECT_EQ(steps.base(s), 0.45);
  s.handover = wire::Handover::kCalledOff;
  EXPECT_EQ(steps.base(s), 0.5) << "the weights stay";
}

TEST(ClientStatus, SaysWhyHotMotorsGiveNoForceAndWhatToDo) {
  ClientStatus s;
  EXPECT_EQ(motors_text(s), "");
  s.motors_hot = true;
  EXPECT_EQ(motors_text(s), "MOTORS TOO HOT: let go until they are cool");
  EXPECT_NE(io::joined(seat_screen(s, setup(), std::nullopt)).find(motors_text(s)), std::string::npos);
  s.motors_latched = true;
  EXPECT_NE(motors_text(s).find("press b"), std::string::npos);
  s.motors_hot = false;
  EXPECT_EQ(motors_text(s), "motors were too hot three times: press b");
}

TEST(ClientReport, TellsOfHotMotorsAndOfNoneWhereNobodyKnows) {
  ClientReport r;
  auto motors = nlohmann::json::parse(to_json(r, setup()))["motors"];
  EXPECT_EQ(motors["too_hot"], 0);
  EXPECT_TRUE(motors["heat_max"].is_null());
  r.last.hot_trips = 2;
  r.last.heat_max = 1.25;
  motors = nlohmann::json::parse(to_json(r, setup()))["motors"];
  EXPECT_EQ(motors["too_hot"], 2);
  EXPECT_EQ(motors["heat_max"], 1.25);
}

TEST(ClientReport, TellsTheDistanceToTheLeadersHandOrThatNoneLeads) {
  ClientReport r;
  EXPECT_TRUE(nlohmann::json::parse(to_json(r, setup()))["beside_leader_m"].is_null());
  r.last.beside_leader_m = 0.0032;
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(to_json(r, setup()))["beside_leader_m"].get<double>(), 0.0032);
}

}  // namespace
}  // namespace tandem::client
