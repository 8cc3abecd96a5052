#include "hal/io/sim_servo.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>
#include <system_error>
#include <utility>

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

constexpr int kPriority = 60;
/// After a longer gap (suspended machine) the plant is not run through all of it.
constexpr Duration kCatchUpMax = 250ms;
constexpr Duration kLateLimit = 1ms;
constexpr std::uint64_t kPublishEvery = 64;  // ticks between copies for readers

Time monotonic_now() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return Time{} + std::chrono::seconds(t.tv_sec) + std::chrono::nanoseconds(t.tv_nsec);
}

void sleep_until(Time at) noexcept {
  const auto ns = at.time_since_epoch().count();
  const timespec t{static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

bool ask_for_realtime() noexcept {
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  const sched_param p{kPriority};
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &p) == 0;
}

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
      period_(std::clamp<Duration>(period, 100us, 100ms)) {
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
  DeviceStats s = published_;
  s.period_p50_s = 1e-9 * static_cast<double>(published_periods_.quantile(0.50));
  s.period_p99_s = 1e-9 * static_cast<double>(published_periods_.quantile(0.99));
  s.period_max_s = 1e-9 * static_cast<double>(published_periods_.max());
  return s;
}

void SimServo::close() noexcept {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) {
    if (thread_.get_id() == std::this_thread::get_id()) return;  // the owner's close() or destructor joins
    thread_.join();
  }
  phase_.store(Phase::kAbsent, std::memory_order_release);
}

void SimServo::count(Duration since_last, Duration late, std::uint64_t missed, bool expired, bool rejected) noexcept {
  ++stats_.ticks;
  stats_.late += late > kLateLimit ? 1 : 0;
  stats_.missed += missed;
  stats_.expired += expired ? 1 : 0;
  stats_.rejected += rejected ? 1 : 0;
  periods_.add(since_last.count());
  if ((stats_.ticks % kPublishEvery == 0 || stats_.ticks == 1) && stats_lock_.try_lock()) {
    published_ = stats_;
    published_periods_ = periods_;
    stats_lock_.unlock();
  }
}

void SimServo::run(ServoClient& client) noexcept {
  realtime_.store(ask_for_realtime(), std::memory_order_relaxed);
  Time due = monotonic_now();
  Time last = due;
  // The device counts its own time; what the client sees is shifted to the host's clock.
  Duration shift = due - device_->state().sampled_at;
  Command command;
  while (!stop_.load(std::memory_order_relaxed)) {
    due += period_;
    sleep_until(due);
    const Time now = monotonic_now();
    const Duration late = now - due;
    const auto behind = static_cast<std::uint64_t>(std::max<Duration::rep>(0, late / period_));
    if (unplugged_.load(std::memory_order_relaxed)) break;

    if (phase() != Phase::kEnabled) command.kind = CommandKind::kNone;
    const bool rejected = command.kind != CommandKind::kNone && !finite(command);
    Command shifted = command;
    shifted.expires = command.expires > Time{} + shift ? command.expires - shift : Time{};
    const auto steps = 1 + std::min(behind, static_cast<std::uint64_t>(kCatchUpMax / period_));
    for (std::uint64_t i = 0; i < steps; ++i) device_->advance(shifted, period_);
    const bool expired = command.kind != CommandKind::kNone && shifted.expires < device_->state().sampled_at;
    due += behind * period_;
    shift = due - device_->state().sampled_at;

    State seen = device_->state();
    seen.sampled_at = due;
    command = client.tick(seen);
    count(now - last, late, behind, expired, rejected);
    last = now;
  }
  device_->advance(Command{}, period_);
  {
    const std::lock_guard lock(stats_lock_);
    published_ = stats_;
    published_periods_ = periods_;
  }
  if (unplugged_.load(std::memory_order_relaxed)) {
    phase_.store(Phase::kLost, std::memory_order_release);
    client.lost(Errc::kUnplugged);
  }
}

}  // namespace tandem::hal
