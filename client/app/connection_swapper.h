#pragma once

#include <atomic>
#include <memory>

#include "client/seat/seat.h"
#include "common/io/udp_socket.h"

namespace tandem::client {

/// A connection of a seat with its socket.
struct ConnectionSwap {
  io::UdpSocket socket;
  Seat::Connection connection;
};

/// Passes a new connection from the main thread to the servo thread, and the replaced one back, so that the main thread
/// frees it. Neither thread waits for the other. Only one swap at a time: the main thread offers the next connection
/// after `take_old` has returned the previous one.
class ConnectionSwapper {
 public:
  ConnectionSwapper() = default;
  ConnectionSwapper(const ConnectionSwapper&) = delete;
  ConnectionSwapper& operator=(const ConnectionSwapper&) = delete;
  ~ConnectionSwapper() {
    delete next_.load();
    delete old_.load();
  }

  // Called on the main thread.
  void offer(std::unique_ptr<ConnectionSwap> next) noexcept { next_.store(next.release(), std::memory_order_release); }
  /// Returns the replaced connection; null if there is none.
  [[nodiscard]] std::unique_ptr<ConnectionSwap> take_old() noexcept {
    return std::unique_ptr<ConnectionSwap>(old_.exchange(nullptr, std::memory_order_acquire));
  }

  // Called on the servo thread.
  /// Returns the offered connection; null if there is none.
  [[nodiscard]] std::unique_ptr<ConnectionSwap> take_next() noexcept {
    if (next_.load(std::memory_order_relaxed) == nullptr) return nullptr;
    return std::unique_ptr<ConnectionSwap>(next_.exchange(nullptr, std::memory_order_acquire));
  }
  void return_old(std::unique_ptr<ConnectionSwap> old) noexcept {
    old_.store(old.release(), std::memory_order_release);
  }

 private:
  std::atomic<ConnectionSwap*> next_{nullptr}, old_{nullptr};
};

}  // namespace tandem::client
