#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "netsim/proxy_core.h"

namespace tandem::netsim {

/// Sorts what is due at one moment by the socket it leaves through, so that each socket needs one system call; the order
/// within one socket stays. Fixed memory.
class ProxyOutbox {
 public:
  static constexpr std::size_t kMax = 64;

  [[nodiscard]] bool full() const noexcept { return count_ == kMax; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

  void add(const ProxyCore::Egress& egress) noexcept {
    const auto me = static_cast<std::uint8_t>(count_++);
    items_[me] = egress;
    next_[me] = kNone;
    const std::size_t socket = socket_of(egress);
    if (tail_[socket] == kNone) {
      leads_[leads_count_++] = me;
    } else {
      next_[tail_[socket]] = me;
    }
    tail_[socket] = me;
  }

  /// Calls `flush(first, rest...)` per socket: `each(egress)` for every datagram of it in order, then `done(lead)`.
  /// Empties the box.
  template <class Each, class Done>
  void empty(const Each& each, const Done& done) noexcept {
    for (std::size_t i = 0; i < leads_count_; ++i) {
      for (std::uint8_t at = leads_[i]; at != kNone; at = next_[at]) each(items_[at]);
      done(items_[leads_[i]], *this, leads_[i]);
      tail_[socket_of(items_[leads_[i]])] = kNone;
    }
    leads_count_ = count_ = 0;
  }
  /// Goes once more over the datagrams of the socket that begins with `lead`.
  template <class Each>
  void again(std::uint8_t lead, const Each& each) const noexcept {
    for (std::uint8_t at = lead; at != kNone; at = next_[at]) each(items_[at]);
  }

 private:
  static constexpr std::uint8_t kNone = 255;
  static_assert(kMax < kNone);
  [[nodiscard]] static std::size_t socket_of(const ProxyCore::Egress& egress) noexcept {
    return std::size_t{egress.client} * kDirections + static_cast<std::size_t>(egress.direction);
  }
  static constexpr std::array<std::uint8_t, ProxyCore::kClientsMax * kDirections> nothing() noexcept {
    std::array<std::uint8_t, ProxyCore::kClientsMax * kDirections> all{};
    all.fill(kNone);
    return all;
  }

  std::array<ProxyCore::Egress, kMax> items_;
  std::array<std::uint8_t, kMax> next_{}, leads_{};
  std::array<std::uint8_t, ProxyCore::kClientsMax * kDirections> tail_ = nothing();
  std::size_t count_ = 0, leads_count_ = 0;
};

}  // namespace tandem::netsim
