#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "server/app/process/tick_queue.h"

namespace tandem::server {

/// Copies of a session's tick records for a recording, from the recorder's thread to that of the recording. Bounded:
/// records that do not fit are dropped; `newest` shows a drop behind which no record follows.
class TickFeed {
 public:
  TickFeed(std::size_t seats, std::size_t tools) : ticks_(TickQueue::capacity_for(seats, tools), seats, tools) {}

  /// For the writing thread.
  void push(const TickRecord& record) noexcept {
    ticks_.push(record);
    newest_.store(record.tick, std::memory_order_release);
  }
  /// For the reading thread.
  [[nodiscard]] TickQueue& ticks() noexcept { return ticks_; }
  /// Session tick of the newest record, pushed or dropped.
  [[nodiscard]] std::uint32_t newest() const noexcept { return newest_.load(std::memory_order_acquire); }

 private:
  TickQueue ticks_;
  std::atomic<std::uint32_t> newest_{0};
};

}  // namespace tandem::server
