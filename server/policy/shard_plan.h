#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tandem::server {

/// A session before it runs.
struct SessionDemand {
  double tick_hz = 1000;
  std::size_t seats = 1;
};

/// Expected processor time of a session whose seats are all taken, as share of one processor [1]. It is only compared
/// with that of other sessions, until their cost is measured.
[[nodiscard]] double expected_cost(const SessionDemand& session) noexcept;

/// Expected processor time of one client of such a session [1].
[[nodiscard]] double expected_seat_cost(double tick_hz) noexcept;

/// Returns the tick rate of each shard [Hz]: one shard per rate, and the rest of `threads` for the rates with the
/// greatest expected cost per shard. A rate gets no more shards than sessions.
/// @param threads      wanted number of shards, at least 1; more if there are more rates
/// @param created_max  sessions of any of these rates that may be created later
[[nodiscard]] std::vector<double> shard_rates(std::span<const SessionDemand> sessions, std::size_t threads,
                                              std::size_t created_max);

/// Returns the shard of each session: in their order, each on that of its rate with the least expected cost so far.
/// @param rates  of the shards, from `shard_rates`
[[nodiscard]] std::vector<std::size_t> first_placement(std::span<const SessionDemand> sessions,
                                                       std::span<const double> rates);

}  // namespace tandem::server
