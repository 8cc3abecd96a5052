#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>

#include "common/base/time.h"
#include "netsim/engine/delay_queue.h"

namespace tandem::netsim {

/// Buffer that sorts datagrams of clients whose own sockets are not connected yet. Until then, the kernel spreads their
/// datagrams over several sockets. Reading the sockets one by one loses the order of arrival; the kernel's time stamps
/// restore it. The constructor allocates all memory.
class ArrivalBuffer {
 public:
  static constexpr std::size_t kMax = 512;

  ArrivalBuffer() : data_(std::make_unique_for_overwrite<std::byte[]>(kMax * kSlotBytes)) {}

  [[nodiscard]] bool full() const noexcept { return count_ == kMax; }
  /// Stores a datagram. Requires !full().
  /// @param stamp  kernel time of arrival, on any clock
  void add(std::uint32_t client, Duration stamp, std::span<const std::byte> bytes) noexcept {
    std::memcpy(data_.get() + count_ * kSlotBytes, bytes.data(), bytes.size());
    waiting_[count_] = {stamp, client, static_cast<std::uint16_t>(bytes.size()), static_cast<std::uint16_t>(count_)};
    ++count_;
  }

  /// Calls `take(client, stamp, bytes)` for all datagrams in order of arrival, and empties the buffer. Equal stamps:
  /// order of reading.
  template <typename Take>
  void flush(Take&& take) noexcept {
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
