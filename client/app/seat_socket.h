#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "client/seat/seat.h"
#include "common/base/axes.h"
#include "common/io/datagram_batch.h"
#include "common/io/udp_socket.h"

namespace tandem::client {

/// Moves datagrams between a connected socket and a seat, several with one system call. No heap after construction.
class SeatSocket {
 public:
  explicit SeatSocket(io::UdpSocket socket) : socket_(std::move(socket)) {}

  /// Passes all waiting datagrams to `seat`, at most 4 batches: a flood of datagrams cannot stall the servo thread.
  void receive(Time now, Seat& seat) noexcept TANDEM_REALTIME;
  /// Sends the datagrams that `seat` has due. One that cannot be sent counts as lost.
  void send(Time now, Seat& seat) noexcept TANDEM_REALTIME;
  /// Exchanges the socket with `other`.
  void swap(io::UdpSocket& other) noexcept { std::swap(socket_, other); }

 private:
  static constexpr std::size_t kSendMax = 4;

  io::UdpSocket socket_;
  io::ReceiveBatch in_;
  Time read_until_{};  ///< datagrams that had arrived by then were read
  io::SendBatch out_;
  std::array<std::array<std::byte, transport::kDatagramMax>, kSendMax> buffers_;
};

}  // namespace tandem::client
