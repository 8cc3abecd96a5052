#include "netsim/models/head_drop.h"

#include <algorithm>

namespace tandem::netsim {

HeadDropQueue::HeadDropQueue(const RateSpec& spec)
    : overhead_(spec.overhead_bytes),
      bytes_max_(spec.queue_bytes > 0 ? spec.queue_bytes : ~std::uint64_t{0}),
      datagrams_max_(spec.queue_datagrams > 0 ? spec.queue_datagrams : kEntriesMax),
      wait_max_(std::min(spec.queue_wait.value_or(LinkRate::kWaitMax), LinkRate::kWaitMax)),
      ring_(datagrams_max_ + 1) {}

bool HeadDropQueue::fits(LinkRate& rate, Time at, std::uint64_t bytes, std::size_t waiting,
                         std::uint64_t waiting_bytes) const noexcept {
  const bool sending = last_sent_ > at;
  if (waiting + (sending ? 2 : 1) > datagrams_max_) return false;
  if (bytes_max_ != ~std::uint64_t{0}) {
    const std::uint64_t unsent = rate.unsent(at).value_or(sending ? last_bytes_ : 0);
    if (unsent + waiting_bytes + bytes > bytes_max_) return false;
  }
  return rate.begins(at, waiting_bytes) - at <= wait_max_;
}

bool HeadDropQueue::enter(LinkRate& rate, Time at, const InTransit& datagram) noexcept {
  advance(rate, at);
  const std::uint64_t bytes = datagram.size + datagram.pieces * overhead_;
  if (size() == ring_.size() || !fits(rate, at, bytes, 0, 0)) return false;
  while (!fits(rate, at, bytes, waiting_, waiting_bytes_)) {
    decide(true, at);
  }
  entry(decided_ + waiting_) = {datagram, bytes, at, false};
  ++waiting_;
  waiting_bytes_ += bytes;
  advance(rate, at);
  return true;
}

void HeadDropQueue::advance(LinkRate& rate, Time now) noexcept {
  while (waiting_ > 0) {
    const Entry& head = entry(decided_);
    if (rate.begins(head.at, 0) > now) return;
    const InTransit& datagram = head.datagram;
    const auto sent = rate.serve(head.at, datagram.size + (datagram.pieces - 1) * overhead_);
    last_sent_ = sent.value_or(now);
    last_bytes_ = head.bytes;
    decide(!sent, last_sent_);  // always sent: no datagram waits for an hour
  }
}

/// Decides the longest-waiting datagram at `at`.
void HeadDropQueue::decide(bool dropped, Time at) noexcept {
  Entry& head = entry(decided_);
  head.dropped = dropped;
  head.at = at;
  waiting_bytes_ -= head.bytes;
  ++decided_;
  --waiting_;
}

std::optional<HeadDropQueue::Decided> HeadDropQueue::next(LinkRate& rate, Time now) noexcept {
  if (decided_ == 0) advance(rate, now);
  if (decided_ == 0) return std::nullopt;
  const Entry& first = entry(0);
  const Decided left{first.datagram, first.dropped, first.at};
  first_ = (first_ + 1) % ring_.size();
  --decided_;
  return left;
}

std::optional<Time> HeadDropQueue::next_time(LinkRate& rate) const noexcept {
  if (decided_ > 0) return entry(0).datagram.sent;  // immediately
  if (waiting_ == 0) return std::nullopt;
  return rate.begins(entry(0).at, 0);
}

void HeadDropQueue::set_ticket(std::uint32_t ticket) noexcept {
  if (size() > 0) entry(size() - 1).datagram.ticket = ticket;
}

void HeadDropQueue::remove_flow(std::uint32_t flow, std::uint32_t nobody) noexcept {
  for (std::size_t i = 0; i < size(); ++i) {
    if (entry(i).datagram.flow == flow) entry(i).datagram.flow = nobody;
  }
}

}  // namespace tandem::netsim
