#pragma once

#include "hal/backends/backend.h"
#include "hal/io/periodic_timer.h"

namespace tandem::hal {

/// A recorded motion as a device.
class ReplayBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "replay"; }
  [[nodiscard]] std::string_view help() const noexcept override {
    return "  "
           "replay:FILE.csv[,columns=PREFIX][,rec=N][,scale=auto|S][,axes=+x+y+z][,end=hold|loop][,middle=zero|keep]\n"
           "                              a recorded motion is the device: it moves as recorded, whatever the tool "
           "does, from\n"
           "                              the moment the seat is taken; feels no force\n";
  }
  /// Returns an empty list: recordings are not searched for.
  [[nodiscard]] Result<std::vector<FoundDevice>> list() override { return std::vector<FoundDevice>{}; }
  [[nodiscard]] std::string library() const override;
  [[nodiscard]] std::vector<DeviceFact> facts() const override;
  [[nodiscard]] Result<> check(const DeviceSpec& choice) const override;
  [[nodiscard]] Result<OpenedDriver> open(const DeviceSpec& choice) override;

 private:
  MonotonicClock clock_;
};

/// A mouse through the kernel's evdev interface.
class MouseBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "mouse"; }
  [[nodiscard]] std::string_view help() const noexcept override {
    return "  mouse[:eventN][,mm_per_count=0.1][,plane=vertical|table][,grab=yes|no]\n"
           "                              a mouse moves the tip, its wheel moves it in depth; feels no force. "
           "grab=yes: the\n"
           "                              pointer on the screen stands still meanwhile\n";
  }
  [[nodiscard]] Result<std::vector<FoundDevice>> list() override;
  [[nodiscard]] std::string library() const override;
  [[nodiscard]] std::vector<DeviceFact> facts() const override;
  [[nodiscard]] Result<> check(const DeviceSpec& choice) const override;
  [[nodiscard]] Result<OpenedDriver> open(const DeviceSpec& choice) override;

 private:
  MonotonicClock clock_;
};

}  // namespace tandem::hal
