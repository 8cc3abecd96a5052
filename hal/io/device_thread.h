#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "hal/io/pulse.h"
#include "hal/io/servo_pace.h"
#include "hal/servo_core.h"

namespace tandem::hal {

/// A driver made live: a thread of its own steps its ServoCore on an absolute schedule. `State::sampled_at` and
/// `Command::expires` are CLOCK_MONOTONIC. When the thread ends, whatever the reason, the device gets zeros. Threads:
/// everything from any thread but the client's tick, where close() only asks the thread to end.
class DeviceThread final : public Device {
 public:
  /// @param core   brought up
  /// @param pulse  beats while forces may be on, for a Deadman; lives as long as this; nullptr: nobody watches
  DeviceThread(std::unique_ptr<ServoCore> core, Duration period, Pulse* pulse = nullptr);
  ~DeviceThread() override { close(); }

  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  [[nodiscard]] const DeviceId& id() const noexcept override { return core_->id(); }
  [[nodiscard]] Phase phase() const noexcept override {
    return closed_.load(std::memory_order_acquire) ? Phase::kAbsent : core_->phase();
  }
  Result<> start(ServoClient& client) override;
  Result<> enable() override { return core_->enable(); }
  void disable() noexcept override { core_->disable(); }
  Result<> reset() override { return core_->reset(); }
  [[nodiscard]] DeviceStats stats() const override;
  [[nodiscard]] DeviceHistograms histograms() const override;
  void close() noexcept override;

  [[nodiscard]] bool realtime() const noexcept override { return realtime_.load(std::memory_order_relaxed); }

 private:
  void run(ServoClient& client) noexcept;

  std::unique_ptr<ServoCore> core_;
  DeviceCaps caps_;
  Duration period_;
  ServoPace pace_;  ///< of the servo thread
  Pulse* pulse_;
  std::atomic<bool> stop_{false}, realtime_{false}, closed_{false};
  std::thread thread_;
  // The servo thread only tries this lock: it never waits for a reader.
  mutable std::mutex stats_lock_;
  DeviceStats published_;
};

}  // namespace tandem::hal
