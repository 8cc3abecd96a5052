#include "hal/io/watchdog_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace tandem::hal {
namespace {

/// Returns the frames received at the other end of the test program's device, until no process holds it.
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

/// Runs `program` in a process that holds the device's end. @return the data received at the other end
template <typename Program>
std::vector<std::string> frames_sent_by(Program program) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    ::close(ends[0]);
    ShutdownFrame words;
    words.fd = ends[1];
    words.size = 3;
    words.frame = {std::byte{0}, std::byte{'z'}, std::byte{'z'}};
    auto deadman = WatchdogProcess::start({&words, 1});
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

TEST(WatchdogProcess, SendsZerosWhenTheProgramIsKilled) {
  const auto frames = frames_sent_by([](std::unique_ptr<WatchdogProcess>) { ::raise(SIGKILL); });
  ASSERT_GE(frames.size(), 4U);
  EXPECT_EQ(frames[0], "force");
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_EQ(frames[i], std::string("\0zz", 3)) << i;
}

TEST(WatchdogProcess, SendsZerosWhenTheProgramCrashes) {
  const auto frames = frames_sent_by([](std::unique_ptr<WatchdogProcess>) {
    ::signal(SIGABRT, SIG_DFL);
    ::raise(SIGABRT);
  });
  EXPECT_GE(frames.size(), 4U);
}

TEST(WatchdogProcess, IgnoresTheTerminalsSignals) {
  const auto frames = frames_sent_by([](std::unique_ptr<WatchdogProcess>) {
    ::signal(SIGINT, SIG_DFL);
    ::kill(0, SIGINT);  // Ctrl-C goes to the whole group
  });
  EXPECT_GE(frames.size(), 4U);
}

TEST(WatchdogProcess, SurvivesASignalToTheProgramsGroup) {
  const auto frames = frames_sent_by([](std::unique_ptr<WatchdogProcess>) {
    ::poll(nullptr, 0, 100);  // the watchdog left the process group long before
    ::kill(0, SIGKILL);
  });
  EXPECT_GE(frames.size(), 4U);
}

TEST(WatchdogProcess, SendsZerosDuringAStallAndStopsWhenIdle) {
  const auto frames = frames_sent_by([](std::unique_ptr<WatchdogProcess> deadman) {
    deadman->heartbeat().beat();
    ::poll(nullptr, 0, 400);  // the time-out and a hundred rounds
    deadman->heartbeat().set_idle();
    ::poll(nullptr, 0, 100);
    deadman.reset();
  });
  ASSERT_GE(frames.size(), 4U);
  EXPECT_LE(frames.size(), 101U) << "it does not go on for ever";
}

TEST(WatchdogProcess, SendsNothingForAServoThatNeverGaveForce) {
  const auto frames = frames_sent_by([](std::unique_ptr<WatchdogProcess> deadman) {
    ::poll(nullptr, 0, 100);
    deadman.reset();
  });
  EXPECT_EQ(frames, std::vector<std::string>{"force"});
}

// A descriptor that stays open in the watchdog process would keep a socket or a lock in use after its program died.
TEST(WatchdogProcess, ClosesEveryInheritedDescriptorButTheDevice) {
  std::array<int, 2> device{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, device.data()), 0);
  rlimit files{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &files), 0);
  const rlimit raised{std::max<rlim_t>(files.rlim_cur, std::min<rlim_t>(files.rlim_max, 5000)), files.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &raised), 0);
  // Descriptors just above the device's, and near the limit of this process.
  const int high = ::fcntl(device[1], F_DUPFD_CLOEXEC, static_cast<int>(raised.rlim_cur) - 10);
  ASSERT_GT(high, 1000) << "the limit of descriptors is " << raised.rlim_cur;
  const int middle = ::fcntl(device[1], F_DUPFD_CLOEXEC, 500);
  const int last = ::fcntl(device[1], F_DUPFD_CLOEXEC, high + 1);
  ASSERT_GT(last, high);
  ShutdownFrame words;
  words.fd = high;
  auto deadman = WatchdogProcess::start({&words, 1});
  ASSERT_TRUE(deadman);
  std::ifstream children("/proc/thread-self/children");
  pid_t child = 0;
  ASSERT_TRUE(children >> child);
  const auto open_in_child = [&] {
    std::set<int> open;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(child) + "/fd"))
      open.insert(std::stoi(entry.path().filename()));
    return open;
  };
  std::set<int> open = open_in_child();
  for (int i = 0; i < 5000 && open.size() > 2; ++i, open = open_in_child()) ::poll(nullptr, 0, 1);
  EXPECT_EQ(open.size(), 2U) << "the device and the line to the program";
  EXPECT_TRUE(open.contains(high));
  deadman->reset();
  for (const int fd : {device[0], device[1], high, middle, last}) ::close(fd);
  ::setrlimit(RLIMIT_NOFILE, &files);
}

TEST(WatchdogProcess, ReportsWhetherItRuns) {
  ShutdownFrame none;
  none.fd = -1;
  auto deadman = WatchdogProcess::start({&none, 0});
  ASSERT_TRUE(deadman);
  EXPECT_TRUE((*deadman)->alive());
  std::ifstream file("/proc/thread-self/children");  // the only child
  pid_t child = 0;
  ASSERT_TRUE(file >> child);
  ::kill(child, SIGKILL);
  for (int i = 0; i < 5000 && (*deadman)->alive(); ++i) ::poll(nullptr, 0, 1);
  EXPECT_FALSE((*deadman)->alive());
}

TEST(WatchdogProcess, SendsNothingAfterACleanShutdown) {
  const auto frames = frames_sent_by([](std::unique_ptr<WatchdogProcess> deadman) { deadman.reset(); });
  EXPECT_EQ(frames, std::vector<std::string>{"force"});
}

TEST(WatchdogProcess, FindsTheDeviceFileOpenedByALibrary) {
  EXPECT_FALSE(find_open_file("/dev/no_such_node"));
  const int fd = ::open("/dev/null", O_RDONLY);
  const auto found = find_open_file("/dev/null");
  ASSERT_TRUE(found);
  EXPECT_NE(::fcntl(*found, F_GETFD), -1);
  ::close(fd);
}

}  // namespace
}  // namespace tandem::hal
