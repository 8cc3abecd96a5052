// HDF5 files of lessons, read back: equal to the exported lesson; damaged and foreign files.
#include "server/export/io/hdf5_import.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <bit>
#include <cmath>

#include "common/base/rng.h"
#include "proto/text/scene_bytes.h"
#include "server/export/io/hdf5_export.h"
#include "server/export/io/hdf5_file.h"
#include "server/export/io/hdf5_id.h"
#include "server/export/lesson_signals.h"
#include "tests/common/base/counts.h"
#include "tests/io/programs.h"
#include "tests/support/lesson_run.h"

namespace tandem::server {
namespace {

constexpr auto kGoOn = [](double) { return true; };

/// Exports a lesson in memory.
std::string export_hdf5(const Lesson& lesson, const std::string& file, const ExportProgress& progress) {
  WholeLesson whole(lesson);
  return server::export_hdf5(whole, file, progress);
}
constexpr const char* kNoLibrary = "libhdf5 is not installed (apt install " TANDEM_HDF5_PACKAGE ")";

/// A lesson with a gap, links, an event, a mark, a sheet, counts and a scheduled end of its own.
Lesson lesson_with_notes(const std::string& scene, double duration_s) {
  Lesson lesson = test::lesson_of(scene, duration_s).lesson;
  lesson.scene_text = scene_file_text(lesson.scene);
  for (std::size_t k = lesson.rows() / 2; k < lesson.rows(); ++k) lesson.tick[k] += 250;
  lesson.scene.duration = 17.25;
  lesson.seats[0].person = "Ada";
  lesson.complete = false;
  LessonLink link;
  link.rtt_p50_ms = 12.3456789;
  link.loss_up_percent = 1.0 / 3;
  for (std::uint32_t k = 0; k < 2; ++k) {
    link.tick = 17 + k;
    link.gate_trips = 3 + k;
    lesson.links.push_back(link);
  }
  lesson.events = {{9, 9'000'000, "joined", lesson.scene.seats[0].name, "the seat joined: é"}};
  lesson.marks = {{1.5, "Ada", "good"}, {2.5, "desk-1", "a longer text"}};
  lesson.sheets = {{"OSATS", lesson.scene.seats[0].name, "Ada", {{"flow", 4}}, true}};
  lesson.counts = {{"/trainer/measured_cp", {100, 2, 3}}};
  return lesson;
}

/// All numbers of a signal, real ones as their bits, so that NaN equals NaN.
std::vector<std::int64_t> bits_of(const LessonSignal& signal, std::size_t rows) {
  std::vector<std::int64_t> out;
  std::vector<double> real(signal.width());
  std::vector<std::int64_t> whole(signal.width());
  for (std::size_t row = 0; row < rows; ++row) {
    if (signal.real) {
      signal.real(row, real);
      for (const double value : real) out.push_back(std::bit_cast<std::int64_t>(value));
    } else {
      signal.whole(row, whole);
      out.insert(out.end(), whole.begin(), whole.end());
    }
  }
  return out;
}

void expect_equal_notes(const Lesson& a, const Lesson& b) {
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t k = 0; k < a.links.size(); ++k) {
    EXPECT_EQ(a.links[k].tick, b.links[k].tick);
    EXPECT_EQ(a.links[k].seat, b.links[k].seat);
    EXPECT_EQ(a.links[k].rtt_p50_ms / 1e3, b.links[k].rtt_p50_ms / 1e3);
    EXPECT_EQ(a.links[k].loss_up_percent / 100, b.links[k].loss_up_percent / 100);
    EXPECT_TRUE(std::isnan(b.links[k].age_p99_ms));
    EXPECT_EQ(a.links[k].gate_trips, b.links[k].gate_trips);
  }
  ASSERT_EQ(b.events.size(), 1u);
  EXPECT_EQ(b.events[0].tick, 9u);
  EXPECT_EQ(b.events[0].time_ns, 9'000'000);
  EXPECT_EQ(b.events[0].what, "joined");
  EXPECT_EQ(b.events[0].seat, a.events[0].seat);
  EXPECT_EQ(b.events[0].text, "the seat joined: é");
  ASSERT_EQ(b.marks.size(), 2u);
  EXPECT_EQ(b.marks[1].t_s, 2.5);
  EXPECT_EQ(b.marks[0].by, "Ada");
  EXPECT_EQ(b.marks[1].text, "a longer text");
  ASSERT_EQ(b.sheets.size(), 1u);
  EXPECT_EQ(b.sheets[0].of, a.sheets[0].of);
  EXPECT_EQ(b.sheets[0].scores, a.sheets[0].scores);
  EXPECT_TRUE(b.sheets[0].closed);
  ASSERT_EQ(b.counts.size(), 1u);
  EXPECT_EQ(b.counts.at("/trainer/measured_cp").never_received, 3u);
}

TEST(Hdf5Import, ReadsBackWhatWasExported) {
  if (!Hdf5Library::load()) GTEST_SKIP() << kNoLibrary;
  for (const std::string scene : {"contact", "one_axis", "evaluation"}) {
    SCOPED_TRACE(scene);
    const Lesson lesson = lesson_with_notes(scene, 5);
    const test::Folder folder;
    ASSERT_EQ(export_hdf5(lesson, folder.file("a.h5"), kGoOn), "");
    const auto read = import_hdf5(folder.file("a.h5"));
    ASSERT_TRUE(read) << read.error();
    ASSERT_EQ(read->rows(), lesson.rows());
    const auto wanted = signals_of(lesson), got = signals_of(*read);
    ASSERT_EQ(wanted.size(), got.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
      EXPECT_TRUE(bits_of(wanted[k], lesson.rows()) == bits_of(got[k], lesson.rows()))
          << wanted[k].group << "/" << wanted[k].name;
    EXPECT_EQ(read->scene_text, lesson.scene_text);
    EXPECT_EQ(read->scene.name, lesson.scene.name);
    EXPECT_EQ(read->scene.duration, 17.25);
    EXPECT_EQ(read->session, lesson.session);
    EXPECT_EQ(read->metadata, lesson.metadata);
    EXPECT_EQ(read->start_unix_ns, lesson.start_unix_ns);
    EXPECT_EQ(read->seats[0].person, "Ada");
    EXPECT_FALSE(read->complete);
    expect_equal_notes(lesson, *read);
  }
}

/// The error of a lesson whose file has one wrong value.
template <class Change>
std::string error_of(const Change& change) {
  Lesson lesson = lesson_with_notes("one_axis", 0.5);
  change(lesson);
  const test::Folder folder;
  EXPECT_EQ(export_hdf5(lesson, folder.file("a.h5"), kGoOn), "");
  const auto read = import_hdf5(folder.file("a.h5"));
  return read ? "" : read.error();
}

TEST(Hdf5Import, NamesDatasetValueAndNextStepOfAWrongValue) {
  if (!Hdf5Library::load()) GTEST_SKIP() << kNoLibrary;
  const std::string name = lesson_with_notes("one_axis", 0.1).scene.seats[0].name;
  const auto expect = [](const std::string& error, const std::string& part) {
    EXPECT_NE(error.find(part), std::string::npos) << part << " not in " << error;
    EXPECT_NE(error.find("a.h5, "), std::string::npos) << error;
    EXPECT_NE(error.find("; export the recording again with `tandem-server recordings export`"), std::string::npos)
        << error;
  };
  expect(error_of([](Lesson& l) { l.seats[0].gate[7] = 9; }),
         "dataset /seats/" + name + "/gate: row 7 is 9; allowed are 0 to 6");
  expect(error_of([](Lesson& l) { l.running[1] = 2; }), "dataset /session/running: row 1 is 2; allowed are 0 to 1");
  expect(error_of([](Lesson& l) { l.tick[5] = l.tick[4]; }), "dataset /session/tick: row 5 is ");
  expect(error_of([](Lesson& l) { l.links[1].seat = 4; }), "dataset /links/seat: row 1 is 4; allowed are 0 to 0");
  expect(error_of([](Lesson& l) { l.scene.duration = -1; }), "attribute duration of /scene: is -1 s");
  expect(error_of([](Lesson& l) { l.scene.tick_hz = 77; }), "attribute tick_hz of /: is 77 Hz; the scene has 1000 Hz");
  expect(error_of([](Lesson& l) { l.scene_text = "no scene"; }), "dataset /scene: is not valid: ");
  expect(error_of([](Lesson& l) { l.start_unix_ns = -5; }), "attribute start_unix_ns of /: is negative");
}

TEST(Hdf5Import, RefusesOtherFiles) {
  if (!Hdf5Library::load()) GTEST_SKIP() << kNoLibrary;
  const test::Folder folder;
  const std::string file = folder.file("a.h5");
  EXPECT_EQ(import_hdf5(file).error(), file + ": No such file or directory");
  folder.write("a.h5", "\x89HDF\r\n\x1a\nno more");
  EXPECT_NE(import_hdf5(file).error().find("is no HDF5 file that libhdf5 can open"), std::string::npos);
  {
    Hdf5File foreign(file);
    foreign.group("/data");
    ASSERT_EQ(foreign.close(), "");
  }
  EXPECT_NE(import_hdf5(file).error().find("attribute format of /: is missing"), std::string::npos);
  {
    Hdf5File foreign(file);
    foreign.attribute("/", "format", std::string("robomimic"));
    ASSERT_EQ(foreign.close(), "");
  }
  EXPECT_NE(import_hdf5(file).error().find("its attribute format is \"robomimic\", not \"tandem-lesson-1\""),
            std::string::npos);
}

/// All datasets of an exported file.
std::vector<std::string> datasets_of(const Lesson& lesson) {
  std::vector<std::string> out{"/scene", "/gaps", "/sheets"};
  for (const LessonSignal& signal : signals_of(lesson)) out.push_back("/" + signal.group + "/" + signal.name);
  for (const char* name : {"links/tick",       "links/seat",
                           "links/rtt_p50",    "links/loss_up",
                           "links/loss_down",  "links/gap_up",
                           "links/gap_down",   "links/age_p99",
                           "links/gate_trips", "links/late_ticks",
                           "events/tick",      "events/time_ns",
                           "events/what",      "events/seat",
                           "events/text",      "marks/time",
                           "marks/by",         "marks/text",
                           "channels/topic",   "channels/recorded",
                           "channels/dropped", "channels/never_received"})
    out.push_back(std::string("/") + name);
  return out;
}

/// Replaces a name in the bytes of a file by one of the same length, wherever it is a link's name.
std::string renamed(std::string bytes, const std::string& name) {
  std::string other = name;
  other.back() = other.back() == 'z' ? 'y' : 'z';
  const std::string from = '\0' + name + '\0', to = '\0' + other + '\0';
  for (std::size_t at = 0; (at = bytes.find(from, at)) != std::string::npos; at += from.size())
    bytes.replace(at, from.size(), to);
  return bytes;
}

TEST(Hdf5Import, NamesEachMissingDataset) {
  if (!Hdf5Library::load()) GTEST_SKIP() << kNoLibrary;
  const Lesson lesson = lesson_with_notes("one_axis", 0.2);
  const test::Folder folder;
  ASSERT_EQ(export_hdf5(lesson, folder.file("whole.h5"), kGoOn), "");
  const std::string whole = folder.read("whole.h5");
  for (const std::string& path : datasets_of(lesson)) {
    SCOPED_TRACE(path);
    folder.write("a.h5", renamed(whole, path.substr(path.rfind('/') + 1)));
    const auto read = import_hdf5(folder.file("a.h5"));
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().find(path.substr(path.rfind('/'))), std::string::npos) << read.error();
    EXPECT_NE(read.error().find(" is missing or damaged"), std::string::npos) << read.error();
  }
}

TEST(Hdf5Import, RefusesAnotherSizeOrType) {
  if (!Hdf5Library::load()) GTEST_SKIP() << kNoLibrary;
  // The columns of a lesson are equally long, so the writer makes wrong files of its parts.
  const test::Folder folder;
  const std::string file = folder.file("a.h5");
  const auto error_after = [&](const auto& write) {
    const Lesson lesson = lesson_with_notes("one_axis", 0.2);
    {
      Hdf5File out(file);
      out.attribute("/", "format", std::string(kHdf5Format));
      write(out, lesson);
      EXPECT_EQ(out.close(), "");
    }
    const auto read = import_hdf5(file);
    return read ? std::string() : read.error();
  };
  EXPECT_NE(error_after([](Hdf5File& out, const Lesson&) {
              out.attribute("/", "session", std::int64_t{4});
            }).find("attribute session of /: is no single text of variable length"),
            std::string::npos);
  const auto head = [](Hdf5File& out) {
    out.attribute("/", "session", std::string("s"));
    out.attribute("/", "complete", std::int64_t{1});
    out.group("/metadata");
  };
  EXPECT_NE(error_after([&](Hdf5File& out, const Lesson&) {
              head(out);
              out.attribute("/", "start_unix_ns", 1.5);
            }).find("attribute start_unix_ns of /: is no single number of the type signed integer of 64 bits"),
            std::string::npos);
  EXPECT_NE(error_after([&](Hdf5File& out, const Lesson&) {
              head(out);
              out.attribute("/", "start_unix_ns", std::int64_t{1});
              out.texts("/scene", {"one", "two"});
            }).find("dataset /scene: has the size 2; it must have 1"),
            std::string::npos);
  EXPECT_NE(error_after([&](Hdf5File& out, const Lesson&) {
              head(out);
              out.attribute("/", "start_unix_ns", std::int64_t{1});
              out.whole("/scene", 1, 0, [](std::size_t, std::size_t, std::span<std::int64_t> to) { to[0] = 1; });
            }).find("dataset /scene: has another type than text of fixed length"),
            std::string::npos);
}

TEST(Hdf5Import, SurvivesCutFilesAndFlippedBytes) {
  if (!Hdf5Library::load()) GTEST_SKIP() << kNoLibrary;
  const Lesson lesson = lesson_with_notes("one_axis", 0.5);
  const test::Folder folder;
  const std::string file = folder.file("a.h5");
  ASSERT_EQ(export_hdf5(lesson, file, kGoOn), "");
  const std::string whole = folder.read("a.h5");
  const std::size_t cuts = test::draws(40, 100, 400), flips = test::draws(80, 200, 2000);
  for (std::size_t k = 0; k < cuts; ++k) {
    folder.write("a.h5", whole.substr(0, whole.size() * k / cuts));
    const auto read = import_hdf5(file);
    ASSERT_FALSE(read) << "cut at " << whole.size() * k / cuts;
    EXPECT_TRUE(read.error().starts_with(file)) << read.error();
  }
  RandomStream random(7);
  std::size_t refused = 0;
  for (std::size_t k = 0; k < flips; ++k) {
    SCOPED_TRACE(k);
    std::string bytes = whole;
    for (std::size_t n = 0; n <= k % 4; ++n) {
      const std::size_t at = random.below(bytes.size());
      bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 + random.below(255)));
    }
    folder.write("a.h5", bytes);
    const auto read = import_hdf5(file);
    refused += read ? 0 : 1;
    EXPECT_TRUE(read ? read->rows() == lesson.rows() : read.error().starts_with(file)) << read.error();
  }
  // Half of the file is space that HDF5 keeps free, or text without a checksum.
  EXPECT_GT(refused, flips / 4);
}

}  // namespace
}  // namespace tandem::server
