#include "hal/io/deadman.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>

namespace tandem::hal {
namespace {

/// The other end of what the program in the test holds as its device: frames as they come, until nobody holds it.
std::vector<std::string> frames_of(int fd) {
  std::vector<std::string> frames;
  std::array<char, 128> buffer;
  while (true) {
    pollfd file{fd, POLLIN, 0};
    if (poll(&file, 1, 20'000) <= 0) return frames;
    const ssize_t got = ::read(fd, buffer.data(), buffer.size());
    if (got <= 0) return frames;
    frames.emplace_back(buffer.data(), static_cast<std::size_t>(got));
  }
}

/// Runs `program` in a process that holds the device's end. @return what came out of that end
template <typename Program>
std::vector<std::string> frames_sent_by(Program program) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    ::close(ends[0]);
    LastWords words;
    words.fd = ends[1];
    words.size = 3;
    words.frame = {std::byte{0}, std::byte{'z'}, std::byte{'z'}};
    auto deadman = Deadman::watch({&words, 1});
    [[maybe_unused]] const auto wrote = ::write(ends[1], "force", 5);
    if (deadman) program(std::move(*deadman));
    ::_exit(0);
  }
  ::close(ends[1]);
  auto frames = frames_of(ends[0]);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  return frames;
}

TEST(Deadman, SendsZerosWhenTheProgramIsKilled) {
  const auto frames = frames_sent_by([](std::unique_ptr<Deadman>) { ::raise(SIGKILL); });
  ASSERT_GE(frames.size(), 4U);
  EXPECT_EQ(frames[0], "force");
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_EQ(frames[i], std::string("\0zz", 3)) << i;
}

TEST(Deadman, SendsZerosWhenTheProgramCrashes) {
  const auto frames = frames_sent_by([](std::unique_ptr<Deadman>) {
    ::signal(SIGABRT, SIG_DFL);
    ::raise(SIGABRT);
  });
  EXPECT_GE(frames.size(), 4U);
}

TEST(Deadman, IsNotTakenAlongByTheTerminalsSignals) {
  const auto frames = frames_sent_by([](std::unique_ptr<Deadman>) {
    ::signal(SIGINT, SIG_DFL);
    ::kill(0, SIGINT);  // Ctrl-C goes to the whole group
  });
  EXPECT_GE(frames.size(), 4U);
}

TEST(Deadman, SurvivesWhatKillsTheProgramsWholeGroup) {
  const auto frames = frames_sent_by([](std::unique_ptr<Deadman>) {
    ::poll(nullptr, 0, 100);  // it has left the group long since
    ::kill(0, SIGKILL);
  });
  EXPECT_GE(frames.size(), 4U);
}

TEST(Deadman, SpeaksWhileAServoStandsStillAndFallsSilentWhenItRests) {
  const auto frames = frames_sent_by([](std::unique_ptr<Deadman> deadman) {
    deadman->pulse().beat();
    ::poll(nullptr, 0, 400);  // patience and a hundred rounds
    deadman->pulse().rest();
    ::poll(nullptr, 0, 100);
    deadman.reset();
  });
  ASSERT_GE(frames.size(), 4U);
  EXPECT_LE(frames.size(), 101U) << "it does not go on for ever";
}

TEST(Deadman, LeavesAServoAloneThatNeverGaveForce) {
  const auto frames = frames_sent_by([](std::unique_ptr<Deadman> deadman) {
    ::poll(nullptr, 0, 100);
    deadman.reset();
  });
  EXPECT_EQ(frames, std::vector<std::string>{"force"});
}

TEST(Deadman, KnowsWhetherItIsThere) {
  LastWords none;
  none.fd = -1;
  auto deadman = Deadman::watch({&none, 0});
  ASSERT_TRUE(deadman);
  EXPECT_TRUE((*deadman)->alive());
  std::ifstream file("/proc/thread-self/children");  // it is the only one
  pid_t child = 0;
  ASSERT_TRUE(file >> child);
  ::kill(child, SIGKILL);
  for (int i = 0; i < 5000 && (*deadman)->alive(); ++i) ::poll(nullptr, 0, 1);
  EXPECT_FALSE((*deadman)->alive());
}

TEST(Deadman, SaysNothingAfterAGoodbye) {
  const auto frames = frames_sent_by([](std::unique_ptr<Deadman> deadman) { deadman.reset(); });
  EXPECT_EQ(frames, std::vector<std::string>{"force"});
}

TEST(Deadman, FindsTheFileThatALibraryHides) {
  EXPECT_FALSE(open_file_of("/dev/no_such_node"));
  const int fd = ::open("/dev/null", O_RDONLY);
  const auto found = open_file_of("/dev/null");
  ASSERT_TRUE(found);
  EXPECT_NE(::fcntl(*found, F_GETFD), -1);
  ::close(fd);
}

}  // namespace
}  // namespace tandem::hal
