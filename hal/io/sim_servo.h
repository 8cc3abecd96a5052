#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "hal/device.h"
#include "hal/io/servo_pace.h"

namespace tandem::hal {

/// Makes a stepped device live: a thread of its own steps it by `period` on an absolute CLOCK_MONOTONIC schedule and
/// calls the client once per wake-up. A wake-up that comes several periods late steps the device through all of them
/// under the last command (which dies at its own expiry) and calls the client once: no bursts. `State::sampled_at` seen
/// by the client and `Command::expires` are CLOCK_MONOTONIC. Threads: start, enable, disable, reset, unplug, stats,
/// close from any thread but the client's tick, where close() only asks the thread to end.
class SimServo final : public Device {
 public:
  SimServo(std::unique_ptr<SteppedDevice> device, DeviceId id, Duration period);
  ~SimServo() override { close(); }

  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] Phase phase() const noexcept override { return phase_.load(std::memory_order_acquire); }
  /// Identified -> Ready. Error: kBadState if already started or closed, kInternal if there is no thread to be had.
  Result<> start(ServoClient& client) override;
  Result<> enable() override;
  void disable() noexcept override;
  /// A simulated device has no faults to leave; kBadState when Lost (open it again) or not started.
  Result<> reset() override;
  [[nodiscard]] DeviceStats stats() const override;
  [[nodiscard]] DeviceHistograms histograms() const override;
  /// Ends the thread after a last step with zero effort. May be called again.
  void close() noexcept override;

  /// Pulls the plug, as a test or a person would: the client hears lost(kUnplugged) on the device's thread, no more
  /// ticks come.
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

  // The servo thread only tries this lock and keeps its numbers for the next tick if a reader holds it: it never waits.
  mutable std::mutex stats_lock_;
  DeviceStats published_;
  DeviceStats stats_;
  ServoPace pace_;
};

}  // namespace tandem::hal
