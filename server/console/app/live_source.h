#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "proto/rpc/rpc_messages.h"

namespace tandem::console {

/// Newest picture of a session.
struct LivePicture {
  rpc::Status status;
  AccessRole role = AccessRole::kObserver;
  std::uint64_t number = 0;  ///< increases with each picture, from 1
  bool connected = false;    ///< false: the connection to the server is lost
};

/// Source of live values and the way of orders to the server. All functions may be called by any thread.
class LiveSource {
 public:
  using Reply = std::function<void(bool ok, std::string text)>;  ///< called once, by the source's thread

  virtual ~LiveSource() = default;
  [[nodiscard]] virtual LivePicture newest() const = 0;
  /// Number of the newest picture, without a copy of it.
  [[nodiscard]] virtual std::uint64_t number() const noexcept = 0;
  /// Sends an order. @return false: too many orders wait, and `reply` is not called
  [[nodiscard]] virtual bool order(rpc::Body body, Reply reply) = 0;
};

}  // namespace tandem::console
