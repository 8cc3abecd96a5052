#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/wire/falcon_model.h"
#include "hal/wire/woodenhaptics_model.h"
#include "tests/io/programs.h"
#include "tests/vm/uhid_device.h"
#include "tests/vm/usbip_server.h"

namespace tandem::test {

/// An order of the host as the device took it; time is the device's own.
struct Order {
  Time at{};
  bool force = false;
  int strength = 0;  ///< of the motor that is told most, as it was told [counts or mA]
};

/// A device in a socket of this machine, and the hand that holds it: what was ordered at the wire, what its motors give.
class Plug {
 public:
  virtual ~Plug() = default;
  [[nodiscard]] virtual bool attached() const = 0;
  /// What a person writes after --device.
  [[nodiscard]] virtual std::string words() const = 0;
  /// A state folder in which its motors are confirmed; empty: it needs none.
  [[nodiscard]] virtual std::string state() const { return {}; }
  /// Puts the tip where a start expects it, nobody listening.
  virtual void rest() = 0;
  /// Carries the tip to where sessions are, the host listening.
  virtual void carry() = 0;
  /// The hand's place on the axis to the right [m].
  virtual void hold(double x) = 0;
  /// Of the motors at the tip, now [N].
  [[nodiscard]] virtual double force() = 0;
  [[nodiscard]] virtual Time now() = 0;
  /// After which the device lets go by itself when nobody orders; zero: it never does, as far as anybody knows.
  [[nodiscard]] virtual Duration watchdog() const = 0;

  /// Orders since the last call, oldest first. Call it every 200 ms at least, by one thread.
  [[nodiscard]] std::vector<Order> take();

 protected:
  static constexpr std::size_t kRemembered = 256;
  /// How many orders there were in all, and the newest ones of them, oldest first.
  virtual std::uint64_t remembered(std::vector<Order>& newest) = 0;

 private:
  std::uint64_t taken_ = 0;
};

enum class Kind { kFalcon, kBoardV1, kBoardV2 };
/// How far a device is when its client starts.
enum class Found {
  kReady,       ///< homed, or resting where the words tell it to be homed
  kUnhomed,     ///< a person must home it
  kNoFirmware,  ///< Falcons only: just got its power
};
[[nodiscard]] std::unique_ptr<Plug> plug_in(Kind kind, const Folder& folder, Found found = Found::kReady);

}  // namespace tandem::test
