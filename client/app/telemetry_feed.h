#pragma once

#include <array>
#include <expected>
#include <functional>
#include <memory>

#include "client/app/join_client.h"
#include "client/diagnostics/read_pace.h"
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
  /// @param socket  connected to the server
  TelemetryFeed(JoinedWatcher joined, io::UdpSocket socket);

  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  /// The console's control connection, for commands.
  [[nodiscard]] const Console& console() const noexcept { return console_; }
  /// Readable when datagrams wait.
  [[nodiscard]] int fd() const noexcept { return socket_.fd.get(); }
  /// Returns how a reader that shows the newest state waits before its next call of `serve`, at most
  /// kServeIntervalMs. Such a reader sleeps until TELEMETRY is due, and does not wait for `fd` then.
  [[nodiscard]] ReadPace::Wait next_wait(Time now) const noexcept { return pace_.wait(now); }
  /// Receives the waiting datagrams and sends those that are due. Call it when `fd` is readable or as `next_wait` says,
  /// and every kServeIntervalMs. @return a newer TELEMETRY arrived
  bool serve(Time now) {
    return serve(now, [](const SessionWatch&) {});
  }
  /// @param on_newer  called after each TELEMETRY that is newer than all before, while `watch` has it
  bool serve(Time now, const std::function<void(const SessionWatch&)>& on_newer);
  [[nodiscard]] const SessionWatch& watch() const noexcept { return *watch_; }
  /// Arrival of the newest TELEMETRY in this computer's kernel.
  [[nodiscard]] Time arrived() const noexcept { return arrived_; }
  /// Ends the watch, so that the server frees the slot at once.
  void leave(Time now);

 private:
  void send(Time now);

  std::unique_ptr<SceneSpec> scene_;
  Console console_;
  io::UdpSocket socket_;
  std::unique_ptr<SessionWatch> watch_;
  std::unique_ptr<io::ReceiveBatch> in_;
  ReadPace pace_;
  Time arrived_{};
};

}  // namespace tandem::client
