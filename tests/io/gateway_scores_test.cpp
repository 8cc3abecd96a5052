// Scores of a running session at tandem-console: their content and their receivers. Real programs.
#include <gtest/gtest.h>

#include "tests/io/multi_client_fixture.h"
#include "tests/io/web_fixture.h"

namespace tandem::test {
namespace {

TEST(GatewayScores, GoToRolesThatScoreOnly) {
  MultiClientFixture fixture{"session { name: \"a\" scene: \"one_axis\" }"};
  WebGateway gateway(fixture.address, {"--sign-in", "--state", fixture.own});
  const auto page_of = [&](const std::string& role) {
    Process made =
        server({"ticket", "--session", "a", "--role", role, "--workstation", "desk", "--state", fixture.state});
    EXPECT_EQ(made.wait(), 0) << made.err();
    const std::string body = Json{{"ticket", first_line(made.out())}}.dump();
    const HttpReply reply = http_post(gateway.at, "/join", "application/json", body, gateway.at.origin());
    EXPECT_EQ(reply.status, 200U) << reply.body;
    return std::make_unique<WebPage>(gateway.at, cookie_of(reply));
  };
  const auto instructor = page_of("instructor"), trainee = page_of("trainee"), observer = page_of("observer");
  const Process seat({TANDEM_CLIENT, "join", "--server", fixture.address, "--state", fixture.own, "--device", "sim",
                      "--seat", "trainer", "--ticket", fixture.ticket("a", "trainer")});
  const Json scores = instructor->next("scores");
  ASSERT_FALSE(scores.is_null());
  ASSERT_FALSE(scores["seats"].empty()) << scores;
  EXPECT_NEAR(scores["rate_hz"].get<double>(), 1000.0 / 17, 1e-9);
  EXPECT_GT(scores["to_s"].get<double>(), 3);
  const Json& metrics = scores["metrics"];
  const Json& cells = scores["seats"][0]["parts"][0]["cells"];
  ASSERT_EQ(cells.size(), metrics.size());
  for (std::size_t m = 0; m < cells.size(); ++m) {
    const std::string key = metrics[m]["key"];
    if (key == "ldlj") {
      EXPECT_TRUE(cells[m]["text"].is_null()) << "it needs every tick";
      EXPECT_NE(cells[m]["trust"], "good");
    } else if (key == "force_peak") {
      EXPECT_NE(cells[m]["trust"], "good");
    }
  }
  // Messages are in order: before this reply the others got all messages of the time in which the instructor got
  // scores.
  for (const auto* page : {&trainee, &observer}) {
    (*page)->send({{"type", "leave"}, {"id", 9}});
    const Json reply = (*page)->until([](const Json& message) {
      EXPECT_NE(message["type"], "scores");
      return message["type"] == "reply";
    });
    EXPECT_EQ(reply["id"], 9);
  }
}

}  // namespace
}  // namespace tandem::test
