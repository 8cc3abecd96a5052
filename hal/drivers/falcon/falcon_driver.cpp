#include "hal/drivers/falcon/falcon_driver.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "hal/drivers/falcon/falcon_ftdi.h"

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

constexpr Duration kWriteWait = 2ms;
constexpr Duration kReplyWait = 2ms;  // 0.3 ms transfer, up to 1 ms until the bridge flushes
constexpr int kPacketsMax = 16;       // per exchange; an idle bridge sends one empty packet per millisecond
constexpr int kSilenceFrames = 4;
constexpr Duration kStoodStill =
    20ms;  // stall: the program was stopped or starved, the watchdog sent frames, and their replies are queued
constexpr double kRateTime = 0.004;  // time constant of the speed estimate [s]; one count per reading is 0.6 rad/s
constexpr double kRateMin = 1e-6;    // [rad/s]
constexpr double kJump = 300 * kFalconRadPerCount;  // 11 degrees [rad]: more than a hand moves a leg in a millisecond

FalconFlagBits bits_of(const FalconFlags& f) { return {.homing = f.homing, .light = {f.green, f.blue, f.red}}; }

/// Returns the capabilities, computed at the origin of the workspace.
DeviceCaps caps_of(const FalconSpec& spec, const FalconForce& force) {
  DeviceCaps caps;
  caps.joints = 3;
  caps.tip_axes = 3;
  caps.timing = Timing::kLockStep;
  caps.homing = Homing::kManual;
  caps.needs_firmware = true;
  caps.force_calibrated = force.calibrated();
  caps.buttons = 4;
  caps.leds = 3;
  caps.mass = spec.mass;
  caps.damping = spec.damping;
  caps.latency = spec.latency;
  caps.stiffness = spec.stiffness;
  caps.workspace_min = {-kFalconSide, -kFalconDepth, -kFalconSide};
  caps.workspace_max = {kFalconSide, kFalconDepth, kFalconSide};
  const auto pose = falcon_pose_at(Vec3::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    AxisLimit& limit = caps.axis[static_cast<std::size_t>(axis)];
    limit.resolution = pose->J.row(axis).norm() * kFalconRadPerCount;
    double peak = std::numeric_limits<double>::infinity();
    for (int leg = 0; leg < 3; ++leg) {
      // Peak of the motors, without the ceiling of an uncalibrated device: the guard applies its own share to it.
      const double torque = kFalconMotorMax / force.counts_per_nm()[static_cast<std::size_t>(leg)];
      peak = std::min(peak, torque / std::abs(pose->J(axis, leg)));
    }
    limit.peak = std::min(peak, spec.peak.value_or(peak));
    limit.continuous = spec.continuous;
    limit.from = force.calibrated() ? Provenance::kConfig : Provenance::kUnknown;
  }
  return caps;
}

}  // namespace

std::expected<FalconDriver, std::string> FalconDriver::make(DeviceId id, UsbPipe& pipe, Clock& clock,
                                                            FalconOptions options) {
  const auto force = FalconForce::from(options.spec);
  if (!force) return std::unexpected(force.error().text);
  return FalconDriver(std::move(id), pipe, clock, std::move(options), *force);
}

FalconDriver::FalconDriver(DeviceId id, UsbPipe& pipe, Clock& clock, FalconOptions options, const FalconForce& force)
    : id_(std::move(id)),
      pipe_(&pipe),
      clock_(&clock),
      options_(std::move(options)),
      force_(force),
      bits_(bits_of(options_.spec.flags)),
      caps_(caps_of(options_.spec, force)) {}

Result<> FalconDriver::bring_up(BringUp& watcher) {
  boot_attempts_ = 0;
  framer_.clear();
  homing_.begin();
  pose_.reset();
  jumped_ = true;
  acting_ = sent_ = {};
  const auto unplugged = [] { return std::unexpected(DeviceError{Errc::kUnplugged, "the Falcon was unplugged"}); };

  FalconBoot boot(*pipe_, *clock_, watcher);
  if (!reload_) {
    watcher.progress("looking for running firmware", 0);
    const auto running = boot.probe();
    if (!running && running.error() == Errc::kUnplugged) return unplugged();
    if (!running && running.error() == Errc::kProtocol) {
      const auto cleared = pipe_->clear_halt();
      if (!cleared && cleared.error() == Errc::kUnplugged) return unplugged();
    } else if (!running && running.error() != Errc::kTimeout) {
      return std::unexpected(DeviceError{running.error(), "the Falcon's USB interface cannot be used"});
    }
    if (watcher.cancelled()) return std::unexpected(DeviceError{Errc::kBadState, "cancelled"});
    if (running && *running) return first_reading(**running), Result<>{};
  }
  if (!options_.firmware) {
    return std::unexpected(DeviceError{
        Errc::kFirmware,
        std::string(reload_
                        ? "the Falcon's encoders did not change while it was homed: its firmware must be loaded again"
                        : "the Falcon has no firmware: it loses the firmware without power") +
            ". It is Novint's and may not be shipped with other programs: take it from the vendor's driver and give it "
            "as "
            "firmware=FILE"});
  }
  if (auto good = check_firmware(*options_.firmware, options_.spec.firmware_sha256); !good) return good;
  const auto loaded = boot.load(*options_.firmware);
  boot_attempts_ = boot.attempts();
  if (!loaded) return std::unexpected(loaded.error());
  reload_ = false;
  framer_.clear();
  first_reading(*loaded);
  return {};
}

void FalconDriver::first_reading(const FalconReply& reply) noexcept {
  reply_ = reply;
  State state;
  (void)take(state, clock_->now());  // the first exchange reports counts without a pose
}

FalconCommand FalconDriver::frame_for(const ServoCommand& command, SentCommand& next) noexcept {
  next = {.seq = command.seq};
  FalconCommand frame{.lights = static_cast<std::uint8_t>(command.leds & 7u)};
  const bool may_push = homing_.homed() && pose_ && !command.homing && !reload_;
  frame.homing = homing_.bit(command.homing);
  if (!may_push) return frame;
  const double share = falcon_effort_share(pose_->condition);
  const FalconForce::Sent sent =
      force_.counts_for(share * Vec3(command.effort[0], command.effort[1], command.effort[2]));
  frame.motor = sent.motor;
  next.tau = sent.tau;
  next.saturated = sent.saturated || share < 1;
  return frame;
}

Errc FalconDriver::after(Errc trouble) noexcept {
  if (trouble != Errc::kProtocol) return trouble;
  framer_.clear();
  const auto cleared = pipe_->clear_halt();
  return cleared ? Errc::kProtocol : cleared.error();
}

std::expected<void, Errc> FalconDriver::send(const FalconCommand& frame) noexcept {
  const FalconBytes bytes = encode(frame, bits_);
  const Moved moved = pipe_->write(bytes, kWriteWait);
  if (!moved) return std::unexpected(after(moved.error()));
  if (*moved != bytes.size())
    return std::unexpected(Errc::kFraming);  // the device resynchronises at the next frame's '<'
  return {};
}

std::expected<void, Errc> FalconDriver::receive(Duration wait) noexcept {
  std::array<std::byte, kFtdiPacket> packet{};
  const Time until = clock_->now() + wait;
  for (int i = 0; i < kPacketsMax; ++i) {
    const Duration left = std::max(until - clock_->now(), Duration{0});
    const Moved moved = pipe_->read(packet, left);
    if (!moved && moved.error() != Errc::kTimeout) return std::unexpected(after(moved.error()));
    if (moved && *moved > 0) {
      const FtdiPacket p = ftdi_packet(std::span(packet).first(std::min(*moved, packet.size())));
      line_error_ = line_error_ || !p.whole || p.line_error;
      bool complete = false;
      for (const std::byte b : p.payload) {
        const auto frame = framer_.push(b);
        if (!frame) continue;
        if (const auto reply = decode_reply(*frame)) {
          reply_ = *reply;
          complete = true;
        } else {
          line_error_ = true;
        }
      }
      if (complete && wait > Duration{0}) return {};  // with wait = 0, all queued frames are read and the newest counts
    } else if (left == Duration{0}) {
      return {};
    }
    if (wait > Duration{0} && clock_->now() >= until) return {};
  }
  return {};
}

/// Discards queued replies of the bridge: they are from before a stall and would appear as present motion.
std::expected<void, Errc> FalconDriver::forget_old_answers() noexcept {
  if (auto purged = pipe_->control(ftdi::kReset, ftdi::kPurgeIn, 0); !purged)
    return std::unexpected(after(purged.error()));
  if (auto waited = receive(Duration{0}); !waited) return waited;
  framer_.clear();
  jumped_ = after_stall_ = true;
  return {};
}

std::expected<Exchange, Errc> FalconDriver::exchange(const ServoCommand& command, State& state) noexcept {
  const Time began = clock_->now();
  if (pace_.stalled(began, kStoodStill)) {
    if (auto forgotten = forget_old_answers(); !forgotten) return std::unexpected(forgotten.error());
  }
  const std::uint64_t thrown_before = framer_.thrown_away();
  reply_.reset();
  line_error_ = false;
  // A reply that missed the previous exchange.
  if (auto late = receive(Duration{0}); !late) return std::unexpected(late.error());
  if (reply_) {
    // It answers the previous frame. Its homing flags and pose apply to the frame that is sent now.
    const auto taken = take(state, clock_->now());
    if (!taken) return taken;
  }
  const bool had_late = reply_.has_value();
  const bool late_resynced = had_late && state.resynced;

  SentCommand next;
  const FalconCommand frame = frame_for(command, next);
  if (auto sent = send(frame); !sent) return std::unexpected(sent.error());
  acting_ = std::exchange(sent_, next);

  reply_.reset();
  const auto read = receive(std::clamp(pace_.next(began) - clock_->now(), Duration{0}, Duration{kReplyWait}));
  if (!read) return std::unexpected(read.error());
  const bool resynced = framer_.thrown_away() != thrown_before || line_error_ || late_resynced;
  if (!reply_) return !had_late ? Exchange::kNothing : late_resynced ? Exchange::kResynced : Exchange::kFresh;
  const auto taken = take(state, clock_->now());
  if (taken && resynced) state.resynced = true;
  return taken && resynced ? std::expected<Exchange, Errc>(Exchange::kResynced) : taken;
}

std::expected<Exchange, Errc> FalconDriver::take(State& state, Time now) noexcept {
  const FalconReply& reply = *reply_;
  const FalconHoming::Verdict verdict = homing_.read(reply, now);
  reload_ = reload_ || verdict == FalconHoming::Verdict::kFrozen;
  if (reload_) {
    pose_.reset();
    state.homed = false;
    return std::unexpected(Errc::kFirmware);
  }
  Vec3 theta;
  for (std::size_t i = 0; i < 3; ++i) {
    theta[static_cast<int>(i)] = kFalconZeroAngle + reply.encoder[i] * kFalconRadPerCount;
    state.raw[i] = reply.encoder[i];
  }
  const bool new_origin = verdict == FalconHoming::Verdict::kJustHomed || verdict == FalconHoming::Verdict::kDropped;
  const bool anew = std::exchange(after_stall_, false);
  const bool jump = !jumped_ && (theta - theta_last_).cwiseAbs().maxCoeff() > kJump;
  const double dt = seconds(now - read_at_);
  if (jumped_ || jump || new_origin) {
    dtheta_.setZero();
  } else if (dt > 0) {
    dtheta_ += dt / (dt + kRateTime) * ((theta - theta_last_) / dt - dtheta_);
  }
  for (int i = 0; i < 3; ++i) {
    if (std::abs(dtheta_[i]) < kRateMin) dtheta_[i] = 0;
  }
  theta_last_ = theta;
  read_at_ = now;
  jumped_ = false;

  pose_.reset();
  if (homing_.homed()) {
    pose_ = falcon_forward(theta, x_last_);
    if (!pose_) {
      jumped_ = true;
      state.homed = false;
      return std::unexpected(Errc::kProtocol);
    }
    x_last_ = pose_->x;
  }
  ++state.seq;
  state.echo_command = acting_.seq;
  state.sampled_at = now;
  state.homed = homing_.homed();
  state.saturated = acting_.saturated;
  state.buttons = reply.buttons;
  state.resynced = jump || new_origin || anew;
  state.stale = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = static_cast<int>(i);
    state.q[i] = theta[k];
    state.dq[i] = dtheta_[k];
    state.tau_out[i] = acting_.tau[k];
  }
  state.x = x_last_;
  state.J.setZero();
  state.dx.setZero();
  state.f_out.setZero();
  if (pose_) {
    state.J.leftCols<3>() = pose_->J;
    state.dx = pose_->J * dtheta_;
    state.f_out = pose_->J_inv.transpose() * acting_.tau;
  }
  return state.resynced ? Exchange::kResynced : Exchange::kFresh;
}

void FalconDriver::send_zeros() noexcept {
  FalconCommand zero;
  zero.homing = homing_.armed();
  for (int i = 0; i < kSilenceFrames; ++i) {
    const auto sent = send(zero);
    if (!sent && sent.error() == Errc::kUnplugged) break;
    reply_.reset();
    const auto read = receive(kReplyWait);
    if (!read && read.error() == Errc::kUnplugged) break;
  }
  // Leaves the boot loader running instead of firmware with frozen encoders, so that the next program loads the
  // firmware.
  if (reload_) (void)line_for_boot(*pipe_);
  acting_ = sent_ = {};
  pose_.reset();
  jumped_ = true;
}

}  // namespace tandem::hal
