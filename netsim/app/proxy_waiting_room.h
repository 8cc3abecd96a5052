#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>

#include "common/base/time.h"
#include "netsim/delay_queue.h"

namespace tandem::netsim {

/// Datagrams of clients who are just getting sockets of their own. Until each of those is connected, the kernel spreads
/// what clients send over several sockets, in an order that reading them one after the other does not show; its stamps
/// do. All memory is taken at construction.
class ProxyWaitingRoom {
 public:
  static constexpr std::size_t kMax = 512;

  ProxyWaitingRoom() : data_(std::make_unique_for_overwrite<std::byte[]>(kMax * kSlotBytes)) {}

  [[nodiscard]] bool full() const noexcept { return count_ == kMax; }
  /// @param stamp  the kernel's moment of arrival, whatever clock it is on
  void add(std::uint32_t client, Duration stamp, std::span<const std::byte> bytes) noexcept {
    std::memcpy(data_.get() + count_ * kSlotBytes, bytes.data(), bytes.size());
    waiting_[count_] = {stamp, client, static_cast<std::uint16_t>(bytes.size()), static_cast<std::uint16_t>(count_)};
    ++count_;
  }

  /// Hands all to `take(client, stamp, bytes)` in the order of arrival; of equal stamps, the first read is the first.
  template <typename Take>
  void empty(Take&& take) noexcept {
    const std::span all{waiting_.data(), count_};
    std::ranges::sort(all, [](const Waiting& a, const Waiting& b) {
      return a.stamp != b.stamp ? a.stamp < b.stamp : a.slot < b.slot;
    });
    for (const Waiting& one : all) {
      take(one.client, one.stamp,
           std::span<const std::byte>{data_.get() + std::size_t{one.slot} * kSlotBytes, one.size});
    }
    count_ = 0;
  }

 private:
  struct Waiting {
    Duration stamp{};
    std::uint32_t client = 0;
    std::uint16_t size = 0, slot = 0;
  };
  static_assert(kSlotBytes <= UINT16_MAX && kMax <= UINT16_MAX);

  std::unique_ptr<std::byte[]> data_;
  std::array<Waiting, kMax> waiting_;
  std::size_t count_ = 0;
};

}  // namespace tandem::netsim
