#pragma once

#include "hal/backends/backend.h"

namespace tandem::hal {

/// Novint Falcon through libusb.
class FalconBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "falcon"; }
  [[nodiscard]] std::string_view help() const noexcept override;
  [[nodiscard]] Result<std::vector<FoundDevice>> list() override;
  [[nodiscard]] std::vector<std::string> udev_rules() const override;
  [[nodiscard]] std::string library() const override;
  [[nodiscard]] std::vector<DeviceFact> facts() const override;
  [[nodiscard]] Result<> check(const DeviceSpec& choice) const override;
  [[nodiscard]] Result<OpenedDriver> open(const DeviceSpec& choice) override;
};

}  // namespace tandem::hal
