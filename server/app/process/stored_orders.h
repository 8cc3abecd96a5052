#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

namespace tandem::server {

/// How many orders of a session (stops, pauses and resumes, Checkpoint::orders) a restart restores. The keeper of the
/// session's snapshots sets it, and the control plane reads it before it confirms such an order. Thread-safe.
class StoredOrders {
 public:
  // ---- The keeper ----
  /// A snapshot with this number of orders is stored, so that it survives the death of the server.
  void set_stored(std::uint32_t orders) {
    stored_.store(std::max(orders, stored_.load(std::memory_order_relaxed)), std::memory_order_release);
    set_problem({});
  }
  /// A snapshot with this number of orders could not be stored. A later one may be.
  /// @param why  cause and remedy, without paths of this computer
  void set_failed(std::uint32_t orders, std::string why) {
    set_problem(std::move(why));
    failed_.store(std::max(orders, failed_.load(std::memory_order_relaxed)), std::memory_order_release);
  }
  /// Snapshots cannot be stored now. Empty: they can.
  void set_problem(std::string why) {
    const std::lock_guard lock(lock_);
    problem_ = std::move(why);
  }

  // ---- Any thread ----
  [[nodiscard]] bool has(std::uint32_t orders) const noexcept {
    return stored_.load(std::memory_order_acquire) >= orders;
  }
  /// A snapshot that has this order was refused, and no later one is stored yet.
  [[nodiscard]] bool failed(std::uint32_t orders) const noexcept {
    return !has(orders) && failed_.load(std::memory_order_acquire) >= orders;
  }
  /// Why the newest snapshot is not stored, with the remedy; empty: it is, or its write has not ended.
  [[nodiscard]] std::string problem() const {
    const std::lock_guard lock(lock_);
    return problem_;
  }

 private:
  std::atomic<std::uint32_t> stored_{0}, failed_{0};
  mutable std::mutex lock_;
  std::string problem_;
};

}  // namespace tandem::server
