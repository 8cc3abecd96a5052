#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/driver.h"
#include "hal/io/device_choice.h"

namespace tandem::hal {

/// A device that is attached, seen without opening it.
struct FoundDevice {
  DeviceId id;          ///< `key` is what a person writes after `BACKEND:`
  std::string product;  ///< as it calls itself
  std::string node;     ///< of the system, for a person
  std::string trouble;  ///< why it could not be opened now, with the remedy; empty: nothing known
};

/// One kind of hardware: how it is found, how a driver for it is made. Never opens "the default" one: of several, a
/// person names theirs.
class Backend {
 public:
  virtual ~Backend() = default;
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// Lines for --help: the words after --device, and what they do.
  [[nodiscard]] virtual std::string_view help() const noexcept = 0;
  /// Error: why nothing can be listed at all, for example a missing library.
  [[nodiscard]] virtual Result<std::vector<FoundDevice>> list() = 0;
  /// A driver for the chosen device, opened and claimed, not brought up. Error: cause and remedy.
  [[nodiscard]] virtual Result<std::unique_ptr<Driver>> open(const DeviceChoice& choice) = 0;
};

/// All that this build has; simulated devices are not among them.
[[nodiscard]] std::span<Backend* const> backends();
/// Error: names the nearest and all.
[[nodiscard]] Result<Backend*> find_backend(std::string_view name);
/// The one a choice means: the named one, or the only one. Error: there is none, or several: lists them.
[[nodiscard]] Result<FoundDevice> choose(const DeviceChoice& choice, std::span<const FoundDevice> found);

}  // namespace tandem::hal
