#include "common/io/screen_block.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "common/io/text_layout.h"

namespace tandem::io {
namespace {

constexpr std::size_t kColumnsMin = 20, kColumnsMax = 1000;
constexpr const char* kClear = "\r\x1b[J";
std::atomic<bool> shown{false};  // a process has one terminal

}  // namespace

std::size_t columns_from_environment() noexcept {
  const char* const text = std::getenv("COLUMNS");
  if (text == nullptr) return 0;
  std::size_t columns = 0;
  const char* const end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, columns);
  return error == std::errc() && rest == end && columns >= kColumnsMin && columns <= kColumnsMax ? columns : 0;
}

ScreenSize screen_size(int fd) noexcept {
  winsize size{};
  ScreenSize out;
  if (ioctl(fd, TIOCGWINSZ, &size) != 0) {
    if (const std::size_t columns = columns_from_environment(); columns > 0) out.columns = columns;
    return out;
  }
  if (size.ws_col > 1) out.columns = size.ws_col;
  if (size.ws_row > 1) out.rows = size.ws_row;
  return out;
}

void ScreenBlock::show(std::span<const std::string> lines) {
  const ScreenSize size = screen_size(STDERR_FILENO);
  std::string text = kClear;
  std::size_t count = 0;
  for (const std::string& line : lines) {
    if (display_width(line) >= size.columns || count + 1 >= size.rows) continue;
    text += (count++ == 0 ? "" : "\r\n") + line;
  }
  text += "\r";
  if (count > 1) text += "\x1b[" + std::to_string(count - 1) + "A";
  shown = count > 0;
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

void ScreenBlock::clear() {
  std::fputs(take_clear_sequence(), stderr);
  std::fflush(stderr);
}

const char* ScreenBlock::take_clear_sequence() noexcept { return shown.exchange(false) ? kClear : ""; }

}  // namespace tandem::io
