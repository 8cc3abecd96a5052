#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "netsim/proxy/app/proxy_clients.h"
#include "netsim/proxy/proxy_core.h"

namespace tandem::netsim {

/// Groups due datagrams by the socket through which they leave, so that each socket needs one system call. The order
/// within one socket is kept. Fixed memory.
class SendQueue {
 public:
  static constexpr std::size_t kMax = 64;

  [[nodiscard]] bool full() const noexcept { return count_ == kMax; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

  /// Adds a datagram. Requires !full().
  void add(const ProxyCore::Egress& egress, ProxySource through) noexcept {
    const auto me = static_cast<std::uint8_t>(count_++);
    items_[me] = egress;
    through_[me] = through;
    next_[me] = kNone;
    const std::size_t socket = number_of(through);
    if (tail_[socket] == kNone) {
      leads_[leads_count_++] = me;
    } else {
      next_[tail_[socket]] = me;
    }
    tail_[socket] = me;
  }

  /// Datagrams of one socket, in order.
  struct Group {
    const SendQueue& queue;
    std::uint8_t lead;
    ProxySource through;

    template <class Each>
    void for_each(const Each& each) const noexcept {
      for (std::uint8_t at = lead; at != kNone; at = queue.next_[at]) each(queue.items_[at]);
    }
  };
  /// Calls `send(group)` for every socket, and empties the queue.
  template <class Send>
  void flush(const Send& send) noexcept {
    for (std::size_t i = 0; i < leads_count_; ++i) {
      const std::uint8_t lead = leads_[i];
      send(Group{*this, lead, through_[lead]});
      tail_[number_of(through_[lead])] = kNone;
    }
    leads_count_ = count_ = 0;
  }

 private:
  static constexpr std::uint8_t kNone = 255;
  static_assert(kMax < kNone);
  static constexpr std::size_t kSockets = ProxyClients::kMax * ProxySource::kKinds;
  [[nodiscard]] static std::size_t number_of(ProxySource source) noexcept {
    return std::size_t{source.place} * ProxySource::kKinds + static_cast<std::size_t>(source.kind);
  }
  static constexpr std::array<std::uint8_t, kSockets> nothing() noexcept {
    std::array<std::uint8_t, kSockets> all{};
    all.fill(kNone);
    return all;
  }

  std::array<ProxyCore::Egress, kMax> items_;
  std::array<std::uint8_t, kMax> next_{}, leads_{};
  std::array<ProxySource, kMax> through_{};
  std::array<std::uint8_t, kSockets> tail_ = nothing();
  std::size_t count_ = 0, leads_count_ = 0;
};

}  // namespace tandem::netsim
