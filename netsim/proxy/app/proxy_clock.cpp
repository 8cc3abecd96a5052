#include "netsim/proxy/app/proxy_clock.h"

#include <algorithm>
#include <ctime>

#include "common/io/clock.h"
#include "netsim/proxy/app/wall_clock_lead.h"

namespace tandem::netsim {
namespace {

/// Upper bound of a datagram's wait in the kernel, in case the wall clock jumps.
constexpr Duration kAgeMax{1'000'000'000};

}  // namespace

void ProxyClock::start() noexcept { started_ = io::read_clock(CLOCK_MONOTONIC); }

Duration ProxyClock::now() const noexcept {
  return io::read_clock(CLOCK_MONOTONIC) - started_.load(std::memory_order_relaxed);
}

void ProxyClock::wait_until(Duration moment, Duration spin) const noexcept {
  if (moment - now() > std::max(spin, kShorterThanSleep)) {
    const timespec at = io::to_timespec(started_.load(std::memory_order_relaxed) + moment - spin);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
  }
  while (now() < moment) {
  }
}

void ProxyClock::update_wall_clock() noexcept {
  const Duration lead =
      wall_clock_lead([] { return io::read_clock(CLOCK_MONOTONIC); }, [] { return io::read_clock(CLOCK_REALTIME); });
  wall_at_start_ = lead + started_.load(std::memory_order_relaxed);
}

Time ProxyClock::arrival(Duration stamp, Duration read_at) const noexcept {
  if (stamp == Duration{}) return Time{read_at};
  // Datagrams that arrived between opening the socket and the first round count as arrived at the start.
  const Duration oldest = std::max(read_at - kAgeMax, Duration::zero());
  return Time{std::clamp(stamp - wall_at_start_, oldest, read_at)};
}

}  // namespace tandem::netsim
