#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "hal/core/servo_core.h"
#include "hal/io/heartbeat.h"
#include "hal/io/periodic_timer.h"

namespace tandem::hal {

/// A live device: a servo thread that steps a ServoCore on an absolute schedule.
/// `State::sampled_at` and `Command::expires` are CLOCK_MONOTONIC. When the thread ends, for any reason, the device
/// receives zero effort.
/// Threads: every function from any thread except the client's tick. There, close() only requests the thread's end.
class DeviceThread final : public Device {
 public:
  /// @param core   already brought up
  /// @param period  of the exchanges, above 0
  /// @param pulse  heartbeat for a WatchdogProcess, beats while forces may be on; outlives this object; nullptr: no
  ///           watchdog
  DeviceThread(std::unique_ptr<ServoCore> core, Duration period, Heartbeat* pulse = nullptr);
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
  PeriodicTimer pace_;  ///< used by the servo thread
  Heartbeat* heartbeat_;
  std::atomic<bool> stop_{false}, realtime_{false}, closed_{false};
  std::thread thread_;
  // The servo thread uses try_lock only: it never waits for a reader.
  mutable std::mutex stats_lock_;
  DeviceStats published_;
};

}  // namespace tandem::hal
