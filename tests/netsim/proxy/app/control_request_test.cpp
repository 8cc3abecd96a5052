#include "netsim/proxy/app/control_request.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/base/rng.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;
using What = ControlRequest::Kind;

TEST(ControlRequests, ParseTypedInput) {
  const auto one = parse_control_request("  delay 20 loss 2.5\tclient 2 7 up \n");
  ASSERT_TRUE(one);
  EXPECT_EQ(one->kind, What::kChange);
  EXPECT_EQ(one->numbers.delay_ms, 20);
  EXPECT_EQ(one->numbers.loss_percent, 2.5);
  EXPECT_FALSE(one->numbers.jitter_ms);
  EXPECT_EQ(one->clients, (std::vector<std::uint64_t>{2, 7}));
  EXPECT_EQ(one->direction, Direction::kUp);

  EXPECT_EQ(parse_control_request("profile wifi-busy")->network, "wifi-busy");
  EXPECT_EQ(parse_control_request("network ./mine.textproto")->network, "./mine.textproto");
  EXPECT_EQ(parse_control_request("outage 400ms")->outage, 400ms);
  EXPECT_EQ(parse_control_request("outage 0.4s")->outage_mode, OutageSpec::Mode::kDrop);
  EXPECT_EQ(parse_control_request("outage 2min hold")->outage_mode, OutageSpec::Mode::kHold);
  EXPECT_EQ(parse_control_request("outage 1s last down")->outage_mode, OutageSpec::Mode::kHoldLast);
  EXPECT_EQ(parse_control_request("outage 1s last down")->direction, Direction::kDown);
  EXPECT_EQ(parse_control_request("rebind")->dead_after, 0ms);
  EXPECT_EQ(parse_control_request("rebind 50ms client 3")->dead_after, 50ms);
  EXPECT_EQ(parse_control_request("rebind client 3")->clients, std::vector<std::uint64_t>{3});
  EXPECT_EQ(parse_control_request("reset client 1")->kind, What::kReset);
  EXPECT_TRUE(parse_control_request("status --json")->json);
  EXPECT_EQ(parse_control_request("stop")->kind, What::kStop);
  EXPECT_EQ(parse_control_request("help")->kind, What::kHelp);
}

TEST(ControlRequests, NameTheWrongWordAndTheAllowedOnes) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "the command is empty"},
      {"   \n", "the command is empty"},
      {"fly", "\"fly\" is not a command"},
      {"delay", "a number in [0, 60000] ms"},
      {"delay 20kg", "delay \"20kg\""},
      {"delay 20%", "delay \"20%\""},
      {"delay -1", "delay \"-1\""},
      {"jitter nan", "jitter \"nan\""},
      {"loss 101", "[0, 100] %"},
      {"duplicate 1e999", "duplicate \"1e999\""},
      {"outage", "400ms"},
      {"outage 0ms", "above 0 and at most 1 h"},
      {"outage 400", "outage \"400\""},
      {"outage 61min", "at most 1 h"},
      {"outage 1s sideways", "\"sideways\" is not understood after \"1s\""},
      {"client 0 delay 1", "numbered from 1"},
      {"delay 1 client", "needs a number"},
      {"rebind 2s up", "\"up\" is not understood"},
      {"rebind 90min", "[0, 1 h]"},
      {"status now", "\"now\" is not understood after \"status\""},
      {"profile", "needs a name or a file"},
      {"stop delay 1", "\"delay\" is not understood"},
      {std::string(5000, 'x'), "at most 4096"},
  };
  for (const auto& [line, says] : cases) {
    const auto request = parse_control_request(line);
    ASSERT_FALSE(request) << line;
    EXPECT_NE(request.error().find(says), std::string::npos) << line << ": " << request.error();
  }
}

TEST(ControlRequests, ParseOrRejectAnyBytes) {
  RandomStream random{3};
  const std::string letters = " delayoutgcipsrwn0123456789.-\t\xff\n";
  for (int i = 0; i < 20'000; ++i) {
    std::string line;
    for (std::uint64_t n = random.below(40); n > 0; --n) line += letters[random.below(letters.size())];
    const auto request = parse_control_request(line);
    if (request && request->numbers.delay_ms) {
      EXPECT_LE(*request->numbers.delay_ms, 60'000);
    }
  }
}

TEST(ControlRequests, RequireAUnitForLengths) {
  EXPECT_EQ(parse_length("1.5us"), 1500ns);
  EXPECT_EQ(parse_length("0s"), 0s);
  EXPECT_EQ(parse_length("3min"), 180s);
  for (const char* wrong : {"", "5", "ms", "-1s", "1e30s", "nans", "1 s", "0x1s"})
    EXPECT_FALSE(parse_length(wrong)) << wrong;
}

TEST(ControlRequests, NameEveryCommandInTheHelp) {
  const std::string help = control_help();
  for (const char* word : {"profile", "delay", "jitter", "loss", "duplicate", "reorder", "outage", "reset", "rebind",
                           "client", "up", "down", "status", "stop"}) {
    EXPECT_NE(help.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace tandem::netsim
