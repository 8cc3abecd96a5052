#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/time.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// A sender that may send only at recorded moments: opportunities of 1500 bytes in milliseconds of a recording, which
/// starts again after its end. An opportunity carries several datagrams or parts of them; what is not used when its
/// millisecond is over, is lost. Source: mahimahi's trace-driven links [Netravali et al. 2015].
class CapacityPlayer {
 public:
  explicit CapacityPlayer(std::shared_ptr<const CapacityTrace> trace) noexcept : trace_(std::move(trace)) {}

  [[nodiscard]] bool present() const noexcept { return trace_ != nullptr; }

  /// When a datagram of so many bytes has been sent, if it were taken now; `accept` takes it.
  /// @param now  never decreasing. Valid while `present()`; at most size / 1500 + 2 steps and one search
  [[nodiscard]] Time offer(Time now, std::uint64_t bytes) noexcept;
  void accept() noexcept {
    here_ = offered_;
    begun_ = true;
  }

 private:
  struct Place {
    std::int64_t cycle = 0;
    std::size_t entry = 0;
    std::uint64_t left = 0;  ///< bytes of this entry not used yet
  };
  [[nodiscard]] Time at(const Place& place) const noexcept;
  void enter(Place& place) const noexcept;

  std::shared_ptr<const CapacityTrace> trace_;
  bool begun_ = false;
  Place here_, offered_;
};

/// What waits in a queue whose limit counts datagrams or bytes: the departures still to come. Memory taken once.
class Backlog {
 public:
  explicit Backlog(std::size_t datagrams) : ring_(datagrams) {}

  /// Forgets what has left by `now`.
  void advance(Time now) noexcept;
  [[nodiscard]] bool full() const noexcept { return count_ == ring_.size(); }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  /// @param departure  never decreasing. Not when full.
  void add(Time departure, std::uint64_t bytes) noexcept;
  /// What waits in `before`, as far as there is room: the newest.
  void take_over(const Backlog& before) noexcept;

 private:
  struct Entry {
    Time departure;
    std::uint64_t bytes = 0;
  };
  std::vector<Entry> ring_;
  std::size_t first_ = 0, count_ = 0;
  std::uint64_t bytes_ = 0;
};

/// Controlled delay: drops at the head when waits stay above a target for an interval, more and more often.
/// Source: RFC 8289, 5.4-5.6; without its rule about the last packet of a queue, which needs what comes later.
class CoDel {
 public:
  explicit CoDel(const CoDelSpec& spec) noexcept : spec_(spec) {}

  /// @param begin  when the datagram reaches the head of the queue, never decreasing
  /// @param wait   since it came
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
