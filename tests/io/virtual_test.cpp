// Programs that work in virtual time, as a user or a CI job starts them.
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
    auto run = netsim({"run", "contact", "--delay", "20", "--jitter", "5", "--loss", "5", "--seed", "3", "--duration",
                       "6", "--json", folder.file(std::string(name) + ".json"), "--trace",
                       folder.file(std::string(name) + ".csv")});
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

TEST(NetsimRun, ReportsErrorsAndStartsNothing) {
  const Folder folder;
  const std::string bad =
      folder.write("bad.textproto", "version: 1\nchannle { }\nseat { name: \"a\" device { mass_kg: nan } }\n");
  for (const auto& [arguments, part] : std::vector<std::pair<test::Words, std::string>>{
           {{"run", "no_such_scene"}, "free_motion"},
           {{"run", bad}, "bad.textproto:2"},
           {{"run", bad}, "bad.textproto:3"},
           {{"run", "free_motion", "--delay", "-5"}, "60000"},
           {{"run", "free_motion", "--loss", "101"}, "100"},
           {{"run", "free_motion", "--hand", "absent=x.csv"}, "trainee"},
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
  const Folder folder;
  const std::string script = folder.write("s.textproto", "event { at_s: 2 client: \"trainee\" outage_ms: 400 }\n");
  auto with =
      netsim({"run", "free_motion", "--delay", "20", "--loss", "3", "--seed", "9", "--script", script, "--check"});
  EXPECT_EQ(with.wait(), 0);
  for (const char* part : {"network: delay 20 ms, loss 3 %, seed 9", "each direction: loss 3 %; delay 20 ms",
                           "network at 2.000 s: outage of 400 ms, for trainee"})
    EXPECT_NE(with.out().find(part), std::string::npos) << part << " not in\n" << with.out();
}

TEST(NetsimRun, ReportsRoundTripsOfTheWholeSession) {
  // 100 ms for 8.5 of 12 s, nearly 0 for the rest: the session's p99 is 100 ms, independent of the last second.
  const Folder folder;
  const std::string script = folder.write("s.textproto", "event { at_s: 9 profile: \"lan\" }\n");
  auto run =
      netsim({"run", "free_motion", "--delay", "50", "--script", script, "--duration", "12", "--quiet", "--json", "-"});
  ASSERT_EQ(run.wait(), 0) << run.err();
  const Json report = Json::parse(run.out(), nullptr, false);
  const Json& link = report["seats"][0]["link"];
  EXPECT_NEAR(link["rtt_p99_ms"].get<double>(), 100, 3);
  EXPECT_GE(link["rtt_p99_ms"].get<double>(), link["rtt_p50_ms"].get<double>());
}

TEST(NetsimRun, ReportsEventsThatTheSessionDidNotReach) {
  const Folder folder;
  const std::string script =
      folder.write("s.textproto",
                   "event { at_s: 0 outage_ms: 1 }\nevent { at_s: 90 outage_ms: 5 }\nevent { at_s: 1 outage_ms: 5 }\n");
  auto run = netsim({"run", "free_motion", "--script", script, "--duration", "2"});
  ASSERT_EQ(run.wait(), 0) << run.err();
  EXPECT_NE(run.out().find("note: the outage at 0 s was over before the session began"), std::string::npos)
      << run.out();
  EXPECT_NE(run.out().find("note: the outage at 90 s came after the end"), std::string::npos) << run.out();
  EXPECT_EQ(run.out().find("the outage at 1 s"), std::string::npos) << run.out();
}

TEST(NetsimRun, WritesTheSameNotesToJsonAndText) {
  const Folder folder;
  const std::string script = folder.write("s.textproto", "event { at_s: 90 outage_ms: 5 }\n");
  const std::string recording = folder.write("r.csv", "t_s[s],rtt_ms[ms]\n0,10\n0.5,12\n1,10\n");
  auto run = netsim({"run", "one_axis", "--network", recording, "--script", script, "--duration", "2", "--json",
                     folder.file("r.json")});
  ASSERT_EQ(run.wait(), 0) << run.err();
  const Json notes = folder.json("r.json")["notes"];
  ASSERT_EQ(notes.size(), 2u) << notes;
  for (const Json& note : notes)
    EXPECT_NE(run.out().find("note: " + note.get<std::string>()), std::string::npos) << note << run.out();
  EXPECT_EQ(folder.json("r.json")["interrupted"], false);
}

TEST(NetsimRun, ReportsWhySeatAndNetworkDifferAfterANewAddress) {
  const Folder folder;
  const std::string script =
      folder.write("s.textproto", "event { at_s: 3 client: \"trainee\" rebind { dead_after_ms: 100 } }\n");
  auto run = netsim({"run", "free_motion", "--script", script, "--duration", "5"});
  ASSERT_EQ(run.wait(), 0) << run.err();
  EXPECT_NE(run.out().find("network: green"), std::string::npos) << "the network carried on: " << run.out();
  EXPECT_NE(run.out().find(
                "note: trainee has a new address from 3 s on: the server validates it before it sends forces there"),
            std::string::npos)
      << run.out();
  EXPECT_NE(run.out().find("lost from 3.1 s on"), std::string::npos) << run.out();
}

TEST(NetsimRun, CountsEveryErrorAndRejectsASeedWithAReplay) {
  const Folder folder;
  const std::string script = folder.write(
      "s.textproto", "event { at_s: 1 client: \"traine\" outage_ms: 0 }\nevent { at_s: -1 profile: \"nix\" }\n");
  auto run = netsim({"run", "free_motion", "--script", script, "--hand", "absent=x.csv"});
  EXPECT_EQ(run.wait(), 2);
  EXPECT_NE(run.err().find("5 mistakes; nothing was started"), std::string::npos) << run.err();
  auto logged = netsim({"run", "one_axis", "--duration", "1", "--seed", "4", "--log", folder.file("l.csv")});
  ASSERT_EQ(logged.wait(), 0) << logged.err();
  auto again =
      netsim({"run", "one_axis", "--duration", "1", "--seed", "4", "--loss", "1", "--replay", folder.file("l.csv")});
  EXPECT_EQ(again.wait(), 2);
  for (const char* part : {"--replay excludes --seed", "--replay excludes --loss", "2 mistakes"})
    EXPECT_NE(again.err().find(part), std::string::npos) << part << " not in\n" << again.err();
}

TEST(NetsimRun, DoesNotPassWhenInterrupted) {
  const Folder folder;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    auto run = netsim(
        {"run", "one_axis", "--duration", "300000", "--trace", folder.file("t.csv"), "--json", folder.file("r.json")});
    for (int tries = 0; tries < 3000 && folder.read("t.csv").empty(); ++tries) usleep(10'000);
    run.signal(signal);
    EXPECT_EQ(run.wait(), 1) << run.err();
    EXPECT_NE(run.err().find("tandem-netsim run: interrupted after "), std::string::npos) << run.err();
    EXPECT_NE(run.err().find("The results so far are reported and do not count as a pass"), std::string::npos)
        << run.err();
    EXPECT_NE(run.out().find("one_axis: interrupted, "), std::string::npos) << run.out();
    EXPECT_EQ(folder.json("r.json")["verdict"], "fail");
    EXPECT_EQ(folder.json("r.json")["interrupted"], true);
    std::filesystem::remove(folder.file("t.csv"));
  }
}

TEST(NetsimInterrupt, HasOneWordingAndOneExitCodeForAllCommands) {
  const Folder folder;
  struct Case {
    test::Words arguments;
    std::string ready, reports;  ///< its output once it works; its report of the completed work
  };
  const std::vector<Case> cases{
      {{"swarm", "--seeds", "100000"}, " sessions, ", "sessions passed"},
      {{"profiles", "5g", "--minutes", "1440", "--ascii"}, "source:", "one-way delay over"},
      {{"sweep", "one_axis", "--duration", "300000", "--delay", "0,10", "--json", folder.file("sweep.json")},
       "",
       "delay [ms]  loss"},
      {{"test", "free-motion-lan", "--seeds", "100000", "--json", folder.file("test.json")}, "", "not run:"}};
  for (const Case& one : cases) {
    auto process = netsim(one.arguments);
    const std::string file = folder.file(one.arguments[0] + ".json");
    ASSERT_TRUE(one.ready.empty() || process.wait_for(one.ready)) << process.err();
    for (int tries = 0; one.ready.empty() && tries < 3000 && !std::filesystem::exists(file); ++tries) usleep(10'000);
    process.signal(SIGINT);
    EXPECT_EQ(process.wait(), 1) << one.arguments[0] << process.err();
    EXPECT_NE(process.err().find("tandem-netsim " + one.arguments[0] + ": interrupted after "), std::string::npos)
        << process.err();
    EXPECT_NE(process.err().find("The results so far are reported and do not count as a pass"), std::string::npos)
        << process.err();
    EXPECT_NE(process.out().find(one.reports), std::string::npos) << one.reports << " not in\n" << process.out();
  }
}

TEST(NetsimSwarm, ReportsNetworkAndClocksOfASingleSession) {
  const Folder folder;
  auto one = netsim({"swarm", "--first", "17", "--seeds", "1", "--json", folder.file("s.json")});
  ASSERT_EQ(one.wait(), 0) << one.err();
  EXPECT_NE(one.out().find("  network of seat"), std::string::npos) << one.out();
  EXPECT_NE(one.out().find("round trip: "), std::string::npos) << one.out();
  auto listing = netsim({"swarm", "--first", "17", "--scene"});
  ASSERT_EQ(listing.wait(), 0);
  std::size_t seats = 0;
  for (std::size_t at = 0; (at = listing.out().find("\nseat {", at)) != std::string::npos; ++at) ++seats;
  EXPECT_GE(seats, 2u) << listing.out();
  EXPECT_EQ(folder.json("s.json")["seeds"][0]["quality"].size(), seats);
  bool clocks = false;
  for (int seed = 1; seed <= 20; ++seed) {
    auto scene = netsim({"swarm", "--first", std::to_string(seed), "--scene"});
    ASSERT_EQ(scene.wait(), 0);
    EXPECT_NE(scene.out().find("# network of every seat\n#   "), std::string::npos) << scene.out();
    EXPECT_NE(scene.out().find("delay "), std::string::npos);
    clocks = clocks || scene.out().find(" ppm, wakes ") != std::string::npos;
  }
  EXPECT_TRUE(clocks) << "none of 20 sessions printed its clocks";
}

TEST(Demo, ComparesAndWritesAReportInVirtualTime) {
  const Folder folder;
  Process demo({TANDEM_DEMO, "--quick", "--runs", "contact_bad", "--out", folder.file("out")});
  ASSERT_EQ(demo.wait(), 0) << demo.err();
  EXPECT_NE(demo.out().find("rendered stiffness"), std::string::npos);
  EXPECT_NE(demo.out().find("file://"), std::string::npos);
  const std::string page = folder.read("out/report.html");
  EXPECT_GT(std::count(page.begin(), page.end(), '<'), 500);
  for (const char* part :
       {"<svg", "Figure 10", "Figure 11", "Figure 12", "bad network, to the server: delay", "</html>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("http://") == std::string::npos || page.find("src=\"http") == std::string::npos, true)
      << "not self-contained";

  // The printed command, unchanged, gives the same trace.
  const std::size_t begin = page.find("<pre>") + 5;
  const std::string command = page.substr(begin, page.find("</pre>", begin) - begin);
  Process again({"/bin/sh", "-c", "cd '" + folder.file("") + "' && " + command});
  ASSERT_EQ(again.wait(), 0) << command << again.err();
  EXPECT_EQ(folder.read("contact_bad.csv"), folder.read("out/contact_bad.csv"));
  EXPECT_GT(folder.read("contact_bad.csv").size(), 1'000'000u);
}

TEST(Demo, AnimationShowsTheTraceAtTheSlidersTime) {
  const Folder folder;
  Process demo({TANDEM_DEMO, "--quick", "--runs", "contact", "--out", folder.file("out")});
  ASSERT_EQ(demo.wait(), 0) << demo.err();
  Process node(
      {"/usr/bin/env", "node", TANDEM_ANIMATION_CHECK, folder.file("out/report.html"), folder.file("out/contact.csv")});
  EXPECT_EQ(node.wait(), 0) << node.out() << node.err();
  EXPECT_NE(node.out().find("checked "), std::string::npos) << node.out();
}

}  // namespace
}  // namespace tandem
