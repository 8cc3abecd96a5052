#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/time.h"
#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Trace-driven sender: it sends only at recorded opportunities of 1500 bytes. Opportunities have a resolution of 1 ms,
/// and the recording repeats after its end. An opportunity carries several datagrams or parts of them; bytes unused at
/// the end of its millisecond are lost. Source: mahimahi's trace-driven links [Netravali et al. 2015].
class CapacityTracePlayer {
 public:
  explicit CapacityTracePlayer(std::shared_ptr<const CapacityTrace> trace) noexcept : trace_(std::move(trace)) {}

  [[nodiscard]] bool present() const noexcept { return trace_ != nullptr; }

  /// Returns the time at which a datagram of `bytes` bytes would be completely sent; `accept` commits the offer.
  /// Requires `present()`. Cost: at most size / 1500 + 2 steps and one search.
  /// @param now  non-decreasing over calls
  [[nodiscard]] Time offer(Time now, std::uint64_t bytes) noexcept;
  void accept() noexcept {
    here_ = offered_;
    begun_ = true;
  }

 private:
  struct Place {
    std::int64_t cycle = 0;
    std::size_t entry = 0;
    std::uint64_t left = 0;  ///< unused bytes of this entry
  };
  [[nodiscard]] Time at(const Place& place) const noexcept;
  void enter(Place& place) const noexcept;

  std::shared_ptr<const CapacityTrace> trace_;
  bool begun_ = false;
  Place here_, offered_;
};

/// Future departures of a queue that is limited in datagrams or bytes. The constructor allocates all memory.
class Backlog {
 public:
  explicit Backlog(std::size_t datagrams) : ring_(datagrams) {}

  /// Removes entries that departed at or before `now`.
  void advance(Time now) noexcept;
  [[nodiscard]] bool full() const noexcept { return count_ == ring_.size(); }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  /// @param departure  non-decreasing over calls. Requires !full().
  void add(Time departure, std::uint64_t bytes) noexcept;
  /// Copies the newest waiting entries of `before`, as many as fit.
  void replace(const Backlog& before) noexcept;

 private:
  struct Entry {
    Time departure;
    std::uint64_t bytes = 0;
  };
  std::vector<Entry> ring_;
  std::size_t first_ = 0, count_ = 0;
  std::uint64_t bytes_ = 0;
};

/// Controlled delay (CoDel): drops at the head, at a rising rate, while waits stay above a target for an interval.
/// Source: RFC 8289, 5.4-5.6. Omits the rule about the last packet of a queue, because that rule needs later
/// arrivals.
class CoDel {
 public:
  explicit CoDel(const CoDelSpec& spec) noexcept : spec_(spec) {}

  /// @param begin  time at which the datagram reaches the head of the queue, non-decreasing
  /// @param wait   time since the datagram arrived in the queue
  [[nodiscard]] bool drops(Time begin, Duration wait) noexcept;

 private:
  [[nodiscard]] Time next(Time from) const noexcept;

  CoDelSpec spec_;
  std::optional<Time> first_above_;
  bool dropping_ = false;
  Time drop_next_{};
  std::uint64_t count_ = 0, last_count_ = 0;
};

}  // namespace tandem::netsim
