#pragma once

#include <atomic>
#include <cstddef>

#include "common/io/event_fd.h"
#include "common/io/spsc_queue.h"
#include "netsim/proxy/app/proxy_request.h"

namespace tandem::netsim {

/// Messages of other threads to the packet thread of a proxy: requests, and the end. Each message wakes the packet
/// thread up, which never waits for a lock.
class ProxyInbox {
 public:
  static constexpr std::size_t kRequestsMax = 64;

  /// False if the system gave no descriptor.
  [[nodiscard]] bool open() const noexcept { return wake_.open(); }

  // Functions of other threads.

  /// Passes a request. One posting thread only. The request must live until `done`, or until the packet thread ends.
  /// @return false if the queue is full
  bool post(ProxyRequest& request) noexcept {
    if (!requests_.push(&request)) return false;
    wake_.signal();
    return true;
  }
  /// Ends the proxy. Any thread or signal handler.
  void stop() noexcept {
    stopping_.store(true, std::memory_order_release);
    wake_.signal();
  }

  // Functions of the packet thread.

  /// Returns the descriptor that is readable after a message, until `clear`.
  [[nodiscard]] int fd() const noexcept { return wake_.get(); }
  void clear() const noexcept { wake_.clear(); }
  [[nodiscard]] bool stopping() const noexcept { return stopping_.load(std::memory_order_acquire); }
  [[nodiscard]] bool empty() const noexcept { return requests_.front() == nullptr; }
  /// Removes and returns the oldest request. Requires !empty().
  [[nodiscard]] ProxyRequest& take() noexcept {
    ProxyRequest& request = **requests_.front();
    requests_.pop();
    return request;
  }

 private:
  io::EventFd wake_;
  io::SpscQueue<ProxyRequest*> requests_{kRequestsMax};
  std::atomic<bool> stopping_{false};
};

}  // namespace tandem::netsim
