// The server is killed and started again, with real programs on loopback: no hand is kicked, and all clients come
// back. Durations are printed, not asserted.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/io/free_address.h"
#include "tests/io/pressing_hands.h"
#include "tests/io/programs.h"
#include "tests/io/traces.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

/// Servers and clients of a test share a directory.
class Restart : public ::testing::Test {
 protected:
  Restart() { setenv("TANDEM_RUNTIME", folder.file("runtime").c_str(), 1); }
  ~Restart() override { unsetenv("TANDEM_RUNTIME"); }

  [[nodiscard]] std::string kept() const {
    for (const auto& entry : fs::directory_iterator(folder.file("runtime")))
      if (entry.path().extension() == ".checkpoint") return entry.path().string();
    return "";
  }
  /// The same, after waiting for it.
  [[nodiscard]] std::string wait_until_kept() const {
    for (int i = 0; i < 3000 && kept().empty(); ++i) std::this_thread::sleep_for(milliseconds(10));
    return kept();
  }

  Folder folder;
  std::string address = free_address();
};

TEST_F(Restart, RestoresAllSeatsWithoutAForceStepAfterAKillInContact) {
  const std::size_t restarts = draws(2, 50, 50);
  std::printf("[  counts  ] %zu restarts\n", restarts);
  const std::string scene = folder.write("press.textproto", pressing());
  RandomStream random{7};
  Process host = hosting(scene, {"--listen", address, "--trace", folder.file("0.csv")});
  ASSERT_EQ(address_of(host), address) << host.err();
  Process trainer = client(address, "trainer", {"--trace", folder.file("a.csv"), "--json", folder.file("a.json")});
  Process trainee = client(address, "trainee", {"--trace", folder.file("b.csv"), "--json", folder.file("b.json")});
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  std::this_thread::sleep_for(milliseconds(4000));  // until they press
  double tool_jump_mm = 0;
  for (std::size_t n = 1; n <= restarts; ++n) {
    std::this_thread::sleep_for(milliseconds(1500 + random.below(700)));
    host.signal(SIGKILL);
    ASSERT_EQ(host.wait(), -SIGKILL);
    std::this_thread::sleep_for(milliseconds(random.below(900)));
    host = hosting(scene, {"--listen", address, "--trace", folder.file(std::to_string(n) + ".csv"), "--json",
                           folder.file("s.json")});
    ASSERT_NE(host.err().find("RESTORED from its checkpoint"), std::string::npos) << host.err();
    ASSERT_NE(host.err().find("epoch " + std::to_string(n + 1)), std::string::npos) << host.err();
    ASSERT_TRUE(host.wait_for("the session runs")) << n << host.err() << trainer.err() << trainee.err();
  }
  std::this_thread::sleep_for(milliseconds(1500));
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(trainee.wait(), 0) << trainee.err();
  EXPECT_EQ(kept(), "") << "a participant ended it";

  for (std::size_t n = 1; n <= restarts; ++n) {
    const Trace before(folder.read(std::to_string(n - 1) + ".csv")), after(folder.read(std::to_string(n) + ".csv"));
    ASSERT_GT(before.size(), 0u);
    ASSERT_GT(after.size(), 0u);
    tool_jump_mm =
        std::max(tool_jump_mm, 1e3 * distance(before.triple(before.size() - 1, "tool."), after.triple(0, "tool.")));
    EXPECT_GT(after.at(0, "t_s"), before.at(before.size() - 1, "t_s") - 0.6)
        << "session time goes on where the checkpoint was";
  }
  EXPECT_LE(tool_jump_mm, 1) << "the tool rests at its old position, within the compliance of the wall";
  std::vector<double> back, first, jump, beyond, forward;
  for (const char* seat : {"a", "b"}) {
    SCOPED_TRACE(seat);
    const Json j = folder.json(std::string(seat) + ".json");
    EXPECT_EQ(j["rejoins"], restarts);
    EXPECT_EQ(j["verdict"], "pass");
    EXPECT_EQ(j["ended_by"], "server_stopped");
    EXPECT_EQ(j["machine"]["trace_dropped"], 0);
    EXPECT_EQ(j["gate"]["trips"], restarts) << "no other loss";
    const auto all = absences(Trace(folder.read(std::string(seat) + ".csv")));
    EXPECT_EQ(all.size(), restarts) << "all seats are back ACTIVE";
    for (const Absence& a : all) {
      EXPECT_LE(a.first_n, 0.05);
      EXPECT_LE(a.jump_mm, 0.5) << "0.5 m/s";
      EXPECT_LE(a.beyond_n, 0.3);
      EXPECT_LE(a.forward_mm, 6);
      back.push_back(a.back_s), first.push_back(a.first_n), jump.push_back(a.jump_mm), beyond.push_back(a.beyond_n),
          forward.push_back(a.forward_mm);
    }
  }
  const Json report = folder.json("s.json");
  // The hands rest in contact, so there is no motion to judge.
  EXPECT_NE(report["verdict"], "fail") << report["violations"];
  EXPECT_EQ(report["violations"].size(), 0U) << report["violations"];
  EXPECT_EQ(report["epoch"], restarts + 1);
  ASSERT_FALSE(back.empty());
  print("release to wholly active [s], asked <= 3", back);
  print("force in the first tick [N], asked <= 0.05", first);
  print("farthest between two ticks of the ramp [mm]", jump);
  print("first 500 ms beyond the force before [N]", beyond);
  print("way of the hand after the release [mm], asked <= 6", forward);
  std::printf("[  figures ] tool, before and after a restart: at most %.3f mm apart\n", tool_jump_mm);
}

TEST_F(Restart, RestoresAllSeatsOfARestartedService) {
  folder.write("press.textproto", pressing());
  const std::string config = folder.write(
      "s.textproto", "version: 1 listen: \"" + address + "\" session { name: \"lab\" scene: \"press.textproto\" }");
  Process host = server({"serve", config});
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  Process trainer = client(address, "trainer", {"--json", folder.file("a.json")}), trainee = client(address, "trainee");
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_NE(kept(), "");
  host = server({"serve", config});
  ASSERT_TRUE(host.wait_for("RESTORED from its checkpoint")) << host.err();
  EXPECT_NE(host.err().find("`tandem-client control --server " + address + " resume`"), std::string::npos)
      << host.err();
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err() << trainer.err();
  EXPECT_TRUE(trainer.wait_for("the server ended or gave the session away; your seat is kept")) << trainer.err();
  // The user ends the clients: they do not come back.
  for (Process* p : {&trainer, &trainee}) {
    p->signal(SIGINT);
    EXPECT_EQ(p->wait(), 0) << p->err();
  }
  EXPECT_EQ(folder.json("a.json")["rejoins"], 1);
  host.signal(SIGTERM);
  EXPECT_EQ(host.wait(), 0) << host.err();
}

TEST_F(Restart, ReportsAnIncompatibleSnapshotAndMovesItAside) {
  Process host = hosting("one_axis", {"--listen", address});
  Process trainer = client(address, "trainer", {"--reconnect-timeout", "1.5"});
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  const auto die = [&] {
    ASSERT_NE(wait_until_kept(), "");
    host.signal(SIGKILL);
    ASSERT_EQ(host.wait(), -SIGKILL);
  };
  die();
  EXPECT_EQ(trainer.wait(), 1);
  EXPECT_NE(trainer.err().find("server lost: no news for 2 s"), std::string::npos) << trainer.err();
  host = hosting("one_axis", {"--listen", address, "--duration", "5"});  // another scene this time
  EXPECT_NE(
      host.err().find("starts from the beginning: its checkpoint is not used: the checkpoint belongs to another scene"),
      std::string::npos)
      << host.err();
  EXPECT_TRUE(fs::exists(wait_until_kept() + ".unfit"));
  die();
  {
    std::fstream file(kept(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(100);
    file.put('x');
  }
  host = hosting("one_axis", {"--listen", address, "--duration", "5"});
  EXPECT_NE(host.err().find("it is damaged"), std::string::npos) << host.err();
  die();
  host = hosting("one_axis", {"--listen", address, "--duration", "5", "--no-restore"});
  EXPECT_NE(host.err().find("--no-restore was given"), std::string::npos) << host.err();
  EXPECT_EQ(host.err().find("RESTORED"), std::string::npos) << host.err();
  die();
  host = hosting("one_axis", {"--listen", address, "--duration", "5"});
  EXPECT_NE(host.err().find("RESTORED"), std::string::npos) << host.err();
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0);
  host = hosting("one_axis", {"--listen", address, "--duration", "5"});
  EXPECT_EQ(host.err().find("RESTORED"), std::string::npos) << "a participant had ended it\n" << host.err();
}

/// The session does not go on in the report of a client while no server serves it.
TEST_F(Restart, ReportsTheTimeWithoutAServerThatDoesNotReturn) {
  Process host = hosting("free_motion", {"--listen", address});
  Process trainer = client(address, "trainer", {"--reconnect-timeout", "4"}),
          trainee = client(address, "trainee", {"--reconnect-timeout", "4", "--json", folder.file("b.json")});
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  host.signal(SIGKILL);
  ASSERT_EQ(host.wait(), -SIGKILL);
  EXPECT_EQ(trainee.wait(), 1);
  EXPECT_NE(trainee.err().find("server lost: no news for 4 s"), std::string::npos) << trainee.err();
  const Json report = folder.json("b.json");
  EXPECT_EQ(report["ended_by"], "server_lost");
  EXPECT_GE(report["away_longest_s"].get<double>(), 4);
  EXPECT_LE(report["session_s"].get<double>(), report["seconds"].get<double>() - 3) << report["seconds"];
}

/// The client was stopped for so long that another client got the seat.
TEST_F(Restart, ReportsThatAnotherClientTookTheSeat) {
  Process host = hosting("free_motion", {"--listen", address});
  Process trainer = client(address, "trainer"), trainee = client(address, "trainee", {"--json", folder.file("b.json")});
  ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
  trainee.signal(SIGSTOP);
  Process other = client(address, "trainee", {"--duration", "4"});
  while (other.wait() == 1) {  // until the server knows that the seat's owner is gone
    ASSERT_NE(other.err().find("is taken already"), std::string::npos) << other.err();
    other = client(address, "trainee", {"--duration", "4"});
  }
  trainee.signal(SIGCONT);
  EXPECT_EQ(trainee.wait(), 1);
  EXPECT_NE(trainee.err().find("the seat is gone: nothing to resume"), std::string::npos) << trainee.err();
  EXPECT_EQ(folder.json("b.json")["ended_by"], "seat_gone");
  EXPECT_EQ(trainer.err().find("silent"), std::string::npos) << trainer.err();
}

}  // namespace
}  // namespace tandem::test
