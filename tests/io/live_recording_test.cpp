// Recordings of real sessions on loopback: orders, participants, recorders from outside, killed servers, slow and full
// disks.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <thread>

#include "common/base/rng.h"
#include "common/io/socket_address.h"
#include "tests/common/base/counts.h"
#include "tests/io/live_recordings.h"
#include "tests/io/metrics_page.h"
#include "tests/io/slow_disk.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using server::test::account_problem;
using server::test::lesson_of;

/// Names of the files in a folder that end so, sorted.
std::vector<std::string> files_of(const Folder& folder, const std::string& end) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.file("")))
    if (entry.path().filename().string().ends_with(end)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}
/// Value of a metric; -1: it is not there.
double metric(const std::string& address, const std::string& name) {
  const std::string text = page(address);
  const auto at = text.find("\n" + name);
  if (at == std::string::npos) return -1;
  const auto space = text.find(' ', at + 1 + name.size());
  return std::atof(text.c_str() + space);
}

TEST(LiveRecording, HoldsAWholeSession) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "3", "--record", folder.file("a.mcap")});
  EXPECT_NE(host.err().find("recording to " + folder.file("a.mcap.part")), std::string::npos) << host.err();
  Process trainer = client(address_of(host), "trainer");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_NE(host.err().find("a.mcap is complete"), std::string::npos) << host.err();
  const Lesson lesson = read(folder, "a.mcap");
  EXPECT_TRUE(lesson.complete);
  EXPECT_EQ(account_problem(lesson), "");
  EXPECT_GE(lesson.rows(), 200u) << "of 3000; of late ticks the server spares nine rows in ten";
  EXPECT_EQ(lesson.scene.name, "one_axis");
  EXPECT_GT(lesson.start_unix_ns, 0);
  EXPECT_TRUE(std::ranges::any_of(lesson.events, [](const LessonEvent& e) { return e.what == "join"; }));
  EXPECT_FALSE(lesson.links.empty());
  double most = 0;
  for (const LessonTriple& x : lesson.seats[0].x) most = std::max(most, std::abs(x[0]));
  EXPECT_GT(most, 0.01) << "the hand moves on a circle of 5 cm";
  EXPECT_EQ(fs::status(folder.file("a.mcap")).permissions() & fs::perms::others_all, fs::perms::none);
}

TEST(LiveRecording, StartsAndEndsByOrdersThatAllParticipantsSee) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "600", "--record", folder.file(""), "--record-on-order"});
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  EXPECT_TRUE(status_of(address)["recording"].is_null());
  Process refused = control(address, {"--role", "evaluator", "record", "start"});
  EXPECT_EQ(refused.wait(), 1);
  EXPECT_NE(refused.err().find("permitted for: instructor, operator"), std::string::npos) << refused.err();
  Process none = control(address, {"record", "stop"});
  EXPECT_EQ(none.wait(), 1) << "none runs";
  Process start = control(address, {"record", "start"});
  EXPECT_EQ(start.wait(), 0) << start.err();
  EXPECT_TRUE(comes_true([&] { return status_of(address)["recording"]["by_server"] == true; }));
  EXPECT_TRUE(trainer.wait_for("RECORDED by the server")) << trainer.err();
  Process again = control(address, {"record", "start"});
  EXPECT_EQ(again.wait(), 1) << "it is recorded already";
  Process note = control(address, {"note", "mark", R"({"t":1.5,"text":"here"})"});
  EXPECT_EQ(note.wait(), 0) << note.err();
  Process watcher = command(TANDEM_CLIENT, {"watch", "--server", address});
  EXPECT_TRUE(watcher.wait_for("RECORDED by the server")) << watcher.out();
  watcher.signal(SIGINT);
  EXPECT_EQ(watcher.wait(), 0);
  Process stop = control(address, {"--role", "instructor", "record", "stop"});
  EXPECT_EQ(stop.wait(), 0) << stop.err();
  EXPECT_TRUE(comes_true([&] { return status_of(address)["recording"].is_null(); }))
      << "the status is a copy made a few times a second";
  EXPECT_TRUE(host.wait_for(".mcap is complete")) << host.err();
  Process second = control(address, {"record", "start"});
  EXPECT_EQ(second.wait(), 0) << second.err();
  std::this_thread::sleep_for(1s);
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
  const auto files = files_of(folder, ".mcap");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_TRUE(files_of(folder, ".part").empty());
  for (const std::string& name : files) {
    const Lesson lesson = read(folder, name);
    EXPECT_EQ(account_problem(lesson), "") << name;
    EXPECT_GT(lesson.rows(), 100u);
    EXPECT_GT(lesson.tick.front(), 0u) << "it begins in the session";
  }
  std::size_t marks = 0;
  for (const std::string& name : files)
    for (const LessonMark& mark : read(folder, name).marks) {
      ++marks;
      EXPECT_EQ(mark.text, "here");
      EXPECT_EQ(mark.t_s, 1.5);
    }
  EXPECT_EQ(marks, 1u);
}

TEST(LiveRecording, IsMadeFromOutsideByARecorder) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "4", "--record", folder.file("server.mcap")});
  const std::string address = address_of(host);
  Process recorder =
      command(TANDEM_CLIENT, {"record", "--server", address, "--out", folder.file("out.mcap"), "--quiet"});
  ASSERT_TRUE(comes_true([&] { return status_of(address)["recording"]["by_recorders"] == 1; }))
      << "participants see recorders, too";
  Process trainer = client(address, "trainer");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(recorder.wait(), 0) << recorder.err() << recorder.out();
  EXPECT_NE(recorder.out().find("ticks recorded"), std::string::npos) << recorder.out();
  const Lesson own = read(folder, "server.mcap"), seen = read(folder, "out.mcap");
  EXPECT_TRUE(seen.complete);
  EXPECT_EQ(account_problem(seen), "");
  ASSERT_GT(seen.rows(), own.rows() / 20);
  std::map<std::uint32_t, std::size_t> rows;
  for (std::size_t k = 0; k < own.rows(); ++k) rows[own.tick[k]] = k;
  std::size_t compared = 0;
  for (std::size_t k = 0; k < seen.rows(); ++k) {
    const auto at = rows.find(seen.tick[k]);
    if (at == rows.end() || !std::isfinite(seen.seats[0].x[k][0])) continue;
    ++compared;
    ASSERT_EQ(seen.seats[0].x[k][0], static_cast<double>(static_cast<float>(own.seats[0].x[at->second][0])))
        << "single precision of the same tick " << seen.tick[k];
  }
  EXPECT_GT(compared, 60u);
}

TEST(LiveRecording, ReplacesNamesByPseudonyms) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "2", "--record", folder.file("a.mcap"), "--pseudonyms"});
  Process trainer = client(address_of(host), "trainer");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const Lesson lesson = read(folder, "a.mcap");
  EXPECT_EQ(lesson.metadata.at("pseudonyms"), "true");
  for (const LessonSeat& seat : lesson.seats) EXPECT_TRUE(seat.person.empty() || seat.person == "P1") << seat.person;
}

// The requirement: a server that is killed at any moment leaves a file that is readable up to the last second.
TEST(LiveRecording, LosesAtMostASecondWhenTheServerIsKilled) {
  const std::size_t kills = draws(6, 200, 200);
  std::printf("[  counts  ] %zu kills\n", kills);
  RandomStream random{31};
  double worst_s = 0;
  std::uint64_t rows = 0;
  for (std::size_t k = 0; k < kills; ++k) {
    SCOPED_TRACE(k);
    const Folder folder;
    Process host = hosting("one_axis", {"--duration", "600", "--record", folder.file("a.mcap"), "--metrics",
                                        "127.0.0.1:0", "--no-restore"});
    const std::string metrics = host.after("metrics on http://");
    const std::string at = metrics.substr(0, metrics.find('/'));
    Process trainer = client(address_of(host), "trainer");
    ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
    std::this_thread::sleep_for(std::chrono::milliseconds(random.below(1500)));
    const double reached_s = metric(at, "tandem_session_time_seconds");
    host.signal(SIGKILL);
    ASSERT_EQ(host.wait(), -SIGKILL);
    trainer.signal(SIGKILL);
    ASSERT_TRUE(fs::exists(folder.file("a.mcap.part")));
    const std::string bytes = folder.read("a.mcap.part");
    const auto cut = lesson_of(bytes);
    ASSERT_TRUE(cut) << cut.error() << ": " << bytes.size() << " bytes are not readable";
    EXPECT_FALSE(cut->complete);
    Process repair = server({"repair", folder.file("a.mcap.part")});
    ASSERT_EQ(repair.wait(), 0) << repair.err();
    const Lesson lesson = read(folder, "a.mcap");
    EXPECT_EQ(lesson.rows(), cut->rows());
    EXPECT_EQ(account_problem(lesson), "");
    const double last_s = lesson.rows() == 0 ? 0 : lesson.tick.back() / lesson.scene.tick_hz;
    EXPECT_LE(reached_s - last_s, 1.0) << lesson.rows() << " rows";
    worst_s = std::max(worst_s, reached_s - last_s);
    rows += lesson.rows();
  }
  std::printf("[  figures ] worst loss of %zu kills: %.3f s; %llu rows read\n", kills, worst_s,
              static_cast<unsigned long long>(rows));
  EXPECT_GT(rows, 0u);
}

TEST(LiveRecording, IsClosedByTheNextServer) {
  const Folder folder;
  Process host = hosting("one_axis", {"--duration", "600", "--record", folder.file(""), "--no-restore"});
  Process trainer = client(address_of(host), "trainer");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  std::this_thread::sleep_for(1500ms);
  host.signal(SIGKILL);
  ASSERT_EQ(host.wait(), -SIGKILL);
  trainer.signal(SIGKILL);
  ASSERT_EQ(files_of(folder, ".mcap.part").size(), 1u);
  Process next = hosting("one_axis", {"--duration", "600", "--record", folder.file(""), "--no-restore"});
  EXPECT_TRUE(next.wait_for("recording of an earlier run")) << next.err() << next.out();
  ASSERT_TRUE(comes_true([&] { return files_of(folder, ".mcap").size() == 1; }));
  EXPECT_EQ(files_of(folder, ".mcap.part").size(), 1u) << "that of the running server";
  EXPECT_EQ(account_problem(read(folder, files_of(folder, ".mcap")[0])), "");
  next.signal(SIGINT);
  EXPECT_EQ(next.wait(), 0);
}

/// Share of ticks that began more than 1 ms late, between two readings.
struct Ticks {
  double late = 0, all = 0;
};
Ticks ticks_of(const std::string& address) {
  return {metric(address, "tandem_tick_late_total"), metric(address, "tandem_tick_lateness_seconds_count")};
}
double share(const Ticks& from, const Ticks& to) { return (to.late - from.late) / std::max(1.0, to.all - from.all); }

TEST(LiveRecording, DisturbsNoSessionOnASlowOrFullDisk) {
  const Folder folder;
  const std::string disk = folder.write("disk", "ok");
  Process host(
      on_slow_disk(disk, {TANDEM_SERVER, "run", "free_motion", "--duration", "14", "--record", folder.file("a.mcap"),
                          "--json", folder.file("s.json"), "--metrics", "127.0.0.1:0"}));
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  const std::string metrics = host.after("metrics on http://");
  const std::string at = metrics.substr(0, metrics.find('/'));
  Process trainer = client(address_of(host), "trainer"), trainee = client(address_of(host), "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  const Ticks start = ticks_of(at);
  std::this_thread::sleep_for(3s);
  const Ticks good = ticks_of(at);
  EXPECT_EQ(metric(at, "tandem_recording_failing"), 0);
  folder.write("disk", "slow");
  std::this_thread::sleep_for(4s);
  folder.write("disk", "full");
  EXPECT_TRUE(host.wait_for("the recording drops ticks")) << host.err();
  EXPECT_NE(host.err().find("the disk is full"), std::string::npos) << host.err();
  EXPECT_EQ(metric(at, "tandem_recording_failing"), 1);
  std::this_thread::sleep_for(1s);
  EXPECT_GT(metric(at, "tandem_recording_dropped_ticks_total"), 0);
  const Ticks bad = ticks_of(at);
  folder.write("disk", "ok");
  EXPECT_TRUE(host.wait_for("the recording goes on")) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << host.err();

  std::printf("[  figures ] ticks more than 1 ms late: %.4f with a good disk, %.4f with a slow and full one\n",
              share(start, good), share(good, bad));
  EXPECT_LE(share(good, bad), share(start, good) + 0.02);
  const Json report = folder.json("s.json");
  EXPECT_EQ(report["machine"]["recorder_dropped"], 0) << "the session's own queue never filled";
  const Lesson lesson = read(folder, "a.mcap");
  EXPECT_TRUE(lesson.complete);
  EXPECT_EQ(account_problem(lesson), "");
  const LessonCount& count = lesson.counts.at("/" + lesson.scene.tools[0].name);
  EXPECT_GT(count.dropped, 50u) << "a second of a full disk, in which a slow computer spares up to nine ticks in ten";
  EXPECT_GT(lesson.tick.back(), 13'500u) << "it went on to the end";
  std::printf("[  figures ] %llu ticks recorded, %llu dropped, %llu not made\n",
              static_cast<unsigned long long>(count.recorded), static_cast<unsigned long long>(count.dropped),
              static_cast<unsigned long long>(count.never_received));
}

TEST(LiveRecording, RejectsTargetsThatCannotBeWritten) {
  const Folder folder;
  folder.write("there.mcap", "x");
  for (const std::string& target : {folder.file("there.mcap"), folder.file("a.csv"), folder.file("absent/a.mcap")}) {
    Process refused = server({"run", "one_axis", "--record", target});
    EXPECT_EQ(refused.wait(), 2) << target;
    EXPECT_NE(refused.err().find("--record"), std::string::npos) << refused.err();
  }
  EXPECT_EQ(folder.read("there.mcap"), "x");
  Process alone = server({"run", "one_axis", "--pseudonyms"});
  EXPECT_EQ(alone.wait(), 2);
}

TEST(LiveRecording, FollowsTheConfigurationOfAServer) {
  const Folder folder, films;
  const std::string config = folder.write(
      "s.textproto",
      "version: 1 listen: \"127.0.0.1:0\"\nrecord: \"" + films.file("") +
          "\" recording { pseudonyms: true file_minutes: 0.1 }\n"
          "session { name: \"lab\" scene: \"one_axis\" duration_s: 2 restart: false }\n"
          "session { name: \"own\" scene: \"one_axis\" duration_s: 2 restart: false record: \"own.mcap\" }\n");
  Process check = server({"serve", config, "--check"});
  EXPECT_EQ(check.wait(), 0) << check.err();
  EXPECT_NE(check.out().find("recording.pseudonyms"), std::string::npos) << check.out();
  Process host = server({"serve", config});
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  Process a = client(address_of(host), "trainer", {"--session", "lab"}),
          b = client(address_of(host), "trainer", {"--session", "own"});
  EXPECT_EQ(a.wait(), 0) << a.err();
  EXPECT_EQ(b.wait(), 0) << b.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const auto named = files_of(films, ".mcap");
  ASSERT_EQ(named.size(), 1u);
  EXPECT_TRUE(named[0].starts_with("lab-")) << named[0];
  EXPECT_EQ(account_problem(read(films, named[0])), "");
  EXPECT_EQ(account_problem(read(folder, "own.mcap")), "");
  folder.write("bad.textproto",
               "version: 1 listen: \"127.0.0.1:0\" record: \"absent\"\n"
               "session { name: \"lab\" scene: \"one_axis\" record: \"a.csv\" }\n");
  Process bad = server({"serve", folder.file("bad.textproto"), "--check"});
  EXPECT_EQ(bad.wait(), 2);
  EXPECT_NE(bad.err().find("session[0].record"), std::string::npos) << bad.err();
}

}  // namespace
}  // namespace tandem::test
