#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/hal/emulation/devices/falcon_model.h"
#include "tests/hal/emulation/devices/woodenhaptics_model.h"
#include "tests/io/programs.h"
#include "tests/vm/uhid_device.h"
#include "tests/vm/usbip_server.h"

namespace tandem::test {

/// A command of the host as the device received it; `at` is in the device's time.
struct Order {
  Time at{};
  bool force = false;
  int strength = 0;  ///< largest absolute value of the motor commands [counts or mA]
};

/// An emulated device attached to this machine, and the hand that holds it. It reports the commands received on the bus
/// and the force of the motors.
class Plug {
 public:
  virtual ~Plug() = default;
  [[nodiscard]] virtual bool attached() const = 0;
  /// Returns the device specification for --device.
  [[nodiscard]] virtual std::string words() const = 0;
  /// Returns a state directory in which its motors are confirmed; empty: it needs none.
  [[nodiscard]] virtual std::string state() const { return {}; }
  /// Places the tip where a starting client expects it. No client is connected.
  virtual void rest() = 0;
  /// Moves the tip to the workspace of the session while a client is connected.
  virtual void carry() = 0;
  /// Sets the position of the hand on the axis to the right [m].
  virtual void hold(double x) = 0;
  /// Returns the current force of the motors at the tip [N].
  [[nodiscard]] virtual double force() = 0;
  [[nodiscard]] virtual Time now() = 0;
  /// Returns the time without commands after which the device itself removes the force; zero: no such watchdog is
  /// known.
  [[nodiscard]] virtual Duration watchdog() const = 0;

  /// Returns the commands since the last call, oldest first. Call it at least every 200 ms, from one thread.
  [[nodiscard]] std::vector<Order> take();

 protected:
  static constexpr std::size_t kRemembered = 256;
  /// Returns the total number of commands; appends the newest, at most kRemembered, to `newest`, oldest first.
  virtual std::uint64_t remembered(std::vector<Order>& newest) = 0;

 private:
  std::uint64_t taken_ = 0;
};

enum class Kind { kFalcon, kBoardV1, kBoardV2 };
/// State of a device when its client starts.
enum class Found {
  kReady,       ///< homed, or at rest where the device specification homes it
  kUnhomed,     ///< the user must home it
  kNoFirmware,  ///< Falcons only: just powered on
};
[[nodiscard]] std::unique_ptr<Plug> plug_in(Kind kind, const Folder& folder, Found found = Found::kReady);

}  // namespace tandem::test
