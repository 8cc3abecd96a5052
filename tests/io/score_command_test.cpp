// `tandem-netsim score` as users start it: tables, files, mistakes, and what it costs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/io/programs.h"

namespace tandem {
namespace {

using test::Folder;
using test::Process;

Process score(test::Words arguments) {
  arguments.insert(arguments.begin(), {TANDEM_NETSIM, "score"});
  return Process(std::move(arguments));
}
int code_of(Process& process) {
  std::optional<int> code;
  for (int attempt = 0; attempt < 10 && !(code = process.wait()); ++attempt) {
  }
  return code.value_or(-1000);
}
/// Writes the trace of a scene. @return its file
std::string trace(const Folder& folder, const std::string& name, const std::string& scene, const std::string& seconds,
                  const std::string& seed = "1") {
  Process run({TANDEM_NETSIM, "run", scene, "--duration", seconds, "--seed", seed, "--quiet", "--no-quality", "--trace",
               folder.file(name)});
  EXPECT_EQ(code_of(run), 0) << run.err();
  return folder.file(name);
}

TEST(ScoreCommand, WritesTablesJsonCsvAndAReport) {
  const Folder folder;
  const std::string file = trace(folder, "a.csv", "contact", "6");
  Process process = score({file, "--scene", "contact", "--json", folder.file("a.json"), "--csv", folder.file("b.csv"),
                           "--html", folder.file("a.html")});
  ASSERT_EQ(code_of(process), 0) << process.err();
  EXPECT_NE(process.out().find("Path length [mm]"), std::string::npos);
  EXPECT_NE(process.out().find("held:trainer"), std::string::npos);
  EXPECT_TRUE(process.out().ends_with("report for the learner: " + folder.file("a.html") + "\n"));
  const auto json = nlohmann::json::parse(folder.read("a.json"));
  ASSERT_EQ(json["lessons"].size(), 1u);
  EXPECT_EQ(json["lessons"][0]["seats"].size(), 2u);
  const auto& metrics = json["lessons"][0]["seats"][0]["parts"][0]["metrics"];
  EXPECT_NEAR(metrics["time"]["value"].get<double>(), 6, 0.01);
  EXPECT_GT(metrics["contact_force_peak"]["value"].get<double>(), 0.5);
  EXPECT_NE(folder.read("b.csv").find(",trainer,instructor,whole,path_length,m,"), std::string::npos);
  EXPECT_NE(folder.read("a.html").find("</html>"), std::string::npos);
}

TEST(ScoreCommand, ReplacesAReportOnlyOnRequest) {
  const Folder folder;
  const std::string file = trace(folder, "a.csv", "contact", "0.5"), report = folder.write("a.html", "old");
  Process refused = score({file, "--scene", "contact", "--quiet", "--html", report});
  EXPECT_EQ(code_of(refused), 2);
  EXPECT_NE(refused.err().find("--html: " + report +
                               " exists already; choose another name, or replace it with "
                               "--overwrite"),
            std::string::npos)
      << refused.err();
  EXPECT_EQ(folder.read("a.html"), "old");
  Process replaced = score({file, "--scene", "contact", "--quiet", "--html", report, "--overwrite"});
  EXPECT_EQ(code_of(replaced), 0) << replaced.err();
  EXPECT_NE(folder.read("a.html").find("</html>"), std::string::npos);
}

TEST(ScoreCommand, GivesARecordingTheScoresOfItsTrace) {
  const Folder folder;
  Process run({TANDEM_NETSIM, "run", "evaluation", "--duration", "12", "--delay", "10", "--jitter", "2", "--quiet",
               "--no-quality", "--trace", folder.file("a.csv"), "--record", folder.file("a.mcap")});
  ASSERT_EQ(code_of(run), 0) << run.err();
  Process process = score({folder.file("a.mcap"), folder.file("a.csv"), "--scene", "evaluation", "--json", "-"});
  ASSERT_EQ(code_of(process), 0) << process.err();
  const auto json = nlohmann::json::parse(process.out());
  const auto &recording = json["lessons"][0]["seats"], &trace_seats = json["lessons"][1]["seats"];
  ASSERT_EQ(recording.size(), 4u);
  ASSERT_EQ(trace_seats.size(), 4u);
  std::size_t compared = 0;
  for (std::size_t s = 0; s < recording.size(); ++s) {
    ASSERT_EQ(recording[s]["parts"].size(), trace_seats[s]["parts"].size());
    for (std::size_t p = 0; p < recording[s]["parts"].size(); ++p)
      for (const auto& [key, metric] : trace_seats[s]["parts"][p]["metrics"].items()) {
        const auto& other = recording[s]["parts"][p]["metrics"][key];
        if (metric["value"].is_null() || other["value"].is_null()) continue;
        // A trace has nine decimals.
        EXPECT_NEAR(metric["value"].get<double>(), other["value"].get<double>(),
                    1e-5 * std::abs(other["value"].get<double>()) + 1e-6)
            << recording[s]["seat"] << " " << recording[s]["parts"][p]["part"] << " " << key;
        ++compared;
      }
  }
  EXPECT_GT(compared, 500u);
  EXPECT_FALSE(recording[0]["parts"][0]["metrics"]["dissipated"]["value"].is_null()) << "only a recording has accounts";
}

TEST(ScoreCommand, ComparesALearnerWithExperts) {
  const Folder folder;
  std::filesystem::create_directory(folder.file("experts"));
  for (const std::string seed : {"1", "2", "3"}) trace(folder, "experts/e" + seed + ".csv", "one_axis", "3", seed);
  const std::string first = trace(folder, "l1.csv", "one_axis", "3", "4"),
                    second = trace(folder, "l2.csv", "one_axis", "3", "5");
  Process process =
      score({"--experts", folder.file("experts"), "--learner", first, second, "--scene", "one_axis", "--json", "-"});
  ASSERT_EQ(code_of(process), 0) << process.err();
  const auto json = nlohmann::json::parse(process.out());
  EXPECT_EQ(json["experts"]["recordings"], 3);
  ASSERT_FALSE(json["experts"]["curves"].empty());
  EXPECT_EQ(json["experts"]["curves"][0]["sessions"].size(), 2u);
  EXPECT_NE(process.err().find("against 3 expert recordings, and over 2 sessions"), std::string::npos);
}

TEST(ScoreCommand, SaysWhatAForeignFileIsNot) {
  const Folder folder;
  folder.write("empty.mcap", "");
  folder.write("letter.txt", "Dear Ada,\nhello\n");
  folder.write("picture.png", std::string("\x89PNG\r\n\x1a\n\0\0", 10));
  Process process = score({folder.file("empty.mcap"), folder.file("letter.txt"), folder.file("picture.png")});
  EXPECT_EQ(code_of(process), 2);
  for (const std::string part :
       {"empty.mcap: is empty; scores are computed from a recording (MCAP)",
        "letter.txt: is no table: its first line has no name[unit]", "picture.png: is a binary file of another kind"})
    EXPECT_NE(process.err().find(part), std::string::npos) << part << " in " << process.err();
}

TEST(ScoreCommand, SkipsForeignFilesOfAFolder) {
  const Folder folder;
  std::filesystem::create_directory(folder.file("lessons"));
  trace(folder, "lessons/b.csv", "contact", "1");
  folder.write("lessons/a.mcap", "no recording\n");
  Process process = score({folder.file("lessons"), "--scene", "contact", "--json", "-"});
  EXPECT_EQ(code_of(process), 0) << process.err();
  const auto json = nlohmann::json::parse(process.out());
  EXPECT_EQ(json["lessons"].size(), 1u);
  EXPECT_NE(json["notes"].dump().find("skipped: " + folder.file("lessons/a.mcap") + ": is no table"), std::string::npos)
      << json["notes"];
  EXPECT_NE(process.err().find("lessons/a.mcap: is no table"), std::string::npos) << process.err();
  std::filesystem::remove(folder.file("lessons/b.csv"));
  Process foreign = score({folder.file("lessons"), "--scene", "contact"});
  EXPECT_EQ(code_of(foreign), 2) << "no other file of the folder has scores";
}

TEST(ScoreCommand, NamesEveryMistakeAtOnce) {
  const Folder folder;
  const std::string file = trace(folder, "a.csv", "contact", "0.5");
  std::ofstream(folder.file("bad.csv")) << "tick[1],trainer.x[m],trainer.y[m],trainer.z[m]\n0,1,two,3\n";
  std::filesystem::create_directory(folder.file("empty"));
  Process none = score({});
  EXPECT_EQ(code_of(none), 2);
  EXPECT_NE(none.err().find("at least one recording is needed"), std::string::npos) << none.err();
  Process sceneless = score({file});
  EXPECT_EQ(code_of(sceneless), 2);
  EXPECT_NE(sceneless.err().find("a trace does not contain its scene; name it with --scene SCENE"), std::string::npos)
      << sceneless.err();
  Process wrong = score({file, folder.file("bad.csv"), folder.file("missing.csv"), "--scene", "contact", "--experts",
                         folder.file("empty"), "--seat", "trainor"});
  EXPECT_EQ(code_of(wrong), 2);
  for (const char* part : {"bad.csv:2: column trainer.y[m]: \"two\" is not a number", "missing.csv: No such file",
                           "empty: the folder has no recording", "did you mean trainer?"})
    EXPECT_NE(wrong.err().find(part), std::string::npos) << part << "\n" << wrong.err();
  Process outputs = score({file, "--scene", "contact", "--json", "same", "--csv", "same", "--hands", "left"});
  EXPECT_EQ(code_of(outputs), 2);
  for (const char* part : {"--csv: is the same file as --json", "--hands left: must be two seats"})
    EXPECT_NE(outputs.err().find(part), std::string::npos) << part << "\n" << outputs.err();
  Process other_scene = score({file, "--scene", "two_by_two"});
  EXPECT_EQ(code_of(other_scene), 2);
  EXPECT_NE(other_scene.err().find("name the scene of this trace with --scene"), std::string::npos)
      << other_scene.err();
}

TEST(ScoreCommand, WritesOntoNoneOfItsInputs) {
  const Folder folder;
  const std::string file = trace(folder, "a.csv", "contact", "0.5"), bytes = folder.read("a.csv");
  std::filesystem::create_symlink(file, folder.file("link"));
  std::filesystem::copy_file(file, folder.file("other.csv"));
  const std::string other = folder.file("other.csv");
  for (const char* option : {"--json", "--csv", "--html"})
    for (const std::string& output : {file, folder.file("link"), folder.file("./a.csv")})
      for (const test::Words& inputs :
           {test::Words{file}, test::Words{"--learner", file}, test::Words{other, "--experts", file}}) {
        test::Words words = inputs;
        words.insert(words.end(), {"--scene", "contact", "--quiet", option, output});
        Process refused = score(words);
        EXPECT_EQ(code_of(refused), 2) << option << " " << output;
        EXPECT_NE(refused.err().find(std::string(option) + ": " + output + " is an input; name another file"),
                  std::string::npos)
            << refused.err();
        EXPECT_TRUE(folder.read("a.csv") == bytes) << option << " " << output;
      }
}

TEST(ScoreCommand, ReportsAnOutputThatCannotBeWritten) {
  const Folder folder;
  const std::string file = trace(folder, "a.csv", "contact", "0.5");
  Process process = score({file, "--scene", "contact", "--quiet", "--json", "/dev/full"});
  EXPECT_EQ(code_of(process), 1);
  EXPECT_NE(process.err().find("/dev/full"), std::string::npos) << process.err();
}

/// Instructions of scoring a file, by callgrind; 0: it failed.
double instructions(const Folder& folder, const std::string& file) {
  const std::string counts = folder.file("callgrind.out");
  Process process({"/usr/bin/env", "valgrind", "--tool=callgrind", "--callgrind-out-file=" + counts, TANDEM_NETSIM,
                   "score", file, "--scene", "contact", "--quiet"});
  if (code_of(process) != 0) return 0;
  std::ifstream in(counts);
  for (std::string line; std::getline(in, line);)
    for (const std::string key : {"totals: ", "summary: "})
      if (line.starts_with(key)) return std::atof(line.c_str() + key.size());
  return 0;
}

TEST(ScoreCommand, CostsAtMostFiveSecondsForTenMinutesOfThreeSeats) {
  if (std::system("valgrind --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "valgrind is not installed";
  if (!std::string(TANDEM_SANITIZED).empty()) GTEST_SKIP() << "callgrind does not run under sanitizers";
  const Folder folder;
  const double shorter = instructions(folder, trace(folder, "a.csv", "contact", "4"));
  const double longer = instructions(folder, trace(folder, "b.csv", "contact", "8"));
  ASSERT_GT(shorter, 0);
  // Two seats; the difference leaves out the start of the program. 10 min of 3 seats are 1.8 million seat-ticks. A
  // processor with 2.5 instructions per cycle at 2.8 GHz executes 7e9 per second.
  const double per_seat_tick = (longer - shorter) / 8000, total = per_seat_tick * 1.8e6;
  std::printf("[  figures ] scores: %.0f instructions per seat and tick, %.1f s for 10 min of 3 seats at 7e9/s\n",
              per_seat_tick, total / 7e9);
  EXPECT_LE(total / 7e9, 5);
  EXPECT_GT(per_seat_tick, 500) << "else nothing was scored";
}

}  // namespace
}  // namespace tandem
