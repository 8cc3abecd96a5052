#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "common/io/fd.h"
#include "hal/wire/wire_model.h"

namespace tandem::test {

/// A wire model as a USB device of the real kernel: the kernel's virtual host controller (vhci_hcd) speaks USB/IP over
/// a socket pair, and this end answers. Needs root and the module. The model's time is the machine's.
class UsbipServer {
 public:
  /// @param port    of the virtual controller, 0..7
  /// @param raster  the device's time moves in these steps, so that its timers do not run late by what waking up costs
  ///                here: a bus has frames of its own too
  UsbipServer(hal::wire::UsbWireModel& model, unsigned port, Duration raster = std::chrono::microseconds(50));
  ~UsbipServer();
  UsbipServer(const UsbipServer&) = delete;

  /// False: there is no such controller, or it did not take the device.
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
    std::vector<std::byte> data;  ///< what goes out, or room for what comes in
    std::size_t room = 0;
  };
  void serve(std::stop_token stop);
  bool take_request();
  void finish_pending();
  bool carry_out(Transfer& transfer);
  hal::wire::WireMoved control(Transfer& transfer);
  void answer(const Transfer& transfer, int status, std::size_t moved);

  [[nodiscard]] Time on_raster(Time t) const { return t - t.time_since_epoch() % raster_; }

  hal::wire::UsbWireModel& model_;
  Duration raster_;
  io::Fd ours_;
  std::mutex mutex_;
  std::deque<Transfer> pending_;
  Time served_at_{};
  bool attached_ = false;
  std::jthread thread_;
};

}  // namespace tandem::test
