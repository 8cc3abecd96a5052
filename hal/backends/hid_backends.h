#pragma once

#include "hal/backends/backend.h"

namespace tandem::hal {

/// WoodenHaptics, AluHaptics and Polhem v1 boards through hidapi. Their USB id is not unique to them, so motors are
/// enabled only on the user's request.
class WoodenHapticsBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "woodenhaptics"; }
  [[nodiscard]] std::string_view help() const noexcept override;
  [[nodiscard]] Result<std::vector<FoundDevice>> list() override;
  [[nodiscard]] std::vector<std::string> udev_rules() const override;
  [[nodiscard]] std::string library() const override;
  [[nodiscard]] std::vector<DeviceFact> facts() const override;
  [[nodiscard]] Result<> check(const DeviceSpec& choice) const override;
  [[nodiscard]] Result<OpenedDriver> open(const DeviceSpec& choice) override;
};

/// 3Dconnexion SpaceMouse devices through hidapi.
class SpaceMouseBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "spacemouse"; }
  [[nodiscard]] std::string_view help() const noexcept override;
  [[nodiscard]] Result<std::vector<FoundDevice>> list() override;
  [[nodiscard]] std::vector<std::string> udev_rules() const override;
  [[nodiscard]] std::string library() const override;
  [[nodiscard]] std::vector<DeviceFact> facts() const override;
  [[nodiscard]] Result<> check(const DeviceSpec& choice) const override;
  [[nodiscard]] Result<OpenedDriver> open(const DeviceSpec& choice) override;
};

}  // namespace tandem::hal
