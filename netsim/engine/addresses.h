#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/schedule.h"

namespace tandem::netsim {

/// Source addresses of one client over time, numbered from 0. A receiver sees the number of the address from which a
/// datagram was sent. Datagrams sent to an address reach the client until that address is dead.
class Addresses {
 public:
  /// Maximum number of addresses of one client.
  static constexpr std::size_t kMax = 1024;

  /// Allocates all memory of the object.
  explicit Addresses(std::span<const LinkSchedule::AddressChange> changes = {}) {
    changes_.reserve(kMax - 1);
    for (const auto& [at, rebind] : changes) change(Time{at}, rebind);
  }

  /// Gives the client a new address from `at` on. Earlier-planned changes with the same time come first.
  /// @return false if there are already kMax - 1 changes; then nothing changes
  bool change(Time at, const Rebind& rebind) noexcept TANDEM_REALTIME {
    if (changes_.size() == kMax - 1) return false;
    changes_.push_back({at, at + rebind.dead_after});
    for (std::size_t i = changes_.size() - 1; i > 0 && changes_[i - 1].at > at; --i) {
      std::swap(changes_[i - 1], changes_[i]);
    }
    return true;
  }

  /// Returns the address from which the client sends at `now`. `now` is non-decreasing over calls.
  [[nodiscard]] std::uint32_t current(Time now) noexcept TANDEM_REALTIME {
    while (current_ < changes_.size() && changes_[current_].at <= now) ++current_;
    return static_cast<std::uint32_t>(current_);
  }

  /// Returns whether a datagram that arrives at `address` at `t` reaches no client.
  [[nodiscard]] bool dead(std::uint32_t address, Time t) const noexcept TANDEM_REALTIME {
    return address < changes_.size() && t >= changes_[address].dead;
  }

  /// Returns the newest address among all delivered datagrams; replies go to this address.
  [[nodiscard]] std::uint32_t newest_delivered() const noexcept { return newest_delivered_; }
  void note_delivered(std::uint32_t address) noexcept {
    if (address > newest_delivered_) newest_delivered_ = address;
  }

 private:
  struct Change {
    Time at, dead;  ///< `dead`: time at which the previous address dies
  };
  std::vector<Change> changes_;
  std::size_t current_ = 0;
  std::uint32_t newest_delivered_ = 0;
};

}  // namespace tandem::netsim
