#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "hal/clock.h"
#include "hal/device.h"
#include "hal/openhaptics/hd_api.h"
#include "hal/openhaptics/latest.h"

namespace tandem::hal::openhaptics {

/// What the vendor's servo cycle found of one device.
struct Sample {
  std::uint64_t cycle = 0;      ///< counts up; 0: nothing yet
  std::uint64_t order = 0;      ///< sequence of the order behind `force`
  std::array<double, 3> x{}, v{};  ///< HAL frame [m], [m/s]
  std::array<double, 3> force{};   ///< set in this cycle, HAL frame [N]
  std::array<std::int32_t, 3> encoders{};
  std::uint32_t buttons = 0;
  bool homed = false;
  bool limited = false;         ///< the library or our own clamp made the force smaller, or took it away
  bool lost = false;            ///< it does not answer any more; nothing touches its handle again
  std::optional<double> heat{};  ///< of the hottest motor, 1: too hot; empty: not known
  std::uint32_t error = 0;      ///< newest error of this device, 0: none in this cycle
};

/// What one device's motors shall do from the next cycle on.
struct Order {
  std::uint64_t number = 0;     ///< of this order: a cycle that sees the same for too long lets go
  std::uint64_t seq = 0;
  std::array<double, 3> force{};  ///< HAL frame [N]
  bool homing = false;
};

/// All devices of the vendor's library in this process: it has one scheduler, so there is one callback with a frame for each device.
/// The callback runs on the vendor's thread; it takes the newest order of each device, never waits, and lets go of a device
/// whose orders stopped coming. `add`, `remove`: from one ordinary thread at a time; while they work all forces are zero.
class TouchGroup {
 public:
  static constexpr std::size_t kMax = 4;
  static constexpr unsigned kOrderCycles = 10;  ///< an order is obeyed this long

  /// @param api    all of it filled in; must outlive this, as must `clock`
  TouchGroup(const Api& api, Clock& clock) noexcept : api_(&api), clock_(&clock) {}
  ~TouchGroup();
  TouchGroup(const TouchGroup&) = delete;
  TouchGroup& operator=(const TouchGroup&) = delete;

  /// What the device says of itself.
  struct About {
    std::size_t slot = 0;
    std::string model, serial, version;
    std::uint32_t calibration = 0;             ///< styles, a bit each
    std::size_t motors = 0;                    ///< with a temperature
    std::optional<double> force_max, force_continuous;  ///< [N]
    std::optional<std::array<double, 6>> workspace;     ///< HAL frame, min xyz, max xyz [m]
  };
  /// Initialises the device of that name in the vendor's set-up tool, and has it served. Error: cause and remedy.
  /// @param name        empty: the default device
  /// @param rests_there  asked once, before the servo starts, of a device that knows where it is only by a reset of its encoders: whether
  ///                    a person put it into its reset pose and says so. Only then are they reset; else it stays unhomed, without force.
  Result<About> add(const std::string& name, const std::function<bool()>& rests_there);
  void remove(std::size_t slot) noexcept;

  void order(std::size_t slot, const Order& order) noexcept { slots_[slot].orders.write(order); }
  [[nodiscard]] const Sample& sample(std::size_t slot) noexcept { return slots_[slot].samples.read(); }
  /// One cycle of all devices; the vendor's scheduler calls it.
  void cycle() noexcept TANDEM_REALTIME;

 private:
  struct Slot {
    bool used = false;  ///< changed only while the scheduler stands
    Handle handle = kInvalidHandle;
    std::uint32_t calibration = 0;
    bool reset = false;          ///< a person had its encoders reset, in this opening
    double force_max = 0;
    std::size_t motors = 0;      ///< whose temperature the library tells; 0: it does not
    Latest<Order> orders;
    Latest<Sample> samples;
    // Of the callback.
    Sample last;
    std::uint64_t order_number = 0;
    unsigned order_age = 0;
    unsigned warm = 0;  ///< cycles in which the library's word that motors are warm still counts
  };
  void serve(Slot& slot) noexcept TANDEM_REALTIME;
  void home(Slot& slot, bool asked) noexcept;
  void feel_heat(Slot& slot) noexcept TANDEM_REALTIME;
  /// Takes all errors off the stack, each told to the device it names, else to `current`.
  void take_errors(Slot& current) noexcept;
  void forget_errors() noexcept;
  [[nodiscard]] std::array<double, 3> force_for(Slot& slot, const Order& order) noexcept;
  void stop() noexcept;
  Result<> start();
  [[nodiscard]] std::optional<double> ask(std::uint32_t what) noexcept;
  /// As the vendor's example Calibration.c: with the servo standing, the device being the current one.
  Result<> reset_encoders(const std::string& name);
  [[nodiscard]] Handle init(const std::string& name) noexcept { return api_->init_device(name.empty() ? nullptr : name.c_str()); }
  [[nodiscard]] DeviceError trouble(const ErrorInfo& error, const std::string& name) const;

  const Api* api_;
  Clock* clock_;
  std::array<Slot, kMax> slots_;
  std::optional<unsigned long> scheduled_;
  std::atomic<bool> quiet_{false};          ///< zeros for all, whatever is ordered
  std::atomic<std::uint64_t> cycles_{0};
};

}  // namespace tandem::hal::openhaptics
