// Frames of a person who holds a seat in the browser, and the message about it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "server/console/browser_frame.h"
#include "server/console/live_json.h"
#include "server/console/seat_picture.h"

namespace tandem::console {
namespace {

auto parse(std::string_view text, AccessRole role = AccessRole::kObserver) {
  return parse_browser_frame(text, role, rpc::Id{});
}

TEST(SeatFrames, TakeLeavePointAndInvite) {
  const auto take = parse(R"({"type":"take","id":5,"seat":"trainee"})");
  ASSERT_TRUE(take);
  EXPECT_EQ(std::get<TakeSeat>(*take).seat, "trainee");
  EXPECT_EQ(std::get<TakeSeat>(*take).id, 5u);
  EXPECT_EQ(std::get<TakeSeat>(*take).ticket, "");
  EXPECT_EQ(std::get<TakeSeat>(*parse(R"({"type":"take","id":5,"seat":"a","ticket":"tandem-ticket:ABC"})")).ticket,
            "tandem-ticket:ABC");
  EXPECT_EQ(std::get<LeaveSeat>(*parse(R"({"type":"leave","id":6})")).id, 6u);
  EXPECT_EQ(std::get<Invite>(*parse(R"({"type":"invite","id":7})")).id, 7u);
  const auto pointer = parse(R"({"type":"pointer","x":[0.01,-0.02,10],"pressed":true})");
  ASSERT_TRUE(pointer);
  EXPECT_EQ(std::get<Pointer>(*pointer).x, (std::array<double, 3>{0.01, -0.02, 10}));
  EXPECT_TRUE(std::get<Pointer>(*pointer).pressed);
}

TEST(SeatFrames, RefuseWithTheKeyAndItsRange) {
  const auto refused = [](const std::string& frame, const std::string& key) {
    const auto got = parse(frame);
    return !got && !got.error().close && got.error().text.find("\"" + key + "\"") != std::string::npos;
  };
  for (const char* x :
       {"[0,0]", "[0,0,0,0]", "[0,0,10.1]", "[0,0,-1e308]", "[0,0,null]", "[0,0,\"1\"]", "{}", "1", "null"})
    EXPECT_TRUE(refused("{\"type\":\"pointer\",\"x\":" + std::string(x) + ",\"pressed\":true}", "x")) << x;
  EXPECT_TRUE(refused(R"({"type":"pointer","x":[0,0,0]})", "pressed"));
  EXPECT_TRUE(refused(R"({"type":"pointer","x":[0,0,0],"pressed":1})", "pressed"));
  EXPECT_TRUE(refused(R"({"type":"pointer","x":[0,0,0],"pressed":true,"force":[9,9,9]})", "force"));
  EXPECT_TRUE(refused(R"({"type":"take","id":1})", "seat"));
  EXPECT_TRUE(refused("{\"type\":\"take\",\"id\":1,\"seat\":\"" + std::string(300, 'a') + "\"}", "seat"));
  EXPECT_TRUE(
      refused("{\"type\":\"take\",\"id\":1,\"seat\":\"a\",\"ticket\":\"" + std::string(1025, 'a') + "\"}", "ticket"));
  EXPECT_TRUE(refused(R"({"type":"take","id":-1,"seat":"a"})", "id"));
  EXPECT_TRUE(refused(R"({"type":"leave"})", "id"));
  EXPECT_TRUE(refused(R"({"type":"invite","id":1,"role":"OPERATOR"})", "role"));
}

TEST(SeatPicture, GivesNullForWhatIsNotKnown) {
  SeatPicture picture;
  picture.seat = "trainee";
  auto json = nlohmann::json::parse(seat_json(picture));
  for (const char* key : {"x", "f", "target", "gate", "ended"}) EXPECT_TRUE(json[key].is_null()) << key;
  EXPECT_EQ(json["seat"], "trainee");
  EXPECT_FALSE(json["engaged"]);
  picture.joined = true;
  picture.gate = wire::GateState::kActive;
  picture.x = {0.1, 0, 0};
  picture.f = {1, std::numeric_limits<double>::quiet_NaN(), 0};  // a device's bad reading makes no bad JSON
  picture.ended = "left";
  json = nlohmann::json::parse(seat_json(picture));
  EXPECT_EQ(json["gate"], "ON");
  EXPECT_TRUE(json["engaged"]);
  EXPECT_EQ(json["x"][0], 0.1);
  EXPECT_TRUE(json["f"].is_null());
  EXPECT_EQ(json["ended"], "left");
}

TEST(Hello, NamesTheOffersOfTheGateway) {
  auto hello = [](const PageOffers& offers) {
    return nlohmann::json::parse(hello_json("p", AccessRole::kEvaluator, "1", {}, offers));
  };
  const auto may = [&](const PageOffers& offers, const char* word) {
    const auto words = hello(offers)["may"];
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  EXPECT_FALSE(may({}, "seat") || may({}, "invite"));
  EXPECT_TRUE(may({.seats = true}, "seat") && may({.invite = true}, "invite"));
  EXPECT_FALSE(may({.seats = true, .invite = true}, "stop")) << "offers give no right of a role";
  EXPECT_TRUE(hello({})["play"].is_null());
  EXPECT_EQ(hello({.play = "trainer"})["play"], "trainer");
}

}  // namespace
}  // namespace tandem::console
