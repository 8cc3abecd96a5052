#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "common/io/fd.h"
#include "common/io/spsc_queue.h"
#include "netsim/link_watch.h"
#include "netsim/proxy_core.h"

namespace tandem::netsim {

/// What a client of the live proxy needs that has not come yet: its link and its judge, so that the packet thread takes no memory
/// when somebody joins. An ordinary thread makes the next ones; two queues carry them there and, used or outdated, back.
/// More than kReady at once find the pool empty: then the packet thread takes the memory, and counts it.
class NewcomerPool {
 public:
  static constexpr std::size_t kReady = 16;

  struct Newcomer {
    ProxyCore::Newcomer place;
    std::unique_ptr<LinkWatch> watch;  ///< null: nobody judges
  };

  /// Makes the first kReady. @param core  must live as long
  NewcomerPool(const ProxyCore& core, const LinkSpec& link, bool watch);
  ~NewcomerPool();
  NewcomerPool(const NewcomerPool&) = delete;
  NewcomerPool& operator=(const NewcomerPool&) = delete;

  // Of the ordinary thread; always the same one, or one after the other.

  /// Frees what came back and makes what is missing.
  void refill();
  /// Those who come after the next change of the network find this link.
  void link_will_be(const LinkSpec& link);
  /// Readable when `refill` has something to do.
  [[nodiscard]] int wanted_fd() const noexcept { return wanted_.get(); }

  // Of the packet thread.

  /// The one for the client that comes next; null: none is ready. Give it back with `done` when what it holds was taken.
  [[nodiscard]] Newcomer* next() noexcept;
  void done(Newcomer* newcomer) noexcept;
  /// The network changed: those made for the one before go back.
  void drop_outdated() noexcept;
  /// Clients for which none was ready, so far; from any thread.
  [[nodiscard]] std::uint64_t missed() const noexcept { return missed_.load(std::memory_order_relaxed); }

 private:
  const ProxyCore* core_;
  bool watch_;
  LinkSpec link_;
  std::uint64_t version_ = 0, made_ = 0;  ///< of the link; clients made for, by number
  std::size_t out_ = 0;                   ///< with the packet thread, or on the way
  io::SpscQueue<Newcomer*> ready_, back_;
  io::Fd wanted_;
  std::atomic<std::uint64_t> seen_{0};  ///< clients that came
  std::atomic<std::uint64_t> missed_{0};
};

}  // namespace tandem::netsim
