#include "common/io/terminal.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "common/io/log.h"
#include "common/io/screen_block.h"

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

}  // namespace

KeyReader::KeyReader() {
  // A background program must not change the terminal: the system would stop it.
  interactive_ =
      isatty(STDIN_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) == getpgrp() && tcgetattr(STDIN_FILENO, &before_) == 0;
  if (!interactive_) return;
  raw_ = before_;
  raw_.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw_.c_cc[VMIN] = 1;
  raw_.c_cc[VTIME] = 0;
  interactive_ = tcsetattr(STDIN_FILENO, TCSANOW, &raw_) == 0;
}

void KeyReader::renew() noexcept {
  if (interactive_ && tcgetpgrp(STDIN_FILENO) == getpgrp()) tcsetattr(STDIN_FILENO, TCSANOW, &raw_);
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
      interactive_ = false;  // the terminal was closed
      return {};
    }
    pending_.assign(bytes.data(), static_cast<std::size_t>(count));
  }
  for (const auto& [bytes, name] : kKeys) {
    if (!pending_.starts_with(bytes)) continue;
    pending_.erase(0, bytes.size());
    return std::string(name);
  }
  if (pending_.front() == '\x1b') {  // another key with a sequence of its own
    pending_.clear();
    return {};
  }
  std::string key = pending_.substr(0, 1);
  pending_.erase(0, 1);
  return key;
}

StatusLine::StatusLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void StatusLine::show(std::span<const ScreenItem> items, std::size_t rows) {
  if (quiet_) return;
  if (!terminal_) {
    if (const std::string line = join_items(items); !line.empty()) std::fprintf(stderr, "%s\n", line.c_str());
    return;
  }
  const ScreenSize size = screen_size(STDERR_FILENO);
  ScreenBlock::show(lay_out_items(items, std::min(rows, rows_max()), size.columns - 1));
}

std::size_t StatusLine::rows_max() const noexcept { return screen_size(STDERR_FILENO).rows - 1; }

void StatusLine::clear() {
  if (terminal_) ScreenBlock::clear();
}

void StatusLine::note(const std::string& text) {
  clear();
  if (!quiet_) log(Level::kInfo, text);
}

void StatusLine::warn(const std::string& text) {
  clear();
  log(Level::kWarn, text);
}

}  // namespace tandem::io
