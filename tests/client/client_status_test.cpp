// What a person reads of his seat while something happens to his hand.
#include "client/app/client_status.h"

#include "client/app/seat_screen.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace tandem::client {
namespace {

SeatSetup setup() {
  SeatSetup s;
  s.seat.name = "trainee";
  s.seat.role = Role::kTrainee;
  return s;
}

TEST(ClientStatus, SaysWhoGivesTheToolToWhomAndWhen) {
  SeatSetup seat = setup();
  seat.masters = {"trainer", "trainee", "second"};
  seat.own_master = 1;
  ClientStatus s;
  s.alpha = 0.25;
  EXPECT_EQ(handover_text(s, seat), "");
  s.handover = wire::Handover::kComes;
  s.handover_s = 0.049;  // heard a tick after it was said
  const auto said = [&](wire::HandoverParties parties) {
    s.handover_parties = parties;
    return handover_text(s, seat);
  };
  EXPECT_EQ(said({.by = wire::HandoverParties::kScene, .to = 2, .percent = 100}), "the scene gives the tool to trainee in 50 ms");
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100}), "trainer gives the tool to trainee in 50 ms");
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 30}), "trainer gives 30 % of the tool to trainee in 50 ms");
  EXPECT_EQ(said({.by = wire::HandoverParties::kOperator, .to = 2, .percent = 100}), "an operator gives the tool to trainee in 50 ms");
  EXPECT_EQ(said({.by = 1, .to = 0, .percent = 15}), "trainer shares the tool anew in 50 ms: your part becomes 15 %");
  s.handover = wire::Handover::kGoes;
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 100}), "trainer takes the tool in 50 ms");
  EXPECT_EQ(said({.by = 1, .to = 1, .percent = 75}), "trainer takes more of the tool in 50 ms: 75 %");
  EXPECT_EQ(said({.by = 24, .to = 16, .percent = 100}), "an operator shares the tool anew in 50 ms: your part becomes 100 %") << "numbers that name nobody";
  seat.tools = {"left", "right"};
  EXPECT_EQ(said({.by = 1, .to = 2, .percent = 100, .tool = 1}), "trainer gives the tool right to trainee in 50 ms");
  s.handover = wire::Handover::kCalledOff;
  EXPECT_EQ(said({}), "hand-over called off: a link is too old");
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

}  // namespace
}  // namespace tandem::client
