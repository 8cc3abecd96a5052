#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/time.h"
#include "common/io/udp_socket.h"

namespace tandem::client {

/// Sends JSON datagrams to a plot program such as PlotJuggler, at most 100 per second. It never waits: a datagram that
/// cannot be sent is dropped and counted.
class PlotStream {
 public:
  /// Shortest time between two datagrams.
  static constexpr Duration kInterval = std::chrono::milliseconds(10);
  /// PlotJuggler's own port, on this computer.
  static constexpr const char* kDefaultAddress = "127.0.0.1:9870";

  /// @param to        address of the plot program
  /// @param now       monotonic clock
  /// @param unix_now  wall clock at `now`, since 1970; time stamps count on from it
  /// @return          the stream, or the error
  [[nodiscard]] static std::expected<PlotStream, std::string> open(const io::SocketAddress& to, Time now,
                                                                   Duration unix_now);

  /// Returns whether a datagram may be sent now.
  [[nodiscard]] bool due(Time now) const noexcept { return !last_ || now - *last_ >= kInterval; }
  /// Time stamp of `now`: seconds since 1970. It increases with the monotonic clock, also when the wall clock is set.
  [[nodiscard]] double timestamp(Time now) const noexcept;
  /// Sends one datagram. @pre due(now)
  void send(Time now, std::string_view json) noexcept;

  /// Address of the plot program.
  [[nodiscard]] const std::string& to() const noexcept { return to_; }
  /// Returns whether the plot program runs on this computer. Otherwise the network can read the datagrams.
  [[nodiscard]] bool on_this_computer() const noexcept { return loopback_; }
  [[nodiscard]] std::uint64_t sent() const noexcept { return sent_; }
  /// Datagrams that could not be sent, such as those to a port at which no program listens.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  PlotStream(io::UdpSocket socket, const io::SocketAddress& to, Time began, Duration unix_began)
      : socket_(std::move(socket)),
        to_(io::to_text(to)),
        loopback_(to.loopback()),
        began_(began),
        unix_began_(unix_began) {}

  io::UdpSocket socket_;
  std::string to_;
  bool loopback_;
  Time began_;
  Duration unix_began_;
  std::optional<Time> last_;
  std::uint64_t sent_ = 0, dropped_ = 0;
};

}  // namespace tandem::client
