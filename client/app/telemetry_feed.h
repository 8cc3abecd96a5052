#pragma once

#include <array>
#include <expected>
#include <functional>
#include <memory>

#include "client/app/join_client.h"
#include "client/diagnostics/session_watch.h"
#include "common/io/datagram_batch.h"
#include "common/io/udp_socket.h"

namespace tandem::client {

/// A console that sees a session live: joined by TLS, with TELEMETRY over UDP.
class TelemetryFeed {
 public:
  /// Longest time between two calls of `serve` [ms].
  static constexpr int kServeIntervalMs = 50;

  /// Joins and opens the socket. @pre as `join_watcher`
  [[nodiscard]] static std::expected<TelemetryFeed, JoinError> open(const JoinOptions& options);

  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  /// The console's control connection, for commands.
  [[nodiscard]] const Console& console() const noexcept { return console_; }
  /// Readable when datagrams wait.
  [[nodiscard]] int fd() const noexcept { return socket_.fd.get(); }
  /// Receives the waiting datagrams and sends those that are due. Call it when `fd` is readable, and every
  /// kServeIntervalMs. @return a newer TELEMETRY arrived
  bool serve(Time now) {
    return serve(now, [](const SessionWatch&) {});
  }
  /// @param on_newer  called after each TELEMETRY that is newer than all before, while `watch` has it
  bool serve(Time now, const std::function<void(const SessionWatch&)>& on_newer);
  [[nodiscard]] const SessionWatch& watch() const noexcept { return *watch_; }
  /// Ends the watch, so that the server frees the slot at once.
  void leave(Time now);

 private:
  TelemetryFeed(JoinedWatcher joined, io::UdpSocket socket);
  void send(Time now);

  std::unique_ptr<SceneSpec> scene_;
  Console console_;
  io::UdpSocket socket_;
  std::unique_ptr<SessionWatch> watch_;
  std::unique_ptr<io::ReceiveBatch> in_;
};

}  // namespace tandem::client
