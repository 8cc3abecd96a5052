#pragma once

#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <utility>

#include "common/base/time.h"
#include "common/io/clock.h"
#include "server/app/process/stored_orders.h"

namespace tandem::server {

/// Replies to orders that the session has carried out, held until a restart of the server would restore the order. They
/// wait side by side: neither other connections nor the session wait for them. All members run on the control plane's
/// thread.
class HeldReplies {
 public:
  static constexpr std::size_t kMax = 1024;  ///< one more is given at once, as not stored
  static constexpr std::chrono::milliseconds kLook{2};

  /// @param context  must run out of work only after `give_all`
  explicit HeldReplies(asio::io_context& context, std::function<Time()> clock = io::monotonic_now)
      : clock_(std::move(clock)), timer_(context) {}

  /// Calls `give` once the order is stored, or its write has failed, or after `limit`; perhaps now.
  /// @param orders  number that the stored snapshot must have
  /// @param give    receives why the order is not stored, with the remedy; empty: it is
  void hold(std::shared_ptr<const StoredOrders> stored, std::uint32_t orders, Duration limit,
            std::function<void(const std::string& why)> give);
  /// Gives all replies now: the server ends.
  void give_all();
  [[nodiscard]] std::size_t size() const noexcept { return held_.size(); }

 private:
  struct Held {
    std::shared_ptr<const StoredOrders> stored;
    std::uint32_t orders;
    Time until;
    std::function<void(const std::string& why)> give;
  };
  void look();
  void look_again();

  std::function<Time()> clock_;
  asio::steady_timer timer_;
  std::list<Held> held_;
};

}  // namespace tandem::server
