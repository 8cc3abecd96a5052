#pragma once

#include <atomic>
#include <cstdint>

namespace tandem::hal {

/// Heartbeat of a servo across processes: one word in shared memory.
/// The servo beats after every exchange that may have carried force and sets the word idle when none can be on.
/// The watchdog detects a stall by an unchanged word.
class Heartbeat {
 public:
  void beat() noexcept {
    const std::uint32_t next = beats_.load(std::memory_order_relaxed) + 1;
    beats_.store(next == kIdle ? kIdle + 1 : next, std::memory_order_release);
  }
  void set_idle() noexcept { beats_.store(kIdle, std::memory_order_release); }

  [[nodiscard]] std::uint32_t beats() const noexcept { return beats_.load(std::memory_order_acquire); }
  static constexpr std::uint32_t kIdle = 0;

 private:
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
  std::atomic<std::uint32_t> beats_{kIdle};
};

}  // namespace tandem::hal
