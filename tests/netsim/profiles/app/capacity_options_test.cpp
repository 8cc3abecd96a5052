// Recorded capacities on the command line: detection, messages, rejections.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "netsim/profiles/app/capacity_file.h"
#include "netsim/profiles/app/network_options.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

/// Folder with recordings; removed at the end.
class CapacityOptions : public ::testing::Test {
 protected:
  CapacityOptions() : folder_(std::filesystem::path(::testing::TempDir()) / ("capacity" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
    write("m.trace", "0\n4\n4\n9\n");  // 4 opportunities in 10 ms: 4.8 Mbit/s
    write("t.csv", "direction[up|down],t_ms[ms],opportunities[count]\nup,0,1\nup,9,1\ndown,4,2\n");
    write("bad.trace", "0\n4\nx\n");
  }
  ~CapacityOptions() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Parses a command line and returns what `read` makes of its options.
  template <class Read>
  static auto parse(const std::vector<std::string>& arguments, Read read) {
    io::Program program("test", "", "", [] { return 0; });
    NetworkOptions options;
    options.add_to(program.root());
    EXPECT_EQ(program.run(arguments), 0);
    return read(options);
  }
  static std::expected<NetworkChoice, std::string> resolve(const std::vector<std::string>& arguments) {
    return parse(arguments, [](const NetworkOptions& options) { return options.resolve(); });
  }
  static std::expected<ScriptChoice, std::string> events(const std::vector<std::string>& arguments) {
    return parse(arguments, [](const NetworkOptions& options) { return options.events(); });
  }
  static std::string mistake(const std::vector<std::string>& arguments) {
    const auto choice = resolve(arguments);
    return choice ? "none" : choice.error();
  }

  std::filesystem::path folder_;
};

TEST_F(CapacityOptions, RecogniseBothFormsAndReportTheFormRead) {
  const auto lines = resolve({"--network", path("m.trace")});
  ASSERT_TRUE(lines) << lines.error();
  EXPECT_EQ(lines->description, "recorded capacity " + path("m.trace") +
                                    " (mahimahi), each direction 4.80 Mbit/s over 0.0 s, then from the start again");
  EXPECT_EQ(path_of(lines->link.up).send(Time{1ms}, 100).at, Time{4ms});
  const auto table = resolve({"--network", path("t.csv")});
  ASSERT_TRUE(table) << table.error();
  EXPECT_NE(table->description.find("(table), up 2.40 Mbit/s over 0.0 s, down 4.80 Mbit/s"), std::string::npos)
      << table->description;
  EXPECT_EQ(path_of(table->link.down).send(Time{1ms}, 100).at, Time{4ms});
  EXPECT_EQ(mistake({"--network", path("bad.trace")}),
            path("bad.trace") + ":3:1: t_ms = x: must be a whole number of milliseconds");
}

TEST_F(CapacityOptions, ReplayTheGivenFileInTheProfile) {
  const auto choice = resolve({"--profile", "4g-trace", "--capacity", path("m.trace")});
  ASSERT_TRUE(choice) << choice.error();
  EXPECT_EQ(choice->name, "4g-trace");
  EXPECT_NE(choice->description.find("profile 4g-trace (version 1), recorded capacity " + path("m.trace")),
            std::string::npos);
  EXPECT_EQ(choice->link.up.rate.queue_wait, Duration{1s});
  EXPECT_EQ(path_of(choice->link.up).send(Time{1ms}, 100).at, Time{24ms});
  const auto slower = resolve({"--profile", "4g-trace", "--capacity", path("m.trace"), "--delay", "50"});
  ASSERT_TRUE(slower) << slower.error();
  EXPECT_EQ(path_of(slower->link.up).send(Time{1ms}, 100).at, Time{54ms});
}

TEST_F(CapacityOptions, ReportMissingAndSuperfluousOptions) {
  const std::string missing = mistake({"--profile", "4g-trace"});
  EXPECT_NE(missing.find("name it with --capacity FILE"), std::string::npos) << missing;
  EXPECT_NE(missing.find("direction[up|down],t_ms[ms],opportunities[count]"), std::string::npos) << missing;
  EXPECT_NE(mistake({"--network", "4g-trace"}).find("--capacity FILE"), std::string::npos);
  EXPECT_NE(mistake({"--profile", "4g-trace", "--capacity", path("none")}).find("--capacity: " + path("none")),
            std::string::npos);
  EXPECT_NE(mistake({"--profile", "4g-trace", "--capacity", path("bad.trace")}).find(":3:1: t_ms = x"),
            std::string::npos);
  EXPECT_NE(mistake({"--profile", "4g", "--capacity", path("m.trace")}).find("profile 4g plays no recorded capacity"),
            std::string::npos);
  EXPECT_NE(mistake({"--capacity", path("m.trace")}).find("belongs to --profile"), std::string::npos);
  EXPECT_NE(mistake({"--network", path("m.trace"), "--capacity", path("m.trace")}).find("excludes --capacity"),
            std::string::npos);
}

TEST_F(CapacityOptions, ResolveAFileBesideItsProfile) {
  const std::string own = write(
      "own.textproto", "version: 3\nboth { rate { capacity { file: \"m.trace\" } queue_datagrams: 5 drop: HEAD } }\n");
  const auto choice = resolve({"--profile", own});
  ASSERT_TRUE(choice) << choice.error();
  EXPECT_EQ(choice->link.up.rate.drop, RateSpec::Drop::kHead);
  ASSERT_NE(choice->link.up.rate.trace, nullptr);
  const auto other = resolve({"--profile", own, "--capacity", path("t.csv")});
  ASSERT_TRUE(other) << other.error();
  EXPECT_NE(other->description.find("t.csv"), std::string::npos);
  const std::string lost = write("lost.textproto", "version: 3\nboth { rate { capacity { file: \"gone.trace\" } } }\n");
  EXPECT_NE(mistake({"--profile", lost}).find(path("gone.trace")), std::string::npos) << mistake({"--profile", lost});
}

TEST_F(CapacityOptions, NoteGapsOfARecording) {
  const std::string gap = write("gap.csv", "t_s[s],delay_ms[ms]\n0,1\n0.01,2\n5.01,3\n5.02,4\n");
  const auto choice = resolve({"--network", gap});
  ASSERT_TRUE(choice) << choice.error();
  ASSERT_EQ(choice->notes.size(), 1U);
  EXPECT_EQ(choice->notes[0],
            gap +
                ":3: the recording has 1 gap, the longest of 5 s after this line; through a gap the last "
                "delay stays in force");
}

TEST_F(CapacityOptions, NoteGapsOfARecordingInAScript) {
  write("rtt.csv", "t_s[s],rtt_ms[ms]\n0,1\n0.01,2\n5.01,3\n5.02,4\n");
  const std::string script =
      write("day.textproto",
            "event { at_s: 1 profile: \"rtt.csv\" }\nevent { at_s: 2 profile: \"rtt.csv\" direction: UP }\n");
  const auto read = events({"--delay", "5", "--script", script});
  ASSERT_TRUE(read) << read.error();
  EXPECT_EQ(read->events.size(), 2U);
  ASSERT_EQ(read->notes.size(), 2U) << "once each, though it is played twice";
  EXPECT_EQ(read->notes[0], path("rtt.csv") + ": the recording holds round trips; each direction gets half of them");
  EXPECT_TRUE(read->notes[1].starts_with(path("rtt.csv") + ":3: the recording has 1 gap")) << read->notes[1];
}

TEST_F(CapacityOptions, RejectASuperfluousTraceInterval) {
  const std::string timed = write("timed.csv", "t_s[s],rtt_ms[ms]\n0,1\n1,2\n"),
                    bare = write("bare.csv", "rtt_ms[ms]\n1\n2\n");
  const std::string wrong = "--trace-interval: is for a recording without a column of times";
  for (const std::vector<std::string>& network :
       std::vector<std::vector<std::string>>{{},
                                             {"--delay", "5"},
                                             {"--profile", "lan"},
                                             {"--network", "lan"},
                                             {"--network", timed},
                                             {"--profile", timed},
                                             {"--network", path("m.trace")}}) {
    std::vector<std::string> all = network;
    all.insert(all.end(), {"--trace-interval", "5"});
    EXPECT_TRUE(mistake(all).starts_with(wrong)) << mistake(all);
  }
  const auto good = resolve({"--network", bare, "--trace-interval", "5"});
  ASSERT_TRUE(good) << good.error();
  EXPECT_EQ(good->link.up.trace->period, 10ms);
  // A script may name the recording that uses --trace-interval.
  const std::string names = write("names.textproto", "event { at_s: 1 profile: \"bare.csv\" }\n"),
                    outage = write("outage.textproto", "event { at_s: 1 outage_ms: 5 }\n");
  const std::vector<std::string> with_names{"--delay", "5", "--trace-interval", "5", "--script", names},
      with_outage{"--delay", "5", "--trace-interval", "5", "--script", outage};
  EXPECT_TRUE(resolve(with_names)) << mistake(with_names);
  EXPECT_TRUE(events(with_names)) << events(with_names).error();
  ASSERT_FALSE(events(with_outage));
  EXPECT_TRUE(events(with_outage).error().starts_with(wrong)) << events(with_outage).error();
  EXPECT_TRUE(events({"--network", bare, "--trace-interval", "5", "--script", outage}));
}

TEST(CapacityFile, RecognisesOnlyCapacityFiles) {
  EXPECT_TRUE(looks_like_capacity("12\n13\n"));
  EXPECT_TRUE(looks_like_capacity("direction[a],t_ms[ms],opportunities[count]\n"));
  EXPECT_FALSE(looks_like_capacity("t_s[s],delay_ms[ms]\n0,1\n"));
  EXPECT_FALSE(looks_like_capacity("version: 1\n"));
  EXPECT_FALSE(looks_like_capacity("# 12\n"));
  EXPECT_FALSE(looks_like_capacity(""));
}

}  // namespace
}  // namespace tandem::netsim
