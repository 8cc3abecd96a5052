#pragma once

#include <atomic>
#include <cstdint>

namespace tandem::hal {

/// Says that a servo lives, across processes: one word in memory that both share. Who moves motors beats after every
/// exchange that may have carried force and rests when none can be on; who watches sees it stand still.
class Pulse {
 public:
  void beat() noexcept {
    const std::uint32_t next = beats_.load(std::memory_order_relaxed) + 1;
    beats_.store(next == kAtRest ? kAtRest + 1 : next, std::memory_order_release);
  }
  void rest() noexcept { beats_.store(kAtRest, std::memory_order_release); }

  [[nodiscard]] std::uint32_t beats() const noexcept { return beats_.load(std::memory_order_acquire); }
  static constexpr std::uint32_t kAtRest = 0;

 private:
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
  std::atomic<std::uint32_t> beats_{kAtRest};
};

}  // namespace tandem::hal
