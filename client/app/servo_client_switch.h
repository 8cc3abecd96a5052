#pragma once

#include <atomic>
#include <optional>

#include "client/seat/rate_control_adapter.h"
#include "hal/core/device.h"

namespace tandem::client {

/// Forwards a device's servo to the client that is connected, also while the servo runs. Without one the device gets no
/// force.
class ServoClientSwitch final : public hal::ServoClient {
 public:
  /// Forwards the device's own states to `client`. @param client  must outlive the servo
  void connect(hal::ServoClient& client) noexcept { client_.store(&client, std::memory_order_release); }
  /// Forwards the states that a seat sees. A device that reports velocity has no motors: it gets no command.
  /// @param device  capabilities of the device  @pre no client was connected before
  void connect_seat(hal::ServoClient& client, const hal::DeviceCaps& device) noexcept {
    if (device.input == hal::InputKind::kRate) adapter_.emplace(device);
    connect(client);
  }
  [[nodiscard]] bool was_lost() const noexcept { return lost_.load(); }

  hal::Command tick(const hal::State& state) noexcept TANDEM_REALTIME override {
    hal::ServoClient* const client = client_.load(std::memory_order_acquire);
    if (client == nullptr) return {};
    if (!adapter_) return client->tick(state);
    client->tick(adapter_->integrate(state));
    return {};
  }
  [[nodiscard]] Duration next_shift() noexcept override {
    hal::ServoClient* const client = client_.load(std::memory_order_acquire);
    return client == nullptr ? Duration{} : client->next_shift();
  }
  void lost(hal::Errc why) noexcept override {
    lost_ = true;
    if (hal::ServoClient* const client = client_.load(std::memory_order_acquire)) client->lost(why);
  }

 private:
  std::atomic<hal::ServoClient*> client_{nullptr};
  std::atomic<bool> lost_{false};
  std::optional<RateControlAdapter> adapter_;
};

}  // namespace tandem::client
