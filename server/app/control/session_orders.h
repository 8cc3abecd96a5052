#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "common/io/event_fd.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::server {

/// Order of an operator to create or end a session, or of an operator or instructor to record it.
struct SessionOrder {
  std::variant<rpc::CreateSession, rpc::EndSession, rpc::RecordSession> body{};
  std::string who{};                        ///< workstation and role of the operator
  std::function<void(rpc::Body)> answer{};  ///< called once, on the control plane's thread
};

/// Bounded queue of orders from the control plane to the thread that opens and finishes sessions. Sessions are built
/// there, so that neither the control plane nor a tick waits for it. Thread-safe.
class SessionOrders {
 public:
  static constexpr std::size_t kMax = 16;

  /// Queues an order. @return false: the queue is full
  [[nodiscard]] bool post(SessionOrder order) {
    const std::lock_guard lock(lock_);
    if (orders_.size() >= kMax) return false;
    orders_.push_back(std::move(order));
    arrived_.signal();
    return true;
  }
  /// Next order; nullopt if there is none.
  [[nodiscard]] std::optional<SessionOrder> take() {
    const std::lock_guard lock(lock_);
    if (orders_.empty()) {
      arrived_.clear();
      return std::nullopt;
    }
    SessionOrder order = std::move(orders_.front());
    orders_.pop_front();
    return order;
  }
  /// File descriptor that is readable while an order waits.
  [[nodiscard]] int fd() const noexcept { return arrived_.get(); }

 private:
  std::mutex lock_;
  std::deque<SessionOrder> orders_;
  io::EventFd arrived_;
};

}  // namespace tandem::server
