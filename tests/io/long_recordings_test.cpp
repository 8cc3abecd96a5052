// Recordings of several files in `tandem-server recordings`: one lesson, as if they were one file.
#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "common/base/raw_bytes.h"
#include "proto/recording/lesson_reader.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/archive/io/recording_stream.h"
#include "tests/io/programs.h"
#include "tests/netsim/replay/recorded_file.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;
using netsim::test::PartsRecorder;

/// The same session as one file, one.mcap, and in parts, lesson-1.mcap and so on.
struct LongSession {
  Folder folder;
  std::vector<std::string> parts;  ///< names

  explicit LongSession(const std::string& scene = "contact", double seconds = 3, double part_s = 0.8) {
    netsim::SimulationConfig setup;
    setup.scene = *parse_scene(find_shipped_scene(scene)->text, scene + ".textproto");
    setup.seed = 3;
    setup.network.up.floor = setup.network.down.floor = std::chrono::milliseconds(20);
    setup.network.up.loss.probability = 0.05;
    fs::create_directory(folder.file("one"));
    folder.write("one/one.mcap", PartsRecorder{.part_s = 100}.record(setup, seconds).at(0));
    for (const std::string& file : PartsRecorder{.part_s = part_s}.record(setup, seconds)) {
      parts.push_back("lesson-" + std::to_string(parts.size() + 1) + ".mcap");
      folder.write(parts.back(), file);
    }
  }
  [[nodiscard]] std::string path(std::size_t k) const { return folder.file(parts.at(k)); }
};

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
      EXPECT_TRUE(session.folder.read("one-" + format + "/" + name) == session.folder.read("parts-" + format + "/" + name))
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

}  // namespace
}  // namespace tandem::test
