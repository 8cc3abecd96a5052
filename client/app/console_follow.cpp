#include "client/app/console_follow.h"

#include <poll.h>

#include "common/io/clock.h"

namespace tandem::client {
namespace {

constexpr Duration kFollow = std::chrono::seconds(15);
constexpr int kRetryMs = 500;

}  // namespace

std::expected<Console, std::string> follow_session(const JoinOptions& options) {
  const Time until = io::monotonic_now() + kFollow;
  while (true) {
    auto again = join_console(options);
    if (again) return std::move(*again);
    if (again.error().ticket_refused || io::monotonic_now() >= until) return std::unexpected(again.error().reason);
    pollfd signal{options.signals, POLLIN, 0};
    if (again.error().interrupted || poll(&signal, 1, kRetryMs) > 0) return std::unexpected(std::string{});
  }
}

}  // namespace tandem::client
