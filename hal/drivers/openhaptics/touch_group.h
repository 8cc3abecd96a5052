#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "hal/core/clock.h"
#include "hal/core/device.h"
#include "hal/drivers/openhaptics/hd_api.h"
#include "hal/drivers/openhaptics/latest.h"

namespace tandem::hal::openhaptics {

/// Reading of one device in the vendor's servo cycle.
struct Sample {
  std::uint64_t cycle = 0;         ///< number of the cycle; 0: no reading yet
  std::uint64_t command_seq = 0;   ///< sequence number of the command behind `force`
  std::array<double, 3> x{}, v{};  ///< HAL frame [m], [m/s]
  std::array<double, 3> force{};   ///< set in this cycle, HAL frame [N]
  std::array<std::int32_t, 3> encoders{};
  std::uint32_t buttons = 0;
  bool homed = false;
  bool limited = false;          ///< the library or Tandem's clamp reduced or removed the force
  bool lost = false;             ///< the device no longer responds; its handle is not used again
  std::optional<double> heat{};  ///< of the hottest motor, 1: too hot; empty: not measured; NaN: unknown
  std::uint32_t error = 0;       ///< newest error of this device, 0: none in this cycle
};

/// Motor command of one device, from the next cycle on.
struct TouchCommand {
  /// Number of this command; a cycle that sees the same number for too long releases the force.
  std::uint64_t number = 0;
  std::uint64_t seq = 0;
  std::array<double, 3> force{};  ///< HAL frame [N]
  bool homing = false;
};

/// All devices of the vendor's library in this process. The library has one scheduler, so one callback handles a frame
/// for each device.
/// The callback runs on the vendor's thread and never waits. It uses the newest command of each device and sets zero
/// force if commands stop arriving.
/// `add`, `remove`: from one non-real-time thread at a time; during these calls all forces are zero.
class TouchGroup {
 public:
  static constexpr std::size_t kMax = 4;
  static constexpr unsigned kCommandCycles = 10;  ///< cycles for which a command is obeyed

  /// @param api    complete function table; must outlive this object, as must `clock`
  TouchGroup(const Api& api, Clock& clock) noexcept : api_(&api), clock_(&clock) {}
  ~TouchGroup();
  TouchGroup(const TouchGroup&) = delete;
  TouchGroup& operator=(const TouchGroup&) = delete;

  /// Data that the device reports.
  struct DeviceInfo {
    std::size_t slot = 0;
    std::string model, serial, version;
    std::uint32_t calibration = 0;                      ///< calibration styles, one bit each
    std::size_t motors = 0;                             ///< motors with a temperature
    std::optional<double> force_max, force_continuous;  ///< [N]
    std::optional<std::array<double, 6>> workspace;     ///< HAL frame, min xyz, max xyz [m]
  };
  /// Initialises a device and adds it to the scheduler's cycle. Error: cause and remedy.
  /// @param name         name in the vendor's set-up tool; empty: the default device
  /// @param rests_there  returns whether the user confirms that the device rests in its reset pose. Called once, before
  ///           the servo starts, and only for devices that find their origin by an encoder reset alone. If true, the
  ///           encoders are reset; else the device stays unhomed, without force.
  Result<DeviceInfo> add(const std::string& name, const std::function<bool()>& rests_there);
  void remove(std::size_t slot) noexcept;

  void set_command(std::size_t slot, const TouchCommand& command) noexcept { slots_[slot].commands.write(command); }
  [[nodiscard]] const Sample& sample(std::size_t slot) noexcept { return slots_[slot].samples.read(); }
  /// Performs one cycle of all devices; the vendor's scheduler calls it.
  void cycle() noexcept TANDEM_REALTIME;

 private:
  struct Slot {
    bool used = false;  ///< changed only while the scheduler is stopped
    Handle handle = kInvalidHandle;
    std::uint32_t calibration = 0;
    bool reset = false;  ///< the user had its encoders reset in this opening
    double force_max = 0;
    std::size_t motors = 0;  ///< number of motors with a temperature; 0: none
    Latest<TouchCommand> commands;
    Latest<Sample> samples;
    // Used by the callback only.
    Sample last;
    std::uint64_t command_number = 0;
    unsigned command_age = 0;
    unsigned warm = 0;  ///< remaining cycles for which a warm-motor report counts
  };
  void serve(Slot& slot) noexcept TANDEM_REALTIME;
  void home(Slot& slot, bool asked) noexcept;
  void feel_heat(Slot& slot) noexcept TANDEM_REALTIME;
  /// Removes all errors from the stack. Each is assigned to the device it names, otherwise to `current`.
  void take_errors(Slot& current) noexcept;
  void forget_errors() noexcept;
  [[nodiscard]] std::array<double, 3> force_for(Slot& slot, const TouchCommand& command) noexcept;
  void stop() noexcept;
  Result<> start();
  [[nodiscard]] std::optional<double> ask(std::uint32_t what) noexcept;
  /// Resets the encoders, as the vendor's example Calibration.c. Requires a stopped servo and the device as the current
  /// one.
  Result<> reset_encoders(const std::string& name);
  [[nodiscard]] Handle init(const std::string& name) noexcept {
    return api_->init_device(name.empty() ? nullptr : name.c_str());
  }
  [[nodiscard]] DeviceError trouble(const ErrorInfo& error, const std::string& name) const;

  const Api* api_;
  Clock* clock_;
  std::array<Slot, kMax> slots_;
  std::optional<unsigned long> scheduled_;
  std::atomic<bool> quiet_{false};  ///< zero force for all devices, whatever is commanded
  std::atomic<std::uint64_t> cycles_{0};
};

}  // namespace tandem::hal::openhaptics
