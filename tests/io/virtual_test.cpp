// Programs that work in virtual time, as a person or a CI job starts them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "tests/io/programs.h"

namespace tandem {
namespace {

using test::Folder;
using test::Json;
using test::Process;

Process netsim(test::Words arguments) {
  arguments.insert(arguments.begin(), TANDEM_NETSIM);
  return Process(std::move(arguments));
}

TEST(NetsimRun, RepeatsReportAndTraceToTheByte) {
  const Folder folder;
  std::vector<Json> reports;
  for (const char* name : {"a", "b"}) {
    auto run = netsim({"run", "contact", "--delay", "20", "--jitter", "5", "--loss", "5", "--seed", "3", "--duration", "6", "--json",
                       folder.file(std::string(name) + ".json"), "--trace", folder.file(std::string(name) + ".csv")});
    ASSERT_EQ(run.wait(), 0) << run.err();
    reports.push_back(folder.json(std::string(name) + ".json"));
    reports.back().erase("cpu_s");
  }
  EXPECT_EQ(reports[0], reports[1]);
  EXPECT_EQ(folder.read("a.csv"), folder.read("b.csv"));
  EXPECT_EQ(reports[0]["trace_hash"].get<std::string>().size(), 64u);
  EXPECT_EQ(folder.read("a.csv").substr(0, 15), "tick[1],t_s[s],");
}

TEST(NetsimRun, HashesTheTraceAlsoWhenNoneIsWritten) {
  const Folder folder;
  auto with = netsim({"run", "one_axis", "--json", folder.file("w.json"), "--trace", folder.file("w.csv")});
  ASSERT_EQ(with.wait(), 0);
  auto without = netsim({"run", "one_axis", "--quiet", "--json", "-"});
  ASSERT_EQ(without.wait(), 0);
  const Json report = Json::parse(without.out(), nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << "--json - shares standard output with something else";
  EXPECT_EQ(report["trace_hash"], folder.json("w.json")["trace_hash"]);
  auto sum = Process({"/usr/bin/sha256sum", folder.file("w.csv")});
  ASSERT_EQ(sum.wait(), 0);
  EXPECT_EQ(sum.out().substr(0, 64), report["trace_hash"].get<std::string>());
}

TEST(NetsimRun, SaysWhatIsWrongAndStartsNothing) {
  const Folder folder;
  const std::string bad = folder.write("bad.textproto", "version: 1\nchannle { }\nseat { name: \"a\" device { mass_kg: nan } }\n");
  for (const auto& [arguments, part] : std::vector<std::pair<test::Words, std::string>>{
           {{"run", "no_such_scene"}, "free_motion"},
           {{"run", bad}, "bad.textproto:2"},
           {{"run", bad}, "bad.textproto:3"},
           {{"run", "free_motion", "--delay", "-5"}, "60000"},
           {{"run", "free_motion", "--loss", "101"}, "100"},
           {{"run", "free_motion", "--hand", "nobody=x.csv"}, "trainee"},
           {{"run", "free_motion", "--hand", "trainer=/no/such.csv"}, "such.csv"},
           {{"run", "free_motion", "--channel", "magic"}, "set_position"},
           {{"run", "free_motion", "--json", "/no/such/folder/x.json"}, "cannot be written"}}) {
    auto run = netsim(arguments);
    EXPECT_EQ(run.wait(), 2) << part;
    EXPECT_NE((run.err() + run.out()).find(part), std::string::npos) << "not in: " << run.err() << run.out();
  }
}

TEST(NetsimRun, ChecksASceneWithoutRunningIt) {
  auto run = netsim({"run", "free_motion", "--check"});
  EXPECT_EQ(run.wait(), 0);
  EXPECT_NE(run.out().find("channel.k_n_m"), std::string::npos);
}

TEST(NetsimRun, ToldRoundTripsAreOfTheWholeSession) {
  // 8.5 of 12 s over 100 ms, the rest over nearly nothing: the p99 of the session is 100 ms, whatever the last second was.
  const Folder folder;
  const std::string script = folder.write("s.textproto", "event { at_s: 9 profile: \"lan\" }\n");
  auto run = netsim({"run", "free_motion", "--delay", "50", "--script", script, "--duration", "12", "--quiet", "--json", "-"});
  ASSERT_EQ(run.wait(), 0) << run.err();
  const Json report = Json::parse(run.out(), nullptr, false);
  const Json& link = report["seats"][0]["link"];
  EXPECT_NEAR(link["rtt_p99_ms"].get<double>(), 100, 3);
  EXPECT_GE(link["rtt_p99_ms"].get<double>(), link["rtt_p50_ms"].get<double>());
}

TEST(NetsimRun, SaysWhichEventsTheSessionNeverMet) {
  const Folder folder;
  const std::string script = folder.write("s.textproto", "event { at_s: 0 outage_ms: 1 }\nevent { at_s: 90 outage_ms: 5 }\nevent { at_s: 1 outage_ms: 5 }\n");
  auto run = netsim({"run", "free_motion", "--script", script, "--duration", "2"});
  ASSERT_EQ(run.wait(), 0) << run.err();
  EXPECT_NE(run.err().find("the outage at 0 s was over before the session began"), std::string::npos) << run.err();
  EXPECT_NE(run.err().find("the outage at 90 s came after the end"), std::string::npos) << run.err();
  EXPECT_EQ(run.err().find("the outage at 1 s"), std::string::npos) << run.err();
}

TEST(NetsimRun, InterruptedIsNoPass) {
  const Folder folder;
  auto run = netsim({"run", "one_axis", "--duration", "300000", "--trace", folder.file("t.csv")});
  for (int tries = 0; tries < 3000 && folder.read("t.csv").empty(); ++tries) usleep(10'000);
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 1) << run.err();
  EXPECT_NE(run.err().find("interrupted"), std::string::npos);
}

TEST(Demo, ComparesAndWritesAReportInVirtualTime) {
  const Folder folder;
  Process demo({TANDEM_DEMO, "--quick", "--runs", "contact", "--out", folder.file("out")});
  ASSERT_EQ(demo.wait(), 0) << demo.err();
  EXPECT_NE(demo.out().find("rendered stiffness"), std::string::npos);
  EXPECT_NE(demo.out().find("file://"), std::string::npos);
  const std::string page = folder.read("out/report.html");
  EXPECT_GT(std::count(page.begin(), page.end(), '<'), 500);
  for (const char* part : {"<svg", "Figure 10", "Figure 11", "Figure 12", "</html>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("http://") == std::string::npos || page.find("src=\"http") == std::string::npos, true) << "not self-contained";
}

}  // namespace
}  // namespace tandem
