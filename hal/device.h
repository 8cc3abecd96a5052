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

/// What Tandem knows of a haptic device, whatever its maker. SI units; frame of every device: right-handed, x right,
/// y away from the user, z up; drivers convert. Missing numbers are `optional`, never 0.
namespace tandem::hal {

using Vec3 = Eigen::Vector3d;
/// Columns: joints. Tip velocity [m/s] = J * dq; joint effort = J^T * tip force [N].
using Jacobian = Eigen::Matrix<double, 3, static_cast<int>(kAxesMax)>;

enum class Errc : std::uint8_t {
  kNotFound, kPermission, kBusy, kUnplugged, kTimeout, kFraming, kProtocol, kFirmware, kNotHomed, kLimit,
  kUnsupported, kLibraryMissing, kBadState, kInternal
};
[[nodiscard]] const char* to_string(Errc) noexcept;

struct DeviceError {
  Errc code = Errc::kInternal;
  std::string message;  ///< cause and remedy, for a person
};
template <class T = void>
using Result = std::expected<T, DeviceError>;

enum class Provenance : std::uint8_t { kUnknown, kDatasheet, kVendorQuery, kConfig, kModel };
enum class Phase : std::uint8_t { kAbsent, kOpening, kBooting, kIdentified, kUnhomed, kReady, kEnabled, kFault, kLost };
enum class Timing : std::uint8_t { kLockStep, kFreeRunning, kVendor };
/// kResetPose: a person puts the device into its reset pose and says so before its servo starts.
enum class Homing : std::uint8_t { kNone, kManual, kPresetPose, kInkwell, kAuto, kResetPose };
enum class GravityCompensation : std::uint8_t { kNone, kHost, kDevice };
enum class InputKind : std::uint8_t { kPose, kRate };
enum class CommandKind : std::uint8_t { kNone, kJointEffort };

/// Backend and the key under which the same hardware is found again.
struct DeviceId {
  std::string backend;
  std::string key;
};

struct AxisLimit {
  std::optional<double> peak;        ///< [N] along this tip axis
  std::optional<double> continuous;  ///< [N]
  std::optional<double> resolution;  ///< [m]
  Provenance from = Provenance::kUnknown;
};

/// Immutable after open.
struct DeviceCaps {
  std::size_t joints = 0;           ///< sensed and actuated joints, <= kAxesMax
  std::size_t tip_axes = 0;         ///< 1..3: how many of x, y, z the tip can move along
  bool prismatic = false;           ///< joints are [m] and [N] instead of [rad] and [N m]
  bool simulated = false;           ///< no hand can be hurt: delay studies may relax the gate
  InputKind input = InputKind::kPose;
  Timing timing = Timing::kFreeRunning;
  Homing homing = Homing::kNone;
  GravityCompensation gravity = GravityCompensation::kNone;
  double nominal_hz = 1000.0;
  std::array<AxisLimit, 3> axis{};
  std::optional<double> mass;       ///< apparent mass at the tip [kg]
  std::optional<double> damping;    ///< physical damping at the tip b_device [N s/m], bounds the coupling stiffness
  std::optional<double> latency;    ///< t_d from a reading to the force that answers it, beside the hold of one tick [s]; bounds it too
  std::optional<double> stiffness;  ///< largest stiffness the maker allows [N/m]
  std::optional<std::chrono::milliseconds> watchdog;  ///< after which the device itself lets go of its motors
  bool needs_firmware = false;
  /// The directions of its motors come from a file that a person wrote: no force before they were confirmed on this very device.
  bool signs_from_file = false;
  bool force_calibrated = true;  ///< false: its force scale is a guess, and its guard keeps to a small ceiling
  std::array<double, 3> workspace_min{}, workspace_max{};  ///< box of the tip [m]; both 0: not known
  unsigned buttons = 0, leds = 0;
};

/// One reading. Joint arrays are used up to `DeviceCaps::joints`.
struct State {
  std::uint64_t seq = 0;
  std::uint64_t echo_command = 0;  ///< sequence of the command that was acting during this reading
  Time sampled_at{};
  AxisArray q{};                   ///< [rad] or [m]
  AxisArray dq{};                  ///< estimate [rad/s] or [m/s]
  Vec3 x = Vec3::Zero();           ///< tip [m]
  Vec3 dx = Vec3::Zero();          ///< tip [m/s]
  Jacobian J = Jacobian::Zero();   ///< at q
  AxisArray tau_out{};             ///< joint effort the motors really gave during the last period, without compensation
  Vec3 f_out = Vec3::Zero();       ///< the same at the tip [N]
  Vec3 f_env = Vec3::Zero();       ///< force of the environment on the tip, where known (simulated slaves) [N]
  double penetration = 0;          ///< depth of the tip in the environment, where known [m]
  std::array<std::int32_t, kAxesMax> raw{};  ///< encoder counts as the device sent them, unwrapped
  unsigned buttons = 0;            ///< bit mask, 1 = pressed
  std::optional<std::uint8_t> battery_percent;  ///< 0..100; only devices that have one and told it
  /// Of the hottest motor, as the device or its maker's library tells it: share of what it may have, 1 is too hot. Empty: not known;
  /// no number: told, and not known.
  std::optional<double> heat;
  bool stale = false;              ///< nothing new came lately: values are held or decay
  bool resynced = false;           ///< positions may have jumped since the reading before
  bool homed = true;
  bool saturated = false;          ///< the last command was beyond the motors
};

/// What the device shall do until the next command or until `expires`, whichever is first. There is no "set and forget": a client sets
/// `expires` to its time plus `command_life` of its ticks, and real motors never obey longer than `kCommandLifeMax` (common/base/command_life.h).
struct Command {
  std::uint64_t seq = 0;
  Time expires{};
  CommandKind kind = CommandKind::kNone;
  AxisArray effort{};  ///< joint effort [N m] or [N]
};

/// Who is served by a device: called once per exchange on the device's own thread.
struct ServoClient {
  virtual ~ServoClient() = default;
  virtual Command tick(const State&) noexcept = 0;
  virtual void lost(Errc) noexcept = 0;
};

struct DeviceStats {
  std::uint64_t ticks = 0;
  std::uint64_t late = 0;          ///< exchanges that began more than 1 ms after their time
  std::uint64_t missed = 0;        ///< periods skipped altogether
  std::uint64_t expired = 0;       ///< commands that died of age
  std::uint64_t rejected = 0;      ///< commands with a non-finite effort
  std::uint64_t resyncs = 0;       ///< exchanges that had to find the beginning of a frame again
  std::uint64_t unanswered = 0;    ///< exchanges without a whole answer in time
  std::uint64_t clamped = 0;       ///< commands that the guard made smaller
  double round_trip_p50_s = 0, round_trip_p99_s = 0, round_trip_max_s = 0;
  double period_p50_s = 0, period_p99_s = 0, period_max_s = 0;
};

/// How often each duration came [ns]. Empty where nothing of the kind happens: a simulated device exchanges nothing.
struct DeviceHistograms {
  Histogram period;      ///< from one exchange to the next
  Histogram round_trip;  ///< of one exchange
};

/// A device with a thread of its own.
/// Absent -> Opening -> ... -> Ready (zero force) -> Enabled -> {Fault, Lost}; Lost never enables itself again.
struct Device {
  virtual ~Device() = default;
  [[nodiscard]] virtual const DeviceCaps& caps() const noexcept = 0;
  [[nodiscard]] virtual const DeviceId& id() const noexcept = 0;
  [[nodiscard]] virtual Phase phase() const noexcept = 0;
  /// Starts the servo with zero force; `client` is called until `close()`.
  virtual Result<> start(ServoClient& client) = 0;
  /// Lets commands through. Only from Ready.
  virtual Result<> enable() = 0;
  virtual void disable() noexcept = 0;
  virtual Result<> reset() = 0;
  [[nodiscard]] virtual DeviceStats stats() const = 0;
  /// Of its whole life; empty before `close()` has returned.
  [[nodiscard]] virtual DeviceHistograms histograms() const { return {}; }
  /// Whether the kernel granted its thread real-time priority.
  [[nodiscard]] virtual bool realtime() const noexcept { return false; }
  virtual void close() noexcept = 0;
};

/// A device without a thread: whoever owns it moves its time. Simulated devices are this, wrapped by a Device when live.
struct SteppedDevice {
  virtual ~SteppedDevice() = default;
  [[nodiscard]] virtual const DeviceCaps& caps() const noexcept = 0;
  /// The reading at the present instant.
  [[nodiscard]] virtual const State& state() const noexcept = 0;
  /// Holds `command` for `dt` and moves there. Real-time safe; a non-finite effort counts as zero.
  virtual void advance(const Command& command, Duration dt) noexcept TANDEM_REALTIME = 0;
};

}  // namespace tandem::hal
