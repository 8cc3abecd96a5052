#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>

#include "common/base/axes.h"
#include "common/base/histogram.h"
#include "common/base/time.h"

/// Vocabulary of haptic devices: capabilities, readings, commands, errors and the device interfaces.
/// Units: SI. Frame of every device: right-handed, x right, y away from the user, z up; drivers convert to it.
/// Unknown numbers are empty `optional`s, never 0.
namespace tandem::hal {

/// Position, velocity or force in the HAL frame, 3x1.
using Vec3 = Eigen::Vector3d;
/// Jacobian of the tip, one column per joint. Tip velocity [m/s] = J * dq; joint effort = J^T * tip force [N].
using Jacobian = Eigen::Matrix<double, 3, static_cast<int>(kAxesMax)>;

/// Cause of a device error.
enum class Errc : std::uint8_t {
  kNotFound,
  kPermission,
  kBusy,
  kUnplugged,
  kTimeout,
  kFraming,
  kProtocol,
  kFirmware,
  kNotHomed,
  kLimit,
  kUnsupported,
  kLibraryMissing,
  kBadState,
  kInternal
};
/// Returns the name of a cause, such as `unplugged`.
[[nodiscard]] const char* to_string(Errc) noexcept;

/// Error of a device with text for the user.
struct DeviceError {
  Errc code = Errc::kInternal;  ///< cause for programs
  std::string message;          ///< cause and remedy, as text for the user
};
/// Value, or the error of a device.
template <class T = void>
using Result = std::expected<T, DeviceError>;

/// Source of a number about a device.
enum class Provenance : std::uint8_t { kUnknown, kDatasheet, kVendorQuery, kConfig, kModel };
/// Phase of a device, see Device.
enum class Phase : std::uint8_t { kAbsent, kOpening, kBooting, kIdentified, kUnhomed, kReady, kEnabled, kFault, kLost };
/// Clock of the exchanges: the reply to each command, the device's own rate, or the vendor's library.
enum class Timing : std::uint8_t { kLockStep, kFreeRunning, kVendor };
/// How a device finds its origin. kResetPose: the user puts the device into its reset pose and confirms this before the
/// servo starts.
enum class Homing : std::uint8_t { kNone, kManual, kPresetPose, kInkwell, kAuto, kResetPose };
/// Part that balances the weight of the device.
enum class GravityCompensation : std::uint8_t { kNone, kHost, kDevice };
/// Meaning of the readings: positions, or velocities of a joystick.
enum class InputKind : std::uint8_t { kPose, kRate };
/// Meaning of Command::effort.
enum class CommandKind : std::uint8_t { kNone, kJointEffort };

/// Identity of a device: its backend and a key that identifies the same hardware again.
struct DeviceId {
  std::string backend;  ///< name of the backend, such as `falcon`
  std::string key;      ///< serial number or port
};

/// Limits of one tip axis. Empty: unknown.
struct AxisLimit {
  std::optional<double> peak;              ///< [N] along this tip axis
  std::optional<double> continuous;        ///< [N]
  std::optional<double> resolution;        ///< [m]
  Provenance from = Provenance::kUnknown;  ///< source of these numbers
};

/// Weight and Coulomb friction of a device with the load at its tip, per joint. The weight acts as
///
///     tau_g,j = w_j J_zj
///
/// with the vertical part J_zj of the tip's Jacobian. This is exact for the links of a Touch, for a load at the tip of
/// any arm, and for vertical rails.
struct DeviceLoad {
  AxisArray weight{};    ///< w_j: weight at the tip that loads joint j as links and load do [N]
  AxisArray friction{};  ///< Coulomb friction c_j [N m] or [N]
};

/// Capabilities of a device. Immutable after open.
struct DeviceCaps {
  std::size_t joints = 0;              ///< sensed and actuated joints, <= kAxesMax
  std::size_t tip_axes = 0;            ///< number of axes along which the tip moves, 1..3: the first of x, y, z
  bool prismatic = false;              ///< joint units are [m] and [N] instead of [rad] and [N m]
  bool simulated = false;              ///< simulated: no operator is at risk, so delay studies may relax the force gate
  InputKind input = InputKind::kPose;  ///< meaning of the readings
  Timing timing = Timing::kFreeRunning;                      ///< clock of the exchanges
  Homing homing = Homing::kNone;                             ///< way in which the device finds its origin
  GravityCompensation gravity = GravityCompensation::kNone;  ///< part that balances its weight
  double nominal_hz = 1000.0;                                ///< rate of the exchanges [Hz]
  std::array<AxisLimit, 3> axis{};                           ///< limits per tip axis x, y, z
  std::optional<double> mass;                                ///< apparent mass at the tip [kg]
  std::optional<double> damping;  ///< physical damping at the tip, b_device [N s/m]; bounds the coupling stiffness
  /// Delay t_d from a reading to the force that answers it, without the hold of one tick [s]; bounds the coupling
  /// stiffness too.
  std::optional<double> latency;
  std::optional<DeviceLoad>
      load;  ///< calibrated part of weight and friction that motors do not balance; empty: not calibrated
  std::optional<double> stiffness;  ///< largest stiffness the manufacturer allows [N/m]
  /// Time-out after which the device itself switches its motors off.
  std::optional<std::chrono::milliseconds> watchdog;
  bool needs_firmware = false;  ///< the device gets its firmware at each start
  /// The motor directions come from a file written by the user. The guard allows no force until they are confirmed on
  /// this device.
  bool signs_from_file = false;
  bool force_calibrated = true;           ///< false: the force scale is a guess, and the guard uses a low ceiling
  std::array<double, 3> workspace_min{},  ///< lower corner of the tip's workspace [m]
      workspace_max{};                    ///< upper corner [m]; both 0: unknown
  unsigned buttons = 0,                   ///< number of buttons
      leds = 0;                           ///< number of lights
};

/// One reading of a device. Joint arrays are used up to `DeviceCaps::joints`.
struct State {
  std::uint64_t seq = 0;           ///< number of this reading
  std::uint64_t echo_command = 0;  ///< sequence number of the command in effect during this reading
  Time sampled_at{};               ///< time of the reading
  AxisArray q{};                   ///< [rad] or [m]
  AxisArray dq{};                  ///< estimate [rad/s] or [m/s]
  Vec3 x = Vec3::Zero();           ///< tip [m]
  Vec3 dx = Vec3::Zero();          ///< tip [m/s]
  Jacobian J = Jacobian::Zero();   ///< at q
  AxisArray tau_out{};  ///< joint effort the motors delivered during the last period, without compensation [N m] or [N]
  Vec3 f_out = Vec3::Zero();  ///< the same at the tip [N]
  Vec3 f_env = Vec3::Zero();  ///< force of the environment on the tip, where known (simulated slaves) [N]
  double penetration = 0;     ///< depth of the tip in the environment, where known [m]
  std::array<std::int32_t, kAxesMax> raw{};     ///< encoder counts from the device, unwrapped
  unsigned buttons = 0;                         ///< bit mask, 1 = pressed
  std::optional<std::uint8_t> battery_percent;  ///< 0..100; empty: the device has no battery or reported nothing
  /// Temperature of the hottest motor as a share of its limit, from the device or its vendor library; 1: too hot.
  /// Empty: not measured. NaN: the device reports temperatures, but this one is unknown.
  std::optional<double> heat;
  bool stale = false;      ///< no new reading arrived in time: values are held or decay
  bool resynced = false;   ///< positions may have jumped since the previous reading
  bool homed = true;       ///< the origin is known
  bool saturated = false;  ///< the last command exceeded the motors' limit
};

/// Command to a device, valid until the next command or until `expires`, whichever is first.
/// There is no command without expiry: a client sets `expires` to its time plus `command_lifetime` of its ticks.
/// Motors of hardware devices obey a command for at most `kCommandLifetimeMax` (common/base/command_lifetime.h).
struct Command {
  std::uint64_t seq = 0;                  ///< number of the command
  Time expires{};                         ///< time from which on the effort fades to zero
  CommandKind kind = CommandKind::kNone;  ///< kNone: the effort is ignored and counts as zero
  AxisArray effort{};                     ///< joint effort [N m] or [N]
};

/// Client of a device's servo, called once per exchange on the device's own thread.
struct ServoClient {
  virtual ~ServoClient() = default;
  /// Takes a new reading and returns the command that answers it. Real-time.
  virtual Command tick(const State&) noexcept = 0;
  /// Returns by how much the next exchange shall begin later than one period after this one; negative: earlier. Called
  /// once after each tick, on the same thread. A servo that a timer of this machine paces follows by at most 1 % of
  /// its period; a device with a clock of its own cannot.
  [[nodiscard]] virtual Duration next_shift() noexcept { return {}; }
  /// Reports that the device is gone; no further tick follows.
  virtual void lost(Errc) noexcept = 0;
};

/// Statistics of a device since `start()`.
struct DeviceStats {
  std::uint64_t ticks = 0;       ///< exchanges
  std::uint64_t late = 0;        ///< exchanges that began more than 1 ms late
  std::uint64_t missed = 0;      ///< periods without an exchange
  std::uint64_t expired = 0;     ///< commands that expired
  std::uint64_t rejected = 0;    ///< commands with a non-finite effort
  std::uint64_t resyncs = 0;     ///< exchanges that had to resynchronise to a frame start
  std::uint64_t unanswered = 0;  ///< exchanges without a complete reply in time
  std::uint64_t clamped = 0;     ///< commands that the guard reduced
  double round_trip_p50_s = 0,   ///< median duration of an exchange [s]
      round_trip_p99_s = 0,      ///< its 99th percentile [s]
      round_trip_max_s = 0;      ///< longest exchange [s]
  double period_p50_s = 0,       ///< median time between the starts of two exchanges [s]
      period_p99_s = 0,          ///< its 99th percentile [s]
      period_max_s = 0;          ///< longest period [s]
};

/// Histograms of durations [ns]. Empty where the duration does not apply: a simulated device has no exchange.
struct DeviceHistograms {
  Histogram period;      ///< from the start of one exchange to the next
  Histogram round_trip;  ///< duration of one exchange
};

/// A device with its own servo thread.
/// Phases: Absent -> Opening -> ... -> Ready (zero force) -> Enabled -> {Fault, Lost}. A Lost device is never enabled
/// again.
struct Device {
  virtual ~Device() = default;
  /// Returns the capabilities.
  [[nodiscard]] virtual const DeviceCaps& caps() const noexcept = 0;
  /// Returns the identity.
  [[nodiscard]] virtual const DeviceId& id() const noexcept = 0;
  /// Returns the present phase.
  [[nodiscard]] virtual Phase phase() const noexcept = 0;
  /// Starts the servo with zero force. The servo calls `client` until `close()`.
  virtual Result<> start(ServoClient& client) = 0;
  /// Lets commands reach the motors. Allowed only in Ready.
  virtual Result<> enable() = 0;
  /// Keeps commands from the motors: Enabled -> Ready.
  virtual void disable() noexcept = 0;
  /// Leaves Fault after its cause is gone.
  virtual Result<> reset() = 0;
  /// Returns the statistics so far.
  [[nodiscard]] virtual DeviceStats stats() const = 0;
  /// Histograms since `start()`; empty before `close()` has returned.
  [[nodiscard]] virtual DeviceHistograms histograms() const { return {}; }
  /// Returns whether the kernel granted real-time priority to the servo thread.
  [[nodiscard]] virtual bool realtime() const noexcept { return false; }
  /// Ends the servo with zero force.
  virtual void close() noexcept = 0;
};

/// A device without a thread: its owner advances its time. Simulated devices implement this; live use wraps them in a
/// Device.
struct SteppedDevice {
  virtual ~SteppedDevice() = default;
  /// Returns the capabilities.
  [[nodiscard]] virtual const DeviceCaps& caps() const noexcept = 0;
  /// Returns the reading at the present instant.
  [[nodiscard]] virtual const State& state() const noexcept = 0;
  /// Applies `command` for `dt` and advances the device by `dt`. Real-time safe; a non-finite effort counts as zero.
  virtual void advance(const Command& command, Duration dt) noexcept TANDEM_REALTIME = 0;
};

}  // namespace tandem::hal
