#include "common/transport/link_timing.h"

namespace tandem::transport {

void LinkTiming::accepted(Time now, std::uint64_t echo_counter, Duration echo_age, std::uint32_t peer_tick) noexcept {
  if (heard_) gaps_.add(now, now - arrived_);
  arrived_ = now;
  if (!heard_) echo_moved_ = now;
  heard_ = true;
  const bool known = remembers(now, echo_counter);
  if (known && (!echoed_ || echo_counter > echo_counter_)) echo_moved_ = now;
  peer_silence_ = known ? echo_age : Duration{};
  if (known && (!echoed_ || echo_counter >= echo_counter_)) {
    echoed_ = true;
    echo_counter_ = echo_counter;
    echo_sent_ = sent_[echo_counter & mask_].near(now);
    // The round trip includes about one tick in which peer and own end wait for their next tick, even without a
    // network.
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
  one_way_ = Duration{(rtt_floor_.any() ? rtt_floor_.value() / 2 : 0) + (transit - transit_floor_.value())};
}

}  // namespace tandem::transport
