#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/drivers/mouse/mouse_pipe.h"

namespace tandem::hal {

/// A mouse of the kernel's evdev interface, "/dev/input/event5".
class EvdevMouse final : public MousePipe {
 public:
  struct Found {
    std::string node;         ///< "event5"
    std::string description;  ///< name the mouse reports; empty: it may not be opened
    std::string problem;      ///< why it may not be opened, with the remedy
  };
  /// Advice for users without a mouse or without permission for it.
  static constexpr const char* kWithout =
      "Without one, `--device sim:keyboard` moves a simulated hand by the arrow keys of the terminal";

  /// Returns the source of the mouse events: "evdev of Linux 6.1.0".
  [[nodiscard]] static std::string library();
  struct Ids {
    unsigned vendor = 0, product = 0;
  };
  /// Returns advice for "permission denied" on "/dev/input/eventN".
  /// @param ids  ids from sysfs, for a udev rule of this mouse alone; empty: unknown
  [[nodiscard]] static std::string permission_advice(const std::string& path, std::optional<Ids> ids);

  /// Returns every input device with the axes and the button of a mouse. One that may not be opened is listed with the
  /// problem if sysfs shows the axes of a mouse.
  [[nodiscard]] static std::vector<Found> list();
  /// Opens a mouse.
  /// @param node  "event5", or a path
  /// @param grab  take the mouse exclusively: no other program, including the screen pointer, sees it move
  [[nodiscard]] static Result<std::unique_ptr<EvdevMouse>> open(const std::string& node, bool grab);

  /// Takes ownership of an open, non-blocking file that delivers evdev records.
  explicit EvdevMouse(int fd) noexcept : fd_(fd) {}
  ~EvdevMouse() override;
  EvdevMouse(const EvdevMouse&) = delete;
  EvdevMouse& operator=(const EvdevMouse&) = delete;

  std::expected<MouseMove, Errc> read() noexcept override;

 private:
  void press(unsigned bit, bool down) noexcept { buttons_ = down ? buttons_ | bit : buttons_ & ~bit; }
  void ask_buttons() noexcept;

  int fd_;
  MouseMove pending_;  ///< of an incomplete report
  unsigned buttons_ = 0;
  bool dropped_ = false;  ///< the kernel's queue overflowed: the rest of this report is incomplete
};

}  // namespace tandem::hal
