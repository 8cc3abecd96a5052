// Recordings that an order begins in the midst of a session: replayed bit for bit from the session's begin, and refused
// with the reason where the server had no inputs. Real programs on loopback.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/io/live_recordings.h"
#include "tests/io/slow_disk.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

struct Outcome {
  int code = 0;
  std::string out, err;
};
Outcome netsim(Words words) {
  Process process = command(TANDEM_NETSIM, std::move(words));
  const int code = process.wait().value_or(-1000);
  return {code, process.out(), process.err()};
}
Json replayed(const std::string& what) {
  const Outcome replay = netsim({"replay", what, "--json", "-"});
  EXPECT_EQ(replay.code, 0) << replay.out << replay.err;
  return Json::parse(replay.out, nullptr, false);
}
void order(const std::string& address, const std::string& what) {
  Process ordered = control(address, {"record", what});
  EXPECT_EQ(ordered.wait(), 0) << ordered.err();
}

/// Complete recordings in a folder, in the order of their begin.
std::vector<std::string> recordings_in(const Folder& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder.file("")))
    if (entry.path().extension() == ".mcap") files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}
/// Names of all files in a folder, hidden ones too.
std::vector<std::string> names_in(const Folder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.file(""))) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

/// A network that loses, delays, doubles and reorders datagrams, in front of a server.
Process lossy(const std::string& address) {
  Process proxy =
      command(TANDEM_NETSIM, {"proxy", "--to", address, "--listen", "127.0.0.1:0", "--delay", "5", "--jitter", "3",
                              "--loss", "5", "--duplicate", "2", "--reorder", "2", "--seed", "11"});
  proxy.wait_for("listening on ");
  return proxy;
}

void expect_equal_and_whole(const Json& result, std::uint64_t unseen_least) {
  EXPECT_EQ(result["equal"], true) << result;
  EXPECT_EQ(result["complete"], true) << result;
  EXPECT_GE(result.value("unseen", 0U), unseen_least) << result;
  EXPECT_GT(result.value("rows", 0U), 60U) << result;
}

// Two hands press a wall; an order begins a recording, ends it, and begins another one.
TEST(LiveLateRecording, ReplaysBitForBitFromTheSessionsBegin) {
  const Folder folder;
  Process host = hosting("contact", {"--duration", "10", "--record", folder.file(""), "--record-on-order"});
  const std::string address = address_of(host);
  Process proxy = lossy(address);
  Process trainer = client(address_of(proxy), "trainer"), trainee = client(address_of(proxy), "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  std::this_thread::sleep_for(2500ms);
  EXPECT_TRUE(names_in(folder).empty()) << "the inputs have no name: " << names_in(folder).front();
  order(address, "start");
  std::this_thread::sleep_for(1500ms);
  order(address, "stop");
  EXPECT_TRUE(host.wait_for(".mcap is complete")) << host.err();
  std::this_thread::sleep_for(1100ms);  // the names have seconds
  order(address, "start");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const auto files = recordings_in(folder);
  ASSERT_EQ(files.size(), 2u);
  const Json first = replayed(files[0]), second = replayed(files[1]);
  expect_equal_and_whole(first, 1800);
  expect_equal_and_whole(second, 4000);
  EXPECT_GT(second.value("unseen", 0U), first.value("unseen", 0U) + first.value("rows", 0U));
  const Lesson lesson = read(folder, fs::path(files[1]).filename().string());
  EXPECT_FALSE(lesson.metadata.contains("no_inputs"));
  EXPECT_EQ(second["unseen"], lesson.tick.front()) << "ticks count from 0";
  EXPECT_GT(lesson.time_ns.front(), 3'500'000'000) << "the clock of the session's begin";
  double pressed = 0;
  for (const LessonTriple& f : lesson.seats[0].f) pressed = std::max(pressed, std::abs(f[0]));
  EXPECT_GT(pressed, 0.5) << "the hand was in contact";
  std::printf("[  figures ] %s rows compared, %s ticks before the recordings replayed unseen\n",
              (first["rows"].dump() + " and " + second["rows"].dump()).c_str(),
              (first["unseen"].dump() + " and " + second["unseen"].dump()).c_str());
  // Commands for a recording from the begin work on this one.
  EXPECT_NE(netsim({"replay", files[1]}).out.find("were replayed unseen"), std::string::npos);
  EXPECT_EQ(netsim({"replay", files[1], "--what-if", "delay=10"}).code, 0);
  EXPECT_EQ(netsim({"score", files[1]}).code, 0);
  Process csv = server({"recordings", "export", files[1], "--to", folder.file("out.csv")});
  EXPECT_EQ(csv.wait(), 0) << csv.err();
  Process again = server({"replay-live", files[0], "--json", folder.file("live.json")});
  EXPECT_EQ(again.wait(), 0) << again.err();
  EXPECT_TRUE(folder.json("live.json")["violations"].empty());
  Process next = hosting("contact", {"--duration", "2"});
  Process hand = client(address_of(next), "trainer", {}, "sim:motion=" + files[1] + ",seat=trainer");
  Process other = client(address_of(next), "trainee", {}, "sim:hand=relaxed");
  EXPECT_EQ(hand.wait(), 0) << hand.err();
}

// The first recording began with the session; an order ends it, and another one begins a second one of several files.
TEST(LiveLateRecording, FollowsARecordingFromTheBeginAndHasParts) {
  const Folder folder, films;
  const std::string config = folder.write(
      "s.textproto", "version: 1 listen: \"127.0.0.1:0\"\nrecord: \"" + films.file("") +
                         "\" recording { file_minutes: 0.1 }\n"
                         "session { name: \"lab\" scene: \"free_motion\" duration_s: 12 restart: false }\n");
  Process host = server({"serve", config});
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  std::this_thread::sleep_for(3s);
  order(address, "stop");
  std::this_thread::sleep_for(1s);
  order(address, "start");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const auto files = recordings_in(films);
  ASSERT_GE(files.size(), 3u) << "8 s in files of 6 s, behind the first recording";
  const Json first = replayed(files[0]), second = replayed(files[1]);
  expect_equal_and_whole(first, 0);
  EXPECT_EQ(first["unseen"], 0);
  EXPECT_EQ(first["files"], 1);
  expect_equal_and_whole(second, 2500);
  EXPECT_EQ(second["files"], files.size() - 1);
}

/// Refusal of a replay.
std::string refusal(const std::string& file) {
  const Outcome replay = netsim({"replay", file});
  EXPECT_EQ(replay.code, 2) << replay.out;
  return replay.err;
}

TEST(LiveLateRecording, SaysWhyItHasNoInputs) {
  const Folder folder, none, little;
  const std::string config = folder.write(
      "s.textproto", "version: 1 listen: \"127.0.0.1:0\"\nrecord: \"" + little.file("") +
                         "\" recording { from_start: false inputs_mib: 0.2 }\n"
                         "session { name: \"lab\" scene: \"free_motion\" duration_s: 9 restart: false }\n");
  Process host = server({"serve", config});
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  // Beside it a server that keeps none.
  const std::string other =
      folder.write("n.textproto", "version: 1 listen: \"127.0.0.1:0\"\nrecord: \"" + none.file("") +
                                      "\" recording { from_start: false inputs_mib: 0 }\n"
                                      "session { name: \"lab\" scene: \"one_axis\" duration_s: 4 restart: false }\n");
  Process second = server({"serve", other});
  ASSERT_TRUE(second.wait_for("Ctrl-C ends")) << second.err();
  Process hand = client(address_of(second), "trainer");
  ASSERT_TRUE(second.wait_for("the session runs")) << second.err();
  std::this_thread::sleep_for(1s);
  order(address_of(second), "start");
  EXPECT_TRUE(host.wait_for("a recording that begins from now on has no inputs")) << host.err();
  order(address, "start");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  auto files = recordings_in(little);
  ASSERT_EQ(files.size(), 1u);
  const std::string reason = "the session had run longer than the inputs kept: 0.2 MiB (recording { inputs_mib })";
  EXPECT_EQ(read(little, fs::path(files[0]).filename().string()).metadata["no_inputs"], reason);
  EXPECT_NE(refusal(files[0]).find(reason), std::string::npos) << refusal(files[0]);
  EXPECT_EQ(host.err().find("recorded inputs"), std::string::npos);
  std::size_t told = 0;
  for (auto at = host.err().find("from now on has no inputs"); at != std::string::npos;
       at = host.err().find("from now on has no inputs", at + 1))
    ++told;
  EXPECT_EQ(told, 1u) << host.err();
  EXPECT_EQ(netsim({"score", files[0]}).code, 0);

  EXPECT_EQ(hand.wait(), 0) << hand.err();
  EXPECT_EQ(second.wait(), 0) << second.err();
  files = recordings_in(none);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_NE(refusal(files[0]).find("this server keeps no inputs (recording { inputs_mib: 0 })"), std::string::npos)
      << refusal(files[0]);
}

// The disk is full for the kept inputs only: the recording that runs has everything, and the next one says why not.
TEST(LiveLateRecording, AFullDiskForKeptInputsDisturbsNoSessionAndNoRecording) {
  const Folder folder, films;
  const std::string disk = folder.write("disk", "ok");
  Process host(on_slow_disk(disk, {TANDEM_SERVER, "run", "free_motion", "--duration", "10", "--record", films.file(""),
                                   "--json", folder.file("s.json")}));
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  const std::string address = address_of(host);
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  std::this_thread::sleep_for(2s);
  folder.write("disk", "inputs");
  EXPECT_TRUE(host.wait_for("cannot be replayed bit for bit: the disk is full")) << host.err();
  std::this_thread::sleep_for(1s);
  order(address, "stop");
  std::this_thread::sleep_for(1100ms);
  order(address, "start");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_TRUE(folder.json("s.json")["violations"].empty());
  const auto files = recordings_in(films);
  ASSERT_EQ(files.size(), 2u);
  expect_equal_and_whole(replayed(files[0]), 0);
  EXPECT_NE(refusal(files[1]).find("the disk is full"), std::string::npos) << refusal(files[1]);
  EXPECT_EQ(server::test::account_problem(read(films, fs::path(files[0]).filename().string())), "");
}

TEST(LiveLateRecording, LeavesNothingBehindAKilledServer) {
  const Folder folder;
  Process host =
      hosting("free_motion", {"--duration", "600", "--record", folder.file(""), "--record-on-order", "--no-restore"});
  Process trainer = client(address_of(host), "trainer"), trainee = client(address_of(host), "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  std::this_thread::sleep_for(2s);
  host.signal(SIGKILL);
  ASSERT_EQ(host.wait(), -SIGKILL);
  EXPECT_TRUE(names_in(folder).empty());
  folder.write(".tandem-inputs-000000", "of a file system that makes no files without a name");
  Process next =
      hosting("free_motion", {"--duration", "600", "--record", folder.file(""), "--record-on-order", "--no-restore"});
  EXPECT_TRUE(names_in(folder).empty()) << names_in(folder).front();
  next.signal(SIGINT);
  EXPECT_EQ(next.wait(), 0);
}

}  // namespace
}  // namespace tandem::test
