#pragma once

#include <sys/types.h>

#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "common/io/fd.h"

namespace tandem::io {

/// A child process of this program. It runs in its own process group, so that Ctrl-C in the terminal reaches only the
/// parent. The kernel sends it SIGTERM when the parent dies for any reason. Its standard input is empty and its output
/// is kept.
class ChildProgram {
 public:
  /// Starts a program. Call on a thread that runs as long as this program, because the kernel watches that thread.
  /// @param name     name for messages
  /// @param command  path of the program, and its arguments
  /// @return         the running child, or why it could not be started
  [[nodiscard]] static std::expected<ChildProgram, std::string> start(std::string name,
                                                                      const std::vector<std::string>& command);
  ChildProgram(ChildProgram&& other) noexcept;
  ChildProgram& operator=(ChildProgram&& other) noexcept;
  ~ChildProgram();  ///< calls `stop`

  /// Waits for a line of standard output that begins with `mark`.
  /// @param limit      longest time to wait
  /// @param interrupt  file that ends the wait when it becomes readable; -1: none
  /// @return           the rest of the line; nullopt if the child ended before, or after a timeout or an interrupt
  [[nodiscard]] std::optional<std::string> wait_for_line(std::string_view mark, Duration limit, int interrupt);
  /// True if the child still runs.
  [[nodiscard]] bool running() noexcept;
  /// True if the child ended with another exit code than 0.
  [[nodiscard]] bool failed() noexcept { return !running() && status_ != 0; }
  /// Returns the last lines of its standard error, at most three.
  [[nodiscard]] std::string last_output() const;
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] pid_t id() const noexcept { return pid_; }
  /// Sends SIGTERM and waits for the end; kills the child after 5 s.
  void stop() noexcept;

 private:
  ChildProgram() = default;

  std::string name_;
  pid_t pid_ = 0;   ///< 0: ended and reaped
  int status_ = 0;  ///< status from waitpid
  Fd out_, err_;
  std::string said_;
};

/// Returns the path of a program in the directory of this one or in $PATH; empty if there is none.
[[nodiscard]] std::string program_path(const std::string& name);

}  // namespace tandem::io
