#include "netsim/app/proxy_watch.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "common/io/clock.h"
#include "common/io/terminal.h"
#include "netsim/app/proxy_view.h"

namespace tandem::netsim {
namespace {

constexpr Duration kEveryOnTerminal{500'000'000};
constexpr Duration kEveryLine{5'000'000'000};
constexpr std::size_t kCommandMax = 200;

/// Rows that stay in their place on standard error; each is cut to the width of the terminal.
class Screen {
 public:
  Screen() : terminal_(isatty(STDERR_FILENO) != 0) {}
  [[nodiscard]] bool terminal() const noexcept { return terminal_; }
  [[nodiscard]] std::size_t height() const {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 4 ? size.ws_row : 24u;
  }
  void show(const std::vector<std::string>& rows) {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    const std::size_t width = known ? size.ws_col - 1u : 79u;
    std::string text = back();
    for (const std::string& row : rows) text += "\x1b[K" + row.substr(0, width) + "\n";
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
    shown_ = rows.size();
  }
  /// Takes the rows away, so that something else can be printed.
  void clear() {
    std::fputs(back().c_str(), stderr);
    std::fflush(stderr);
    shown_ = 0;
  }

 private:
  [[nodiscard]] std::string back() const {
    return shown_ == 0 ? std::string{} : "\x1b[" + std::to_string(shown_) + "A\r\x1b[J";
  }
  bool terminal_;
  std::size_t shown_ = 0;
};

/// What somebody types: a command, ended by Enter.
class CommandLine {
 public:
  /// @return the command when it is complete
  std::optional<std::string> key(const std::string& key) {
    if (key == "\n" || key == "\r") {
      std::string whole;
      std::swap(whole, text_);
      return whole;
    }
    if (key == "\x7f" || key == "\b") {
      if (!text_.empty()) text_.pop_back();
    } else if (key == "\x15") {  // Ctrl-U
      text_.clear();
    } else if (key.size() == 1 && static_cast<unsigned char>(key[0]) >= ' ' && text_.size() < kCommandMax) {
      text_ += key;
    }
    return std::nullopt;
  }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

}  // namespace

std::string wire_text(const ProxyControl::Answer& answer) {
  return (answer.done ? "0" : answer.understood ? "1" : "2") + answer.text;
}

void watch_proxy(Proxy& proxy, ProxyControl& control, ControlSocket& socket, int signals, int finished) {
  Screen screen;
  io::KeyReader keys;
  CommandLine command;
  ProxyView view{proxy};
  view.look();
  std::vector<std::string> last_answer;
  const Duration every = screen.terminal() ? kEveryOnTerminal : kEveryLine;
  Duration next = io::read_clock(CLOCK_MONOTONIC) + every;
  bool stop = false;
  const auto show = [&] {
    if (!screen.terminal()) return;
    std::vector<std::string> rows =
        view.table(screen.height() > 6 + last_answer.size() ? screen.height() - 4 - last_answer.size() : 3);
    rows.insert(rows.begin(), view.line());
    rows.insert(rows.end(), last_answer.begin(), last_answer.end());
    if (keys.interactive())
      rows.push_back("> " + command.text() + "_" + (command.text().empty() ? "  (a command; `help`)" : ""));
    screen.show(rows);
  };
  while (!stop) {
    std::array<pollfd, 5> fds{{{signals, POLLIN, 0},
                               {finished, POLLIN, 0},
                               {socket.fd(), POLLIN, 0},
                               {keys.fd(), POLLIN, 0},
                               {proxy.wanted_fd(), POLLIN, 0}}};
    const Duration left = std::max(next - io::read_clock(CLOCK_MONOTONIC), Duration{});
    ::poll(fds.data(), fds.size(), static_cast<int>(left.count() / 1'000'000) + 1);
    if (fds[0].revents != 0 || fds[1].revents != 0) break;
    if (fds[2].revents != 0) {
      socket.serve([&](const std::string& line) {
        const ProxyControl::Answer answer = control.carry_out(line);
        stop = stop || answer.stop;
        return wire_text(answer);
      });
    }
    if (fds[4].revents != 0) proxy.refill();
    bool typed = false;
    for (std::string key = keys.next(); !key.empty(); key = keys.next()) {
      typed = true;
      const auto whole = command.key(key);
      if (!whole) continue;
      last_answer.clear();
      if (whole->empty()) continue;
      const ProxyControl::Answer answer = control.carry_out(*whole);
      stop = stop || answer.stop;
      last_answer = lines_of(answer.text);
      if (!screen.terminal()) std::fputs(answer.text.c_str(), stderr);
    }
    if (io::read_clock(CLOCK_MONOTONIC) >= next) {
      next += every;
      view.look();
      if (!screen.terminal()) std::fprintf(stderr, "%s\n", view.line().c_str());
      show();
    } else if (typed) {
      show();
    }
  }
  screen.clear();
  proxy.stop();
}

}  // namespace tandem::netsim
