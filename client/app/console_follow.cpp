#include "client/app/console_follow.h"

#include <poll.h>

#include "common/io/clock.h"

namespace tandem::client {
namespace {

constexpr Duration kFollow = std::chrono::seconds(15);
constexpr int kRetryMs = 500;

template <class Joined>
std::expected<Joined, std::string> joined_again(const JoinOptions& options,
                                                std::expected<Joined, JoinError> (*join)(const JoinOptions&)) {
  const Time until = io::monotonic_now() + kFollow;
  while (true) {
    auto again = join(options);
    if (again) return std::move(*again);
    if (again.error().refused == rpc::ErrorCode::kTicket || io::monotonic_now() >= until)
      return std::unexpected(again.error().reason);
    pollfd signal{options.signals, POLLIN, 0};
    if (again.error().interrupted || poll(&signal, 1, kRetryMs) > 0) return std::unexpected(std::string{});
  }
}

}  // namespace

std::expected<Console, std::string> follow_session(const JoinOptions& options) {
  return joined_again<Console>(options, join_console);
}

std::expected<TelemetryFeed, std::string> follow_watched_session(const JoinOptions& options) {
  return joined_again<TelemetryFeed>(options, TelemetryFeed::open);
}

}  // namespace tandem::client
