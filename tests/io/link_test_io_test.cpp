// `tandem-client link-test` against a real server, directly and through the proxy. The proxy's settings determine loss
// and delay. The program prints the timing of this machine, and no test asserts it.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/io/programs.h"

namespace tandem::test {
namespace {

Process link_test(const std::string& address, Words arguments) {
  Words command{TANDEM_CLIENT, "link-test", "--server", address};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return Process(std::move(command));
}

Process proxy_to(const std::string& address, Words arguments) {
  Words command{TANDEM_NETSIM, "proxy", "--to", address};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Process proxy{std::move(command)};
  proxy.wait_for("listening on ");
  return proxy;
}

Json findings(Process& process) {
  EXPECT_TRUE(process.wait().has_value());
  const Json j = Json::parse(process.out(), nullptr, false);
  EXPECT_FALSE(j.is_discarded()) << process.out() << process.err();
  return j;
}

TEST(LinkTestLive, FindsNothingWrongWithLoopback) {
  const Process host = hosting("one_axis");
  Process test = link_test(address_of(host), {"--duration", "2", "--json", "-"});
  const Json j = findings(test);
  EXPECT_TRUE(j["complete"]);
  EXPECT_EQ(j["up"]["lost"], 0);
  EXPECT_EQ(j["down"]["lost"], 0);
  EXPECT_EQ(j["duplicates"], 0);
  EXPECT_EQ(j["refused"], 0);
  EXPECT_GT(j["up"]["sent"].get<int>(), 1000);
  EXPECT_GT(j["rtt_p50_ms"].get<double>(), 0);
}

TEST(LinkTestLive, MeasuresTheDelayAndLossOfTheProxy) {
  const Process host = hosting("one_axis");
  const Process proxy = proxy_to(address_of(host), {"--delay", "15", "--loss", "5"});
  Process test = link_test(address_of(proxy), {"--duration", "4", "--json", "-"});
  const Json j = findings(test);
  EXPECT_GE(j["rtt_min_ms"].get<double>(), 29.9);
  // 4000 datagrams, each lost with 5 %: 200 +- 14; the tolerance is six times that.
  EXPECT_NEAR(j["up"]["loss_percent"].get<double>(), 5, 2.1);
  EXPECT_NEAR(j["down"]["loss_percent"].get<double>(), 5, 2.1);
  EXPECT_NE(j["verdict"], "GOOD");
  EXPECT_NE(j["advice"].dump().find("lost on the way up"), std::string::npos);
}

TEST(LinkTestLive, FindsReorderingAndOutages) {
  const Process host = hosting("one_axis");
  const Process proxy =
      proxy_to(address_of(host), {"--delay", "2", "--reorder", "5", "--duplicate", "2", "--outage", "1.5,0.3"});
  Process test = link_test(address_of(proxy), {"--duration", "4"});
  EXPECT_TRUE(test.wait().has_value());
  EXPECT_NE(test.out().find("silences beyond 20 ms"), std::string::npos) << test.out();
  EXPECT_EQ(test.out().find("reordered 0"), std::string::npos) << test.out();
  EXPECT_EQ(test.out().find(" 0 duplicates"), std::string::npos) << test.out();
  EXPECT_NE(test.out().find("after which a hand is released"), std::string::npos) << test.out();
}

TEST(LinkTestLive, RunsBesideASessionWithoutDisturbingIt) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "4", "--json", folder.file("s.json")});
  Process trainer = client(address_of(host), "trainer");
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  Process test = link_test(address_of(host), {"--duration", "2", "--json", "-"});
  EXPECT_TRUE(findings(test)["complete"]);
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(folder.json("s.json")["verdict"], "pass");
}

TEST(LinkTestLive, ReportsItsResultsSoFarOnCtrlC) {
  const Process host = hosting("one_axis");
  Process test = link_test(address_of(host), {"--duration", "60"});
  // Without a terminal a status line is printed every 5 s.
  ASSERT_TRUE(test.wait_for("link test: ")) << test.err();
  test.signal(SIGINT);
  EXPECT_EQ(test.wait(), 0);
  EXPECT_NE(test.err().find("ended by Ctrl-C"), std::string::npos) << test.err();
  EXPECT_NE(test.out().find("round trip"), std::string::npos) << test.out();
}

TEST(LinkTestLive, ReportsThatSigtermEndedIt) {
  const Process host = hosting("one_axis");
  Process test = link_test(address_of(host), {"--duration", "60", "--json", "-"});
  ASSERT_TRUE(test.wait_for("link test: ")) << test.err();
  test.signal(SIGTERM);
  const Json j = findings(test);
  EXPECT_NE(test.err().find("ended by SIGTERM"), std::string::npos) << test.err();
  EXPECT_EQ(test.err().find("Ctrl-C"), std::string::npos) << test.err();
  EXPECT_EQ(j["complete"], false);
  EXPECT_EQ(j["ended_by"], "interrupted");
}

TEST(LinkTestLive, IsNotCompleteWhenTheServerIsKilledInTheMiddle) {
  Process host = hosting("one_axis");
  Process test = link_test(address_of(host), {"--duration", "60", "--json", "-"});
  ASSERT_TRUE(test.wait_for("link test: ")) << test.err();
  host.signal(SIGKILL);
  const Json j = findings(test);
  EXPECT_EQ(j["complete"], false);
  EXPECT_EQ(j["ended_by"], "server_lost");
  EXPECT_EQ(j["verdict"], "BAD");
  EXPECT_LT(j["duration_s"].get<double>(), 55) << "there was nothing more to learn";
  EXPECT_NE(test.err().find("the server was lost"), std::string::npos) << test.err();
}

TEST(LinkTestLive, RatesAnOutageOf400MillisecondsAsBad) {
  const Process host = hosting("one_axis");
  const Process proxy = proxy_to(address_of(host), {"--delay", "2", "--outage", "1.5,0.4"});
  Process test = link_test(address_of(proxy), {"--duration", "4", "--json", "-"});
  const Json j = findings(test);
  EXPECT_EQ(j["verdict"], "BAD") << j.dump(1);
  EXPECT_EQ(j["complete"], true);
  EXPECT_GE(j["down"]["longest_gap_ms"].get<double>(), 380);
}

TEST(LinkTestLive, SaysWhenTheServerEnds) {
  Process host = hosting("one_axis");
  Process test = link_test(address_of(host), {"--duration", "60"});
  ASSERT_TRUE(test.wait_for("link test: ")) << test.err();
  host.signal(SIGINT);
  EXPECT_EQ(test.wait(), 1);
  EXPECT_NE(test.err().find("the server ended"), std::string::npos) << test.err();
}

TEST(LinkTestLive, ReportsThatNoServerListens) {
  Process test = link_test("127.0.0.1:9", {"--timeout", "0.3"});
  EXPECT_EQ(test.wait(), 1);
  EXPECT_NE(test.err().find("no server at 127.0.0.1:9"), std::string::npos) << test.err();
}

TEST(LinkTestLive, ReportsAllErrorsAtOnce) {
  Process test = link_test("192.0.2.1", {"--duration", "nan", "--timeout", "-1", "--json", "/no/such/folder/x.json"});
  EXPECT_EQ(test.wait(), 2);
  for (const char* word : {"--server: ", "--duration", "--timeout", "--json", "4 mistakes"})
    EXPECT_NE(test.err().find(word), std::string::npos) << word << "\n" << test.err();
}

}  // namespace
}  // namespace tandem::test
