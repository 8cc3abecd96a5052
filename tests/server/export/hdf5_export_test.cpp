// HDF5 files as other programs read them: h5py (names, attributes, numbers) and Octave (numbers).
#include "server/export/io/hdf5_export.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "server/export/lesson_records.h"
#include "tests/io/programs.h"
#include "tests/support/lesson_run.h"

namespace tandem::server {
namespace {

using test::Json;
using test::Process;

constexpr auto kGoOn = [](double) { return true; };

/// Exports a lesson in memory.
std::string export_hdf5(const Lesson& lesson, const std::string& file, const ExportProgress& progress) {
  WholeLesson whole(lesson);
  return server::export_hdf5(whole, file, progress);
}

/// A lesson with a gap, a link, an event, a mark, a sheet and counts.
Lesson full_lesson() {
  Lesson lesson = test::lesson_of("contact", 6).lesson;
  for (auto* column : {&lesson.tick})
    for (std::size_t k = 3000; k < lesson.rows(); ++k) (*column)[k] += 250;
  lesson.seats[0].person = "Ada";
  lesson.complete = false;
  LessonLink link;
  link.tick = 17;
  link.seat = 1;
  link.rtt_p50_ms = 12.5;
  link.loss_up_percent = 4;
  lesson.links = {link};
  lesson.events = {{9, 9'000'000, "joined", "trainee", "seat trainee joined: é"}};
  lesson.marks = {{1.5, "Ada", "good"}, {2.5, "desk-1", "a longer text"}};
  lesson.sheets = {{"OSATS", "trainee", "Ada", {{"flow", 4}}, true}};
  lesson.counts = {{"/trainer/measured_cp", {100, 2, 3}}};
  return lesson;
}

/// Python that prints all datasets and attributes of a file as JSON; NaN is null.
constexpr const char* kReadAll = R"(
import json, sys, h5py, numpy
def plain(v):
    if isinstance(v, numpy.ndarray): v = v.tolist()
    if isinstance(v, list): return [plain(x) for x in v]
    if isinstance(v, bytes): return v.decode()
    if isinstance(v, numpy.generic): v = v.item()
    return None if v != v else v
out = {}
def visit(name, node):
    out[name] = {'attributes': {k: plain(v) for k, v in node.attrs.items()}}
    if isinstance(node, h5py.Dataset):
        out[name].update(shape=list(node.shape), type=str(node.dtype), rows=[plain(r) for r in node[::1000]])
with h5py.File(sys.argv[1], 'r') as f:
    f.visititems(visit)
    out[''] = {'attributes': {k: plain(v) for k, v in f.attrs.items()}}
print(json.dumps(out))
)";

/// Writes the lesson and reads it with h5py; nullopt if there is no h5py.
std::optional<Json> read_with_h5py(const Lesson& lesson, const std::string& file) {
  Process probe({"/usr/bin/python3", "-c", "import h5py"});
  if (probe.wait() != 0) return std::nullopt;
  EXPECT_EQ(export_hdf5(lesson, file, kGoOn), "");
  Process python({"/usr/bin/python3", "-c", kReadAll, file});
  EXPECT_EQ(python.wait(), 0) << python.err();
  return Json::parse(python.out());
}

TEST(Hdf5Export, IsReadByH5pyWithNamesUnitsAndNumbers) {
  const Lesson lesson = full_lesson();
  const test::Folder folder;
  const auto read = read_with_h5py(lesson, folder.file("lesson.h5"));
  if (!read) GTEST_SKIP() << "python3-h5py is not installed (apt install python3-h5py)";
  const Json& all = *read;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.file("")), {}), 1) << "no temporary file is left";
  ASSERT_GT(lesson.rows(), 5000u);
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) {
    const std::string seat = "seats/" + lesson.scene.seats[i].name;
    SCOPED_TRACE(seat);
    const Json& x = all[seat + "/measured_cp"];
    EXPECT_EQ(x["shape"], (Json{lesson.rows(), 3}));
    EXPECT_EQ(x["type"], "float64");
    EXPECT_EQ(x["attributes"]["unit"], "m");
    EXPECT_EQ(x["attributes"]["frame"], "task");
    EXPECT_EQ(x["attributes"]["columns"], (Json{"x", "y", "z"}));
    EXPECT_FALSE(x["attributes"]["description"].get<std::string>().empty());
    for (std::size_t k = 0; k < x["rows"].size(); ++k) {
      EXPECT_EQ(x["rows"][k], Json(lesson.seats[i].x[1000 * k])) << "bit for bit";
      EXPECT_DOUBLE_EQ(all[seat + "/energy_in"]["rows"][k][0].get<double>(),
                       1e-9 * static_cast<double>(lesson.seats[i].e_in[1000 * k][0]));
    }
    EXPECT_EQ(all[seat + "/energy_in"]["attributes"]["unit"], "J");
    EXPECT_EQ(all[seat + "/alpha"]["shape"], (Json{lesson.rows()}));
  }
  for (const auto& [name, node] : all.items()) {
    const bool numbers =
        node.contains("shape") && name.find('/') != std::string::npos && node["type"].get<std::string>()[0] != '|';
    EXPECT_TRUE(!numbers || node["attributes"].contains("unit")) << name;
  }
  EXPECT_EQ(all["tools/" + lesson.scene.tools[0].name + "/environment_cf"]["attributes"]["unit"], "N");
  EXPECT_EQ(all["session/tick"]["type"], "int64");
  EXPECT_EQ(all["session/tick"]["rows"][0], lesson.tick[0]);
}

TEST(Hdf5Export, StatesGapsNotesLinksAndMetadata) {
  const Lesson lesson = full_lesson();
  const test::Folder folder;
  const auto read = read_with_h5py(lesson, folder.file("lesson.h5"));
  if (!read) GTEST_SKIP() << "python3-h5py is not installed (apt install python3-h5py)";
  const Json& all = *read;
  EXPECT_EQ(all["gaps"]["shape"], (Json{1, 2}));
  EXPECT_EQ(all["gaps"]["rows"][0], (Json{lesson.tick[2999] + 1, 250}));
  EXPECT_EQ(all["links/rtt_p50"]["rows"][0], 0.0125);
  EXPECT_EQ(all["links/rtt_p50"]["attributes"]["unit"], "s");
  EXPECT_EQ(all["links/loss_up"]["rows"][0], 0.04);
  EXPECT_TRUE(all["links/loss_down"]["rows"][0].is_null()) << "unknown is NaN, not 0";
  EXPECT_EQ(all["events/text"]["rows"][0], "seat trainee joined: é");
  EXPECT_EQ(all["marks/text"]["shape"], (Json{2}));
  EXPECT_EQ(all["marks/by"]["rows"][0], "Ada");
  EXPECT_EQ(Json::parse(all["sheets"]["rows"][0].get<std::string>())["scores"]["flow"], 4);
  EXPECT_EQ(all["channels/dropped"]["rows"][0], 2);
  const Json& root = all[""]["attributes"];
  EXPECT_EQ(root["session"], lesson.session);
  EXPECT_EQ(root["complete"], 0);
  EXPECT_EQ(root["tick_hz"], 1000.0);
  EXPECT_EQ(root["start_unix_ns"], lesson.start_unix_ns);
  EXPECT_EQ(all["metadata"]["attributes"]["seed"], "1");
  EXPECT_EQ(all["seats/" + lesson.scene.seats[0].name]["attributes"]["person"], "Ada");
  EXPECT_EQ(all["scene"]["rows"][0], lesson.scene_text);
}

TEST(Hdf5Export, IsReadByOctave) {
  Process probe({"/bin/sh", "-c", "command -v octave-cli"});
  if (probe.wait() != 0) GTEST_SKIP() << "octave is not installed (apt install octave; ./test --full installs it)";
  Lesson lesson = full_lesson();
  for (std::size_t i = 0; i < lesson.scene.seats.size(); ++i) lesson.scene.seats[i].name = "hand" + std::to_string(i);
  const test::Folder folder;
  const std::string file = folder.file("lesson.h5");
  ASSERT_EQ(export_hdf5(lesson, file, kGoOn), "");
  Process octave({"/usr/bin/env", "octave-cli", "--no-init-file", "--quiet", "--eval",
                  "s = load('" + file +
                      "'); x = s.seats.hand0.measured_cp; if (rows(x) == 3) x = x'; end; printf('%d %d\\n', size(x)); "
                      "printf('%.17g %.17g %.17g\\n', x(1:1000:end, :)'); printf('%d\\n', s.session.tick(end)); "
                      "printf('%.17g\\n', s.links.rtt_p50)"});
  ASSERT_EQ(octave.wait(), 0) << octave.err();
  std::istringstream out(octave.out());
  std::size_t rows = 0, columns = 0;
  out >> rows >> columns;
  EXPECT_EQ(rows, lesson.rows());
  EXPECT_EQ(columns, 3u);
  for (std::size_t k = 0; k < rows; k += 1000)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double value = NAN;
      out >> value;
      EXPECT_EQ(value, lesson.seats[0].x[k][axis]) << k;
    }
  std::uint32_t last = 0;
  double rtt = 0;
  out >> last >> rtt;
  EXPECT_EQ(last, lesson.tick.back());
  EXPECT_EQ(rtt, 0.0125);
}

TEST(Hdf5Export, WritesALessonWithoutGapsLinksOrNotes) {
  const Lesson lesson = test::lesson_of("one_axis", 1).lesson;
  const test::Folder folder;
  const auto read = read_with_h5py(lesson, folder.file("lesson.h5"));
  if (!read) GTEST_SKIP() << "python3-h5py is not installed (apt install python3-h5py)";
  EXPECT_EQ((*read)["gaps"]["shape"], (Json{0, 2}));
  EXPECT_EQ((*read)["links/tick"]["shape"], (Json{0}));
  EXPECT_EQ((*read)["events/text"]["shape"], (Json{0}));
}

TEST(Hdf5Export, LeavesNothingWhenInterruptedOrTheDiskIsFull) {
  const Lesson lesson = test::lesson_of("one_axis", 1).lesson;
  const test::Folder folder;
  const std::string file = folder.file("lesson.h5");
  int calls = 0;
  EXPECT_EQ(export_hdf5(lesson, file, [&calls](double) { return ++calls < 5; }), kExportInterrupted);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
  // Files may have at most 50 kB here: libhdf5 meets the error while it writes, as on a full disk.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{50'000, before.rlim_max};
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string problem = export_hdf5(lesson, file, kGoOn);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(problem.find("larger than allowed here"), std::string::npos) << problem;
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
  EXPECT_EQ(export_hdf5(lesson, folder.file("no/lesson.h5"), kGoOn).find(folder.file("no/lesson.h5")), 0u);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

TEST(Hdf5Export, RefusesMetadataThatTheFormatCannotHold) {
  Lesson lesson = test::lesson_of("one_axis", 0.2).lesson;
  lesson.metadata["note"] = std::string(70'000, 'x');
  const test::Folder folder;
  const std::string problem = export_hdf5(lesson, folder.file("lesson.h5"), kGoOn);
  EXPECT_NE(problem.find("attribute note of /metadata has 70000 bytes"), std::string::npos) << problem;
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

}  // namespace
}  // namespace tandem::server
