// tandem-netsim replay and diff, and recordings as hands, from the side of users.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace tandem::netsim {
namespace {

using tandem::test::Process;

/// A folder of this test's own, with a recording of 5 s over 20 ms and 5 % loss.
class ReplayCommand : public testing::Test {
 protected:
  ReplayCommand()
      : folder_(std::filesystem::temp_directory_path() /
                ("tandem_replay_" + std::to_string(getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
    record("a.mcap", {"--delay", "20", "--loss", "5"});
  }
  ~ReplayCommand() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Runs the program. @return its exit code; its words are in `out_` and `err_`
  int netsim(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), TANDEM_NETSIM_PROGRAM);
    Process process(std::move(arguments));
    const int code = process.wait().value_or(-1000);
    out_ = process.out();
    err_ = process.err();
    return code;
  }
  void record(const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {"run", "contact", "--duration", "5", "--quiet", "--record", path(name)});
    EXPECT_LE(netsim(std::move(options)), 1) << err_;
  }
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out_); }

  std::filesystem::path folder_;
  std::string out_, err_;
};

TEST_F(ReplayCommand, FindsARecordingEqual) {
  ASSERT_EQ(netsim({"replay", path("a.mcap"), "--json", "-"}), 0) << err_;
  EXPECT_NE(err_.find("equal, bit for bit"), std::string::npos) << err_;
  const auto result = json();
  EXPECT_EQ(result["equal"], true);
  EXPECT_GT(result["outputs"], 5000);
  EXPECT_GT(result["rows"], 4900);
  EXPECT_TRUE(result["difference"].is_null());
}

// Damage in the file ends the replay at the last whole chunk before it; a file of another kind is no recording.
TEST_F(ReplayCommand, SaysWhatCannotBeReplayed) {
  std::ifstream in(path("a.mcap"), std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t at = bytes.size() * 2 / 5; at < bytes.size() * 3 / 5; at += 100)
    bytes[at] = static_cast<char>(bytes[at] ^ 0x40);
  std::ofstream(path("damaged.mcap"), std::ios::binary) << bytes;
  const int code = netsim({"replay", path("damaged.mcap"), "--json", "-"});
  EXPECT_EQ(json()["complete"], false);
  EXPECT_EQ(code, json()["error"] == "" ? 0 : 1) << out_;
  EXPECT_LT(json()["ticks"], 5000);
  EXPECT_NE(err_.find("note: a file has no undamaged end"), std::string::npos) << err_;
  std::ofstream(path("text.mcap")) << "no recording";
  EXPECT_EQ(netsim({"replay", path("text.mcap")}), 2);
  EXPECT_NE(err_.find("text.mcap"), std::string::npos) << err_;
  EXPECT_EQ(netsim({"replay", path("missing.mcap")}), 2);
  EXPECT_EQ(netsim({"replay", path("a.mcap"), "--json", path("no/such/file")}), 2);
}

TEST_F(ReplayCommand, PlaysTheHandsUnderAnotherLawAndNetwork) {
  ASSERT_EQ(netsim({"replay", path("a.mcap"), "--what-if", "law=set_position,delay=100", "--json", "-"}), 0) << err_;
  const auto result = json();
  EXPECT_NE(std::string(result["played_under"]).find("set_position"), std::string::npos) << out_;
  const auto& stiffness = result["numbers"]["stiffness_felt_n_m"];
  EXPECT_GT(stiffness["recorded"], 300.0);
  EXPECT_LT(stiffness["played"], 100.0) << "law set_position is soft over 100 ms";
  for (const char* key : {"stiffness_felt_n_m", "drag_n", "trips_per_min", "delivered_error_n"})
    EXPECT_TRUE(result["numbers"].contains(key)) << key;
  for (const char* wrong : {"law=none", "delay=x", "delay=-1", "loss=101", "speed=2", ""})
    EXPECT_EQ(netsim({"replay", path("a.mcap"), std::string("--what-if=") + wrong}), 2) << wrong;
}

// Under the same law and network the played hands do what was recorded: the same distance, stiffness and drag.
TEST_F(ReplayCommand, PlaysTheSameSessionUnderTheSameConditions) {
  record("calm.mcap", {});
  ASSERT_EQ(netsim({"replay", path("calm.mcap"), "--what-if", "delay=0", "--json", "-"}), 0) << err_;
  const auto numbers = json()["numbers"];
  for (const char* key : {"leader_tool_rms_m", "stiffness_felt_n_m"}) {
    const double recorded = numbers[key]["recorded"], played = numbers[key]["played"];
    EXPECT_NEAR(played, recorded, 0.2 * recorded) << key;
  }
  EXPECT_EQ(numbers["trips_per_min"]["played"], 0.0);
}

TEST_F(ReplayCommand, ComparesTwoRecordings) {
  record("same.mcap", {"--delay", "20", "--loss", "5"});
  record("other.mcap", {"--delay", "25", "--loss", "5"});
  EXPECT_EQ(netsim({"diff", path("a.mcap"), path("same.mcap")}), 0) << out_ << err_;
  EXPECT_NE(out_.find("equal, bit for bit"), std::string::npos) << out_;
  EXPECT_EQ(netsim({"diff", path("a.mcap"), path("other.mcap"), "--json", "-"}), 1) << err_;
  double largest = 0;
  const auto result = json();
  for (const auto& channel : result["channels"])
    if (channel["channel"] == "/tool/measured_cp") largest = channel["difference"];
  EXPECT_GT(largest, 1e-6);
  std::vector<std::string> wide{"diff", path("a.mcap"), path("other.mcap")};
  for (const auto& channel : result["channels"]) {
    wide.emplace_back("--limit");
    wide.push_back(std::string(channel["channel"]) + "=1e12");
  }
  EXPECT_EQ(netsim(wide), 0) << out_ << err_;
  EXPECT_NE(out_.find("within the limits"), std::string::npos) << out_;
  EXPECT_EQ(netsim({"diff", path("a.mcap"), path("missing.mcap")}), 2);
  EXPECT_EQ(netsim({"diff", path("a.mcap"), path("a.mcap"), "--limit", "measured_cp"}), 2);
  EXPECT_EQ(netsim({"diff", path("a.mcap"), path("a.mcap"), "--limit", "nothing=1"}), 2);
  EXPECT_NE(err_.find("there is no channel nothing"), std::string::npos) << err_;
  EXPECT_NE(netsim({"diff", path("a.mcap")}), 0);
  EXPECT_NE(err_.find("B.mcap is required"), std::string::npos) << err_;
}

TEST_F(ReplayCommand, TakesAHandOfARecording) {
  EXPECT_LE(netsim({"run", "contact", "--duration", "3", "--quiet", "--json", "-", "--hand",
                    "trainer=" + path("a.mcap") + ",seat=trainer"}),
            1)
      << err_;
  EXPECT_GT(json()["duration_s"], 2.9);
  EXPECT_EQ(netsim({"run", "contact", "--hand", "trainer=" + path("a.mcap") + ",seat=tutor"}), 2);
  EXPECT_NE(err_.find("the recording has no hand tutor"), std::string::npos) << err_;
  EXPECT_EQ(netsim({"run", "contact", "--hand", "trainer=" + path("a.mcap") + ",scale=2"}), 2);
}

}  // namespace
}  // namespace tandem::netsim
