#pragma once

#include <sys/types.h>

#include <expected>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tandem::netsim::demo {

/// A program we started: its output goes to a log file, its input is empty, and it has a process group of its own, so
/// that Ctrl-C in the terminal reaches us alone and we end it, by its own id, in our own order. Ended when destroyed.
class ChildProcess {
 public:
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
  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  /// Looks whether it still runs.
  [[nodiscard]] bool running() noexcept;
  /// Ended by itself with this exit code; 128 + n if by signal n. Nothing while it runs.
  [[nodiscard]] std::optional<int> exit_code() const noexcept { return exit_code_; }
  /// To this process only, and only while it is ours.
  void signal(int number) noexcept;
  /// The text it has written so far.
  [[nodiscard]] std::string output() const;

 private:
  ChildProcess() = default;
  std::string name_, log_;
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
};

/// Ends those that still run: SIGINT, then SIGTERM, then SIGKILL, with time to obey before each next step.
void end_all(std::span<ChildProcess> children) noexcept;

/// The command as a person would type it.
[[nodiscard]] std::string command_text(const std::vector<std::string>& arguments);

}  // namespace tandem::netsim::demo
