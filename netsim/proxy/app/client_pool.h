#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "common/io/event_fd.h"
#include "common/io/fd.h"
#include "common/io/spsc_queue.h"
#include "netsim/proxy/proxy_core.h"
#include "netsim/quality/link_monitor.h"

namespace tandem::netsim {

/// Pool of prepared clients of the live proxy (link and quality monitor), so that the packet thread allocates nothing
/// when a client joins. An ordinary thread creates them. One queue carries them to the packet thread; another returns
/// used or outdated ones. If more than kReady clients join at once, the packet thread allocates the resources itself
/// and counts a miss.
class ClientPool {
 public:
  static constexpr std::size_t kReady = 16;

  /// Resources of one future client.
  struct PreparedClient {
    PreparedLink link;
    std::unique_ptr<LinkMonitor> monitor;  ///< null: quality is not monitored
  };

  /// Creates the first kReady clients.
  /// @param core  must outlive the pool
  ClientPool(const ProxyCore& core, const LinkSpec& link, bool monitor);
  ~ClientPool();
  ClientPool(const ClientPool&) = delete;
  ClientPool& operator=(const ClientPool&) = delete;

  // Functions of the ordinary thread. Calls from several threads must not overlap.

  /// Frees returned clients and creates missing ones.
  void refill();
  /// Sets the link of clients that join after the next change of the network.
  void set_next_link(const LinkSpec& link);
  /// Returns a descriptor that is readable when `refill` has work.
  [[nodiscard]] int wanted_fd() const noexcept { return wanted_.get(); }

  // Functions of the packet thread.

  /// Returns the prepared client for the next arrival; null if none is ready. Return it with `give_back` after using
  /// its contents.
  [[nodiscard]] PreparedClient* next() noexcept;
  void give_back(PreparedClient* prepared) noexcept;
  /// Gives back clients prepared for a previous network.
  void drop_outdated() noexcept;
  /// Returns the number of clients for which none was ready. Any thread.
  [[nodiscard]] std::uint64_t misses() const noexcept { return misses_.load(std::memory_order_relaxed); }

 private:
  const ProxyCore* core_;
  bool monitor_;
  LinkSpec link_;
  std::uint64_t version_ = 0, made_ = 0;  ///< version of the link; number of clients prepared so far
  std::size_t outstanding_ = 0;           ///< held by the packet thread or in a queue
  io::SpscQueue<PreparedClient*> ready_, returned_;
  io::EventFd wanted_;
  std::atomic<std::uint64_t> arrived_{0};  ///< number of clients that joined
  std::atomic<std::uint64_t> misses_{0};
};

}  // namespace tandem::netsim
