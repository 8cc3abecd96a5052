#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>

#include "server/report/tick_record.h"

namespace tandem::server {

/// A bounded single-producer, single-consumer queue of tick records, without lock and without heap use after
/// construction. If it is full, new records are dropped and counted; a late reader never delays the writer. It stores
/// only the seats and tools of its scene: a record for the most of both takes 11 kB, one for two seats and one tool 1.2
/// kB, and the shard writes one per tick.
class TickQueue {
 public:
  /// @param ticks  capacity, at least 1
  /// @param seats  records of further seats read as zeros [0, kSeatsMax]
  /// @param tools  records of further tools read as zeros [0, kToolsMax]
  explicit TickQueue(std::size_t ticks, std::size_t seats = kSeatsMax, std::size_t tools = kToolsMax)
      : ticks_(ticks),
        seats_(std::min(seats, kSeatsMax) * sizeof(SeatRecord)),
        tools_(std::min(tools, kToolsMax) * sizeof(ToolRecord)),
        bytes_(std::make_unique<std::byte[]>(ticks * stride())) {}

  /// Returns the capacity with which a queue takes about 1.45 MB, but at most 2 s of ticks at 1 kHz and at least a
  /// quarter. The reader may be late by so many ticks before records are dropped.
  [[nodiscard]] static std::size_t capacity_for(std::size_t seats, std::size_t tools) noexcept {
    const std::size_t stride = kHeader + seats * sizeof(SeatRecord) + tools * sizeof(ToolRecord);
    return std::clamp<std::size_t>(1'450'000 / stride, 256, 2048);
  }

  /// For the writing thread. @return false if the record was dropped
  bool push(const TickRecord& record) noexcept {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) >= ticks_) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    std::byte* const at = slot(end);
    std::memcpy(at, &record, kHeader);
    std::memcpy(at + kHeader, record.seats.data(), seats_);
    std::memcpy(at + kHeader + seats_, record.tools.data(), tools_);
    end_.store(end + 1, std::memory_order_release);
    return true;
  }
  /// For the reading thread: returns the oldest record, null if there is none. It stays valid until the next `front`.
  [[nodiscard]] const TickRecord* front() noexcept {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return nullptr;
    const std::byte* const at = slot(begin);
    std::memcpy(static_cast<void*>(&front_), at, kHeader);
    std::memcpy(front_.seats.data(), at + kHeader, seats_);
    std::memcpy(front_.tools.data(), at + kHeader + seats_, tools_);
    return &front_;
  }
  /// Removes the oldest record. @pre front() is not null
  void pop() noexcept { begin_.store(begin_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
  /// Returns the memory of all records [bytes].
  [[nodiscard]] std::size_t size_bytes() const noexcept { return ticks_ * stride(); }

 private:
  static constexpr std::size_t kHeader = offsetof(TickRecord, seats);
  static_assert(std::is_trivially_copyable_v<TickRecord> && std::is_standard_layout_v<TickRecord>);
  static_assert(offsetof(TickRecord, seats) < offsetof(TickRecord, tools), "the header comes first");

  [[nodiscard]] std::size_t stride() const noexcept { return kHeader + seats_ + tools_; }
  [[nodiscard]] std::byte* slot(std::uint64_t number) const noexcept {
    return bytes_.get() + number % ticks_ * stride();
  }

  std::size_t ticks_, seats_, tools_;  ///< seats_, tools_: [bytes]
  std::unique_ptr<std::byte[]> bytes_;
  TickRecord front_{};  ///< of the reading thread
  alignas(64) std::atomic<std::uint64_t> begin_{0};
  alignas(64) std::atomic<std::uint64_t> end_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace tandem::server
