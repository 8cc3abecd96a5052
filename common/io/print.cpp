#include "common/io/print.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdarg>

#include "common/io/help_text.h"
#include "common/io/screen_block.h"
#include "common/io/text_layout.h"

namespace tandem::io {

std::optional<std::size_t> text_width(std::FILE* file) noexcept {
  const bool terminal = isatty(fileno(file)) != 0;
  if (terminal) return screen_size(fileno(file)).columns - 1;
  const std::size_t columns = columns_from_environment();
  return columns > 0 ? std::optional(columns - 1) : std::nullopt;
}

std::string wrap_text(std::string_view text, std::size_t width) {
  const bool ends_line = text.ends_with('\n');
  std::string out;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    out += wrap_line(line, width);
  }
  if (!ends_line && out.ends_with('\n')) out.pop_back();
  return out;
}

std::string wrap_for_terminal(std::string_view text, std::FILE* file) {
  const auto width = text_width(file);
  return width ? wrap_text(text, *width) : std::string(text);
}

void print(std::FILE* file, std::string_view text) { std::fputs(wrap_for_terminal(text, file).c_str(), file); }

void print_formatted(std::FILE* file, const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int size = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(size > 0 ? static_cast<std::size_t>(size) : 0, ' ');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  print(file, text);
}

bool reader_closed(std::FILE* file) noexcept {
  pollfd end{fileno(file), 0, 0};
  return poll(&end, 1, 0) > 0 && (end.revents & (POLLERR | POLLHUP)) != 0;
}

}  // namespace tandem::io
