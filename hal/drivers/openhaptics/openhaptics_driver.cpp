#include "hal/drivers/openhaptics/openhaptics_driver.h"

#include <utility>

namespace tandem::hal::openhaptics {

namespace {

using namespace std::chrono_literals;

constexpr Duration kFirstCycle = 2s;    // the vendor's scheduler starts its own threads
constexpr Duration kCycleMax = 1500us;  // one and a half cycles
constexpr Duration kLook = 100us;

Homing homing_of(std::uint32_t styles) noexcept {
  if ((styles & id::kStyleAuto) != 0) return Homing::kAuto;
  if ((styles & id::kStyleInkwell) != 0) return Homing::kInkwell;
  if ((styles & id::kStyleEncoderReset) != 0) return Homing::kResetPose;
  return Homing::kAuto;
}

}  // namespace

OpenHapticsDriver::OpenHapticsDriver(std::string name, std::shared_ptr<TouchGroup> group, Clock& clock,
                                     bool home_at_start)
    : id_{"openhaptics", name.empty() ? "default" : name},
      name_(std::move(name)),
      home_at_start_(home_at_start),
      group_(std::move(group)),
      clock_(&clock) {}

OpenHapticsDriver::~OpenHapticsDriver() { release(); }

void OpenHapticsDriver::release() noexcept {
  if (slot_) group_->remove(*std::exchange(slot_, std::nullopt));
}

Result<> OpenHapticsDriver::bring_up(BringUp& watcher) {
  release();
  watcher.progress("opening", 0);
  auto about = group_->add(name_, [&] {
    return std::exchange(home_at_start_, false) ||
           watcher.request_user_action("openhaptics " + id_.key +
                                       " finds its position only by a reset: put it into its reset pose (all links at "
                                       "right angles, as in its manual), hold it there");
  });
  if (!about) return std::unexpected(std::move(about.error()));
  slot_ = about->slot;
  cycle_ = 0;

  caps_ = {};
  caps_.joints = caps_.tip_axes = 3;
  caps_.prismatic = true;
  caps_.timing = Timing::kVendor;
  caps_.homing = homing_of(about->calibration);
  caps_.gravity = GravityCompensation::kDevice;
  caps_.latency = 0.001;  // a force takes effect in the vendor's cycle after the one with the reading
  caps_.buttons = 4;
  for (AxisLimit& axis : caps_.axis) {
    axis.peak = about->force_max;  // unknown: the guard gives no force
    axis.continuous = about->force_continuous;
    axis.from = about->force_max ? Provenance::kVendorQuery : Provenance::kUnknown;
  }
  if (about->workspace) {
    for (std::size_t i = 0; i < 3; ++i) {
      caps_.workspace_min[i] = (*about->workspace)[i];
      caps_.workspace_max[i] = (*about->workspace)[i + 3];
    }
  }
  watcher.progress("waiting for the vendor's servo", 0.5);
  for (const Time end = clock_->now() + kFirstCycle; clock_->now() < end;) {
    if (wait_for_cycle(20ms)) {
      if (group_->sample(*slot_).lost)
        return std::unexpected(
            DeviceError{Errc::kUnplugged, "openhaptics: '" + id_.key + "' stopped answering at once; check its cable"});
      watcher.progress("ready", 1);
      return {};
    }
    if (watcher.cancelled()) return std::unexpected(DeviceError{Errc::kBadState, "openhaptics: cancelled"});
  }
  return std::unexpected(
      DeviceError{Errc::kTimeout,
                  "openhaptics: the vendor's servo did not begin within 2 s; it needs real-time priority "
                  "or another program has it"});
}

bool OpenHapticsDriver::wait_for_cycle(Duration limit) noexcept {
  const Time end = clock_->now() + limit;
  while (group_->sample(*slot_).cycle == cycle_) {
    const Time now = clock_->now();
    if (now >= end) return false;
    clock_->wait_until(now + kLook);
  }
  cycle_ = group_->sample(*slot_).cycle;
  return true;
}

std::expected<Exchange, Errc> OpenHapticsDriver::exchange(const ServoCommand& command, State& state) noexcept {
  if (!slot_) return std::unexpected(Errc::kBadState);
  TouchCommand touch;
  touch.number = ++commands_;
  touch.seq = command.seq;
  for (std::size_t i = 0; i < 3; ++i) touch.force[i] = command.effort[i];  // q = tip, J = 1
  touch.homing = command.homing;
  group_->set_command(*slot_, touch);
  if (!wait_for_cycle(kCycleMax)) return Exchange::kNothing;

  const Sample& s = group_->sample(*slot_);
  if (s.lost) return std::unexpected(Errc::kUnplugged);
  ++state.seq;
  state.echo_command = s.command_seq;
  state.sampled_at = clock_->now();
  state.J.setZero();
  for (int i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i);
    state.q[a] = state.x[i] = s.x[a];
    state.dq[a] = state.dx[i] = s.v[a];
    state.J(i, i) = 1;
    state.tau_out[a] = state.f_out[i] = s.force[a];
    state.raw[a] = s.encoders[a];
  }
  state.buttons = s.buttons;
  state.homed = s.homed;
  state.saturated = s.limited;
  state.heat = s.heat;
  return Exchange::kFresh;
}

void OpenHapticsDriver::send_zeros() noexcept {
  if (!slot_) return;
  for (int i = 0; i < 3; ++i) {
    TouchCommand zeros;
    zeros.number = ++commands_;
    group_->set_command(*slot_, zeros);
    if (!wait_for_cycle(5ms) || group_->sample(*slot_).lost) return;
  }
}

}  // namespace tandem::hal::openhaptics
