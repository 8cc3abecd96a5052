#pragma once

#include <termios.h>

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "common/io/text_layout.h"

namespace tandem::io {

/// Reads single keys from the terminal, without echo and without waiting. The destructor restores the terminal. Signals
/// are read elsewhere (signals.h), so that every end of the program runs the destructor.
class KeyReader {
 public:
  KeyReader();
  ~KeyReader();
  KeyReader(const KeyReader&) = delete;
  KeyReader& operator=(const KeyReader&) = delete;

  [[nodiscard]] bool interactive() const noexcept { return interactive_; }
  /// Descriptor to wait for; -1 without a terminal.
  [[nodiscard]] int fd() const noexcept;
  /// Returns the next key: one character, or `up down left right pageup pagedown`; empty if none waits.
  [[nodiscard]] std::string next();
  /// Takes the terminal's echo away again, which a shell gives back to a program that it stops and continues.
  void renew() noexcept;

 private:
  bool interactive_ = false;
  termios before_{}, raw_{};
  std::string pending_;
};

/// A status of a few lines that keeps its place on a terminal. Without a terminal it prints one line every five
/// seconds.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  /// Returns the refresh interval of the status [ms].
  [[nodiscard]] int interval_ms() const noexcept { return terminal_ ? 250 : 5000; }
  [[nodiscard]] bool wanted() const noexcept { return !quiet_; }
  /// Shows a status on standard error: on a terminal in at most `rows` lines laid out for its present width, elsewhere
  /// in one line, and nothing if there is no text.
  void show(std::span<const ScreenItem> items, std::size_t rows = 2);
  void show(const std::string& text) { show(std::array<ScreenItem, 1>{{{text, "", 0}}}); }
  /// Returns the number of lines that fit the terminal in addition to one line of other text.
  [[nodiscard]] std::size_t rows_max() const noexcept;
  /// Removes the status, so that other text can be printed.
  void clear();
  /// Prints permanent lines above the status (log.h).
  void note(const std::string& text);
  void warn(const std::string& text);

 private:
  bool quiet_, terminal_;
};

}  // namespace tandem::io
