#pragma once

#include <expected>
#include <string>

#include "client/joining.h"
#include "common/io/udp_socket.h"

namespace tandem::client {

/// A seat that was given.
struct GivenSeat {
  SeatSetup setup;
  link::Link::Params link;
};

/// Why there is none.
struct NotSeated {
  bool interrupted = false;  ///< a signal ended it
  std::string reason;        ///< cause and remedy; or which signal
};

/// Asks the server for a seat and waits for its answer.
/// @param signals  file of signals.h
[[nodiscard]] std::expected<GivenSeat, NotSeated> ask_for_seat(const io::UdpSocket& socket, const std::string& server,
                                                               const std::string& seat, const hal::DeviceCaps& caps,
                                                               Duration patience, int signals);

/// Tells the server that a seat just given will not be used, so that it is free for others at once.
void give_back(const io::UdpSocket& socket, const GivenSeat& given, const hal::DeviceCaps& caps);

}  // namespace tandem::client
