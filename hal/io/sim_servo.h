#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "hal/core/device.h"
#include "hal/io/periodic_timer.h"

namespace tandem::hal {

/// A live stepped device: a servo thread steps it by `period` on an absolute CLOCK_MONOTONIC schedule and calls the
/// client once per wake-up.
/// A wake-up that is several periods late steps the device through all of them under the last command, up to its
/// expiry. The client is then called once, so there are no bursts.
/// `State::sampled_at` as seen by the client and `Command::expires` are CLOCK_MONOTONIC.
/// Threads: start, enable, disable, reset, unplug, stats and close from any thread except the client's tick. There,
/// close() only requests the thread's end.
class SimServo final : public Device {
 public:
  /// Takes a device that is not yet stepped. @param device  stepped by the servo thread only  @param id  identity for
  /// the user  @param period  of the exchanges, above 0
  SimServo(std::unique_ptr<SteppedDevice> device, DeviceId id, Duration period);
  ~SimServo() override { close(); }

  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] Phase phase() const noexcept override { return phase_.load(std::memory_order_acquire); }
  /// Starts the servo thread: Identified -> Ready. Error: kBadState if already started or closed, kInternal if no
  /// thread can be created.
  Result<> start(ServoClient& client) override;
  Result<> enable() override;
  void disable() noexcept override;
  /// Does nothing: a simulated device has no faults. Error: kBadState if Lost (open it again) or not started.
  Result<> reset() override;
  [[nodiscard]] DeviceStats stats() const override;
  [[nodiscard]] DeviceHistograms histograms() const override;
  /// Ends the thread after a last step with zero effort. May be called repeatedly.
  void close() noexcept override;

  /// Simulates unplugging: the client receives lost(kUnplugged) on the device's thread, and no more ticks follow.
  void unplug() noexcept { unplugged_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool realtime() const noexcept override { return realtime_.load(std::memory_order_relaxed); }

 private:
  void run(ServoClient& client) noexcept;
  void count(bool expired, bool rejected) noexcept;
  void publish() noexcept;

  std::unique_ptr<SteppedDevice> device_;
  DeviceCaps caps_;
  DeviceId id_;
  Duration period_;
  std::atomic<Phase> phase_{Phase::kIdentified};
  std::atomic<bool> stop_{false}, unplugged_{false}, realtime_{false};
  std::thread thread_;

  // The servo thread uses try_lock only. If a reader holds the lock, the thread publishes its numbers at a later tick.
  mutable std::mutex stats_lock_;
  DeviceStats published_;
  DeviceStats stats_;
  PeriodicTimer pace_;
};

}  // namespace tandem::hal
