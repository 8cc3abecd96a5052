#include "common/io/help_text.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "common/io/text_layout.h"

namespace tandem::io {
namespace {

constexpr std::size_t kMissing = std::string_view::npos;

std::size_t indent_of(std::string_view line) { return std::min(line.find_first_not_of(' '), line.size()); }

std::string_view trimmed(std::string_view line) {
  line.remove_prefix(indent_of(line));
  while (line.ends_with(' ')) line.remove_suffix(1);
  return line;
}

/// Returns where the second column of a table row begins; kMissing: it has only one.
std::size_t second_column(std::string_view line) {
  const std::size_t gap = line.find("  ", indent_of(line));
  return gap == kMissing ? kMissing : line.find_first_not_of(' ', gap);
}

/// Returns whether a line begins with a Tandem program, with or without its directory.
bool is_command(std::string_view line) {
  std::string_view word = trimmed(line);
  word = word.substr(0, word.find(' '));
  if (const auto slash = word.rfind('/'); slash != kMissing && !word.starts_with("./")) word.remove_prefix(slash + 1);
  return word.starts_with("tandem-") || word.starts_with("./");
}

/// Returns whether a line such as `Exit: ...` begins a new paragraph.
bool begins_paragraph(std::string_view line) {
  const std::size_t end = line.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz");
  return end != kMissing && end > 0 && line[end] == ':' && line.front() >= 'A' && line.front() <= 'Z';
}

/// Allows breaks before each part in brackets in syntax words that are wider than a line.
std::string with_breaks(std::string_view text, std::size_t room) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size() - 1) + 1;  // with the space
    const std::string_view word = text.substr(at, end - at);
    for (const char c : word) out += c == '[' && display_width(word) > room ? std::string(" [") : std::string(1, c);
    at = end;
  }
  return out;
}

/// Returns a command over several lines that a shell reads as one.
std::string command_lines(std::string_view command, std::size_t width, std::size_t indent) {
  std::string out;
  std::vector<std::string> lines = wrap_words(command, width > indent + 4 ? width - indent - 2 : 1, 4);
  for (std::size_t i = 0; i < lines.size(); ++i)
    out += std::string(indent, ' ') + lines[i] + (i + 1 < lines.size() ? " \\\n" : "\n");
  return out;
}

/// Collects and fills paragraphs.
class Filling {
 public:
  explicit Filling(std::size_t width) : width_(width) {}

  void line(std::string_view line, std::string_view next) {
    if (trimmed(line).empty()) {
      flush();
      column_ = kMissing;
      out_ += '\n';
    } else if (line.front() == ' ') {
      indented(line);
    } else if (next.starts_with(' ') && line.size() < 50 && !line.ends_with('.')) {
      flush();  // a heading
      out_ += std::string(line) + "\n";
    } else {
      if (row_ || begins_paragraph(line)) flush();
      add(trimmed(line));
    }
  }
  std::string end() {
    flush();
    return std::move(out_);
  }

 private:
  void indented(std::string_view line) {
    const std::size_t indent = indent_of(line);
    // The second column of a row with a long first one may begin further right than that of the rows before.
    const std::size_t column = std::min(hang_, column_);
    const bool continues = row_ && indent > indent_ && (hang_ == kMissing || indent >= column || command_);
    if (continues) return add(trimmed(line));
    column_ = hang_ == kMissing ? column_ : hang_;
    flush();
    row_ = true;
    indent_ = indent;
    command_ = is_command(line);
    hang_ = command_ ? kMissing : second_column(line);
    if (hang_ == kMissing) return add(trimmed(line));
    left_ = trimmed(line.substr(0, hang_));
    add(trimmed(line.substr(hang_)));
  }
  void add(std::string_view words) { text_ += (text_.empty() ? "" : " ") + std::string(words); }
  void flush() {
    if (text_.empty() && left_.empty()) return;
    if (command_) {
      out_ += command_lines(text_, width_, indent_);
    } else {
      std::string start(indent_, ' ');
      std::size_t hang = row_ ? indent_ + 2 : 0;
      if (hang_ != kMissing) {
        start += left_;
        hang = hang_ <= width_ / 2 ? hang_ : indent_ + 4;
        if (display_width(start) + 2 > hang) {
          for (const std::string& part : wrap_words(with_breaks(start, width_), width_, indent_ + 4))
            out_ += part + "\n";
          start.clear();
        }
        start.resize(std::max(start.size(), hang), ' ');
      }
      const std::vector<std::string> lines =
          wrap_words(with_breaks(text_, width_ - hang), width_, hang, display_width(start));
      for (std::size_t i = 0; i < lines.size(); ++i) out_ += (i == 0 ? start : "") + lines[i] + "\n";
    }
    text_.clear();
    left_.clear();
    row_ = command_ = false;
    indent_ = 0;
    hang_ = kMissing;
  }

  std::size_t width_;
  std::string out_, text_, left_;
  bool row_ = false, command_ = false;
  std::size_t indent_ = 0, hang_ = kMissing;
  std::size_t column_ = kMissing;  ///< second column of the row before
};

}  // namespace

std::string fill_paragraphs(std::string_view text, std::size_t width) {
  Filling filling{width};
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    filling.line(line, text.substr(0, text.find('\n')));
  }
  return filling.end();
}

std::string wrap_line(std::string_view line, std::size_t width) {
  const std::size_t indent = indent_of(line);
  if (indent > 0 && is_command(line)) return command_lines(trimmed(line), width, indent);
  const std::size_t second = second_column(line);
  const std::size_t hang = second == kMissing ? 0 : display_width(line.substr(0, second));
  std::string out;
  for (const std::string& part : wrap_words(line, width, hang > 0 && hang <= width / 2 ? hang : indent + 2))
    out += part + "\n";
  return out;
}

std::string option_row(const std::string& name, const std::string& description, std::size_t width) {
  const std::size_t column = std::min<std::size_t>(28, width / 3);
  std::string flat = description;
  std::ranges::replace(flat, '\n', ' ');
  std::string start = "  " + name;
  std::string out;
  if (display_width(start) + 2 > column) {
    out = start + "\n";
    start.clear();
  }
  start.resize(std::max(start.size(), column), ' ');
  const std::vector<std::string> lines = wrap_words(with_breaks(flat, width - column), width, column, column);
  for (std::size_t i = 0; i < lines.size(); ++i) out += (i == 0 ? start : "") + lines[i] + "\n";
  return out;
}

}  // namespace tandem::io
