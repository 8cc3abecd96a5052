// Attempts in a child process: their text, their crashes, their end.
#include "server/export/io/trial_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <new>

namespace tandem::server {
namespace {

constexpr unsigned kSeconds = 60;

TEST(TrialProcess, ReturnsTheTextOfTheAttempt) {
  EXPECT_EQ(try_in_child([] { return std::string(); }, kSeconds), "");
  EXPECT_EQ(try_in_child([] { return std::string("row 7 is 9."); }, kSeconds), "row 7 is 9.");
  const std::string longer(300'000, 'x');  // more than a pipe holds
  EXPECT_TRUE(try_in_child([&] { return longer; }, kSeconds) == longer);
}

TEST(TrialProcess, ReportsCrashesAndTheLackOfMemory) {
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS}) {
    const auto crash = [number]() -> std::string {
      ::raise(number);
      return {};
    };
    EXPECT_EQ(try_in_child(crash, kSeconds).find("reading crashed: "), 0u) << number;
  }
  EXPECT_EQ(try_in_child([]() -> std::string { ::_exit(0); }, kSeconds), "reading crashed");
  EXPECT_EQ(try_in_child([]() -> std::string { throw std::bad_alloc(); }, kSeconds), "there is not enough memory");
}

TEST(TrialProcess, EndsAnAttemptThatDoesNotEnd) {
  const auto endless = []() -> std::string {
    for (;;) ::getppid();
  };
  EXPECT_EQ(try_in_child(endless, 1), "reading took more than 1 s of processor time, or was killed");
}

TEST(TrialProcess, LeavesThisProcessAsItWas) {
  int value = 1;
  EXPECT_EQ(try_in_child([&value] { return std::to_string(++value); }, kSeconds), "2");
  EXPECT_EQ(value, 1);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD) << "no child is left";
}

}  // namespace
}  // namespace tandem::server
