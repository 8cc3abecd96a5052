// `tandem-server recordings` with recordings of real programs: index, exports, deletions with their audit lines.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "server/archive/app/lesson_file.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

Process recordings(Words arguments) {
  arguments.insert(arguments.begin(), "recordings");
  return server(std::move(arguments));
}

/// Runs a session in virtual time. @return whether it left `NAME.mcap` and `NAME.csv` in the folder
bool record(const Folder& folder, const std::string& name, const std::string& scene = "one_axis") {
  Process run({TANDEM_NETSIM, "run", scene, "--duration", "2", "--quiet", "--record", folder.file(name + ".mcap"),
               "--trace", folder.file(name + ".csv")});
  const auto code = run.wait();
  EXPECT_TRUE(code == 0 || code == 1) << run.err();  // 1: the verdict of the short session
  return fs::exists(folder.file(name + ".mcap")) && fs::exists(folder.file(name + ".csv"));
}

TEST(Recordings, ExportTheBytesOfTheTrace) {
  const Folder folder;
  for (const std::string scene : {"one_axis", "contact"}) {
    ASSERT_TRUE(record(folder, scene, scene));
    Process out = recordings({"export", folder.file(scene + ".mcap"), "--to", folder.file("out.csv"), "--overwrite"});
    EXPECT_EQ(out.wait(), 0) << out.err();
    EXPECT_NE(out.err().find("out.csv is complete"), std::string::npos) << out.err();
    EXPECT_TRUE(folder.read("out.csv") == folder.read(scene + ".csv")) << scene << ": the files differ";
  }
}

TEST(Recordings, AreExportedForNoOtherUser) {
  const Folder folder;
  ASSERT_TRUE(record(folder, "a"));
  for (const std::string format : {"csv", "hdf5"}) {
    const std::string to = folder.file("out." + format);
    Process out({"/bin/sh", "-c",
                 "umask 000; exec '" + std::string(TANDEM_SERVER) + "' recordings export '" + folder.file("a.mcap") +
                     "' --to '" + to + "' --format " + format});
    const auto code = out.wait();
    if (format == "hdf5" && code != 0) continue;  // libhdf5 is not installed
    ASSERT_EQ(code, 0) << out.err();
    EXPECT_EQ(static_cast<unsigned>(fs::status(to).permissions()), 0640U) << format << ", as a recording has";
  }
}

TEST(Recordings, AreNotOverwrittenByTheirExport) {
  const Folder folder;
  ASSERT_TRUE(record(folder, "a"));
  const std::string file = folder.file("a.mcap"), bytes = folder.read("a.mcap");
  fs::create_symlink(file, folder.file("link.csv"));
  fs::create_hard_link(file, folder.file("twin.csv"));
  for (const std::string& to : {file, folder.file("link.csv"), folder.file("twin.csv"), folder.file("./a.mcap")})
    for (const std::string format : {"csv", "hdf5"}) {
      Process refused =
          recordings({"export", "a.mcap", "--dir", folder.file(""), "--to", to, "--format", format, "--overwrite"});
      EXPECT_EQ(refused.wait(), 1) << to;
      EXPECT_NE(refused.err().find("is the recording itself; name another file"), std::string::npos) << refused.err();
      EXPECT_TRUE(folder.read("a.mcap") == bytes) << to;
    }
  EXPECT_TRUE(fs::is_symlink(folder.file("link.csv")));
}

TEST(Recordings, AreListedWithDamagedAndForeignFilesNamed) {
  const Folder folder;
  ASSERT_TRUE(record(folder, "a"));
  folder.write("foreign.mcap", "no recording");
  const std::string whole = folder.read("a.mcap");
  folder.write("cut.mcap", whole.substr(0, whole.size() / 2));
  Process text = recordings({"list", "--dir", folder.file("")});
  EXPECT_EQ(text.wait(), 0) << text.err();
  EXPECT_NE(text.out().find("2 recordings"), std::string::npos) << text.out();
  EXPECT_NE(text.out().find("(cut, damaged or repaired)"), std::string::npos) << "the cut file: " << text.out();
  EXPECT_NE(text.out().find("foreign.mcap: skipped, "), std::string::npos) << text.out();
  Process list = recordings({"list", "--dir", folder.file(""), "--json"});
  EXPECT_EQ(list.wait(), 0) << list.err();
  const Json rows = Json::parse(list.out());
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["file"], "a.mcap");
  EXPECT_EQ(rows[0]["complete"], true);
  EXPECT_EQ(rows[0]["missing_ticks"], 0);
  EXPECT_NEAR(rows[0]["duration_s"].get<double>(), 2, 0.1);
  EXPECT_EQ(rows[1]["complete"], false);
  EXPECT_TRUE(rows[2]["problem"].is_string());
  Process show = recordings({"show", "a.mcap", "--dir", folder.file("")});
  EXPECT_EQ(show.wait(), 0) << show.err();
  EXPECT_NE(show.out().find("scene     one_axis"), std::string::npos) << show.out();
  Process unknown = recordings({"show", "b.mcap", "--dir", folder.file("")});
  EXPECT_EQ(unknown.wait(), 2);
  EXPECT_NE(unknown.err().find("did you mean a.mcap?"), std::string::npos) << unknown.err();
}

TEST(Recordings, NeedTheLibraryOfHdf5ForHdf5Only) {
  const Folder folder;
  ASSERT_TRUE(record(folder, "a"));
  folder.write(TANDEM_HDF5_LIBRARY, "no library");
  for (const bool csv : {true, false}) {
    const std::string out = folder.file(csv ? "out.csv" : "out.h5");
    Process run({"/usr/bin/env", "LD_LIBRARY_PATH=" + folder.file(""), TANDEM_SERVER, "recordings", "export",
                 folder.file("a.mcap"), "--to", out});
    EXPECT_EQ(run.wait(), csv ? 0 : 1) << run.err();
    EXPECT_EQ(fs::exists(out), csv);
    EXPECT_EQ(run.err().find("apt install " TANDEM_HDF5_PACKAGE) == std::string::npos, csv) << run.err();
  }
}

/// The lessons of `tandem-netsim score FILE --json -` without the name of the file.
Json scores_of(const std::string& file) {
  Process run({TANDEM_NETSIM, "score", file, "--quiet", "--json", "-"});
  EXPECT_EQ(run.wait(), 0) << run.err();
  Json json = Json::parse(run.out(), nullptr, false);
  EXPECT_EQ(json["lessons"].size(), 1u);
  json["lessons"][0].erase("file");
  return json;
}

TEST(Recordings, HaveEqualScoresInMcapAndHdf5) {
  if (::dlopen(TANDEM_HDF5_LIBRARY, RTLD_LAZY | RTLD_LOCAL) == nullptr)
    GTEST_SKIP() << "libhdf5 is not installed (apt install " TANDEM_HDF5_PACKAGE ")";
  const Folder folder;
  for (const std::string scene : {"one_axis", "contact", "evaluation"}) {
    SCOPED_TRACE(scene);
    Process run({TANDEM_NETSIM, "run", scene, "--duration", "4", "--delay", "10", "--jitter", "3", "--loss", "5",
                 "--quiet", "--no-quality", "--record", folder.file("a.mcap")});
    ASSERT_TRUE(run.wait().has_value()) << run.err();
    Process out = recordings({"export", folder.file("a.mcap"), "--to", folder.file("a.h5")});
    ASSERT_EQ(out.wait(), 0) << out.err();
    const Json recorded = scores_of(folder.file("a.mcap")), exported = scores_of(folder.file("a.h5"));
    EXPECT_EQ(recorded, exported) << Json::diff(recorded, exported).dump();
    const Json& metrics = recorded["lessons"][0]["seats"][0]["parts"][0]["metrics"];
    for (const char* name : {"path_length", "dissipated", "rtt_p50", "loss_up", "gap_up"})
      EXPECT_TRUE(metrics[name]["value"].is_number()) << name << ": " << metrics[name];
    fs::remove(folder.file("a.h5"));
  }
}

TEST(Recordings, AreNotScoredFromHdf5WithoutItsLibraryOrADataset) {
  const Folder folder;
  folder.write("a.h5", std::string("\x89HDF\r\n\x1a\n") + std::string(100, '\0'));
  folder.write(TANDEM_HDF5_LIBRARY, "no library");
  Process without({"/usr/bin/env", "LD_LIBRARY_PATH=" + folder.file(""), TANDEM_NETSIM, "score", folder.file("a.h5")});
  EXPECT_EQ(without.wait(), 2);
  EXPECT_NE(without.err().find("a.h5: HDF5 files need " TANDEM_HDF5_LIBRARY ": apt install " TANDEM_HDF5_PACKAGE),
            std::string::npos)
      << without.err();
  if (::dlopen(TANDEM_HDF5_LIBRARY, RTLD_LAZY | RTLD_LOCAL) == nullptr) GTEST_SKIP() << "libhdf5 is not installed";
  Process damaged({TANDEM_NETSIM, "score", folder.file("a.h5")});
  EXPECT_EQ(damaged.wait(), 2);
  EXPECT_NE(damaged.err().find("a.h5: is no HDF5 file that libhdf5 can open"), std::string::npos) << damaged.err();
}

TEST(Recordings, HaveTheSummaryOfTheirLessonAlsoWhenCut) {
  const Folder folder;
  ASSERT_TRUE(record(folder, "a", "free_motion"));
  const std::string whole = folder.read("a.mcap");
  for (const double share : {1.0, 0.97, 0.6, 0.3}) {
    SCOPED_TRACE(share);
    folder.write("cut.mcap", whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    const auto lesson = server::load_lesson(folder.file("cut.mcap"));
    const auto summary = server::load_summary(folder.file("cut.mcap"));
    ASSERT_TRUE(lesson) << lesson.error();
    ASSERT_TRUE(summary) << summary.error();
    EXPECT_GT(summary->rows, 100u);
    EXPECT_EQ(*summary, server::summary_of(*lesson));
  }
  folder.write("cut.mcap", whole.substr(0, 30));
  EXPECT_EQ(server::load_summary(folder.file("cut.mcap")).error(),
            server::load_lesson(folder.file("cut.mcap")).error());
}

TEST(Recordings, AreDeletedOnlyWithYesAndWithAnAuditLine) {
  const Folder folder, state;
  ASSERT_TRUE(record(folder, "a"));
  fs::copy(folder.file("a.mcap"), folder.file("b.mcap"));
  const std::string keys = state.file("state");
  Process init = server({"init", "--state", keys});
  ASSERT_EQ(init.wait(), 0) << init.err();
  Process dry = recordings({"delete", "a.mcap", "--dir", folder.file("")});
  EXPECT_EQ(dry.wait(), 0) << dry.err();
  EXPECT_NE(dry.out().find("nothing was deleted: repeat with --yes"), std::string::npos) << dry.out();
  EXPECT_TRUE(fs::exists(folder.file("a.mcap")));
  Process without = recordings({"delete", "a.mcap", "--dir", folder.file(""), "--yes", "--state", state.file("none")});
  EXPECT_EQ(without.wait(), 1);
  EXPECT_NE(without.err().find("each deletion needs a line in the audit log of a state folder, and there is none at " +
                               state.file("none") + ". Repeat with --state DIR"),
            std::string::npos)
      << without.err();
  EXPECT_NE(without.err().find("`tandem-server init --state DIR`"), std::string::npos) << without.err();
  EXPECT_TRUE(fs::exists(folder.file("a.mcap")));
  Process gone = recordings({"delete", "a.mcap", "--dir", folder.file(""), "--yes", "--state", keys});
  EXPECT_EQ(gone.wait(), 0) << gone.err();
  EXPECT_FALSE(fs::exists(folder.file("a.mcap")));
  Process retain = recordings({"retain", "--bytes", "1", "--dir", folder.file(""), "--yes", "--state", keys, "--json"});
  EXPECT_EQ(retain.wait(), 0) << retain.err();
  EXPECT_EQ(Json::parse(retain.out())["recordings"][0]["file"], "b.mcap");
  EXPECT_FALSE(fs::exists(folder.file("b.mcap")));
  std::istringstream log(state.read("state/audit.log"));
  std::vector<Json> lines;
  for (std::string line; std::getline(log, line);)
    if (Json entry = Json::parse(line); entry["event"] == "recording_deleted") lines.push_back(std::move(entry));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["name"], "a.mcap");
  EXPECT_TRUE(lines[0]["detail"].get<std::string>().starts_with("on request; "));
  EXPECT_TRUE(lines[1]["detail"].get<std::string>().starts_with("retention; "));
  Process person = recordings({"forget-person", "Ada", "--dir", folder.file(""), "--yes", "--state", keys});
  EXPECT_EQ(person.wait(), 0) << person.err();
  EXPECT_NE(person.err().find("no recording has a person \"Ada\""), std::string::npos) << person.err();
}

TEST(Recordings, HaveTheirLengthInSessionTimeAfterARepair) {
  const Folder folder;
  ASSERT_TRUE(record(folder, "a"));
  const std::string whole = folder.read("a.mcap");
  folder.write("cut.mcap.part", whole.substr(0, whole.size() * 7 / 10));
  Process repair = server({"repair", folder.file("cut.mcap.part")});
  ASSERT_EQ(repair.wait(), 0) << repair.err();
  Process show = recordings({"show", "cut.mcap", "--dir", folder.file(""), "--json"});
  ASSERT_EQ(show.wait(), 0) << show.err();
  const double length = Json::parse(show.out())[0]["duration_s"];
  EXPECT_GT(length, 0.5);
  char text[40];
  std::snprintf(text, sizeof text, ", %.3f s of the session\n", length);
  EXPECT_NE(repair.out().find(text), std::string::npos) << text << " in " << repair.out();
  folder.write("empty.mcap.part", "");
  Process empty = server({"repair", folder.file("empty.mcap.part")});
  EXPECT_EQ(empty.wait(), 1);
  EXPECT_NE(empty.err().find("empty.mcap.part: is empty: "), std::string::npos) << empty.err();
}

TEST(Recordings, AreReplayedLiveFromAFileNotAFolder) {
  const Folder folder;
  Process refused = server({"replay-live", folder.file("")});
  EXPECT_EQ(refused.wait(), 2);
  EXPECT_NE(refused.err().find(folder.file("") + ": is a folder; name a recording"), std::string::npos)
      << refused.err();
}

TEST(Recordings, NameAllMistakesOfTheirArguments) {
  const Folder folder;
  Process wrong = recordings({"export", "--dir", "/no/such", "--to", "/no/such/x", "--fps", "0"});
  EXPECT_EQ(wrong.wait(), 2);
  for (const char* part : {"--dir: \"/no/such\" is no folder", "NAME is required", "--format is required",
                           "--to:", "--fps:", "mistakes, nothing was done"})
    EXPECT_NE(wrong.err().find(part), std::string::npos) << part << " not in " << wrong.err();
  for (const auto& [words, part] : {std::pair<Words, const char*>{{"lst", "--dir", "."}, "did you mean list?"},
                                    {{"list"}, "--dir is required"},
                                    {{"list", "x", "--dir", "."}, "list takes no name"},
                                    {{"retain", "--dir", "."}, "retain needs --days or --bytes"},
                                    {{"retain", "--dir", ".", "--days", "x"}, "--days"},
                                    {{"forget-person", "Ada", "Byron", "--dir", "."}, "quotation marks"},
                                    {{"export", "a", "b", "--one-file", "--to", "x.csv"}, "take one file, not 2"}}) {
    Process process = recordings(words);
    EXPECT_EQ(process.wait(), 2) << words.front();
    EXPECT_NE(process.err().find(part), std::string::npos) << part << " not in " << process.err();
  }
  Process missing = recordings({"export", folder.file("no.mcap"), "--to", folder.file("x.csv")});
  EXPECT_EQ(missing.wait(), 1);
  EXPECT_NE(missing.err().find("no.mcap: No such file"), std::string::npos) << missing.err();
  EXPECT_FALSE(fs::exists(folder.file("x.csv")));
}

}  // namespace
}  // namespace tandem::test
