#include "client/app/console_lines.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "common/io/clock.h"

namespace tandem::client {
namespace {

constexpr const char* kEraseToEnd = "\x1b[K";

/// Whether a line can be drawn again on standard output.
bool draws() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) == 1 && kind != nullptr && *kind != '\0' && std::string_view(kind) != "dumb";
}

}  // namespace

ConsoleLines::ConsoleLines(int signals, int server, int input, std::string prompt)
    : signals_(signals), server_(server), input_(input), prompt_(std::move(prompt)) {
  if (input_ != STDIN_FILENO || isatty(input_) != 1 || !draws()) return;
  keys_.emplace();
  if (!keys_->interactive()) keys_.reset();
}

void ConsoleLines::show_prompt() const {
  std::printf("%s%s", prompt_.c_str(), typed_.text().c_str());
  std::fflush(stdout);
}

std::optional<std::string> ConsoleLines::next() {
  idle_ = false;
  const Time due = io::monotonic_now() + std::chrono::milliseconds(kIdleMs);
  if (keys_) keys_->renew();
  while (true) {
    if (auto line = take_line()) return line;
    pollfd files[] = {{input_, POLLIN, 0}, {signals_, POLLIN, 0}, {server_, POLLIN | POLLRDHUP, 0}};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(due - io::monotonic_now()).count();
    const int events = poll(files, 3, static_cast<int>(std::max<decltype(left)>(left, 0)));
    if (events == 0) {
      idle_ = true;
      return std::nullopt;
    }
    if (events < 0 || files[1].revents != 0) return std::nullopt;
    if (files[2].revents != 0) {
      server_gone_ = true;
      return std::nullopt;
    }
    if (keys_) {
      if (!read_keys()) return std::nullopt;
      continue;
    }
    std::array<char, 4096> part;
    const ssize_t size = ::read(input_, part.data(), part.size());
    if (size <= 0 || text_.size() > part.size()) {
      if (std::exchange(skips_end_, false)) text_.clear();
      return text_.empty() ? std::nullopt : std::optional(std::exchange(text_, {}));
    }
    text_.append(part.data(), static_cast<std::size_t>(size));
  }
}

bool ConsoleLines::read_keys() {
  for (std::string key = keys_->next(); !key.empty(); key = keys_->next()) {
    const std::string shown = typed_.on_key(key);
    std::fwrite(shown.data(), 1, shown.size(), stdout);
    if (typed_.redraw()) std::printf("\r%s%s%s", prompt_.c_str(), typed_.text().c_str(), kEraseToEnd);
    if (typed_.ended()) {
      std::fputs("\n", stdout);
      break;
    }
  }
  std::fflush(stdout);
  text_ += typed_.take_finished();
  return keys_->interactive() && !typed_.ended();
}

ConsoleLines::Arrived ConsoleLines::take_arrived() {
  Arrived arrived;
  if (keys_) {
    for (std::string key = keys_->next(); !key.empty(); key = keys_->next()) typed_.on_key(key);
    text_ += typed_.take_finished();
    arrived.begun = typed_.text();
    typed_.clear();
  } else {
    int waiting = 0;  // [bytes] input that arrives later than this call is not read
    if (::ioctl(input_, FIONREAD, &waiting) != 0) waiting = 0;
    for (std::size_t left = std::min(static_cast<std::size_t>(std::max(waiting, 0)), kArrivedMax); left > 0;) {
      std::array<char, 4096> part;
      const ssize_t size = ::read(input_, part.data(), std::min(left, part.size()));
      if (size <= 0) break;
      text_.append(part.data(), static_cast<std::size_t>(size));
      left -= static_cast<std::size_t>(size);
    }
    if (isatty(input_) == 1) tcflush(input_, TCIFLUSH);  // the begin of a line is in the terminal
  }
  while (auto line = take_line()) arrived.lines.push_back(std::move(*line));
  if (!keys_ && !text_.empty()) {
    skips_end_ = true;
    arrived.begun = std::exchange(text_, {});
  }
  return arrived;
}

std::optional<std::string> ConsoleLines::take_line() {
  auto end = text_.find('\n');
  if (end != std::string::npos && std::exchange(skips_end_, false)) {
    text_.erase(0, end + 1);
    end = text_.find('\n');
  }
  if (end == std::string::npos) return std::nullopt;
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  return line;
}

}  // namespace tandem::client
