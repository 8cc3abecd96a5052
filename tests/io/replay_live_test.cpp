// Recorded lessons that are played again live: the recorded hands, the seats that wait for clients, what the server
// prints.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <thread>

#include "tests/io/live_recordings.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

/// The only child process of a program.
pid_t child_of(pid_t parent) {
  const std::string id = std::to_string(parent);
  pid_t child = -1;
  EXPECT_TRUE(std::ifstream("/proc/" + id + "/task/" + id + "/children") >> child) << "it has no child";
  return child;
}

// A trainee follows the expert's recorded hand: the same motion through a new session.
TEST(LiveRecording, IsReplayedLiveForOtherHands) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "6", "--record", folder.file("a.mcap")});
  Process trainer = client(address_of(host), "trainer"), trainee = client(address_of(host), "trainee");
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const Lesson lesson = read(folder, "a.mcap");
  Process again = server({"replay-live", folder.file("a.mcap"), "--seat", "trainer", "--record", folder.file("b.mcap"),
                          "--json", folder.file("b.json")});
  ASSERT_TRUE(again.wait_for("Ctrl-C ends")) << again.err();
  EXPECT_NE(again.out().find("recorded hands play trainer"), std::string::npos) << again.out();
  EXPECT_EQ(again.out().find("--seat trainer"), std::string::npos) << "nothing can join there: " << again.out();
  EXPECT_NE(again.out().find("--seat trainee"), std::string::npos) << again.out();
  // The recorded hand is there, and the clock stands still until the trainee is.
  const std::string address = address_of(again);
  const auto taken = [&](const Json& status) { return status["seats"][0]["taken"] == true; };
  ASSERT_TRUE(comes_true([&] { return taken(status_of(address)); }));
  std::this_thread::sleep_for(1s);
  const Json waiting = status_of(address);
  EXPECT_TRUE(taken(waiting)) << waiting;
  EXPECT_EQ(waiting["time_s"], 0) << waiting;
  EXPECT_EQ(waiting["phase"], "waiting") << waiting;
  Process follower = client(address_of(again), "trainee", {}, "sim:hand=relaxed");
  EXPECT_EQ(again.wait(), 0) << again.err() << again.out();
  EXPECT_EQ(follower.wait(), 0) << follower.err();
  const Lesson replayed = read(folder, "b.mcap");
  ASSERT_GT(replayed.rows(), 300u);
  EXPECT_TRUE(folder.json("b.json")["violations"].empty()) << folder.json("b.json")["violations"];
  std::map<std::uint32_t, std::size_t> rows;
  for (std::size_t k = 0; k < lesson.rows(); ++k) rows[lesson.seats[0].sample_tick[k]] = k;
  double sum = 0, far = 0;
  std::size_t n = 0;
  for (std::size_t k = 0; k < replayed.rows(); ++k) {
    const auto at = rows.find(replayed.seats[0].sample_tick[k]);
    if (at == rows.end() || replayed.tick[k] < 2000) continue;  // until hands are engaged and have settled
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double d = replayed.seats[0].x[k][a] - lesson.seats[0].x[at->second][a];
      square += d * d;
    }
    sum += square;
    far = std::max(far, std::sqrt(square));
    ++n;
  }
  ASSERT_GT(n, 3000u);
  std::printf("[  figures ] replayed hand beside the recorded one: RMS %.2f mm, worst %.2f mm of a circle of 50 mm\n",
              1e3 * std::sqrt(sum / static_cast<double>(n)), 1e3 * far);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(n)), 5e-3);
  EXPECT_LT(replayed.tick.front(), 100u);
  EXPECT_TRUE(std::isfinite(replayed.seats[1].x[100][0])) << "the trainee is there from the beginning";
  double followed = 0;
  for (const LessonTriple& x : replayed.seats[1].x) followed = std::max(followed, std::abs(x[0]));
  EXPECT_GT(followed, 0.02) << "the trainee's relaxed hand is led";
  Process wrong = server({"replay-live", folder.file("a.mcap"), "--seat", "nurse"});
  EXPECT_EQ(wrong.wait(), 2);
  EXPECT_NE(wrong.err().find("master seats: trainer, trainee"), std::string::npos) << wrong.err();
}

TEST(LiveRecording, IsReplayedWithoutOtherHandsIfAsked) {
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "2", "--record", folder.file("a.mcap")});
  Process trainer = client(address_of(host), "trainer"), trainee = client(address_of(host), "trainee");
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  Process alone = server({"replay-live", folder.file("a.mcap"), "--seat", "trainer", "--no-wait"});
  EXPECT_EQ(alone.wait(), 0) << alone.err() << alone.out();
  Process patient = server({"replay-live", folder.file("a.mcap"), "--seat", "trainer", "--start-timeout", "1"});
  EXPECT_EQ(patient.wait(), 1);
  EXPECT_NE(patient.err().find("required seats not ready: trainee"), std::string::npos) << patient.err();
  // Without its recorded hand the server would wait for ever.
  Process handless = server({"replay-live", folder.file("a.mcap"), "--seat", "trainer"});
  ASSERT_TRUE(handless.wait_for("trainer joined")) << handless.err();
  ::kill(child_of(handless.id()), SIGKILL);
  EXPECT_EQ(handless.wait(), 1);
  EXPECT_NE(handless.err().find("the recorded hand of trainer ended by itself"), std::string::npos) << handless.err();
  Process all = server({"replay-live", folder.file("a.mcap")});
  EXPECT_EQ(all.wait(), 0) << all.err();
  EXPECT_NE(all.out().find("recorded hands play trainer, trainee\n"), std::string::npos) << all.out();
  EXPECT_EQ(all.out().find("tandem-client join"), std::string::npos) << all.out();
}

}  // namespace
}  // namespace tandem::test
