#include "common/io/terminal.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace tandem::io {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kKeys{{{"\x1b[A", "up"},
                                                                               {"\x1b[B", "down"},
                                                                               {"\x1b[C", "right"},
                                                                               {"\x1b[D", "left"},
                                                                               {"\x1bOA", "up"},
                                                                               {"\x1bOB", "down"},
                                                                               {"\x1bOC", "right"},
                                                                               {"\x1bOD", "left"},
                                                                               {"\x1b[5~", "pageup"},
                                                                               {"\x1b[6~", "pagedown"}}};

/// Length of the first `columns` characters of UTF-8 text, in bytes.
std::size_t bytes_of_columns(const std::string& text, std::size_t columns) {
  std::size_t at = 0;
  while (at < text.size()) {
    const bool begins = (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80;
    if (begins && columns-- == 0) break;
    ++at;
  }
  return at;
}

}  // namespace

KeyReader::KeyReader() {
  // A program in the background may not touch the terminal: it would be stopped.
  interactive_ =
      isatty(STDIN_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) == getpgrp() && tcgetattr(STDIN_FILENO, &before_) == 0;
  if (!interactive_) return;
  termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 1;
  raw.c_cc[VTIME] = 0;
  interactive_ = tcsetattr(STDIN_FILENO, TCSANOW, &raw) == 0;
}

KeyReader::~KeyReader() {
  if (interactive_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

int KeyReader::fd() const noexcept { return interactive_ ? STDIN_FILENO : -1; }

std::string KeyReader::next() {
  if (!interactive_) return {};
  if (pending_.empty()) {
    pollfd waiting{STDIN_FILENO, POLLIN, 0};
    if (poll(&waiting, 1, 0) <= 0) return {};
    std::array<char, 64> bytes;
    const auto count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0) {
      interactive_ = false;  // the terminal went away
      return {};
    }
    pending_.assign(bytes.data(), static_cast<std::size_t>(count));
  }
  for (const auto& [bytes, name] : kKeys) {
    if (!pending_.starts_with(bytes)) continue;
    pending_.erase(0, bytes.size());
    return std::string(name);
  }
  if (pending_.front() == '\x1b') {  // some other key with a sequence of its own
    pending_.clear();
    return {};
  }
  std::string key = pending_.substr(0, 1);
  pending_.erase(0, 1);
  return key;
}

StatusLine::StatusLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void StatusLine::show(const std::string& line) {
  if (quiet_) return;
  if (!terminal_) {
    std::fprintf(stderr, "%s\n", line.c_str());
    return;
  }
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  const std::size_t bytes = bytes_of_columns(line, known ? size.ws_col - 1u : 119u);
  std::fprintf(stderr, "\r\x1b[K%.*s", static_cast<int>(bytes), line.c_str());
  std::fflush(stderr);
  shown_ = true;
}

void StatusLine::clear() {
  if (std::exchange(shown_, false)) std::fprintf(stderr, "\r\x1b[K");
  std::fflush(stderr);
}

void StatusLine::note(const std::string& text) {
  clear();
  if (!quiet_) spdlog::info(text);
}

void StatusLine::warn(const std::string& text) {
  clear();
  spdlog::warn(text);
}

}  // namespace tandem::io
