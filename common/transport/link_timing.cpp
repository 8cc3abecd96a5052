#include "common/transport/link_timing.h"

namespace tandem::transport {

void LinkTiming::accepted(Time now, std::uint64_t echo_counter, Duration echo_age, std::uint32_t peer_tick) noexcept {
  if (heard_) gaps_.add(now, now - arrived_);
  arrived_ = now;
  if (!heard_) echo_moved_ = now;
  heard_ = true;
  const Time echo_sent = sent_[echo_counter & mask_].near(now);
  const bool known = remembers(now, echo_counter, echo_sent);
  if (known && (!echoed_ || echo_counter > echo_counter_)) {
    echo_moved_ = now;
    half_peer_wait_ = half_wait(echo_age);  // an older echo waited for a later datagram, too
  }
  peer_silence_ = known ? echo_age : Duration{};
  const bool measured = known && (!echoed_ || echo_counter >= echo_counter_);
  if (measured) {
    echoed_ = true;
    echo_counter_ = echo_counter;
    echo_sent_ = echo_sent;
    rtt_ = std::max(Duration{0}, now - echo_sent_ - echo_age);
    rtts_.add(rtt_.count());
    recent_.add(rtt_.count());
    if (recent_.count() >= kLearnEvery) {
      recent_p99_ = recent_.quantile(0.99);
      recent_.reset();
    }
    rtt_floor_.add(now, rtt_.count());
  }
  const std::int64_t transit = now.time_since_epoch().count() - static_cast<std::int64_t>(peer_tick) * tick_.count();
  transit_floor_.add(now, transit);
  std::int64_t half_rtt = 0, extra = transit - transit_floor_.value();
  // A peer that shifts its ticks sends each datagram earlier or later than its tick count says. The round trip does not
  // contain that, and no datagram was delayed by more than its round trip beyond the best one.
  if (rtt_floor_.any()) [[likely]] {
    const std::int64_t best = rtt_floor_.value();
    half_rtt = best >> 1;
    if (measured) [[likely]]
      extra = std::min(extra, rtt_.count() - best);
  }
  transit_ = Duration{half_rtt + extra};
  one_way_ = transit_ + half_peer_wait_;
  in_use_ = false;
}

}  // namespace tandem::transport
