#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/script.h"

namespace tandem::netsim {

/// The source addresses a client had so far, numbered from 0. Whoever hears the client sees the number of the address
/// it sent from; what is sent down to a number reaches the client until that address is dead.
class Addresses {
 public:
  /// Addresses a client may have in its life.
  static constexpr std::size_t kMax = 1024;

  /// Memory is taken here and not later.
  explicit Addresses(std::span<const LinkSchedule::AddressChange> changes = {}) {
    changes_.reserve(kMax - 1);
    for (const auto& [at, rebind] : changes) change(Time{at}, rebind);
  }

  /// From `at` on the client has a new address. Changes known already come first.
  /// @return false: it had kMax - 1 changes, nothing happens
  bool change(Time at, const Rebind& rebind) noexcept TANDEM_REALTIME {
    if (changes_.size() == kMax - 1) return false;
    changes_.push_back({at, at + rebind.dead_after});
    for (std::size_t i = changes_.size() - 1; i > 0 && changes_[i - 1].at > at; --i) {
      std::swap(changes_[i - 1], changes_[i]);
    }
    return true;
  }

  /// The address from which the client sends at `now`.
  [[nodiscard]] std::uint32_t present(Time now) noexcept TANDEM_REALTIME {
    while (present_ < changes_.size() && changes_[present_].at <= now) ++present_;
    return static_cast<std::uint32_t>(present_);
  }

  /// Whether what arrives at `address` at `t` finds nobody.
  [[nodiscard]] bool dead(std::uint32_t address, Time t) const noexcept TANDEM_REALTIME {
    return address < changes_.size() && t >= changes_[address].dead;
  }

  /// The newest address that anything delivered so far came from: where an answer goes.
  [[nodiscard]] std::uint32_t heard() const noexcept { return heard_; }
  void hear(std::uint32_t address) noexcept {
    if (address > heard_) heard_ = address;
  }

 private:
  struct Change {
    Time at, dead;  ///< of the address before
  };
  std::vector<Change> changes_;
  std::size_t present_ = 0;
  std::uint32_t heard_ = 0;
};

}  // namespace tandem::netsim
