#pragma once

#include <atomic>

#include "client/seat/seat.h"
#include "common/base/axes.h"
#include "common/control/authority.h"
#include "common/io/spsc_queue.h"

namespace tandem::client {

/// Commands of the user, from the main thread to the servo thread of a seat. Neither thread waits for the other.
class UserCommands {
 public:
  // Called on the main thread.
  void reset_gate() noexcept { reset_.store(true, std::memory_order_relaxed); }
  void leave() noexcept { leave_.store(true, std::memory_order_relaxed); }
  /// Stops the seat with the next servo tick, until `resume`.
  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }
  /// Requests a stop or pause of the whole session, as the role of the seat allows.
  void stop_all() noexcept { stop_all_.store(true, std::memory_order_relaxed); }
  void resume() noexcept { resume_.store(true, std::memory_order_relaxed); }
  /// @param alpha  authority of all masters over the tool of the seat, sum 1. Dropped if 64 requests wait.
  void change_authority(const control::MasterArray& alpha) noexcept { authority_.push(alpha); }

  /// Passes the commands that arrived to `seat`. For the servo thread. @return true if one changes authority
  bool apply(Seat& seat) noexcept TANDEM_REALTIME {
    if (reset_.exchange(false, std::memory_order_relaxed)) seat.requests().reset_gate();
    if (resume_.exchange(false, std::memory_order_relaxed)) seat.requests().resume();
    if (stop_.exchange(false, std::memory_order_relaxed))
      seat.requests().stop_locally();  // after resume: stop takes precedence
    if (stop_all_.exchange(false, std::memory_order_relaxed)) static_cast<void>(seat.requests().stop_all());
    if (leave_.load(std::memory_order_relaxed)) seat.leave();
    bool changed = false;
    for (const control::MasterArray* alpha = authority_.front(); alpha != nullptr; alpha = authority_.front()) {
      seat.requests().change_own_tool(*alpha);
      authority_.pop();
      changed = true;
    }
    return changed;
  }

 private:
  std::atomic<bool> reset_{false}, leave_{false}, stop_{false}, stop_all_{false}, resume_{false};
  io::SpscQueue<control::MasterArray> authority_{64};
};

}  // namespace tandem::client
