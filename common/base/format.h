#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

namespace tandem {

/// printf into a string.
[[nodiscard, gnu::format(printf, 1, 0)]] inline std::string format_list(const char* pattern, std::va_list arguments) {
  std::va_list again;
  va_copy(again, arguments);
  const int size = std::vsnprintf(nullptr, 0, pattern, arguments);
  std::string text(size > 0 ? static_cast<std::size_t>(size) : 0, ' ');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  return text;
}

/// printf into a string, for lines that users read.
[[nodiscard, gnu::format(printf, 1, 2)]] inline std::string format(const char* pattern, ...) {
  std::va_list arguments;
  va_start(arguments, pattern);
  std::string text = format_list(pattern, arguments);
  va_end(arguments);
  return text;
}

}  // namespace tandem
