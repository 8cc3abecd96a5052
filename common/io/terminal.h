#pragma once

#include <termios.h>

#include <string>
#include <string_view>

namespace tandem::io {

/// Single keys from the terminal, without echo and without waiting. Everything is put back when it ends; signals are
/// read elsewhere (signals.h), so that no end of the program goes around it.
class KeyReader {
 public:
  KeyReader();
  ~KeyReader();
  KeyReader(const KeyReader&) = delete;
  KeyReader& operator=(const KeyReader&) = delete;

  [[nodiscard]] bool interactive() const noexcept { return interactive_; }
  /// File to wait for; -1 when there is no terminal.
  [[nodiscard]] int fd() const noexcept;
  /// The next key pressed: one character, or `up down left right pageup pagedown`; empty when none waits.
  [[nodiscard]] std::string next();

 private:
  bool interactive_ = false;
  termios before_{};
  std::string pending_;
};

/// A line of status that stays in its place on a terminal. Without one, lines follow each other, seldom.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  /// How often a line is worth making [ms].
  [[nodiscard]] int interval_ms() const noexcept { return terminal_ ? 250 : 5000; }
  [[nodiscard]] bool wanted() const noexcept { return !quiet_; }
  /// Shows the line on standard error; on a terminal it is cut to the width, as a line that wraps cannot be replaced.
  void show(const std::string& line);
  /// Removes the line, so that something else can be printed.
  void clear();
  /// Lasting lines, above the status (log.h).
  void note(const std::string& text);
  void warn(const std::string& text);

 private:
  bool quiet_, terminal_, shown_ = false;
};

}  // namespace tandem::io
