// `tandem-netsim test` as users and CI jobs start it.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "tests/io/programs.h"

namespace tandem {
namespace {

using test::Folder;
using test::Json;
using test::Process;

Process netsim_test(test::Words arguments) {
  arguments.insert(arguments.begin(), {TANDEM_NETSIM, "test"});
  return Process(std::move(arguments));
}

/// Must fail: 30 ms each way on a scene whose tracking error then exceeds 1 mm, and 5 % loss where none is allowed.
constexpr const char* kMustFail =
    "version: 1\nscene: \"one_axis\"\nduration_s: 3\nseeds: 3\nnetwork { delay_ms: 30 loss_percent: 5 }\n"
    "seat_limits { tracking_rms_m { max: 0.00001 } loss_percent { max: 0 } }\n";

TEST(NetsimTest, ShippedScenariosPassWithinTheirLimits) {
  const Folder folder;
  auto run = netsim_test({"shipped", "--json", folder.file("v.json"), "--junit", folder.file("v.xml")});
  std::optional<int> code;
  for (int attempt = 0; attempt < 10 && !(code = run.wait()); ++attempt) {
  }
  ASSERT_EQ(code, 0) << run.out() << run.err();
  const Json json = folder.json("v.json");
  EXPECT_EQ(json["verdict"], "pass");
  EXPECT_GE(json["scenarios"].size(), 6u);
  for (const Json& scenario : json["scenarios"]) {
    EXPECT_EQ(scenario["verdict"], "pass");
    for (const Json& limit : scenario["limits"])
      EXPECT_FALSE(limit["worst"].is_null()) << scenario["name"] << " " << limit;
  }
  std::printf("[  cpu     ] %.1f s for %d seeds of all shipped scenarios\n", json["cpu_s"].get<double>(),
              json["seeds_run"].get<int>());
  if (std::filesystem::exists("/usr/bin/xmllint")) {
    Process lint({"/usr/bin/xmllint", "--noout", folder.file("v.xml")});
    EXPECT_EQ(lint.wait(), 0) << lint.err();
  } else {
    std::printf(
        "[ NOT RUN ] JUnit XML through xmllint: it is not installed (package libxml2-utils; ./test --full installs "
        "it)\n");
  }
}

/// The first block of text under "## Verdicts for CI" in netsim/README.md.
std::string scenario_of_the_manual() {
  std::ifstream file(TANDEM_SOURCE_DIR "/netsim/README.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto chapter = text.find("## Verdicts for CI"), begin = text.find("```\n", chapter),
             end = text.find("```", begin + 4);
  return chapter == std::string::npos || end == std::string::npos ? "" : text.substr(begin + 4, end - begin - 4);
}

TEST(NetsimTest, PassesTheScenarioOfTheManual) {
  const Folder folder;
  const std::string scenario = scenario_of_the_manual();
  ASSERT_NE(scenario.find("seat_limits"), std::string::npos);
  auto run = netsim_test({folder.write("manual.textproto", scenario)});
  EXPECT_EQ(run.wait(), 0) << run.out() << run.err();
}

TEST(NetsimTest, ReportsWhyItFailedAndACommandThatRepeatsTheTrace) {
  const Folder folder;
  const std::string file = folder.write("must fail.textproto", kMustFail);
  auto run = netsim_test({file, "--json", folder.file("v.json"), "--junit", folder.file("v.xml")});
  ASSERT_EQ(run.wait(), 1) << run.err();
  for (const char* part : {"FFF", "FAIL 3 of 3", "tracking_rms_m", "must be at most 1e-05 m", "must be at most 0 %",
                           "--seed 2 --seeds 1 --trace"})
    EXPECT_NE(run.out().find(part), std::string::npos) << part << " not in\n" << run.out();
  const Json seed = folder.json("v.json")["scenarios"][0]["seeds"][1];
  EXPECT_EQ(seed["verdict"], "fail");
  EXPECT_EQ(seed["causes"].size(), 3u) << seed;
  EXPECT_NE(folder.read("v.xml").find("failures=\"3\""), std::string::npos);

  // The command, literally, in a shell.
  const std::string bin = std::filesystem::path(TANDEM_NETSIM).parent_path().string();
  const std::string command = "cd '" + folder.file("") + "' && PATH=" + bin + ":$PATH && " +
                              seed["replay"].get<std::string>() +
                              " --json again.json && echo passed || sha256sum 'must fail-2.csv'";
  Process again({"/bin/sh", "-c", command});
  ASSERT_EQ(again.wait(), 0) << again.err();
  EXPECT_EQ(folder.json("again.json")["scenarios"][0]["seeds"][0]["trace_hash"], seed["trace_hash"]);
  EXPECT_NE(again.out().find(seed["trace_hash"].get<std::string>()), std::string::npos) << again.out();
}

TEST(NetsimTest, RunOfTheSameSceneNetworkAndSeedHasTheSameTrace) {
  const Folder folder;
  const std::string file = folder.write(
      "same.textproto",
      "version: 1 scene: \"one_axis\" duration_s: 3 network { delay_ms: 10 jitter_ms: 5 loss_percent: 5 }");
  auto test = netsim_test({file, "--seed", "9", "--json", "-", "--quiet"});
  ASSERT_EQ(test.wait(), 0) << test.err();
  Process run({TANDEM_NETSIM, "run", "one_axis", "--duration", "3", "--delay", "10", "--jitter", "5", "--loss", "5",
               "--seed", "9", "--json", "-", "--quiet"});
  ASSERT_EQ(run.wait(), 0) << run.err();
  EXPECT_EQ(Json::parse(test.out())["scenarios"][0]["seeds"][0]["trace_hash"], Json::parse(run.out())["trace_hash"]);
}

TEST(NetsimTest, GivesTheSameBytesForAnyNumberOfJobs) {
  const Folder folder;
  const std::string file = folder.write("f.textproto", kMustFail);
  std::vector<std::string> bytes;
  for (const char* jobs : {"1", "4"}) {
    auto run = netsim_test({file, "--jobs", jobs, "--seeds", "5", "--json", "-", "--quiet"});
    ASSERT_EQ(run.wait(), 1);
    std::string text;
    std::istringstream lines(run.out());
    for (std::string line; std::getline(lines, line);)
      if (line.find("\"cpu_s\"") == std::string::npos) text += line + "\n";
    bytes.push_back(text);
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(NetsimTest, ReportsErrorsAndStartsNothing) {
  const Folder folder;
  const std::string bad = folder.write("bad.textproto", "version: 1\nscene: \"free_motoin\"\nseeds: 0\nnetwrk { }\n");
  const std::string good = folder.write("good.textproto", "version: 1 scene: \"one_axis\" duration_s: 1");
  std::filesystem::create_directory(folder.file("empty"));
  for (const auto& [arguments, part] : std::vector<std::pair<test::Words, std::string>>{
           {{}, "SCENARIO is required"},
           {{"free-motion-lam"}, "did you mean free-motion-lan?"},
           {{bad}, "bad.textproto:3:8: seeds = 0: must be in [1, 1e5]"},
           {{bad}, "bad.textproto:4:1: netwrk: unknown key; did you mean network?"},
           {{folder.file("empty")}, "holds no *.textproto"},
           {{good, "--seeds", "0"}, "[1, 100000]"},
           {{good, "--seeds", "1.5"}, "whole number"},
           {{good, "--seed", "18446744073709551615", "--seeds", "2"}, "beyond 64 bits"},
           {{good, "--jobs", "257"}, "[1, 256]"},
           {{good, "--seeds", "2", "--trace", folder.file("t.csv")}, "of one seed of one scenario, these are 2"},
           {{good, "--check", "--json", "-"}, "--check runs nothing, so there is nothing for --json"},
           {{good, "--list", "--junit", folder.file("x")}, "--list runs nothing, so there is nothing for --junit"},
           {{good, "--trace", "-"}, "standard output is for --json"},
           {{good, "--junit", folder.file("x"), "--json", folder.file("x")}, "is the same file as --json"},
           {{good, "--json", "/no/such/folder/x.json"}, "cannot be written"},
           {{good, "--keep-going"}, "--keep-going"}}) {
    auto run = netsim_test(arguments);
    EXPECT_EQ(run.wait(), 2) << part;
    EXPECT_NE(run.err().find(part), std::string::npos) << part << " not in: " << run.err() << run.out();
    EXPECT_EQ(run.out(), "") << part;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.file("t.csv")));
}

TEST(NetsimTest, ListsAndChecksWithoutRunning) {
  auto list = netsim_test({"--list"});
  EXPECT_EQ(list.wait(), 0);
  EXPECT_NE(list.out().find("free-motion-lan"), std::string::npos);
  auto check = netsim_test({"contact-delay", "--check"});
  EXPECT_EQ(check.wait(), 0);
  for (const char* part :
       {"scene ", "delay 20 ms, jitter 0 to 5 ms, loss 5 %", "seeds ", "1 to 4", "force_error_rms_n", "at most 0.02"})
    EXPECT_NE(check.out().find(part), std::string::npos) << part << " not in\n" << check.out();
}

TEST(NetsimTest, ShowsEffectiveOptionsAndUnreachedEventsInACheck) {
  const Folder folder;
  const std::string file =
      folder.write("late.textproto",
                   "version: 1 scene: \"one_axis\" duration_s: 3 seeds: 3 event { at_s: 2 outage_ms: 5 }\n"
                   "event { at_s: 90 outage_ms: 5 } fault { kind: PAUSE seat: \"trainer\" at_s: 4 for_ms: 5 }\n");
  auto check = netsim_test({file, "--check", "--seed", "7", "--seeds", "2"});
  EXPECT_EQ(check.wait(), 0) << check.err();
  for (const char* part :
       {"7 to 8", "note: the outage at 90 s will not come, unless the session of 3 s begins later than at 87 s",
        "note: the fault PAUSE at 4 s will not come"})
    EXPECT_NE(check.out().find(part), std::string::npos) << part << " not in\n" << check.out();
  EXPECT_EQ(check.out().find("outage at 2 s"), std::string::npos) << check.out();
}

TEST(NetsimSweep, PrintsAMapWhosePointsTheRunCommandRepeats) {
  Process sweep(
      {TANDEM_NETSIM, "sweep", "one_axis", "--duration", "2", "--delay", "0,30", "--loss", "0,5", "--json", "-"});
  ASSERT_EQ(sweep.wait(), 0) << sweep.err();
  EXPECT_NE(sweep.err().find("delay [ms]  loss"), std::string::npos) << sweep.err();
  const Json point = Json::parse(sweep.out())["points"][3];
  EXPECT_EQ(point["loss_percent"], 5);
  Process run(
      {TANDEM_NETSIM, "run", "one_axis", "--duration", "2", "--delay", "30", "--loss", "5", "--json", "-", "--quiet"});
  ASSERT_EQ(run.wait(), 0) << run.err();
  const Json report = Json::parse(run.out());
  EXPECT_EQ(point["seeds"][0]["trace_hash"], report["trace_hash"]);
  EXPECT_EQ(point["worst"], report["seats"][0]["tracking_rms_m"]);
}

TEST(NetsimSweep, SaysWhenItsSeedsAreIdentical) {
  for (const auto& [loss, says] : std::vector<std::pair<const char*, bool>>{{"0", true}, {"0,5", false}}) {
    Process sweep(
        {TANDEM_NETSIM, "sweep", "one_axis", "--duration", "1", "--delay", "0,10", "--loss", loss, "--seeds", "2"});
    ASSERT_EQ(sweep.wait(), 0) << sweep.err();
    EXPECT_EQ(sweep.out().find("the seeds are identical") != std::string::npos, says) << sweep.out();
  }
}

TEST(NetsimSweep, ReportsErrorsAndStartsNothing) {
  for (const auto& [arguments, part] : std::vector<std::pair<test::Words, std::string>>{
           {{"one_axis"}, "nothing to sweep"},
           {{"one_axis", "--delay", "0", "--metric", "force_error_rms_n"},
            "measured in phases that the scene marks `contact: true`"},
           {{"one_axs", "--delay", "0"}, "did you mean one_axis?"},
           {{"one_axis", "--delay", "0,60001"}, "--delay: \"60001\" is out of range"},
           {{"one_axis", "--loss", "0,x"}, "--loss: \"x\" is not a number"},
           {{"one_axis", "--delay", "0", "--metric", "trackin"}, "--metric: \"trackin\" is no number of a report"},
           {{"one_axis", "--delay", "0", "--csv", "/no/such/x.csv"}, "cannot be written"}}) {
    test::Words command{TANDEM_NETSIM, "sweep"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    Process sweep(command);
    EXPECT_EQ(sweep.wait(), 2) << part;
    EXPECT_NE(sweep.err().find(part), std::string::npos) << part << " not in: " << sweep.err();
  }
}

TEST(NetsimTest, EndsAtOnceOnAnInterruptAndNamesTheRunsNotDone) {
  const Folder folder;
  // The second scenario takes hours. The result files are opened after the signal handlers are installed.
  const std::string soon = folder.write("a-soon.textproto", "version: 1 scene: \"one_axis\" duration_s: 0.5");
  const std::string later = folder.write("b-later.textproto", "version: 1 scene: \"one_axis\" duration_s: 3e5");
  auto run = netsim_test(
      {soon, later, "--jobs", "1", "--seeds", "2", "--json", folder.file("v.json"), "--junit", folder.file("v.xml")});
  for (int i = 0; i < 1000 && !std::filesystem::exists(folder.file("v.xml")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 1) << run.err();
  EXPECT_NE(run.out().find("not run:"), std::string::npos) << run.out();
  EXPECT_NE(run.out().find("b-later (1 2)"), std::string::npos) << run.out();
  EXPECT_NE(run.err().find("interrupted"), std::string::npos) << run.err();
  const Json json = folder.json("v.json");
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_EQ(json["interrupted"], true);
  // Readers of the XML that count only failures and errors must not take it for a pass.
  const std::string xml = folder.read("v.xml");
  const std::string later_suite = xml.substr(xml.find("<testsuite name=\"b-later\""));
  EXPECT_NE(later_suite.find("tests=\"2\" failures=\"0\" errors=\"1\" skipped=\"1\""), std::string::npos) << xml;
  EXPECT_NE(later_suite.find("type=\"interrupted\""), std::string::npos) << xml;
  EXPECT_EQ(xml.find("errors=\"0\" skipped=\"2\""), std::string::npos) << xml;
  EXPECT_EQ(json["scenarios"][1]["seeds"][0]["verdict"], "not run");
}

}  // namespace
}  // namespace tandem
