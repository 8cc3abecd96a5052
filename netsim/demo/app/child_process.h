#pragma once

#include <sys/types.h>

#include <expected>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tandem::netsim::demo {

/// A child process. Its output goes to a log file, its input is empty, and it has its own process group. Ctrl-C in the
/// terminal therefore reaches only the demo, which ends its children in order, by process id. The destructor ends the
/// process.
class ChildProcess {
 public:
  /// Starts a program.
  /// @param arguments  the program's path first
  /// @return the running program, or why it could not be started
  [[nodiscard]] static std::expected<ChildProcess, std::string> start(std::string name,
                                                                      const std::vector<std::string>& arguments,
                                                                      const std::string& log);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::string& log() const noexcept { return log_; }
  /// Returns whether the process still runs; reaps it if it ended.
  [[nodiscard]] bool running() noexcept;
  /// Returns the exit code of a process that ended; 128 + n after signal n. Empty while it runs.
  [[nodiscard]] std::optional<int> exit_code() const noexcept { return exit_code_; }
  /// Sends a signal to this process only, and only while it runs.
  void signal(int number) noexcept;
  /// Returns the text that the process has written so far.
  [[nodiscard]] std::string output() const;

 private:
  ChildProcess() = default;
  std::string name_, log_;
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
};

/// Ends the processes that still run: SIGINT, then SIGTERM, then SIGKILL, with a time limit for each step.
void end_all(std::span<ChildProcess> children) noexcept;

/// Returns the contents of a file; empty if it cannot be read.
[[nodiscard]] std::optional<std::string> read_text(const std::string& path);

/// Returns the command as a user would type it.
[[nodiscard]] std::string command_text(const std::vector<std::string>& arguments);

}  // namespace tandem::netsim::demo
