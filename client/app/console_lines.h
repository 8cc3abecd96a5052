#pragma once

#include <poll.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace tandem::client {

/// Reads the lines of standard input until it ends or a signal arrives.
class ConsoleLines {
 public:
  static constexpr int kIdleMs = 1000;  ///< `next` returns after so long without input

  ConsoleLines(int signals, int server) : signals_(signals), server_(server) {}
  /// Returns the next line; nullopt at the end of input, after a signal, if the server is gone, or if `idle`.
  std::optional<std::string> next() {
    idle_ = false;
    while (true) {
      if (const auto end = text_.find('\n'); end != std::string::npos) {
        std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        return line;
      }
      pollfd files[] = {{STDIN_FILENO, POLLIN, 0}, {signals_, POLLIN, 0}, {server_, POLLIN | POLLRDHUP, 0}};
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
      const ssize_t size = ::read(STDIN_FILENO, part.data(), part.size());
      if (size <= 0 || text_.size() > part.size())
        return text_.empty() ? std::nullopt : std::optional(std::exchange(text_, {}));
      text_.append(part.data(), static_cast<std::size_t>(size));
    }
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
  int signals_, server_;
  bool server_gone_ = false, idle_ = false;
  std::string text_;
};

}  // namespace tandem::client
