#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/mouse/mouse_pipe.h"

namespace tandem::hal {

/// A mouse of the kernel's evdev, "/dev/input/event5".
class EvdevMouse final : public MousePipe {
 public:
  struct Found {
    std::string node;     ///< "event5"
    std::string about;    ///< its own name; empty when it may not be opened
    std::string trouble;  ///< why it may not, with the remedy
  };
  /// What a person does who has no mouse, or may not use it.
  static constexpr const char* kWithout = "Without one, `--device sim:keyboard` moves a simulated hand by the arrow keys of the terminal";

  /// What gives the mouse its events: "evdev of Linux 6.1.0".
  [[nodiscard]] static std::string library();
  struct Ids {
    unsigned vendor = 0, product = 0;
  };
  /// What to do about "permission denied" on "/dev/input/eventN".
  /// @param ids  as sysfs has them, for a udev rule of this mouse alone; empty: not known
  [[nodiscard]] static std::string permission_advice(const std::string& path, std::optional<Ids> ids);

  /// Everything that has the axes and the button of a mouse; what may not be opened is listed with its trouble where the
  /// kernel calls it a mouse.
  [[nodiscard]] static std::vector<Found> list();
  /// @param node  "event5", or a path
  /// @param grab  nobody else, no pointer on a screen, sees it move
  [[nodiscard]] static Result<std::unique_ptr<EvdevMouse>> open(const std::string& node, bool grab);

  /// Takes an open, non-blocking file that gives records of evdev.
  explicit EvdevMouse(int fd) noexcept : fd_(fd) {}
  ~EvdevMouse() override;
  EvdevMouse(const EvdevMouse&) = delete;
  EvdevMouse& operator=(const EvdevMouse&) = delete;

  std::expected<MouseMove, Errc> read() noexcept override;

 private:
  void press(unsigned bit, bool down) noexcept { buttons_ = down ? buttons_ | bit : buttons_ & ~bit; }
  void ask_buttons() noexcept;

  int fd_;
  MouseMove pending_;      ///< of a report that is not complete
  unsigned buttons_ = 0;
  bool dropped_ = false;   ///< the kernel's queue ran over: the rest of this report is incomplete
};

}  // namespace tandem::hal
