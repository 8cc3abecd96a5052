#pragma once

#include <cstdint>
#include <expected>

#include "common/base/rng.h"
#include "hal/device.h"
#include "proto/seat_setup.h"
#include "server/session.h"

namespace tandem::netsim {

/// What a client has after joining: the seat's setup, and its end of the connection.
struct VirtualSeat {
  SeatSetup setup;
  link::Link::Params link;
};

/// Draws tokens for the session's path challenges, as the host of a live one does from the kernel.
/// @param first  of the draws of `key`
void fill_path_tokens(server::Session& session, RandomKey key, std::uint64_t first) noexcept;

/// Joining without TLS: what the two ends of a handshake would know afterwards is drawn from `key`. The control connection is taken
/// to be there, at once; from the first datagram on everything is as it is live.
/// @param number      of this attempt: other ids and secrets each time
/// @param same_owner  he who sat there comes again  @param slot  of the session, where a server has several
[[nodiscard]] std::expected<VirtualSeat, server::JoinResult> join_virtually(server::Session& session, Time now, std::size_t seat,
                                                                          const hal::DeviceCaps& caps, RandomKey key, std::uint64_t number,
                                                                          bool same_owner = false, std::uint8_t slot = 0);
/// The same for one who only judges his link; his setup is that of the first seat.
[[nodiscard]] std::expected<VirtualSeat, server::JoinResult> visit_virtually(server::Session& session, Time now, RandomKey key,
                                                                           std::uint64_t number);

}  // namespace tandem::netsim
