#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "common/io/fd.h"
#include "tests/hal/emulation/devices/emulated_device.h"

namespace tandem::test {

/// Presents an emulated device as a USB device to the real kernel. The kernel's virtual host controller (vhci_hcd)
/// sends USB/IP requests over a socket pair, and this class answers them. Needs root and the kernel module. The model's
/// time follows the machine's clock.
class UsbipServer {
 public:
  /// @param port    port of the virtual controller, 0..7
  /// @param raster  step of the device's time, like the frames of a bus. The wake-up latency of this thread does not
  ///                delay the device's timers.
  UsbipServer(hal::emulation::EmulatedUsbDevice& model, unsigned port, Duration raster = std::chrono::microseconds(50));
  ~UsbipServer();
  UsbipServer(const UsbipServer&) = delete;

  /// Returns false if the controller is missing or did not accept the device.
  [[nodiscard]] bool attached() const { return attached_; }
  void unplug();

  template <class Do>
  auto with_model(Do&& act) {
    const std::lock_guard hold(mutex_);
    return act();
  }

 private:
  struct Transfer {
    std::uint32_t sequence = 0, endpoint = 0;
    bool in = false;
    std::array<std::byte, 8> setup{};
    std::vector<std::byte> data;  ///< received data (OUT), or space for the answer (IN)
    std::size_t room = 0;
  };
  void serve(std::stop_token stop);
  bool take_request();
  void finish_pending();
  bool carry_out(Transfer& transfer);
  hal::emulation::TransferResult control(Transfer& transfer);
  void answer(const Transfer& transfer, int status, std::size_t moved);

  [[nodiscard]] Time on_raster(Time t) const { return t - t.time_since_epoch() % raster_; }

  hal::emulation::EmulatedUsbDevice& model_;
  Duration raster_;
  io::Fd ours_;
  std::mutex mutex_;
  std::deque<Transfer> pending_;
  Time served_at_{};
  bool attached_ = false;
  std::jthread thread_;
};

}  // namespace tandem::test
