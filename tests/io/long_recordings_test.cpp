// Recordings of several files in `tandem-server recordings`: one lesson, as if they were one file.
#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "common/base/raw_bytes.h"
#include "proto/recording/lesson_reader.h"
#include "server/app/commands/run_scores.h"
#include "server/archive/io/recording_stream.h"
#include "tests/io/long_session.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

Process export_of(Words arguments) {
  arguments.insert(arguments.begin(), {"recordings", "export"});
  return server(std::move(arguments));
}

void expect_exported(Words arguments) {
  Process run = export_of(std::move(arguments));
  EXPECT_EQ(run.wait(), 0) << run.err();
}

TEST(LongRecordings, AreReadPieceByPieceAsInOneGo) {
  const LongSession session("two_by_two", 6, 4.5);
  ASSERT_EQ(session.parts.size(), 2u);
  LessonReader reader;
  std::vector<std::string> files;
  for (std::size_t k = 0; k < session.parts.size(); ++k) {
    ASSERT_TRUE(reader.add(bytes_of(session.folder.read(session.parts[k]))));
    files.push_back(session.path(k));
  }
  const Lesson whole = reader.take();
  const auto stream = server::RecordingStream::open(files, [](double) { return true; });
  ASSERT_TRUE(stream) << stream.error();
  const Lesson& head = (*stream)->head();
  EXPECT_EQ((*stream)->extent(), extent_of(whole));
  EXPECT_EQ(head.rows(), 0u);
  EXPECT_TRUE(head.complete);
  EXPECT_EQ(head.events.size(), whole.events.size());
  EXPECT_EQ(head.links.size(), whole.links.size());
  for (const ToolSpec& tool : whole.scene.tools) EXPECT_EQ(head.counts.at("/" + tool.name).recorded, whole.rows());
  std::size_t at = 0, pieces = 0, largest = 0;
  for (;; ++pieces) {
    const auto piece = (*stream)->next();
    ASSERT_TRUE(piece) << piece.error();
    if (*piece == nullptr) break;
    const Lesson& rows = **piece;
    largest = std::max(largest, rows.rows());
    for (std::size_t row = 0; row < rows.rows(); ++row, ++at) {
      ASSERT_EQ(rows.tick[row], whole.tick[at]);
      ASSERT_EQ(rows.time_ns[row], whole.time_ns[at]);
      for (std::size_t i = 0; i < whole.seats.size(); ++i) {
        ASSERT_EQ(rows.seats[i].fresh[row], whole.seats[i].fresh[at]) << "row " << at << " seat " << i;
        ASSERT_EQ(rows.seats[i].x[row], whole.seats[i].x[at]);
        ASSERT_EQ(rows.seats[i].e_out[row], whole.seats[i].e_out[at]);
      }
      ASSERT_EQ(rows.tools[1].alpha[row], whole.tools[1].alpha[at]);
    }
  }
  EXPECT_EQ(at, whole.rows());
  EXPECT_GE(pieces, 3u);
  EXPECT_LE(largest, 4100u) << "8 chunks of 500 ms";
}

TEST(LongRecordings, ExportTheBytesOfOneFileAsCsv) {
  const LongSession session;
  ASSERT_GE(session.parts.size(), 3u);
  expect_exported({session.folder.file("one/one.mcap"), "--to", session.folder.file("one.csv")});
  const std::string one = session.folder.read("one.csv");
  EXPECT_GT(one.size(), 100'000u);
  for (std::size_t k = 0; k < session.parts.size(); ++k) {  // each part finds the others
    const std::string out = "parts" + std::to_string(k) + ".csv";
    expect_exported({session.parts[k], "--dir", session.folder.file(""), "--to", session.folder.file(out)});
    EXPECT_TRUE(session.folder.read(out) == one) << "named: " << session.parts[k];
  }
  Words all;
  for (std::size_t k = session.parts.size(); k-- > 0;) all.push_back(session.path(k));
  all.insert(all.end(), {"--to", session.folder.file("all.csv")});
  expect_exported(all);
  EXPECT_TRUE(session.folder.read("all.csv") == one) << "in another order";
}

TEST(LongRecordings, ExportTheDataSetOfOneFile) {
  Process probe({"/bin/sh", "-c", "command -v node"});
  if (probe.wait() != 0) GTEST_SKIP() << "Node.js is not installed (apt install nodejs)";
  const LongSession session("free_motion");
  for (const std::string format : {"lerobot-v2.1", "lerobot-v3.0"}) {
    const std::string one = session.folder.file("one-" + format), parts = session.folder.file("parts-" + format);
    expect_exported({session.folder.file("one/one.mcap"), "--to", one, "--format", format});
    expect_exported({session.path(1), session.path(0), "--to", parts, "--format", format});
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(one)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = entry.path().lexically_relative(one).string();
      EXPECT_TRUE(session.folder.read("one-" + format + "/" + name) ==
                  session.folder.read("parts-" + format + "/" + name))
          << name;
      ++files;
    }
    EXPECT_GE(files, 5u);
  }
}

/// Python that compares two files of HDF5: names, numbers, types and attributes. Channels of seats have a message more
/// where a file begins, so that only the sums of their accounts are equal.
constexpr const char* kCompare = R"(
import sys, h5py, numpy
a, b = h5py.File(sys.argv[1], 'r'), h5py.File(sys.argv[2], 'r')
def names(f):
    out = []
    f.visit(out.append)
    return out
def same(x, y):
    x, y = numpy.asarray(x), numpy.asarray(y)
    return x.shape == y.shape and x.dtype == y.dtype and numpy.array_equal(x, y, equal_nan=x.dtype.kind == 'f')
assert names(a) == names(b), 'names'
sets = 0
for name in names(a) + ['/']:
    for key in set(a[name].attrs) | set(b[name].attrs):
        assert same(a[name].attrs[key], b[name].attrs[key]), (name, key)
    if isinstance(a[name], h5py.Dataset) and name not in ('channels/recorded', 'channels/never_received'):
        assert same(a[name][()], b[name][()]), name
        sets += 1
ticks = lambda f: f['channels/recorded'][()] + f['channels/dropped'][()] + f['channels/never_received'][()]
assert same(ticks(a), ticks(b)), 'accounts'
print(sets)
)";

TEST(LongRecordings, ExportTheNumbersOfOneFileAsHdf5) {
  Process probe({"/usr/bin/python3", "-c", "import h5py"});
  if (probe.wait() != 0) GTEST_SKIP() << "python3-h5py is not installed (apt install python3-h5py)";
  const LongSession session("contact", 6);
  expect_exported({session.folder.file("one/one.mcap"), "--to", session.folder.file("one.h5")});
  expect_exported({session.path(0), "--to", session.folder.file("parts.h5")});
  Process compare({"/usr/bin/python3", "-c", kCompare, session.folder.file("one.h5"), session.folder.file("parts.h5")});
  EXPECT_EQ(compare.wait(), 0) << compare.err();
  EXPECT_GT(std::atoi(compare.out().c_str()), 50) << compare.out();
}

TEST(LongRecordings, NameTheMissingPartAndExportOneFileOnRequest) {
  const LongSession session;
  fs::remove(session.path(1));
  const std::string out = session.folder.file("a.csv");
  for (const std::size_t named : {0u, 2u}) {
    Process refused = export_of({session.path(named), "--to", out});
    EXPECT_EQ(refused.wait(), 1);
    EXPECT_NE(refused.err().find("part 2 of the recording is missing, lesson-2.mcap"), std::string::npos)
        << refused.err();
    EXPECT_NE(refused.err().find("repeat with --one-file"), std::string::npos) << refused.err();
    EXPECT_FALSE(fs::exists(out));
  }
  expect_exported({session.path(2), "--one-file", "--to", out});
  const std::string rows = session.folder.read("a.csv");
  const auto part = read_lesson(bytes_of(session.folder.read(session.parts[2])));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(rows, '\n')), part->rows() + 1);
  Process two = export_of({session.path(0), session.path(2), "--one-file", "--to", session.folder.file("b.csv")});
  EXPECT_EQ(two.wait(), 2);
  EXPECT_NE(two.err().find("csv and hdf5 with --one-file take one file, not 2"), std::string::npos) << two.err();
}

TEST(LongRecordings, AreReplayedLiveWholeOrNotAtAll) {
  const LongSession session;
  double end_s = 0;  // of the last part
  for (const std::string& part : session.parts) {
    const auto lesson = read_lesson(bytes_of(session.folder.read(part)));
    ASSERT_TRUE(lesson);
    end_s = std::max(end_s, static_cast<double>(lesson->tick.back()) / lesson->scene.tick_hz);
  }
  Process replay = server({"replay-live", session.path(1)});
  ASSERT_TRUE(replay.wait_for("listening on")) << replay.err();
  ASSERT_TRUE(replay.wait_for("Ctrl-C ends")) << replay.err();
  const std::string duration = replay.after("scene contact, ");
  EXPECT_NEAR(std::atof(duration.c_str()), end_s, 0.01) << replay.out();
  replay.signal(SIGTERM);
  static_cast<void>(replay.wait());

  fs::remove(session.path(1));
  Process refused = server({"replay-live", session.path(0)});
  EXPECT_EQ(refused.wait(), 2);
  EXPECT_NE(refused.err().find("part 2 of the recording is missing, lesson-2.mcap"), std::string::npos)
      << refused.err();
}

TEST(LongRecordings, OfTwoSessionsAreNoSingleTable) {
  const LongSession session;
  const std::string other = session.folder.file("one/other.mcap");
  Process run({TANDEM_NETSIM, "run", "one_axis", "--duration", "0.5", "--quiet", "--record", other});
  ASSERT_TRUE(run.wait().has_value()) << run.err();
  Process two = export_of({session.path(0), other, session.path(1), "--to", session.folder.file("a.csv")});
  EXPECT_EQ(two.wait(), 2);
  EXPECT_NE(two.err().find("csv and hdf5 take one recording, not 2"), std::string::npos) << two.err();
}

TEST(LongRecordings, ExportOverAFileOnlyOnRequest) {
  const LongSession session("one_axis", 1, 100);
  const std::string out = session.folder.write("a.csv", "old");
  Process refused = export_of({session.path(0), "--to", out});
  EXPECT_EQ(refused.wait(), 2);
  EXPECT_NE(refused.err().find("a.csv exists already; choose another name, or replace it with --overwrite"),
            std::string::npos)
      << refused.err();
  EXPECT_EQ(session.folder.read("a.csv"), "old");
  expect_exported({session.path(0), "--to", out, "--overwrite"});
  EXPECT_GT(session.folder.read("a.csv").size(), 1000u);
}

Process recordings_of(const LongSession& session, Words arguments) {
  arguments.insert(arguments.begin(), "recordings");
  arguments.insert(arguments.end(), {"--dir", session.folder.file("")});
  return server(std::move(arguments));
}

TEST(LongRecordings, AreListedAndShownTogether) {
  const LongSession session;
  Process list = recordings_of(session, {"list"});
  EXPECT_EQ(list.wait(), 0) << list.err();
  EXPECT_NE(list.out().find("(part 2)"), std::string::npos) << list.out();
  const std::string files = std::to_string(session.parts.size() + 1);
  EXPECT_NE(list.out().find("2 recordings, " + files + " files, "), std::string::npos) << list.out();
  EXPECT_EQ(list.out().find("is missing"), std::string::npos) << list.out();
  fs::remove(session.path(0));
  Process damaged = recordings_of(session, {"list"});
  EXPECT_EQ(damaged.wait(), 0) << damaged.err();
  EXPECT_NE(damaged.out().find("part 1 of the recording is missing, lesson-1.mcap: lesson-2.mcap is part 2"),
            std::string::npos)
      << damaged.out();
  Process show = recordings_of(session, {"show", "lesson-2.mcap"});
  EXPECT_EQ(show.wait(), 0) << show.err();
  EXPECT_NE(show.out().find("part      2 of a recording of "), std::string::npos) << show.out();
  EXPECT_NE(show.out().find("missing   part 1"), std::string::npos) << show.out();
  Process json = recordings_of(session, {"show", "lesson-2.mcap", "--json"});
  EXPECT_EQ(json.wait(), 0) << json.err();
  EXPECT_EQ(Json::parse(json.out())[0]["part"], 2);
}

TEST(LongRecordings, NameTheFilesThatStayWhenOneIsDeleted) {
  const LongSession session;
  const Folder state;
  Process init = server({"init", "--state", state.file("s")});
  ASSERT_EQ(init.wait(), 0) << init.err();
  Process dry = recordings_of(session, {"delete", "lesson-2.mcap"});
  EXPECT_EQ(dry.wait(), 0) << dry.err();
  EXPECT_NE(dry.err().find("lesson-2.mcap: only a part of a recording of "), std::string::npos) << dry.err();
  EXPECT_NE(dry.err().find("would stay: lesson-1.mcap, lesson-3.mcap"), std::string::npos) << dry.err();
  Process one = recordings_of(session, {"delete", "lesson-2.mcap", "--yes", "--state", state.file("s")});
  EXPECT_EQ(one.wait(), 0) << one.err();
  EXPECT_NE(one.err().find("The others stay: lesson-1.mcap, lesson-3.mcap"), std::string::npos) << one.err();
  EXPECT_TRUE(fs::exists(session.path(0)));
  EXPECT_FALSE(fs::exists(session.path(1)));
  Words all{"delete", "--yes", "--state", state.file("s"), "lesson-1.mcap"};
  for (std::size_t k = 2; k < session.parts.size(); ++k) all.push_back(session.parts[k]);
  Process rest = recordings_of(session, all);
  EXPECT_EQ(rest.wait(), 0) << rest.err();
  EXPECT_EQ(rest.err().find("only a part"), std::string::npos) << rest.err();
}

TEST(LongRecordings, HaveTheScoresOfOneFileInTheReportOfTheirSession) {
  const LongSession session("contact", 6, 2);
  const auto scores = [&](const std::string& recording) {
    const std::string report = session.folder.write("report.json", "{}");
    EXPECT_EQ(server::add_scores(recording, report, true), "");
    return Json::parse(session.folder.read("report.json"))["scores"];
  };
  const Json one = scores(session.folder.file("one/one.mcap")), parts = scores(session.path(0));
  EXPECT_TRUE(one.is_object() || one.is_array()) << one;
  EXPECT_EQ(one, parts) << Json::diff(one, parts).dump();
  fs::remove(session.path(1));
  const std::string report = session.folder.write("report.json", "{}");
  const std::string problem = server::add_scores(session.path(0), report, true);
  EXPECT_EQ(problem.find("--scores: part 2 of the recording is missing"), 0u) << problem;
  EXPECT_EQ(session.folder.read("report.json"), "{}");
}

}  // namespace
}  // namespace tandem::test
