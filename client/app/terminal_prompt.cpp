#include "client/app/terminal_prompt.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <optional>

namespace tandem::client {
namespace {

constexpr std::size_t kAnswerMax = 64;

/// Returns the next line without line feed; nullopt after a signal or at the end of input.
std::optional<std::string> next_line(int signals) {
  std::string line;
  for (;;) {
    std::array<pollfd, 2> files{{{signals, POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}}};
    if (poll(files.data(), files.size(), -1) < 0) continue;
    if (files[0].revents != 0) return std::nullopt;
    char c = 0;
    if (::read(STDIN_FILENO, &c, 1) != 1) return std::nullopt;
    if (c == '\n') return line;
    if (line.size() < kAnswerMax) line += c;
  }
}

}  // namespace

bool wait_for_enter(const std::string& words, int signals) {
  std::fprintf(stderr, "%s; then press Enter\n", words.c_str());
  return next_line(signals).has_value();
}

bool user_confirms(const std::string& words, int signals) {
  std::fprintf(stderr, "%s\nType yes and press Enter to begin, anything else to leave it: ", words.c_str());
  std::fflush(stderr);
  return next_line(signals) == "yes";
}

}  // namespace tandem::client
