#include "hal/drivers/woodenhaptics/woodenhaptics_driver.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hal/core/port_map.h"
#include "hal/drivers/woodenhaptics/woodenhaptics_caps.h"

namespace tandem::hal::woodenhaptics {
namespace {

using std::chrono::milliseconds;

/// Longest wait for a report. Lock-step: the host's frame and the board's reply take one USB frame each. Free-running:
/// the board sends every millisecond.
constexpr Duration kReplyLockStep = std::chrono::microseconds{2000},
                   kReplyFreeRunning = std::chrono::microseconds{1500};
constexpr int kReportsMax = 80;  ///< reports read per call; a hidraw queue holds 64
constexpr int kAttempts = 20;
constexpr int kPresetFrames = 20;
constexpr int kPresetTolerance = 100;  ///< the user's hand may move the arm while its counters are preset [counts]
/// Least time between two readings. A shorter interval is an artefact: the host stalled between them.
constexpr Duration kApart = std::chrono::microseconds{750};
/// Largest drum speed by a hand [rad/s], and largest error of one reading [rad].
constexpr double kSpeedMax = 60.0, kJump = 0.05;

bool has_effort(const ServoCommand& command) noexcept {
  return std::any_of(command.effort.begin(), command.effort.begin() + 3, [](double e) { return e != 0.0; });
}

}  // namespace

WoodenHapticsDriver::WoodenHapticsDriver(DeviceId id, HidPipe& pipe, Clock& clock, const WoodenHapticsOptions& options)
    : id_(std::move(id)),
      caps_(caps_of(options.spec)),
      pipe_(pipe),
      clock_(clock),
      options_(options),
      kinematics_(options.spec),
      motors_(options.spec),
      reply_timeout_(has_presets(options.spec.protocol) ? kReplyLockStep : kReplyFreeRunning) {
  for (int i = 0; i < 3; ++i)
    rates_[static_cast<std::size_t>(i)] = AdaptiveVelocityEstimator(kinematics_.angle_per_count()[i], kApart);
}

Result<> WoodenHapticsDriver::bring_up(BringUp& watcher) {
  homed_ = false;
  presets_left_ = 0;
  gravity_.restart();
  acting_ = Vec3::Zero();
  acted_.restart(clock_.now());
  if (!kinematics_.inverse(Vec3::Zero())) {
    return std::unexpected(DeviceError{Errc::kLimit,
                                       "the preset puts the workspace's origin out of the arm's reach: "
                                       "check link_mm and origin_mm"});
  }
  // Queued reports are from before the start. Any frame of the host activates the amplifiers, so the first one must be
  // a zero frame.
  bool torn = false;
  Taken taken;
  Taken before;
  if (const auto ok = take_reports(Duration{0}, before); !ok && ok.error() != Errc::kFraming) {
    return std::unexpected(DeviceError{ok.error(), "the board cannot be read"});
  }
  for (int attempt = 0; attempt < kAttempts && !taken.newest; ++attempt) {
    watcher.progress("waiting for the board's first report", static_cast<double>(attempt) / kAttempts);
    if (watcher.cancelled()) return std::unexpected(DeviceError{Errc::kBadState, "given up"});
    for (const bool write : {true, false}) {
      const auto ok = write ? send({}) : take_reports(milliseconds{10}, taken);
      if (!ok && ok.error() != Errc::kTimeout && ok.error() != Errc::kFraming) {
        return std::unexpected(
            DeviceError{ok.error(), std::string("the board stopped answering: ") + to_string(ok.error())});
      }
      torn = torn || taken.torn;
    }
  }
  if (!taken.newest) return std::unexpected(silent_board(torn || before.torn, odd_length_));
  settle_at(*taken.newest, false);
  if (std::exchange(options_.home_at_start, false)) preset_counters(true);
  home_requested_.store(false);
  watcher.progress("waiting for the board's first report", 1.0);
  return {};
}

DeviceError WoodenHapticsDriver::silent_board(bool torn, std::size_t length) const {
  if (!torn) {
    return {Errc::kTimeout,
            "the board is silent: check its power, and that it is a WoodenHaptics board (its USB id is used by other "
            "devices too)"};
  }
  std::string message = "the board sends reports of " + std::to_string(length) + " bytes, the preset expects " +
                        std::to_string(report_size(options_.spec.protocol));
  for (const auto& [protocol, name] : {std::pair{WoodenProtocol::kV1, "V1"}, std::pair{WoodenProtocol::kV2, "V2"},
                                       std::pair{WoodenProtocol::kRaw64, "RAW64"}}) {
    if (report_size(protocol) == length) message += std::string(": write protocol: ") + name;
  }
  return {Errc::kProtocol, message};
}

std::expected<Exchange, Errc> WoodenHapticsDriver::exchange(const ServoCommand& command, State& state) noexcept {
  const Time now = clock_.now();
  if (home_requested_.exchange(false) && !has_effort(command)) preset_counters(true);
  if (!homed_ && latched_ && presets_left_ == 0) preset_counters(button_armed_);
  const bool presetting = presets_left_ > 0 && has_presets(options_.spec.protocol);
  MotorCommand motors;
  if (!presetting) motors = motors_for(command, now);

  Taken taken;  // late or unprompted reports
  auto trouble = take_reports(Duration{0}, taken);
  if (!trouble) return std::unexpected(trouble.error());
  if (trouble = send(presetting ? preset_command() : BoardCommand{.current_ma = motors.current_ma}); !trouble) {
    return std::unexpected(trouble.error());
  }
  const Vec3 acted = acting_;
  const std::uint64_t acted_seq = std::exchange(acting_seq_, command.seq);
  acting_ = motors.effort;
  saturated_ = motors.saturated;
  sent_at_ = now;
  const Time left = clock_.now();
  acted_.add(acted, left);
  // The next report is awaited also from a board that sends unprompted. A queued report is up to a period old, and its
  // force would act yet another period later.
  // A spring with this delay feeds energy into an arm that is not held.
  // A host that is already late uses the queued report, because hidapi waits in whole milliseconds.
  const Duration until_due = pace_.next(now) - left > ReplyDeadline::kPeriod / 2 ? ReplyDeadline::kPeriod : Duration{0};
  const bool by_itself = !has_presets(options_.spec.protocol);
  const auto old = std::exchange(taken.newest, std::nullopt);
  if (trouble = take_reports(old && by_itself ? until_due : reply_timeout_, taken); !trouble)
    return std::unexpected(trouble.error());
  // A board that replies samples on arrival of the command; one that sends unprompted samples after the command has
  // acted for a while.
  const Time at = taken.newest ? clock_.now() : left;
  if (taken.newest && by_itself) acted_.add(acting_, at);
  if (!taken.newest) taken.newest = old;
  if (!taken.newest) {
    if (taken.torn) return std::unexpected(Errc::kFraming);
    return Exchange::kNothing;
  }
  const bool jumped = follow(*taken.newest, at);
  state.echo_command = acted_seq;
  fill(*taken.newest, at, jumped, state);
  return jumped || taken.torn ? Exchange::kResynced : Exchange::kFresh;
}

MotorCommand WoodenHapticsDriver::motors_for(const ServoCommand& command, Time now) noexcept {
  const bool wanted = has_effort(command);
  if (!homed_ || !options_.enable_motors || command.homing) {
    gravity_.release();
    MotorCommand none;
    none.saturated = wanted;
    return none;
  }
  const double share = options_.spec.gravity ? gravity_.update(now, wanted, now - sent_at_) : 0.0;
  const Vec3 effort(command.effort[0], command.effort[1], command.effort[2]);
  return motors_.to_command(effort, share * kinematics_.holding_effort(q_));
}

void WoodenHapticsDriver::preset_counters(bool then_homed) noexcept {
  homed_ = false;
  homed_by_preset_ = then_homed;
  presets_left_ = kPresetFrames;
}

void WoodenHapticsDriver::continue_homing(const BoardReport& report) noexcept {
  const auto& pose = options_.spec.calibration_counts;
  if (!has_presets(options_.spec.protocol)) {
    presets_left_ = 0;
    settle_at(report, true);
    for (std::size_t i = 0; i < 3; ++i) counters_[i].set(pose[i], report.counts[i]);
    return;
  }
  --presets_left_;
  bool there = !report.calibration_pressed;
  for (std::size_t i = 0; i < 3; ++i) {
    there = there && std::abs(UnwrappedCounter::difference(report.counts[i], pose[i])) <= kPresetTolerance;
  }
  if (there) presets_left_ = 0;
  there = there && homed_by_preset_;
  // The total starts near the preset value, on the same side of the counter's wrap.
  settle_at(report, there);
  for (std::size_t i = 0; i < 3 && there; ++i) {
    counters_[i].set(pose[i] + UnwrappedCounter::difference(report.counts[i], pose[i]), report.counts[i]);
  }
}

void WoodenHapticsDriver::settle_at(const BoardReport& report, bool home) noexcept {
  for (std::size_t i = 0; i < kEncoders; ++i) counters_[i].set(report.counts[i], report.counts[i]);
  for (auto& rate : rates_) rate.restart();
  homed_ = home;
  button_armed_ = false;
  note_button(report);
  read_at_ = clock_.now();
}

void WoodenHapticsDriver::note_button(const BoardReport& report) noexcept {
  latched_ = report.calibration_pressed;
  button_armed_ = !homed_ && (button_armed_ || !latched_);
}

bool WoodenHapticsDriver::follow(const BoardReport& report, Time at) noexcept {
  if (presets_left_ > 0) {
    continue_homing(report);
    return true;
  }
  const double reach = kJump + kSpeedMax * seconds(at - read_at_);
  bool jumped = false;
  for (std::size_t i = 0; i < kEncoders; ++i) {
    const int moved = counters_[i].take(report.counts[i]);
    jumped = jumped || (i < 3 && std::abs(moved * kinematics_.angle_per_count()[static_cast<int>(i)]) > reach);
  }
  if (jumped) settle_at(report, false);  // the board lost power, or the counter lost its reference
  note_button(report);
  read_at_ = at;
  return jumped;
}

void WoodenHapticsDriver::fill(const BoardReport& report, Time at, bool jumped, State& state) noexcept {
  q_ = kinematics_.angles({counters_[0].total(), counters_[1].total(), counters_[2].total()});
  const Eigen::Matrix3d j = kinematics_.jacobian(q_);
  const Vec3 tau = acted_.take(acting_);
  Vec3 dq;
  state.seq = ++readings_;
  state.sampled_at = at;
  state.J.setZero();
  state.J.leftCols<3>() = j;
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = static_cast<int>(i);
    state.q[i] = q_[k];
    state.dq[i] = dq[k] = rates_[i].update(at, q_[k]);
    state.tau_out[i] = tau[k];
  }
  for (std::size_t i = 0; i < kEncoders; ++i) state.raw[i] = counters_[i].total();
  state.x = kinematics_.tip(q_);
  state.dx = j * dq;
  state.f_out = solve_tip_force(state.J, state.tau_out, 3);
  state.buttons = (report.stylus_pressed ? 1u : 0u) | (report.calibration_pressed ? 2u : 0u);
  state.stale = false;
  state.resynced = jumped;
  state.homed = homed_;
  state.saturated = saturated_;
}

std::expected<void, Errc> WoodenHapticsDriver::take_reports(Duration timeout, Taken& taken) noexcept {
  const Time until = clock_.now() + timeout;
  std::array<std::byte, kReportMax + 1> bytes;
  bool got = false;
  for (int i = 0; i < kReportsMax; ++i) {
    const Duration left = got ? Duration{0} : std::max(until - clock_.now(), Duration{0});
    const Moved moved = pipe_.read(bytes, left);
    if (!moved) return std::unexpected(moved.error());
    if (*moved == 0) return {};
    const auto report = parse_report(options_.spec.protocol, options_.spec.stylus_on_encoder_d,
                                     std::span(bytes).first(std::min(*moved, bytes.size())));
    if (!report) {
      taken.torn = true;
      odd_length_ = *moved;
      continue;
    }
    taken.newest = *report;
    got = true;
  }
  return {};
}

std::expected<void, Errc> WoodenHapticsDriver::send(const BoardCommand& command) noexcept {
  std::array<std::byte, kReportMax> bytes;
  const std::size_t size = write_command(options_.spec.protocol, command, bytes);
  const Moved moved = pipe_.write(std::span(bytes).first(size));
  if (!moved) return std::unexpected(moved.error());
  return {};
}

BoardCommand WoodenHapticsDriver::preset_command() const noexcept {
  BoardCommand command{.preset = true};
  std::ranges::copy(options_.spec.calibration_counts, command.counts.begin());
  return command;
}

void WoodenHapticsDriver::send_zeros() noexcept {
  gravity_.restart();
  for (int i = 0; i < 3; ++i) {
    if (const auto ok = send({}); !ok && ok.error() == Errc::kUnplugged) break;
  }
  acting_ = Vec3::Zero();
  saturated_ = false;
}

}  // namespace tandem::hal::woodenhaptics
