#include "client/app/telemetry_feed.h"

#include <sys/socket.h>

#include <cmath>
#include <utility>

#include "common/io/clock.h"

namespace tandem::client {

namespace {
constexpr int kRounds = 4;  // batches per call: a flood of datagrams cannot stall the caller

wire::TelemetryLayout layout_of(const SceneSpec& scene) {
  return {scene.seats.size(), scene.masters(), scene.tools.size()};
}

/// Returns the time between two TELEMETRY to a console: whole ticks.
Duration period_of(const SceneSpec& scene) {
  return from_seconds(std::ceil(scene.tick_hz / wire::kTelemetryHz) / scene.tick_hz);
}
}  // namespace

std::expected<TelemetryFeed, JoinError> TelemetryFeed::open(const JoinOptions& options) {
  auto joined = join_watcher(options);
  if (!joined) return std::unexpected(joined.error());
  auto socket = io::connect_udp(joined->udp);
  if (!socket) return std::unexpected(JoinError{.reason = "--server: " + socket.error()});
  return TelemetryFeed(std::move(*joined), std::move(*socket));
}

TelemetryFeed::TelemetryFeed(JoinedWatcher joined, io::UdpSocket socket)
    : scene_(std::make_unique<SceneSpec>(std::move(joined.scene))),
      console_(std::move(joined.console)),
      socket_(std::move(socket)),
      watch_(std::make_unique<SessionWatch>(layout_of(*scene_), joined.link.tick, joined.link)),
      in_(std::make_unique<io::ReceiveBatch>()),
      pace_(period_of(*scene_), std::chrono::milliseconds(kServeIntervalMs)) {}

bool TelemetryFeed::serve(Time now, const std::function<void(const SessionWatch&)>& on_newer) {
  bool newer = false, stamped = false;
  for (int round = 0; round < kRounds; ++round) {
    const int count = in_->receive(fd());
    const Duration read_at = io::read_clock(CLOCK_REALTIME);
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (in_->too_long(i) || !watch_->on_datagram(now, in_->bytes(i))) continue;
      const auto details = in_->details(i, read_at);
      newer = true;
      stamped = details.stamp != Duration::zero();
      arrived_ = now - details.age;
      on_newer(*watch_);
    }
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) break;
  }
  if (newer && stamped)
    pace_.on_arrival(arrived_);
  else if (newer)
    pace_.restart();
  send(now);
  return newer;
}

void TelemetryFeed::leave(Time now) {
  watch_->leave();
  send(now);
}

/// A datagram that cannot be sent counts as lost.
void TelemetryFeed::send(Time now) {
  std::array<std::byte, transport::kDatagramMax> buffer;
  while (const auto size = watch_->poll_transmit(now, buffer))
    static_cast<void>(::send(fd(), buffer.data(), *size, MSG_NOSIGNAL | MSG_DONTWAIT));
}

}  // namespace tandem::client
