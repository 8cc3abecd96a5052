#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/fd.h"

namespace tandem::test {

/// A child process with its output. Every wait has a generous limit, so that a hanging program fails the test instead
/// of hanging it. No test may assert durations. In a build with sanitizers the test fails if the process printed a
/// report of one, also if the test kills it or expects an error of it.
class Process {
 public:
  static constexpr std::chrono::seconds kTimeout{30};

  /// @param command  program and arguments; standard input is /dev/null
  explicit Process(std::vector<std::string> command);
  ~Process();  ///< kills a process that still runs
  Process(Process&& other) noexcept;
  Process& operator=(Process&& other) noexcept;

  /// Waits until standard output or standard error contains `text`. @return whether it appeared before the end or the
  /// limit
  bool wait_for(std::string_view text);
  /// Waits for the end. @return the exit code, or minus the signal that killed it; nullopt if it still runs
  std::optional<int> wait();
  void signal(int number) const;
  [[nodiscard]] pid_t id() const { return pid_; }

  [[nodiscard]] const std::string& out() const { return out_; }
  [[nodiscard]] const std::string& err() const { return err_; }
  /// Returns the text after `mark` on its line of standard output; empty if no line has `mark`.
  [[nodiscard]] std::string after(std::string_view mark) const;

 private:
  /// Reads the output that arrives within `slice`. @return false once both pipes are closed
  bool read_some(std::chrono::milliseconds slice);
  /// Fails the test if standard error has a report of a sanitizer, once.
  void expect_no_report();

  pid_t pid_ = 0;
  std::optional<int> code_;
  io::Fd out_fd_, err_fd_;
  std::string out_, err_;
  bool reported_ = false;
};

}  // namespace tandem::test
