#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hal/core/device.h"
#include "hal/io/heartbeat.h"

namespace tandem::hal {

/// Zero-force frame that the watchdog process sends when the client can no longer do so.
struct ShutdownFrame {
  static constexpr std::size_t kFrameMax = 65;
  int fd = -1;                    ///< the device's file, as open in this process
  std::uint8_t usb_endpoint = 0;  ///< bulk OUT endpoint for usbfs; 0: the frame is written to the file
  std::array<std::byte, kFrameMax> frame{};
  std::size_t size = 0;
};

/// Watchdog process: sends the shutdown frames through inherited files, repeatedly for 100 ms, if the client cannot.
/// It runs as long as this object exists and acts in two cases:
/// - The client process ended without a clean shutdown: killed, crashed, aborted. No signal handler could do this for
///   SIGKILL, and none is safe after a crash.
/// - The client's servo stalls for `kTimeout` with forces on: stopped by a signal or a debugger, writing a core file,
///   or starved of CPU time. When the servo resumes, the watchdog resumes monitoring.
class WatchdogProcess {
 public:
  /// Stall time-out and poll interval. Their sum equals the life of an expired command: 5 ms until expiry (ticks at 600
  /// Hz and above) and 20 ms of fading in the guard.
  static constexpr std::chrono::milliseconds kTimeout{20}, kPollInterval{5};

  /// Forks this process. Call it before real-time threads hold locks that the child needs. Error kInternal: no process,
  /// socket or shared memory available.
  [[nodiscard]] static Result<std::unique_ptr<WatchdogProcess>> start(std::span<const ShutdownFrame> devices);
  /// Ends the watchdog cleanly: the devices have received zeros already, and it sends nothing.
  ~WatchdogProcess();
  WatchdogProcess(const WatchdogProcess&) = delete;
  WatchdogProcess& operator=(const WatchdogProcess&) = delete;

  /// Heartbeat for the servo; exists as long as this object.
  [[nodiscard]] Heartbeat& heartbeat() noexcept { return *heartbeat_; }
  /// Returns whether the watchdog process runs. False: it was ended from outside, and the devices are unprotected.
  [[nodiscard]] bool alive() noexcept;

 private:
  WatchdogProcess(int line, pid_t child, Heartbeat* pulse) noexcept : line_(line), child_(child), heartbeat_(pulse) {}
  int line_;  ///< socket to the child; the kernel closes it whatever ends this process
  pid_t child_;
  Heartbeat* heartbeat_;  ///< in memory shared with the child
};

/// Returns the file that this process has open on a node such as "/dev/hidraw0"; libraries do not expose theirs.
[[nodiscard]] std::optional<int> find_open_file(const std::string& node);

}  // namespace tandem::hal
