#include "netsim/proxy/app/proxy_control_loop.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "common/io/clock.h"
#include "common/io/screen_block.h"
#include "common/io/terminal.h"
#include "common/io/text_layout.h"
#include "netsim/proxy/app/proxy_status_view.h"

namespace tandem::netsim {
namespace {

constexpr Duration kEveryOnTerminal{500'000'000};
constexpr Duration kEveryLine{5'000'000'000};
constexpr std::size_t kTypedCommandMax = 200;

/// Command being typed, completed by Enter.
class CommandLine {
 public:
  /// Processes a key.
  /// @return the command, once it is complete
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
    } else if (key.size() == 1 && static_cast<unsigned char>(key[0]) >= ' ' && text_.size() < kTypedCommandMax) {
      text_ += key;
    }
    return std::nullopt;
  }
  /// Returns the end of the typed text that fits.
  [[nodiscard]] std::string shown(std::size_t width) const {
    if (text_.empty()) return "> _  (a command; `help`)";
    const std::size_t room = width > 4 ? width - 4 : 1;
    return "> " + (text_.size() > room ? text_.substr(text_.size() - room) : text_) + "_";
  }

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

std::string control_reply_text(const ProxyControl::Answer& answer) {
  return (answer.done ? "0" : answer.understood ? "1" : "2") + answer.text;
}

void run_control_loop(Proxy& proxy, ProxyControl& control, ControlSocket& socket, int signals, int finished) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  io::KeyReader keys;
  CommandLine command;
  ProxyStatusView view{proxy};
  view.take_snapshot();
  std::vector<std::string> last_answer;
  const Duration every = terminal ? kEveryOnTerminal : kEveryLine;
  Duration next = io::read_clock(CLOCK_MONOTONIC) + every;
  bool stop = false;
  const auto show = [&] {
    if (!terminal) return;
    const io::ScreenSize size = io::screen_size(STDERR_FILENO);
    const std::size_t width = size.columns - 1;
    std::vector<std::string> rows = io::lay_out_items(view.line(), 2, width);
    std::vector<std::string> answer;
    for (const std::string& line : last_answer)
      std::ranges::move(io::wrap_words(line, width, 2), std::back_inserter(answer));
    const std::size_t taken = rows.size() + answer.size() + 2;
    std::ranges::move(view.table(size.rows > taken + 2 ? size.rows - taken : 3, width), std::back_inserter(rows));
    std::ranges::move(answer, std::back_inserter(rows));
    if (keys.interactive()) rows.push_back(command.shown(width));
    io::ScreenBlock::show(rows);
  };
  while (!stop) {
    std::array<pollfd, 5> fds{{{signals, POLLIN, 0},
                               {finished, POLLIN, 0},
                               {socket.fd(), POLLIN, 0},
                               {keys.fd(), POLLIN, 0},
                               {proxy.pool().wanted_fd(), POLLIN, 0}}};
    const Duration left = std::max(next - io::read_clock(CLOCK_MONOTONIC), Duration{});
    ::poll(fds.data(), fds.size(), static_cast<int>(left.count() / 1'000'000) + 1);
    if (fds[0].revents != 0 || fds[1].revents != 0) break;
    if (fds[2].revents != 0) {
      socket.serve([&](const std::string& line) {
        const ProxyControl::Answer answer = control.execute(line);
        stop = stop || answer.stop;
        return control_reply_text(answer);
      });
    }
    if (fds[4].revents != 0) proxy.pool().refill();
    bool typed = false;
    for (std::string key = keys.next(); !key.empty(); key = keys.next()) {
      typed = true;
      const auto whole = command.key(key);
      if (!whole) continue;
      last_answer.clear();
      if (whole->empty()) continue;
      const ProxyControl::Answer answer = control.execute(*whole);
      stop = stop || answer.stop;
      last_answer = lines_of(answer.text);
      if (!terminal) std::fputs(answer.text.c_str(), stderr);
    }
    if (io::read_clock(CLOCK_MONOTONIC) >= next) {
      next += every;
      view.take_snapshot();
      if (!terminal) std::fprintf(stderr, "%s\n", io::join_items(view.line()).c_str());
      show();
    } else if (typed) {
      show();
    }
  }
  if (terminal) io::ScreenBlock::clear();
  proxy.stop();
}

}  // namespace tandem::netsim
