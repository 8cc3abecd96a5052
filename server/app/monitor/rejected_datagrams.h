#pragma once

#include <cstddef>
#include <cstdint>

#include "server/app/monitor/session_status.h"

namespace tandem::server {

/// Sums of the rejected datagrams of sessions.
struct RejectedDatagrams {
  void add(const SessionStatus& status) noexcept {
    unmatched += status.unmatched_datagrams;
    for (const SeatStatus& seat : status.seats)
      for (std::size_t r = 0; r < by_reason.size(); ++r) by_reason[r] += seat.refused[r];
  }

  decltype(SeatStatus::refused) by_reason{};
  std::uint64_t unmatched = 0;  ///< they belong to no connection
};

}  // namespace tandem::server
