#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "server/console/session_picture.h"

namespace tandem::console {

/// Source of live values and the way of orders to the server. All functions may be called by any thread.
class LiveSource {
 public:
  /// Called once, by the source's thread or by `order` itself. message: a further message for the page, empty: none
  using Reply = std::function<void(bool ok, std::string text, std::string message)>;

  virtual ~LiveSource() = default;
  /// Never null.
  [[nodiscard]] virtual std::shared_ptr<const LivePicture> newest() const = 0;
  /// Number of the newest picture.
  [[nodiscard]] virtual std::uint64_t number() const noexcept = 0;
  /// Sends an order. Without a connection the order is refused at once, and never carried out later. @return false: too
  /// many orders wait, and `reply` is not called
  [[nodiscard]] virtual bool order(rpc::Body body, Reply reply) = 0;
};

}  // namespace tandem::console
