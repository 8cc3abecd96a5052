// The processes of a trial, with shells in place of server and partners.
#include "client/app/try_session.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "client/app/interruptible_wait.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

/// A file to which each child writes its name when it ends.
class EndLog {
 public:
  EndLog() { std::filesystem::remove(path_); }
  ~EndLog() { std::filesystem::remove(path_); }

  /// Starts a child that runs until SIGTERM.
  [[nodiscard]] io::ChildProgram child(const std::string& name) const {
    auto child = io::ChildProgram::start(
        name, {"/bin/sh", "-c",
               "trap 'echo " + name + " >> " + path_ + "; exit 0' TERM; echo ready; while :; do sleep 0.01; done"});
    EXPECT_TRUE(child) << child.error();
    EXPECT_TRUE(child->wait_for_line("ready", 20s, -1));
    return std::move(*child);
  }
  [[nodiscard]] std::string text() const {
    std::ostringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }

 private:
  std::string path_ = testing::TempDir() + "try_session_" + std::to_string(::getpid());
};

TEST(TrySession, EndsThePartnersBeforeTheServerHoweverItEnds) {
  for (const bool stops : {true, false}) {
    const EndLog ends;
    {
      std::vector<io::ChildProgram> programs;
      for (const char* name : {"server", "trainer", "trainee"}) programs.push_back(ends.child(name));
      TrySession trial{false, true, {"trainer", "trainee"}, TrialPrograms(std::move(programs))};
      EXPECT_EQ(trial.leave_reason(), "");
      if (stops) trial.stop();
    }
    EXPECT_EQ(ends.text(), "trainee\ntrainer\nserver\n") << (stops ? "stopped" : "a partner could not be started");
  }
}

TEST(TrySession, ExtendsAShortSessionBeyondTheTutorial) {
  SceneSpec scene;
  scene.duration = 20;  // as scene contact, whose end would cut off the last two steps
  EXPECT_EQ(TrySession::longer_duration(scene), 60);
  scene.duration = 60;
  EXPECT_EQ(TrySession::longer_duration(scene), std::nullopt);
  scene.duration = std::numeric_limits<double>::infinity();
  ASSERT_TRUE(scene.endless());
  EXPECT_EQ(TrySession::longer_duration(scene), std::nullopt) << "it has no end, and keeps none";
}

TEST(TrySession, LeavesWhenAChildFailsAndNamesIt) {
  auto child = io::ChildProgram::start("the simulated trainer", {"/bin/sh", "-c", "echo no seat >&2; exit 3"});
  ASSERT_TRUE(child) << child.error();
  std::vector<io::ChildProgram> programs;
  programs.push_back(std::move(*child));
  TrySession trial{false, true, {}, TrialPrograms(std::move(programs))};
  EXPECT_EQ(trial.failure(), "");
  EXPECT_TRUE(wait_unless_interrupted(20s, -1, [&] { return !trial.leave_reason().empty(); }));
  EXPECT_EQ(trial.leave_reason(), "the simulated trainer ended by itself: no seat");
  EXPECT_EQ(trial.failure(), trial.leave_reason());
}

}  // namespace
}  // namespace tandem::client
