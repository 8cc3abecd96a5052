#pragma once

#include <string>

#include "common/io/fd.h"

namespace tandem::io {

/// Keeps the processor out of deep sleep as long as it lives, where permitted (root): the cheapest gain in wake-up
/// jitter (design notes, performance 2: p99 153 -> 57 us).
class AwakeProcessor {
 public:
  AwakeProcessor() noexcept;
  [[nodiscard]] bool granted() const noexcept { return fd_.open(); }

 private:
  Fd fd_;
};

/// Locks the process's memory as it is used, where that cannot make a later allocation fail. @return whether it is
/// locked
bool lock_memory() noexcept;

/// Asks for SCHED_FIFO and exact timers for the calling thread. @return whether SCHED_FIFO was granted
bool ask_for_realtime(int priority) noexcept;

/// One sentence about what was not granted, and the remedy; empty if all was.
[[nodiscard]] std::string realtime_notice(bool fifo, bool memory, bool awake);

}  // namespace tandem::io
