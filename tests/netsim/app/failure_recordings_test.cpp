// Recordings of failed seeds: which are written, what they state, and what is reported where one is missing.
#include "netsim/app/failure_recordings.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/base/raw_bytes.h"
#include "netsim/app/scenario_loader.h"
#include "netsim/app/test_report.h"
#include "proto/recording/lesson_reader.h"

namespace tandem::netsim {
namespace {

namespace fs = std::filesystem;

/// A folder of this test's own, and scenarios of half a second.
class FailureRecordingsTest : public testing::Test {
 protected:
  FailureRecordingsTest()
      : folder_(fs::temp_directory_path() / ("tandem_failures_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~FailureRecordingsTest() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string bytes(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder_), {}));
  }
  static Scenario loaded(const std::string& name, const std::string& limits) {
    auto scenario = load_scenario_text(
        "version: 1 scene: \"one_axis\" duration_s: 0.5 network { delay_ms: 5 jitter_ms: 5 }\n" + limits,
        name + ".textproto", false);
    if (!scenario) throw std::runtime_error(to_text(scenario.error()));
    return std::move(*scenario);
  }
  static Scenario failing(const std::string& name) { return loaded(name, "session_limits { duration_s { min: 9 } }"); }
  static Scenario passing(const std::string& name) { return loaded(name, "session_limits { duration_s { max: 9 } }"); }
  [[nodiscard]] TestResult recorded(std::vector<Scenario> scenarios, std::uint64_t seeds) const {
    TestResult result = run_tests(std::move(scenarios), {.seeds = seeds});
    record_failures(result, {.folder = path("out")});
    return result;
  }

  fs::path folder_;
};

TEST_F(FailureRecordingsTest, StateTheVerdictOfTheirRun) {
  const TestResult result = recorded({passing("good"), failing("bad")}, 2);
  const ScenarioResult& bad = result.scenarios[1];
  for (const SeedOutcome& seed : bad.seeds) {
    SCOPED_TRACE(seed.seed);
    EXPECT_EQ(seed.recording, path("out/bad-seed-" + std::to_string(seed.seed) + ".mcap"));
    EXPECT_EQ(seed.recording_problem, "");
    const std::string file = bytes("out/bad-seed-" + std::to_string(seed.seed) + ".mcap");
    const auto lesson = read_lesson(bytes_of(file));
    ASSERT_TRUE(lesson) << lesson.error();
    EXPECT_TRUE(lesson->complete);
    EXPECT_EQ(lesson->metadata.at("program"), "tandem-netsim test");
    EXPECT_EQ(lesson->metadata.at("scenario"), "bad");
    EXPECT_EQ(lesson->metadata.at("seed"), std::to_string(seed.seed));
    EXPECT_EQ(lesson->metadata.at("verdict"), "fail");
    EXPECT_EQ(lesson->metadata.at("causes"), causes(bad.scenario, seed).front());
  }
  EXPECT_EQ(files(), 3u) << "the folder and two files: none of the scenario that passed";
  EXPECT_EQ(result.recorded(), 2u);
}

TEST_F(FailureRecordingsTest, ChangeNoVerdict) {
  TestResult result = run_tests({failing("bad")}, {.seeds = 3});
  const auto seeds = [&] {
    std::vector<std::string> all;
    for (SeedOutcome seed : result.scenarios[0].seeds) {
      seed.recording.clear();
      all.push_back(to_bytes(seed));
    }
    return all;
  };
  const auto before = seeds();
  record_failures(result, {.folder = path("out"), .jobs = 2});
  EXPECT_EQ(result.recorded(), 3u);
  EXPECT_EQ(seeds(), before);
}

TEST_F(FailureRecordingsTest, AreAtMostTwentyInTheOrderOfTheTable) {
  const TestResult result = recorded({failing("one"), failing("two")}, 12);
  EXPECT_EQ(files(), 1 + kFailureRecordingsMax);
  EXPECT_EQ(result.recorded(), 20u);
  ASSERT_TRUE(result.recordings);
  EXPECT_EQ(result.recordings->left_out, 4u);
  EXPECT_NE(result.scenarios[1].seeds[7].recording, "");
  EXPECT_EQ(result.scenarios[1].seeds[8].recording, "");
  const std::string text = test_summary(result);
  EXPECT_NE(text.find("recordings: 20 of 24 failures in " + path("out") +
                      "; 4 were left out, as a call writes at most 20 files\n"),
            std::string::npos)
      << text;
  const auto json = nlohmann::json::parse(test_json(result));
  EXPECT_EQ(json["recordings"]["written"], 20);
  EXPECT_EQ(json["recordings"]["left_out"], 4);
  EXPECT_FALSE(json["scenarios"][1]["seeds"][8].contains("recording"));
}

TEST_F(FailureRecordingsTest, OfScenariosOfOneNameHaveFilesOfTheirOwn) {
  const TestResult result = recorded({failing("same"), failing("other"), failing("same")}, 1);
  EXPECT_EQ(result.scenarios[0].seeds[0].recording, path("out/same-seed-1.mcap"));
  EXPECT_EQ(result.scenarios[2].seeds[0].recording, path("out/same-seed-1-2.mcap"));
  EXPECT_EQ(files(), 4u);
}

TEST_F(FailureRecordingsTest, OfACrashEndBeforeIt) {
  Scenario crash = failing("crash");
  crash.setup.scene.duration = 5;
  crash.setup.tick_cost = [](Time now, std::size_t) {
    if (now > Time{} + std::chrono::seconds(3)) std::raise(SIGKILL);
    return Duration::zero();
  };
  const TestResult result = recorded({crash}, 1);
  const SeedOutcome& seed = result.scenarios[0].seeds[0];
  ASSERT_EQ(seed.state, SeedOutcome::State::kCrash) << seed.trouble;
  EXPECT_EQ(seed.recording, path("out/crash-seed-1.mcap"));
  EXPECT_NE(seed.recording_problem.find("the repeat crashed (ended by signal 9"), std::string::npos)
      << seed.recording_problem;
  const std::string file = bytes("out/crash-seed-1.mcap");
  const auto lesson = read_lesson(bytes_of(file));
  ASSERT_TRUE(lesson) << lesson.error();
  EXPECT_FALSE(lesson->complete);
  EXPECT_GT(lesson->rows(), 1000u);
  EXPECT_NE(junit_xml(result).find("note on the recording: the repeat crashed"), std::string::npos);
}

TEST_F(FailureRecordingsTest, OfAnotherRunAreReported) {
  TestResult result = run_tests({failing("bad")}, {.seeds = 1});
  result.scenarios[0].seeds[0].trace_hash = "0123";
  record_failures(result, {.folder = path("out")});
  const SeedOutcome& seed = result.scenarios[0].seeds[0];
  EXPECT_NE(seed.recording, "");
  EXPECT_NE(seed.recording_problem.find("it has another run: the repeat ended with fail and trace_hash "),
            std::string::npos)
      << seed.recording_problem;
}

TEST_F(FailureRecordingsTest, ReportFilesThatCannotBeWritten) {
  fs::create_directories(path("out/bad-seed-2.mcap"));
  TestResult result = recorded({failing("bad")}, 3);
  const auto& seeds = result.scenarios[0].seeds;
  EXPECT_NE(seeds[0].recording, "");
  EXPECT_EQ(seeds[1].recording, "");
  EXPECT_EQ(seeds[1].recording_problem, path("out/bad-seed-2.mcap") + " cannot be written: it is a folder");
  EXPECT_NE(seeds[2].recording, "");
  EXPECT_NE(test_summary(result).find("  not recorded: " + seeds[1].recording_problem + "\n"), std::string::npos);
  EXPECT_NE(test_summary(result).find("recordings: 2 of 3 failures in "), std::string::npos);

  result = run_tests({failing("bad")}, {.seeds = 1});
  record_failures(result, {.folder = "/proc/tandem_none/out"});
  EXPECT_NE(result.scenarios[0].seeds[0].recording_problem.find("/proc/tandem_none/out cannot be made: "),
            std::string::npos)
      << result.scenarios[0].seeds[0].recording_problem;
  EXPECT_EQ(result.failed(), 1u);
}

TEST_F(FailureRecordingsTest, OfASessionThatCannotBeMadeAreNone) {
  Scenario impossible = failing("impossible");
  impossible.setup.network.up.loss.probability = 2;  // no parser accepts this; the engine itself rejects it
  fs::create_directories(path("out"));
  std::ofstream(path("out/impossible-seed-1.mcap")) << "of an earlier call";
  const TestResult result = recorded({impossible}, 1);
  EXPECT_EQ(result.scenarios[0].seeds[0].recording, "");
  EXPECT_NE(result.scenarios[0].seeds[0].recording_problem.find("no session was made"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("out/impossible-seed-1.mcap")));
}

TEST_F(FailureRecordingsTest, StopWhenInterrupted) {
  Scenario hours = failing("hours");
  hours.setup.scene.duration = 3e5;
  TestResult result;
  SeedOutcome failed;
  failed.seed = 1;
  failed.state = SeedOutcome::State::kFail;
  result.scenarios.push_back({hours, {failed}});
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "x", 1), 1);
  record_failures(result, {.folder = path("out"), .jobs = 1, .stop_fd = ends[0]});
  EXPECT_EQ(result.scenarios[0].seeds[0].recording_problem, "interrupted before the recording was complete");
  EXPECT_EQ(result.recorded(), 0u);
  fs::remove_all(path("out"));
  record_failures(result, {.folder = path("out"), .interrupted = true});
  EXPECT_EQ(result.scenarios[0].seeds[0].recording_problem, "interrupted before the recording began");
  EXPECT_FALSE(fs::exists(path("out")));
  for (const int end : ends) close(end);
}

TEST_F(FailureRecordingsTest, NeedAFolder) {
  EXPECT_EQ(recording_folder_problem(path("a/b/c")), "");
  EXPECT_EQ(recording_folder_problem(path("")), "");
  EXPECT_FALSE(fs::exists(path("a"))) << "the check makes nothing";
  std::ofstream(path("file")) << "x";
  for (const char* name : {"file", "file/deeper", "file/deeper/still"})
    EXPECT_NE(recording_folder_problem(path(name)).find(path("file") + " is no folder; name another place"),
              std::string::npos)
        << recording_folder_problem(path(name));
  EXPECT_NE(recording_folder_problem("-"), "");
  if (geteuid() == 0) return;  // the checks below need a user with limits
  fs::create_directories(path("locked"));
  fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(recording_folder_problem(path("locked/out")).find("no permission"), std::string::npos);
}

}  // namespace
}  // namespace tandem::netsim
