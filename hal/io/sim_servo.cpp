#include "hal/io/sim_servo.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

/// Longest gap that the plant is stepped through; longer gaps (suspended machine) are cut to it.
constexpr Duration kCatchUpMax = 250ms;
constexpr std::uint64_t kSimPublishEvery = 64;  // ticks between copies for readers

bool finite(const Command& command) noexcept {
  return std::all_of(command.effort.begin(), command.effort.end(), [](double e) { return std::isfinite(e); });
}

Result<> bad_state(const char* what) {
  return std::unexpected(DeviceError{Errc::kBadState, std::string("simulated device: ") + what});
}

}  // namespace

SimServo::SimServo(std::unique_ptr<SteppedDevice> device, DeviceId id, Duration period)
    : device_(std::move(device)),
      caps_(device_->caps()),
      id_(std::move(id)),
      period_(std::clamp<Duration>(period, 100us, 100ms)),
      pace_(period_) {
  caps_.nominal_hz = 1.0 / seconds(period_);
}

Result<> SimServo::start(ServoClient& client) {
  Phase expected = Phase::kIdentified;
  if (!phase_.compare_exchange_strong(expected, Phase::kReady)) return bad_state("already started, or closed");
  try {
    thread_ = std::thread([this, &client] { run(client); });
  } catch (const std::system_error& e) {
    phase_ = Phase::kIdentified;
    return std::unexpected(
        DeviceError{Errc::kInternal, std::string("no thread for the simulated device: ") + e.what()});
  }
  return {};
}

Result<> SimServo::enable() {
  Phase expected = Phase::kReady;
  if (!phase_.compare_exchange_strong(expected, Phase::kEnabled))
    return bad_state("only a Ready device can be enabled");
  return {};
}

void SimServo::disable() noexcept {
  Phase expected = Phase::kEnabled;
  phase_.compare_exchange_strong(expected, Phase::kReady);
}

Result<> SimServo::reset() {
  switch (phase()) {
    case Phase::kReady:
    case Phase::kEnabled:
      return {};
    case Phase::kLost:
      return bad_state("lost; open it again");
    default:
      return bad_state("not started");
  }
}

DeviceStats SimServo::stats() const {
  const std::lock_guard lock(stats_lock_);
  return published_;
}

DeviceHistograms SimServo::histograms() const {
  return phase() == Phase::kAbsent ? DeviceHistograms{.period = pace_.periods(), .round_trip = {}} : DeviceHistograms{};
}

void SimServo::close() noexcept {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) {
    if (thread_.get_id() == std::this_thread::get_id()) return;  // the owner's close() or destructor joins
    thread_.join();
  }
  phase_.store(Phase::kAbsent, std::memory_order_release);
}

void SimServo::count(bool expired, bool rejected) noexcept {
  ++stats_.ticks;
  stats_.expired += expired ? 1 : 0;
  stats_.rejected += rejected ? 1 : 0;
  if (stats_.ticks % kSimPublishEvery == 1 && stats_lock_.try_lock()) {
    publish();
    stats_lock_.unlock();
  }
}

void SimServo::publish() noexcept {
  pace_.report(stats_);
  published_ = stats_;
}

void SimServo::run(ServoClient& client) noexcept {
  realtime_.store(request_realtime(), std::memory_order_relaxed);
  pace_.begin();
  // The device has its own time; the client sees it shifted to the host's clock.
  Duration shift = MonotonicClock{}.now() - device_->state().sampled_at;
  Command command;
  Time last = MonotonicClock{}.now();
  while (!stop_.load(std::memory_order_relaxed)) {
    const auto [due, behind] = pace_.next();
    if (unplugged_.load(std::memory_order_relaxed)) break;

    if (phase() != Phase::kEnabled) command.kind = CommandKind::kNone;
    const bool rejected = command.kind != CommandKind::kNone && !finite(command);
    Command shifted = command;
    shifted.expires = command.expires > Time{} + shift ? command.expires - shift : Time{};
    // The client may have shifted this period, and the device's time follows the host's.
    const auto periods = static_cast<std::int64_t>(1 + behind);
    const auto steps = std::min<std::int64_t>(periods, 1 + kCatchUpMax / period_);
    for (std::int64_t i = 0; i < steps; ++i) device_->advance(shifted, (due - last) / periods);
    last = due;
    const bool expired = command.kind != CommandKind::kNone && shifted.expires < device_->state().sampled_at;
    shift = due - device_->state().sampled_at;

    State seen = device_->state();
    seen.sampled_at = due;
    command = client.tick(seen);
    pace_.shift(client.next_shift());
    count(expired, rejected);
  }
  device_->advance(Command{}, period_);
  {
    const std::lock_guard lock(stats_lock_);
    publish();
  }
  if (unplugged_.load(std::memory_order_relaxed)) {
    phase_.store(Phase::kLost, std::memory_order_release);
    client.lost(Errc::kUnplugged);
  }
}

}  // namespace tandem::hal
