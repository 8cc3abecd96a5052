#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/fd.h"

namespace tandem::test {

/// A small terminal emulator: shows a program's output as a screen does. It supports carriage return, line feed,
/// backspace, CSI A B C D G J K m and the wrap at the right margin.
class Terminal {
 public:
  /// Treatment of lines that are wider than the new width: newer terminals wrap them again, older ones cut them.
  enum class Resize { kReflows, kCuts };

  Terminal(std::size_t columns, std::size_t rows, Resize resize) : columns_(columns), rows_(rows), resize_(resize) {}

  void feed(std::string_view bytes);
  void resize(std::size_t columns, std::size_t rows);

  /// Returns the rows on the screen, without blanks at the right and empty rows at the bottom.
  [[nodiscard]] std::vector<std::string> screen() const;
  /// Returns the same rows, preceded by those that have scrolled off the screen.
  [[nodiscard]] std::vector<std::string> all() const;
  /// Rows that were broken at the right margin since the last `forget_wraps`.
  [[nodiscard]] const std::vector<std::string>& wraps() const noexcept { return wraps_; }
  void forget_wraps() { wraps_.clear(); }

 private:
  struct Row {
    std::vector<std::string> cells;
    bool continues = false;  ///< the next row belongs to the same line
  };
  [[nodiscard]] std::size_t top() const noexcept { return lines_.size() > rows_ ? lines_.size() - rows_ : 0; }
  void put(std::string cell);
  void down();
  void command(char what, std::size_t number, bool given);
  [[nodiscard]] static std::string text_of(const Row& row);
  [[nodiscard]] std::vector<std::string> from(std::size_t first) const;

  std::size_t columns_, rows_;
  Resize resize_;
  std::vector<Row> lines_{1};
  std::size_t row_ = 0, column_ = 0;
  std::string pending_;
  std::vector<std::string> wraps_;
};

/// A child process on a pseudo-terminal, shown on a Terminal. Every wait has a generous limit; no test may assert
/// durations.
class TerminalProcess {
 public:
  TerminalProcess(std::vector<std::string> command, std::size_t columns, std::size_t rows,
                  Terminal::Resize resize = Terminal::Resize::kReflows);
  ~TerminalProcess();  ///< kills a process that still runs
  TerminalProcess(const TerminalProcess&) = delete;
  TerminalProcess& operator=(const TerminalProcess&) = delete;

  /// Waits until `wanted` accepts the screen. @return whether it did before the end or the limit
  bool wait_until(const std::function<bool(const Terminal&)>& wanted,
                  std::chrono::milliseconds timeout = std::chrono::seconds(30));
  /// Waits until `text` is on the screen or has scrolled off it; line breaks count as spaces.
  bool wait_for(std::string_view text);
  /// Reads the output that arrives within this time.
  void watch(std::chrono::milliseconds time);
  void resize(std::size_t columns, std::size_t rows);
  void type(std::string_view keys) const;
  void signal(int number) const;
  /// Waits for the end. @return the exit code, or minus the signal
  int wait();

  [[nodiscard]] const Terminal& terminal() const noexcept { return terminal_; }
  [[nodiscard]] Terminal& terminal() noexcept { return terminal_; }
  /// Returns all rows, for the message of a failed test.
  [[nodiscard]] std::string picture() const;

 private:
  bool read_some(std::chrono::milliseconds slice);

  Terminal terminal_;
  pid_t pid_ = -1;
  io::Fd master_;
};

/// Returns the rows as one text, with runs of blanks joined.
[[nodiscard]] std::string flat(const std::vector<std::string>& rows);

}  // namespace tandem::test
