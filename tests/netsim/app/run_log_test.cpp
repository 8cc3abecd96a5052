// --script, --log and --replay through the program.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/process.h"

namespace tandem::netsim {
namespace {

/// Separate folder, removed afterwards.
class RunLog : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("tandem_run_log_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }
  void write(const char* name, std::string_view text) const { std::ofstream(path(name)) << text; }
  [[nodiscard]] std::string read(const char* name) const {
    std::ifstream file(path(name));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// Runs a shipped scene with two seats, trainer and trainee, for 1 s.
  static int run(std::vector<std::string> options, std::string* err = nullptr, std::string* out = nullptr) {
    // A replay has no seed: the log determines the decisions.
    if (std::ranges::find(options, "--replay") == options.end()) options.insert(options.begin(), {"--seed", "3"});
    options.insert(options.begin(), {TANDEM_NETSIM_PROGRAM, "run", "free_motion", "--duration", "1"});
    tandem::test::Process process{options};
    const int code = process.wait().value_or(-1);
    if (err != nullptr) *err = process.err();
    if (out != nullptr) *out = process.out();
    return code;
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(RunLog, ReplaysARunIdentically) {
  std::string out;
  EXPECT_EQ(run({"--profile", "wifi-busy", "--log", path("a.csv"), "--trace", path("a_trace.csv"), "--quiet"}), 0);
  EXPECT_EQ(run({"--replay", path("a.csv"), "--log", path("b.csv"), "--trace", path("b_trace.csv")}, nullptr, &out), 0);
  const std::string log = read("a.csv");
  EXPECT_TRUE(log.starts_with("t_in_ns[ns],link[1],dir[1],flow[1],idx[1],size[B],verdict[1],t_out_ns[ns],cause[1]\n"));
  EXPECT_GT(log.size(), 100'000U);
  EXPECT_TRUE(log == read("b.csv"));
  EXPECT_TRUE(read("a_trace.csv") == read("b_trace.csv"));
  EXPECT_NE(out.find("datagrams got their own recorded verdict\n"), std::string::npos) << out;
}

TEST_F(RunLog, AppliesAScriptToTheNamedSeat) {
  write("day.textproto",
        "event { at_s: 0.5 client: \"trainee\" outage_ms: 200 }\nevent { at_s: 0.9 profile: \"beside.textproto\" }\n");
  write("beside.textproto", "version: 1\nboth { floor_ms: 7 }\n");
  std::string err;
  ASSERT_EQ(run({"--delay", "2", "--script", path("day.textproto"), "--log", path("log.csv"), "--quiet"}, &err), 0)
      << err;
  std::istringstream log(read("log.csv"));
  std::size_t struck = 0, seven = 0;
  for (std::string line; std::getline(log, line);) {
    if (line.ends_with(",outage")) {
      ++struck;
      EXPECT_NE(line.find(",1,up,1,") == std::string::npos, line.find(",1,down,1,") == std::string::npos) << line;
    }
    if (line.starts_with("1000000000,0,up,")) {
      ++seven;
      EXPECT_NE(line.find(",1007000000,"), std::string::npos) << line;
    }
  }
  EXPECT_EQ(struck, 400U);
  EXPECT_EQ(seven, 1U);
}

TEST_F(RunLog, ListsAllMistakesWithTheirPlace) {
  write("day.textproto", "event {\n  at_s: 1\n  client: \"trainees\"\n  outage_ms: 200\n}\n");
  write("broken.csv", "t_in_ns[ns],link[1]\n1,2\n");
  std::string err;
  EXPECT_EQ(run({"--script", path("day.textproto"), "--replay", path("broken.csv")}, &err), 2);
  EXPECT_NE(err.find("day.textproto:3:11: event[0].client[0] = \"trainees\": no such client; did you mean trainee?"),
            std::string::npos)
      << err;
  EXPECT_NE(err.find("--replay excludes --script"), std::string::npos) << err;
  EXPECT_NE(err.find("broken.csv:1:1: dir: this column of a decision log is missing"), std::string::npos) << err;
  EXPECT_EQ(run({"--replay", path("none.csv")}, &err), 2);
  EXPECT_NE(err.find("No such file"), std::string::npos) << err;
  write("one.csv",
        "t_in_ns[ns],link[1],dir[1],flow[1],idx[1],size[B],verdict[1],t_out_ns[ns],cause[1]\n0,0,up,0,0,9,delivered,5,-"
        "\n");
  EXPECT_EQ(run({"--replay", path("one.csv")}, &err), 2);
  EXPECT_NE(err.find("holds no flow 1, which is seat trainee"), std::string::npos) << err;
  EXPECT_EQ(run({"--log", path("nowhere/log.csv")}, &err), 2);
  EXPECT_NE(err.find("--log:"), std::string::npos) << err;
}

}  // namespace
}  // namespace tandem::netsim
