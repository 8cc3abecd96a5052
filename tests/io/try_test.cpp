// `tandem-client try` with the real programs, on a pseudo-terminal. Messages, exit codes and processes are asserted,
// never durations.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "common/io/fd.h"
#include "tests/io/machine_witness.h"
#include "tests/support/process.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
constexpr auto kTimeout = 40s;

struct Stat {
  pid_t parent = 0, group = 0;
  char state = 'X';
};
/// Status of a process; nullopt if there is none.
std::optional<Stat> stat_of(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  if (!std::getline(in, text)) return std::nullopt;
  std::istringstream rest(text.substr(text.rfind(')') + 1));
  Stat s;
  rest >> s.state >> s.parent >> s.group;
  return s;
}
bool gone(pid_t pid) {
  const auto s = stat_of(pid);
  return !s || s->state == 'Z';
}
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (const auto s = stat_of(std::stoi(name)); s && s->parent == parent) found.push_back(std::stoi(name));
  }
  return found;
}
bool all_gone_soon(const std::vector<pid_t>& all) {
  for (const auto end = Clock::now() + kTimeout; Clock::now() < end; std::this_thread::sleep_for(50ms))
    if (std::ranges::all_of(all, gone)) return true;
  return false;
}

/// A program on its own pseudo-terminal.
class OnTerminal {
 public:
  explicit OnTerminal(std::vector<std::string> command) {
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    winsize size{.ws_row = 40, .ws_col = 160, .ws_xpixel = 0, .ws_ypixel = 0};
    int terminal = -1;
    pid_ = forkpty(&terminal, nullptr, nullptr, &size);
    if (pid_ == 0) {
      execv(arguments.front(), arguments.data());
      _exit(127);
    }
    terminal_ = io::Fd{terminal};
  }
  ~OnTerminal() {
    if (pid_ > 0 && !code_) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  bool wait_for(const std::string& text) {
    for (const auto end = Clock::now() + kTimeout; said_.find(text) == std::string::npos;)
      if (Clock::now() > end || !read_some()) return said_.find(text) != std::string::npos;
    return true;
  }
  void press(const std::string& keys) {
    ASSERT_EQ(write(terminal_.get(), keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  /// Exit code, or minus the signal; nullopt if it does not end.
  std::optional<int> wait() {
    for (const auto end = Clock::now() + kTimeout; Clock::now() < end && !code_;) {
      read_some();
      int status = 0;
      if (waitpid(pid_, &status, WNOHANG) == pid_) code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    while (read_some()) {
    }
    return code_;
  }
  [[nodiscard]] pid_t id() const { return pid_; }
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  bool read_some() {
    pollfd file{terminal_.get(), POLLIN, 0};
    if (poll(&file, 1, 100) == 0) return !code_;
    std::array<char, 4096> bytes;
    const ssize_t got = read(terminal_.get(), bytes.data(), bytes.size());
    if (got <= 0) {
      std::this_thread::sleep_for(20ms);
      return false;
    }
    said_.append(bytes.data(), static_cast<std::size_t>(got));
    return true;
  }

  pid_t pid_ = 0;
  io::Fd terminal_;
  std::optional<int> code_;
  std::string said_;
};

/// The server and the partner of a running trial: two programs, each in its own process group.
std::vector<pid_t> companions(const OnTerminal& trial) {
  const std::vector<pid_t> children = children_of(trial.id());
  EXPECT_EQ(children.size(), 2u) << trial.said();
  for (const pid_t child : children) EXPECT_EQ(stat_of(child).value_or(Stat{}).group, child);
  return children;
}

/// One trial that its user ends with q. Returns whether the hand-over was judged: a hand whose force is latched off
/// gives and gets no tool.
bool trial_with_hand_over() {
  const MachineWitness witness;
  OnTerminal trial({TANDEM_CLIENT, "try"});
  EXPECT_TRUE(trial.wait_for("you hold the seat instructor; trainee is simulated")) << trial.said();
  const std::vector<pid_t> children = companions(trial);
  EXPECT_TRUE(trial.wait_for("press the arrow keys")) << trial.said();
  for (int n = 0; n < 4; ++n) trial.press("\x1b[C");
  EXPECT_TRUE(trial.wait_for("the hand with authority moves the tool")) << trial.said();
  EXPECT_TRUE(trial.wait_for("press 0: trainee gets the tool")) << trial.said();
  trial.press("0");
  const bool gave = trial.wait_for("instructor gives the tool to trainee (");
  const bool disturbed = !gave && witness.machine_stood_still() && trial.said().find("trips") != std::string::npos;
  if (!disturbed) {
    EXPECT_TRUE(gave) << trial.said();
  }
  trial.press("q");
  EXPECT_EQ(trial.wait(), 0) << trial.said();
  EXPECT_TRUE(all_gone_soon(children));
  EXPECT_NE(trial.said().find("were ended as well"), std::string::npos) << trial.said();
  return !disturbed;
}

TEST(Try, StartsASessionWithASimulatedPartnerAndEndsAllOnQ) {
  repeat_disturbed("Try, the hand-over", trial_with_hand_over);
}

TEST(Try, EndsAllOnCtrlC) {
  OnTerminal trial({TANDEM_CLIENT, "try"});
  ASSERT_TRUE(trial.wait_for("you hold the seat instructor")) << trial.said();
  const std::vector<pid_t> children = companions(trial);
  trial.press("\x03");
  EXPECT_EQ(trial.wait(), 0) << trial.said();
  EXPECT_TRUE(all_gone_soon(children));
}

TEST(Try, LeavesNoOrphanProcessWhenKilled) {
  OnTerminal trial({TANDEM_CLIENT, "try", "free_motion", "--seat", "trainee"});
  ASSERT_TRUE(trial.wait_for("you hold the seat trainee; trainer is simulated")) << trial.said();
  const std::vector<pid_t> children = companions(trial);
  kill(trial.id(), SIGKILL);
  EXPECT_EQ(trial.wait(), -SIGKILL);
  EXPECT_TRUE(all_gone_soon(children));
}

TEST(Try, SimulatesTheUsersHandWithoutATerminalAndEnds) {
  Process trial({TANDEM_CLIENT, "try", "--duration", "2"});
  EXPECT_TRUE(
      trial.wait_for("Standard input is no terminal, so your hand is simulated too: start this command in a terminal"))
      << trial.err();
  EXPECT_EQ(trial.wait(), 0) << trial.err();
}

TEST(Try, NamesThePackageOfAMissingServerProgram) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("tandem_try_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  std::filesystem::copy_file(TANDEM_CLIENT, folder / "tandem-client");
  Process trial({"/usr/bin/env", "-i", (folder / "tandem-client").string(), "try"});
  EXPECT_EQ(trial.wait(), 1);
  EXPECT_NE(trial.err().find("install the package tandem-server"), std::string::npos) << trial.err();
  std::filesystem::remove_all(folder);
}

TEST(Try, ReportsErrorsBeforeAnythingStarts) {
  Process scene({TANDEM_CLIENT, "try", "lessen"});
  EXPECT_EQ(scene.wait(), 2);
  EXPECT_NE(scene.err().find("did you mean lesson?"), std::string::npos) << scene.err();
  Process seat({TANDEM_CLIENT, "try", "lesson", "--seat", "trainer", "--duration", "x"});
  EXPECT_EQ(seat.wait(), 2);
  EXPECT_NE(seat.err().find("--seat trainer: no MASTER seat of the scene lesson has this name"), std::string::npos)
      << seat.err();
  EXPECT_NE(seat.err().find("2 mistakes, nothing was started"), std::string::npos) << seat.err();
}

}  // namespace
}  // namespace tandem::test
