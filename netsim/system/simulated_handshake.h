#pragma once

#include <cstdint>
#include <expected>

#include "common/base/rng.h"
#include "hal/core/device.h"
#include "proto/text/seat_setup.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Result of a join for the client: the seat's setup, and its end of the connection.
struct SimulatedJoin {
  SeatSetup setup;
  transport::SecureChannel::Params channel_params;
};

/// Draws tokens for the session's path challenges. A live server takes them from the kernel.
/// @param first  index of the first draw of `key`
void fill_path_tokens(server::Session& session, RandomKey key, std::uint64_t first) noexcept;

/// Joins a seat without TLS: draws from `key` the ids and secrets that both ends of a handshake would share. The
/// control connection takes no time; all datagrams after the join are as in a live session.
/// @param number      number of this attempt; each attempt has other ids and secrets
/// @param same_owner  the previous owner of the seat joins again
/// @param slot        slot of the session, where a server has several
[[nodiscard]] std::expected<SimulatedJoin, server::JoinResult> simulate_join(
    server::Session& session, Time now, std::size_t seat, const hal::DeviceCaps& caps, RandomKey key,
    std::uint64_t number, bool same_owner = false, std::uint8_t slot = 0);
/// Joins a link test, which has no seat; the setup is that of the first seat.
[[nodiscard]] std::expected<SimulatedJoin, server::JoinResult> simulate_link_test_join(server::Session& session,
                                                                                       Time now, RandomKey key,
                                                                                       std::uint64_t number);
/// Joins a watcher, which has no seat; the setup is that of the first seat.
/// @param recorder  it gets TELEMETRY at every tick
[[nodiscard]] std::expected<SimulatedJoin, server::JoinResult> simulate_watch_join(server::Session& session, Time now,
                                                                                   RandomKey key, std::uint64_t number,
                                                                                   bool recorder = false);

}  // namespace tandem::netsim
