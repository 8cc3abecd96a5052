#pragma once

#include <sys/types.h>

#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "common/io/fd.h"

namespace tandem::client {

/// A program that this one started. It runs in a process group of its own, so that Ctrl-C in the terminal reaches only its parent, and
/// the kernel sends it SIGTERM when its parent dies, however that happens. Standard input is empty; what it prints is kept.
class ChildProgram {
 public:
  /// @param name  for people  @param command  program (a path) and arguments. Call from a thread that lives as long as this program.
  /// @return the running child, or why it could not be started
  [[nodiscard]] static std::expected<ChildProgram, std::string> start(std::string name, const std::vector<std::string>& command);
  ChildProgram(ChildProgram&& other) noexcept;
  ChildProgram& operator=(ChildProgram&& other) noexcept;
  ~ChildProgram();  ///< `stop`

  /// The rest of the line of standard output that begins with `mark`, once it came; nothing: the child ended before, or `patience` is over.
  /// @param interrupt  a file that becomes readable when nobody wants to wait any longer; -1: none
  [[nodiscard]] std::optional<std::string> wait_for_line(std::string_view mark, Duration patience, int interrupt);
  /// Whether it still runs.
  [[nodiscard]] bool running() noexcept;
  /// It ended, and not with exit code 0.
  [[nodiscard]] bool failed() noexcept { return !running() && status_ != 0; }
  /// What it last said on standard error, at most three lines.
  [[nodiscard]] std::string last_words() const;
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] pid_t id() const noexcept { return pid_; }
  /// Asks it to end (SIGTERM) and waits; kills it after 5 s.
  void stop() noexcept;

 private:
  ChildProgram() = default;

  std::string name_;
  pid_t pid_ = 0;  ///< 0: ended and waited for
  int status_ = 0;  ///< as waitpid told it
  io::Fd out_, err_;
  std::string said_;
};

/// Path of a program beside this one, or in $PATH; empty: there is none.
[[nodiscard]] std::string program_path(const std::string& name);

}  // namespace tandem::client
