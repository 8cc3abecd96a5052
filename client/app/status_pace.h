#pragma once

#include <cstdint>
#include <utility>

namespace tandem::client {

/// Decides in which ticks a seat publishes its status: every 64th, the first of each connection, and all once it is
/// closed. A tick that could not publish, because another thread reads, is repeated by the next one.
class StatusPace {
 public:
  /// Counts a tick. @return whether it publishes the status
  [[nodiscard]] bool due(bool closed) noexcept {
    due_ = due_ || closed || ticks_ % kPublishEvery == 0;
    ++ticks_;
    return due_;
  }
  /// @param published  false: another thread reads  @param closed  as published
  /// @return true if the end of the seat can be signalled now, because all readers see it; once per connection
  [[nodiscard]] bool on_publish(bool published, bool closed) noexcept {
    due_ = !published;
    signalled_ = signalled_ && closed;
    return published && closed && !std::exchange(signalled_, true);
  }
  /// The next tick is the first of a connection.
  void restart() noexcept { due_ = true; }

 private:
  static constexpr std::uint64_t kPublishEvery = 64;

  std::uint64_t ticks_ = 0;
  bool due_ = false, signalled_ = false;
};

}  // namespace tandem::client
