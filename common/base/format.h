#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

namespace tandem {

/// printf into a string, for lines that users read; text beyond 511 characters is cut.
[[nodiscard, gnu::format(printf, 1, 2)]] inline std::string format(const char* pattern, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(line, sizeof line, pattern, arguments);
  va_end(arguments);
  return line;
}

}  // namespace tandem
