#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/time.h"
#include "netsim/models/link_rate.h"
#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Datagram inside a path whose decision is still open.
struct InTransit {
  static constexpr std::uint32_t kNoTicket = ~std::uint32_t{0};
  std::uint32_t flow = 0;
  std::uint32_t pieces = 1;          ///< number of fragments
  std::uint64_t index = 0;           ///< index in its flow
  std::uint64_t packet = 0;          ///< number of its first fragment in its flow
  std::size_t size = 0;              ///< payload [bytes]
  Time sent;                         ///< time at which the datagram was sent into the path
  Duration recorded{};               ///< delay of the recorded trace at the time of sending
  std::uint32_t ticket = kNoTicket;  ///< caller's storage location of the datagram
};

/// Sender queue that makes space by dropping the longest-waiting datagrams (drop-head). The datagram being sent is
/// never dropped. A new datagram that still does not fit is rejected. Datagrams behind a dropped one leave earlier, so
/// each decision waits until sending begins or a later datagram pushes the datagram out. The constructor allocates all
/// memory.
class HeadDropQueue {
 public:
  /// Ring capacity when the spec has no limit in datagrams.
  static constexpr std::size_t kEntriesMax = 65'536;

  /// @param spec  has Drop::kHead and at least one limit
  explicit HeadDropQueue(const RateSpec& spec);

  /// Datagram with a final decision of the queue.
  struct Decided {
    InTransit datagram;
    bool dropped = false;
    Time at;  ///< time at which the last bit is sent, or at which the datagram is dropped
  };

  /// Offers a datagram to the queue. Before and after this call, call `next` until it returns empty.
  /// @param at  non-decreasing over calls
  /// @return whether the queue accepted the datagram
  bool enter(LinkRate& rate, Time at, const InTransit& datagram) noexcept;

  /// Returns the next datagram whose decision is final at `now`, in order of arrival.
  std::optional<Decided> next(LinkRate& rate, Time now) noexcept;

  /// Returns the latest time at which `next` has a result if no further datagram arrives.
  [[nodiscard]] std::optional<Time> next_time(LinkRate& rate) const noexcept;

  /// Returns the wait of a datagram that arrives at `now`, assuming no drops.
  [[nodiscard]] Duration waiting(LinkRate& rate, Time now) const noexcept {
    return rate.begins(now, waiting_bytes_) - now;
  }
  /// Sets the caller's storage location of the newest datagram.
  void set_ticket(std::uint32_t ticket) noexcept;
  /// Removes a flow. Its datagrams stay in the queue under a number that no flow has.
  void remove_flow(std::uint32_t flow, std::uint32_t nobody) noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return decided_ + waiting_; }

 private:
  struct Entry {
    InTransit datagram;
    std::uint64_t bytes = 0;  ///< including overhead
    Time at;                  ///< arrival time; after the decision: see Decided::at
    bool dropped = false;
  };
  [[nodiscard]] Entry& entry(std::size_t place) noexcept { return ring_[(first_ + place) % ring_.size()]; }
  [[nodiscard]] const Entry& entry(std::size_t place) const noexcept { return ring_[(first_ + place) % ring_.size()]; }
  void advance(LinkRate& rate, Time now) noexcept;
  void decide(bool dropped, Time at) noexcept;
  [[nodiscard]] bool fits(LinkRate& rate, Time at, std::uint64_t bytes, std::size_t waiting,
                          std::uint64_t waiting_bytes) const noexcept;

  std::uint64_t overhead_, bytes_max_;
  std::size_t datagrams_max_;
  Duration wait_max_;
  std::vector<Entry> ring_;
  /// From `first_` on: decided entries, then waiting entries.
  std::size_t first_ = 0, decided_ = 0, waiting_ = 0;
  std::uint64_t waiting_bytes_ = 0;
  Time last_sent_{};  ///< departure time of the last bit of the newest datagram whose sending began
  std::uint64_t last_bytes_ = 0;
};

}  // namespace tandem::netsim
