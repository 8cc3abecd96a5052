// tandem-netsim run --record and trace, from the side of users.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/process.h"

namespace tandem::netsim {
namespace {

using tandem::test::Process;

/// A folder of this test's own.
class RunRecording : public testing::Test {
 protected:
  RunRecording()
      : folder_(std::filesystem::temp_directory_path() /
                ("tandem_record_" + std::to_string(getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~RunRecording() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// Runs the program. @return its exit code; its words are in `err`
  int netsim(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), TANDEM_NETSIM_PROGRAM);
    Process process(std::move(arguments));
    const int code = process.wait().value_or(-1000);
    err_ = process.err();
    return code;
  }

  std::filesystem::path folder_;
  std::string err_;
};

TEST_F(RunRecording, GivesTheTraceOfTheSameRun) {
  for (const auto& [scene, options] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"contact", {"--delay", "20", "--jitter", "5", "--loss", "5"}},
           {"two_by_two", {"--delay", "10"}},
           {"contact_remote", {}},
           {"one_axis", {"--seed", "3"}},
           {"seed_contact", {}}}) {
    SCOPED_TRACE(scene);
    std::vector<std::string> arguments{"run",      scene,          "--duration", "3",          "--quiet",
                                       "--record", path("a.mcap"), "--trace",    path("a.csv")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    std::filesystem::remove(path("a.mcap"));
    ASSERT_LE(netsim(arguments), 1) << err_;
    ASSERT_EQ(netsim({"trace", path("a.mcap"), "--output", path("b.csv")}), 0) << err_;
    EXPECT_EQ(err_, "");
    const std::string trace = content("a.csv");
    EXPECT_GT(trace.size(), 100'000u);
    EXPECT_TRUE(trace == content("b.csv"));
  }
}

TEST_F(RunRecording, GivesTheSameBytesAgain) {
  for (const char* name : {"a.mcap", "b.mcap"})
    ASSERT_LE(netsim({"run", "contact", "--duration", "2", "--loss", "10", "--quiet", "--record", path(name)}), 1);
  EXPECT_GT(content("a.mcap").size(), 100'000u);
  EXPECT_TRUE(content("a.mcap") == content("b.mcap"));
}

TEST_F(RunRecording, ReadsACutFileWithANote) {
  ASSERT_LE(
      netsim({"run", "contact", "--duration", "2", "--quiet", "--record", path("a.mcap"), "--trace", path("a.csv")}),
      1);
  std::filesystem::resize_file(path("a.mcap"), content("a.mcap").size() / 2);
  ASSERT_EQ(netsim({"trace", path("a.mcap"), "--output", path("b.csv")}), 0) << err_;
  EXPECT_NE(err_.find("has no undamaged end"), std::string::npos) << err_;
  EXPECT_TRUE(content("a.csv").starts_with(content("b.csv")));
}

TEST_F(RunRecording, NamesFilesThatCannotBe) {
  EXPECT_EQ(netsim({"run", "contact", "--record", path("no/such/a.mcap")}), 2);
  EXPECT_NE(err_.find("--record"), std::string::npos) << err_;
  EXPECT_EQ(netsim({"run", "contact", "--record", "-"}), 2);
  EXPECT_EQ(netsim({"run", "contact", "--record", path("a"), "--trace", path("a")}), 2);
  EXPECT_NE(err_.find("same file"), std::string::npos) << err_;
  std::ofstream(path("text.mcap")) << "no recording";
  EXPECT_EQ(netsim({"trace", path("text.mcap"), "--output", path("b.csv")}), 2);
  EXPECT_NE(err_.find("text.mcap"), std::string::npos) << err_;
  EXPECT_EQ(netsim({"trace", path("missing.mcap"), "--output", path("b.csv")}), 2);
}

TEST_F(RunRecording, ReplacesNoRecording) {
  std::ofstream(path("a.mcap")) << "kept";
  EXPECT_EQ(netsim({"run", "contact", "--duration", "1", "--record", path("a.mcap")}), 2);
  EXPECT_NE(err_.find("--record " + path("a.mcap") + ": exists already; choose another name"), std::string::npos)
      << err_;
  EXPECT_EQ(content("a.mcap"), "kept");
}

// A file system that takes no byte: the limit of the size of files is 0.
TEST_F(RunRecording, LeavesNoEmptyFileOnAFullDisk) {
  Process run({"/bin/sh", "-c",
               "ulimit -f 0; trap '' XFSZ; exec " TANDEM_NETSIM_PROGRAM " run one_axis --duration 1 --quiet --record " +
                   path("a.mcap")});
  EXPECT_EQ(run.wait(), 1) << run.err();
  EXPECT_NE(run.err().find("a.mcap could not be written to the end: the file would be larger than allowed here"),
            std::string::npos)
      << run.err();
  EXPECT_FALSE(std::filesystem::exists(path("a.mcap")));
}

// The report has the values and the trust that `score` computes from the same file.
TEST_F(RunRecording, PutsMainScoresIntoTheReport) {
  EXPECT_EQ(netsim({"run", "contact", "--scores"}), 2);
  EXPECT_NE(err_.find("--scores: needs --record"), std::string::npos) << err_;
  Process run({TANDEM_NETSIM_PROGRAM, "run", "contact", "--duration", "4", "--delay", "20", "--record", path("a.mcap"),
               "--scores", "--json", path("a.json")});
  ASSERT_LE(run.wait(), 1) << run.err();
  EXPECT_NE(run.out().find("  scores"), std::string::npos) << run.out();
  EXPECT_NE(run.out().find("Path length [mm]"), std::string::npos) << run.out();
  ASSERT_EQ(netsim({"score", path("a.mcap"), "--json", path("s.json"), "--quiet"}), 0) << err_;
  const auto report = nlohmann::json::parse(content("a.json"))["scores"];
  const auto scored = nlohmann::json::parse(content("s.json"))["lessons"][0];
  ASSERT_EQ(report["seats"].size(), 2u);
  EXPECT_FALSE(report["conditions"].empty());
  std::size_t compared = 0;
  for (std::size_t s = 0; s < 2; ++s)
    for (const auto& part : report["seats"][s]["parts"])
      for (const auto& other : scored["seats"][s]["parts"])
        for (const auto& [key, metric] : part["metrics"].items())
          if (part["part"] == other["part"]) {
            EXPECT_EQ(metric, other["metrics"][key]) << key;
            ++compared;
          }
  EXPECT_GT(compared, 30u);
}

TEST_F(RunRecording, ReportsAFullDisk) {
  EXPECT_EQ(netsim({"run", "one_axis", "--duration", "1", "--quiet", "--record", "/dev/full"}), 1);
  EXPECT_NE(err_.find("disk is full"), std::string::npos) << err_;
}

}  // namespace
}  // namespace tandem::netsim
