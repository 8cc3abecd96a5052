// `tandem-netsim test --record-failures` as users and CI jobs start it.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/io/programs.h"

namespace tandem {
namespace {

namespace fs = std::filesystem;
using test::Folder;
using test::Json;
using test::Process;

Process recording_test(const Folder& folder, const std::string& scenario, test::Words more = {}) {
  test::Words command{TANDEM_NETSIM,        "test", scenario, "--record-failures", folder.file("a/b"), "--json",
                      folder.file("v.json")};
  command.insert(command.end(), more.begin(), more.end());
  return Process(std::move(command));
}

/// Must fail: no session of 4 s lasts an hour.
constexpr const char* kFails =
    "version: 1 scene: \"contact\" duration_s: 4 seeds: 2 network { delay_ms: 10 jitter_ms: 5 loss_percent: 5 }\n"
    "session_limits { duration_s { min: 3600 } }\n";
/// The same with a restart of the server and a hand that pauses. Ticks come again: the session clock stands still, or
/// returns to the checkpoint.
constexpr const char* kFailsWithFaults =
    "version: 1 scene: \"contact\" duration_s: 4 network { delay_ms: 10 jitter_ms: 5 loss_percent: 5 }\n"
    "fault { kind: SERVER_RESTART at_s: 2 for_ms: 100 } fault { kind: PAUSE seat: \"trainer\" at_s: 3 for_ms: 100 }\n"
    "session_limits { duration_s { min: 3600 } }\n";
constexpr const char* kPasses =
    "version: 1 scene: \"one_axis\" duration_s: 1 network { delay_ms: 10 } session_limits { duration_s { max: 9 } }\n";

TEST(RecordFailures, ReplayBitForBitAndShowTheFailedRun) {
  const Folder folder;
  const std::string scenario = folder.write("must fail.textproto", kFails);
  auto run = recording_test(folder, scenario, {"--junit", folder.file("v.xml")});
  ASSERT_EQ(run.wait(), 1) << run.err();
  EXPECT_EQ(run.err(), "");
  const Json json = folder.json("v.json");
  EXPECT_EQ(json["recordings"], (Json{{"folder", folder.file("a/b")}, {"written", 2}, {"left_out", 0}}));
  for (int i = 0; i < 2; ++i) {
    const Json seed = json["scenarios"][0]["seeds"][i];
    const std::string file = folder.file("a/b/must fail-seed-" + std::to_string(i + 1) + ".mcap");
    EXPECT_EQ(seed["recording"], file);
    EXPECT_FALSE(seed.contains("recording_problem")) << seed;
    EXPECT_NE(run.out().find("  recording: " + file + "\n"), std::string::npos) << run.out();
    EXPECT_NE(folder.read("v.xml").find("<system-out>\n[[ATTACHMENT|" + file + "]]\n</system-out>"), std::string::npos);

    Process replay({TANDEM_NETSIM, "replay", file});
    EXPECT_EQ(replay.wait(), 0) << replay.err();
    EXPECT_NE(replay.out().find("equal, bit for bit"), std::string::npos) << replay.out();
    // The rows of the run that was judged: the same hash, so the same values against the same limits.
    Process trace({TANDEM_NETSIM, "trace", file, "--output", folder.file("t.csv")});
    ASSERT_EQ(trace.wait(), 0) << trace.err();
    Process sum({"/usr/bin/sha256sum", folder.file("t.csv")});
    ASSERT_EQ(sum.wait(), 0) << sum.err();
    EXPECT_TRUE(sum.out().starts_with(seed["trace_hash"].get<std::string>())) << sum.out() << seed;
  }
  if (fs::exists("/usr/bin/xmllint")) {
    Process lint({"/usr/bin/xmllint", "--noout", folder.file("v.xml")});
    EXPECT_EQ(lint.wait(), 0) << lint.err();
  }
}

TEST(RecordFailures, ReplayARestartAndHaveEveryTickOnce) {
  const Folder folder;
  auto run = recording_test(folder, folder.write("f.textproto", kFailsWithFaults), {"--trace", folder.file("t.csv")});
  ASSERT_EQ(run.wait(), 1) << run.err();
  const std::string file = folder.file("a/b/f-seed-1.mcap");
  Process replay({TANDEM_NETSIM, "replay", file});
  EXPECT_EQ(replay.wait(), 0) << replay.out() << replay.err();
  Process trace({TANDEM_NETSIM, "trace", file, "--output", folder.file("recorded.csv")});
  ASSERT_EQ(trace.wait(), 0) << trace.err();
  std::istringstream rows(folder.read("t.csv"));
  std::string once;  // the rows of the run, without those whose tick is not later than the one before
  std::getline(rows, once);
  once += "\n";
  long last = -1;
  std::size_t repeats = 0;
  for (std::string row; std::getline(rows, row);) {
    const long tick = std::stol(row.substr(0, row.find(',')));
    if (tick > last) {
      last = tick;
      once += row + "\n";
    } else {
      ++repeats;
    }
  }
  EXPECT_GE(repeats, 100u) << "the faults stop the session clock";
  EXPECT_TRUE(folder.read("recorded.csv") == once);
}

TEST(RecordFailures, WriteNothingForAPass) {
  const Folder folder;
  auto run = recording_test(folder, folder.write("good.textproto", kPasses), {"--junit", folder.file("v.xml")});
  ASSERT_EQ(run.wait(), 0) << run.out() << run.err();
  EXPECT_FALSE(fs::exists(folder.file("a")));
  EXPECT_EQ(run.out().find("recording"), std::string::npos) << run.out();
  EXPECT_EQ(folder.read("v.xml").find("ATTACHMENT"), std::string::npos);
  EXPECT_EQ(folder.json("v.json")["recordings"]["written"], 0);
}

TEST(RecordFailures, KeepTheExitCodeOfTheVerdictWithoutTheirFiles) {
  const Folder folder;
  const std::string scenario = folder.write("f.textproto", kFails);
  fs::create_directories(folder.file("a/b/f-seed-1.mcap"));
  auto run = recording_test(folder, scenario);
  EXPECT_EQ(run.wait(), 1);
  EXPECT_NE(run.err().find("--record-failures: f, seed 1: " + folder.file("a/b/f-seed-1.mcap") +
                           " cannot be written: it is a folder"),
            std::string::npos)
      << run.err();
  Json seeds = folder.json("v.json")["scenarios"][0]["seeds"];
  EXPECT_FALSE(seeds[0].contains("recording"));
  EXPECT_NE(seeds[0]["recording_problem"].get<std::string>().find("it is a folder"), std::string::npos);
  EXPECT_TRUE(seeds[1].contains("recording"));

  // A disk that takes no more than 100 blocks of 512 bytes per file.
  Process full({"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 100; exec \"$0\" \"$@\"", TANDEM_NETSIM, "test", scenario,
                "--seed", "2", "--seeds", "1", "--record-failures", folder.file("full"), "--json",
                folder.file("v.json")});
  EXPECT_EQ(full.wait(), 1);
  EXPECT_NE(full.err().find("f, seed 2: " + folder.file("full/f-seed-2.mcap") + " could not be written to the end"),
            std::string::npos)
      << full.err();
  seeds = folder.json("v.json")["scenarios"][0]["seeds"];
  EXPECT_EQ(seeds[0]["verdict"], "fail");
  EXPECT_FALSE(seeds[0].contains("recording"));
}

TEST(RecordFailures, StartNothingForAFolderThatCannotBe) {
  const Folder folder;
  const std::string good = folder.write("good.textproto", kPasses);
  for (const auto& [arguments, part] : std::vector<std::pair<test::Words, std::string>>{
           {{"--record-failures", good}, good + " is no folder"},
           {{"--record-failures", good + "/deeper"}, good + " is no folder"},
           {{"--record-failures", "-"}, "names a folder"},
           {{"--check", "--record-failures", folder.file("a")}, "nothing for --record-failures"}}) {
    test::Words command{TANDEM_NETSIM, "test", good};
    command.insert(command.end(), arguments.begin(), arguments.end());
    Process run(command);
    EXPECT_EQ(run.wait(), 2) << part;
    EXPECT_NE(run.err().find(part), std::string::npos) << part << " not in: " << run.err();
    EXPECT_EQ(run.out(), "") << part;
  }
  EXPECT_FALSE(fs::exists(folder.file("a")));
}

}  // namespace
}  // namespace tandem
