#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hal/device.h"

namespace tandem::hal {

/// The zeros a device gets when nobody is left to send them.
struct LastWords {
  static constexpr std::size_t kFrameMax = 65;
  int fd = -1;                    ///< the device's, as open in this process
  std::uint8_t usb_endpoint = 0;  ///< bulk OUT of usbfs; 0: the frame is written
  std::array<std::byte, kFrameMax> frame{};
  std::size_t size = 0;
};

/// A process that lives as long as this object and does nothing. If the program dies before saying goodbye - killed,
/// crashed, aborted - it sends the last words, again and again for 100 ms, through the file it inherited. No handler of
/// signals could do that for SIGKILL, and none is safe after a crash.
class Deadman {
 public:
  /// Copies this process; to be called before realtime threads hold locks that matter. Error: no process to be had.
  [[nodiscard]] static Result<std::unique_ptr<Deadman>> watch(std::span<const LastWords> devices);
  /// Says goodbye: the devices were silenced, nothing is to be done.
  ~Deadman();
  Deadman(const Deadman&) = delete;
  Deadman& operator=(const Deadman&) = delete;

 private:
  Deadman(int line, pid_t child) noexcept : line_(line), child_(child) {}
  int line_;  ///< closed by the system whatever this process dies of
  pid_t child_;
};

/// The file this process has open on a node such as "/dev/hidraw0"; libraries hide theirs.
[[nodiscard]] std::optional<int> open_file_of(const std::string& node);

}  // namespace tandem::hal
