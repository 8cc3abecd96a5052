#pragma once

#include <termios.h>

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "common/io/text_layout.h"

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

/// A status of a few lines that stays in its place on a terminal. Without one, a line follows every five seconds.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  /// How often a status is worth making [ms].
  [[nodiscard]] int interval_ms() const noexcept { return terminal_ ? 250 : 5000; }
  [[nodiscard]] bool wanted() const noexcept { return !quiet_; }
  /// Shows a status on standard error: on a terminal in at most `rows` lines laid out for its width now, elsewhere in one.
  void show(std::span<const ScreenItem> items, std::size_t rows = 2);
  void show(const std::string& text) { show(std::array<ScreenItem, 1>{{{text, "", 0}}}); }
  /// Lines that the terminal has room for beside one line of other text.
  [[nodiscard]] std::size_t rows_max() const noexcept;
  /// Removes the status, so that something else can be printed.
  void clear();
  /// Lasting lines, above the status (log.h).
  void note(const std::string& text);
  void warn(const std::string& text);

 private:
  bool quiet_, terminal_;
};

}  // namespace tandem::io
