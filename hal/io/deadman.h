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

#include "hal/device.h"
#include "hal/io/pulse.h"

namespace tandem::hal {

/// The zeros a device gets when nobody is left to send them.
struct LastWords {
  static constexpr std::size_t kFrameMax = 65;
  int fd = -1;                    ///< the device's, as open in this process
  std::uint8_t usb_endpoint = 0;  ///< bulk OUT of usbfs; 0: the frame is written
  std::array<std::byte, kFrameMax> frame{};
  std::size_t size = 0;
};

/// A process that lives as long as this object and sends the last words through the file it inherited, again and again
/// for 100 ms, whenever nobody else can:
/// - the program died before saying goodbye: killed, crashed, aborted. No handler of signals could do that for SIGKILL,
///   and none is safe after a crash.
/// - its servo stands still for `kPatience` with forces on: stopped by a signal or a debugger, writing its core, starved
///   of the processor. When it moves on, so does the watch.
class Deadman {
 public:
  /// As long as a command that died needs to let go: its age of 5 ms and the guard's 20 ms.
  static constexpr std::chrono::milliseconds kPatience{20}, kLook{5};

  /// Copies this process; to be called before realtime threads hold locks that matter. Error: no process to be had.
  [[nodiscard]] static Result<std::unique_ptr<Deadman>> watch(std::span<const LastWords> devices);
  /// Says goodbye: the devices were silenced, nothing is to be done.
  ~Deadman();
  Deadman(const Deadman&) = delete;
  Deadman& operator=(const Deadman&) = delete;

  /// For the servo; lives as long as this object.
  [[nodiscard]] Pulse& pulse() noexcept { return *pulse_; }
  /// False: somebody ended the process, and nobody would speak for the devices.
  [[nodiscard]] bool alive() noexcept;

 private:
  Deadman(int line, pid_t child, Pulse* pulse) noexcept : line_(line), child_(child), pulse_(pulse) {}
  int line_;  ///< closed by the system whatever this process dies of
  pid_t child_;
  Pulse* pulse_;  ///< in memory shared with the child
};

/// The file this process has open on a node such as "/dev/hidraw0"; libraries hide theirs.
[[nodiscard]] std::optional<int> open_file_of(const std::string& node);

}  // namespace tandem::hal
