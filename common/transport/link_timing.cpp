#include "common/transport/link_timing.h"

namespace tandem::transport {

void LinkTiming::accepted(Time now, std::uint64_t echo_counter, Duration echo_age, std::uint32_t peer_tick) noexcept {
  if (heard_) gaps_.add(now, now - arrived_);
  arrived_ = now;
  if (!heard_) echo_moved_ = now;
  heard_ = true;
  const bool known = remembers(now, echo_counter);
  if (known && (!echoed_ || echo_counter > echo_counter_)) {
    echo_moved_ = now;
    peer_wait_ = std::clamp(echo_age, Duration{}, tick_);  // an older echo waited for a later datagram, too
  }
  peer_silence_ = known ? echo_age : Duration{};
  const bool measured = known && (!echoed_ || echo_counter >= echo_counter_);
  if (measured) {
    echoed_ = true;
    echo_counter_ = echo_counter;
    echo_sent_ = sent_[echo_counter & mask_].near(now);
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
  std::int64_t extra = transit - transit_floor_.value();
  // A peer that shifts its ticks sends each datagram earlier or later than its tick count says. The round trip does not
  // contain that, and no datagram was delayed by more than its round trip beyond the best one.
  if (measured) extra = std::min(extra, std::max<std::int64_t>(0, rtt_.count() - rtt_floor_.value()));
  transit_ = Duration{(rtt_floor_.any() ? rtt_floor_.value() / 2 : 0) + extra};
  one_way_ = transit_ + peer_wait_ / 2;
  in_use_ = false;
}

}  // namespace tandem::transport
