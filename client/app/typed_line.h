#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace tandem::client {

/// A line that is typed at a terminal whose own editing is off, so that the program can show it again behind a notice.
/// Backspace removes a character, Ctrl-W a word, Ctrl-U the line; Enter ends it.
class TypedLine {
 public:
  /// Handles one key (io::KeyReader): one byte, or the name of a key, which is ignored.
  /// @return text for the terminal; the caller shows the whole line again if `redraw`
  std::string on_key(std::string_view key) {
    redraw_ = false;
    if (key.size() != 1) return {};
    const auto c = static_cast<unsigned char>(key.front());
    if (c == '\n' || c == '\r') {
      finished_ += std::exchange(text_, {}) + '\n';
      return "\n";
    }
    if (c == kEnd) {
      ended_ = text_.empty();
    } else if (c == kBackspace || c == kDelete) {
      erase_character();
    } else if (c == kEraseWord) {
      while (text_.ends_with(' ')) erase_character();
      while (!text_.empty() && !text_.ends_with(' ')) erase_character();
    } else if (c == kEraseLine) {
      clear();
    } else if (c >= 0x20 && text_.size() < kLineMax) {
      text_ += key;
      return std::string(key);
    }
    return {};
  }
  /// Text before Enter.
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool redraw() const { return redraw_; }
  /// Ctrl-D was typed at the begin of a line: the input is over.
  [[nodiscard]] bool ended() const { return ended_; }
  /// Takes the finished lines, each with its line feed.
  [[nodiscard]] std::string take_finished() { return std::exchange(finished_, {}); }
  void clear() {
    redraw_ = redraw_ || !text_.empty();
    text_.clear();
  }

 private:
  static constexpr std::size_t kLineMax = 4096;  // as a terminal that edits by itself
  static constexpr unsigned char kEnd = 4, kBackspace = 8, kEraseLine = 21, kEraseWord = 23, kDelete = 127;

  void erase_character() {
    if (text_.empty()) return;
    redraw_ = true;
    while (text_.size() > 1 && (static_cast<unsigned char>(text_.back()) & 0xc0U) == 0x80) text_.pop_back();
    text_.pop_back();
  }

  std::string text_, finished_;
  bool redraw_ = false, ended_ = false;
};

}  // namespace tandem::client
