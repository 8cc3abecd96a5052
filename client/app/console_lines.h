#pragma once

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tandem::client {

/// Reads the lines of an input until it ends or a signal arrives.
class ConsoleLines {
 public:
  static constexpr int kIdleMs = 1000;  ///< `next` returns after so long without input
  static constexpr std::size_t kArrivedMax = 65536;

  ConsoleLines(int signals, int server, int input = STDIN_FILENO) : signals_(signals), server_(server), input_(input) {}
  /// Returns the next line; nullopt at the end of input, after a signal, if the server is gone, or if `idle`.
  std::optional<std::string> next() {
    idle_ = false;
    while (true) {
      if (auto line = take_line()) return line;
      pollfd files[] = {{input_, POLLIN, 0}, {signals_, POLLIN, 0}, {server_, POLLIN | POLLRDHUP, 0}};
      const int events = poll(files, 3, kIdleMs);
      if (events == 0) {
        idle_ = true;
        return std::nullopt;
      }
      if (events < 0 || files[1].revents != 0) return std::nullopt;
      if (files[2].revents != 0) {
        server_gone_ = true;
        return std::nullopt;
      }
      std::array<char, 4096> part;
      const ssize_t size = ::read(input_, part.data(), part.size());
      if (size <= 0 || text_.size() > part.size())
        return text_.empty() ? std::nullopt : std::optional(std::exchange(text_, {}));
      text_.append(part.data(), static_cast<std::size_t>(size));
    }
  }

  /// Takes the lines that have arrived already, at most kArrivedMax bytes of them: those of a time without a
  /// connection. The begin of a line whose end has not arrived stays.
  std::vector<std::string> take_arrived() {
    int waiting = 0;  // [bytes] input that arrives later than this call is not read
    if (::ioctl(input_, FIONREAD, &waiting) != 0) waiting = 0;
    for (std::size_t left = std::min(static_cast<std::size_t>(std::max(waiting, 0)), kArrivedMax); left > 0;) {
      std::array<char, 4096> part;
      const ssize_t size = ::read(input_, part.data(), std::min(left, part.size()));
      if (size <= 0) break;
      text_.append(part.data(), static_cast<std::size_t>(size));
      left -= static_cast<std::size_t>(size);
    }
    std::vector<std::string> lines;
    while (auto line = take_line()) lines.push_back(std::move(*line));
    return lines;
  }

  /// Watches another connection from now on.
  void set_server(int server) {
    server_ = server;
    server_gone_ = false;
  }
  /// True if `next` returned because of kIdleMs without input.
  [[nodiscard]] bool idle() const { return idle_; }
  /// True if the server closed the connection while no request was pending.
  [[nodiscard]] bool server_gone() const { return server_gone_; }

 private:
  std::optional<std::string> take_line() {
    const auto end = text_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
  }

  int signals_, server_, input_;
  bool server_gone_ = false, idle_ = false;
  std::string text_;
};

}  // namespace tandem::client
