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

TEST(ClientStatus, TellsWhenWeightComesAndGoes) {
  ClientStatus s;
  EXPECT_EQ(handover_text(s), "");
  s.handover = wire::Handover::kComes;
  s.handover_s = 0.05;
  EXPECT_EQ(handover_text(s), "more weight in 50 ms");
  s.handover = wire::Handover::kGoes;
  EXPECT_EQ(handover_text(s), "less weight in 50 ms");
  s.handover = wire::Handover::kCalledOff;
  EXPECT_EQ(handover_text(s), "hand-over called off: a link is too old");
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
