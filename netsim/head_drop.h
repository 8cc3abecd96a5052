#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/time.h"
#include "netsim/link_rate.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// A datagram inside a path that is not decided about yet.
struct InTransit {
  static constexpr std::uint32_t kNoTicket = ~std::uint32_t{0};
  std::uint32_t flow = 0;
  std::uint32_t pieces = 1;    ///< fragments
  std::uint64_t index = 0;     ///< in its flow
  std::uint64_t packet = 0;    ///< number of its first fragment in its flow
  std::size_t size = 0;        ///< payload [bytes]
  Time sent;                   ///< into the path
  Duration recorded{};         ///< delay of a recording at the time of sending
  std::uint32_t ticket = kNoTicket;  ///< where the caller keeps it
};

/// The queue of a sender that makes room by dropping what waits longest. What is being sent is not dropped any more; one
/// that does not fit even then is refused. What is behind a dropped one leaves earlier, so nothing is decided before its
/// sending begins or a later datagram pushes it out. Memory is taken once.
class HeadDropQueue {
 public:
  /// Longest queue without a limit in datagrams.
  static constexpr std::size_t kEntriesMax = 65'536;

  /// @param spec  with Drop::kHead and at least one limit
  explicit HeadDropQueue(const RateSpec& spec);

  /// One datagram decided about.
  struct Left {
    InTransit datagram;
    bool dropped = false;
    Time at;  ///< the last bit is sent; or dropped
  };

  /// A datagram reaches the queue. Call `next` until empty before it and after it.
  /// @param at  never decreasing
  /// @return whether it is in the queue now
  bool enter(LinkRate& rate, Time at, const InTransit& datagram) noexcept;

  /// Those whose fate is known at `now`, in the order in which they came.
  std::optional<Left> next(LinkRate& rate, Time now) noexcept;

  /// When `next` has something to say at the latest, if nothing else comes.
  [[nodiscard]] std::optional<Time> next_time(LinkRate& rate) const noexcept;

  /// How long a datagram that comes now would wait if nothing were dropped.
  [[nodiscard]] Duration waiting(LinkRate& rate, Time now) const noexcept {
    return rate.begins(now, waiting_bytes_) - now;
  }
  /// Where the caller keeps the newest.
  void set_ticket(std::uint32_t ticket) noexcept;
  /// A flow is no more: what it has in here stays, without a name.
  void forget(std::uint32_t flow, std::uint32_t nobody) noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return decided_ + waiting_; }

 private:
  struct Entry {
    InTransit datagram;
    std::uint64_t bytes = 0;  ///< with overhead
    Time at;                  ///< of coming; decided: as Left::at
    bool dropped = false;
  };
  [[nodiscard]] Entry& entry(std::size_t place) noexcept { return ring_[(first_ + place) % ring_.size()]; }
  [[nodiscard]] const Entry& entry(std::size_t place) const noexcept { return ring_[(first_ + place) % ring_.size()]; }
  void advance(LinkRate& rate, Time now) noexcept;
  [[nodiscard]] bool fits(LinkRate& rate, Time at, std::uint64_t bytes, std::size_t waiting,
                          std::uint64_t waiting_bytes) const noexcept;

  std::uint64_t overhead_, bytes_max_;
  std::size_t datagrams_max_;
  Duration wait_max_;
  std::vector<Entry> ring_;
  /// From `first_` on: those decided about, then those that wait.
  std::size_t first_ = 0, decided_ = 0, waiting_ = 0;
  std::uint64_t waiting_bytes_ = 0;
  Time last_sent_{};               ///< the last bit of the last one that began
  std::uint64_t last_bytes_ = 0;
};

}  // namespace tandem::netsim
