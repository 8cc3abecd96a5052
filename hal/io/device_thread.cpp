#include "hal/io/device_thread.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace tandem::hal {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kPublishEvery =
    64;  // exchanges between copies for readers: computing quantiles costs some microseconds

/// Observer of a bring-up during operation: its progress is not shown; closing the device cancels it.
class SilentBringUp final : public BringUp {
 public:
  explicit SilentBringUp(const std::atomic<bool>& stop) : stop_(stop) {}
  void progress(std::string_view, double) override {}
  bool cancelled() const noexcept override { return stop_.load(std::memory_order_relaxed); }

 private:
  const std::atomic<bool>& stop_;
};

}  // namespace

DeviceThread::DeviceThread(std::unique_ptr<ServoCore> core, Duration period, Heartbeat* pulse)
    : core_(std::move(core)),
      caps_(core_->caps()),
      period_(std::clamp<Duration>(period, 100us, 100ms)),
      pace_(period_),
      heartbeat_(pulse) {}

Result<> DeviceThread::start(ServoClient& client) {
  if (thread_.joinable() || closed_) {
    return std::unexpected(DeviceError{Errc::kBadState, id().backend + ": already started, or closed"});
  }
  try {
    thread_ = std::thread([this, &client] { run(client); });
  } catch (const std::system_error& e) {
    return std::unexpected(DeviceError{Errc::kInternal, "no thread for the device: " + std::string(e.what())});
  }
  return {};
}

void DeviceThread::run(ServoClient& client) noexcept {
  realtime_.store(request_realtime(), std::memory_order_relaxed);
  MonotonicClock clock;
  const auto publish = [&] {
    DeviceStats stats = core_->counts();
    pace_.report(stats);
    stats.round_trip_p50_s = 1e-9 * static_cast<double>(core_->round_trips().quantile(0.50));
    stats.round_trip_p99_s = 1e-9 * static_cast<double>(core_->round_trips().quantile(0.99));
    stats.round_trip_max_s = 1e-9 * static_cast<double>(core_->round_trips().max());
    published_ = stats;
  };
  const auto show_life = [&](bool forces) {
    if (heartbeat_ != nullptr) forces ? heartbeat_->beat() : heartbeat_->set_idle();
  };
  SilentBringUp watcher{stop_};
  pace_.begin();
  while (!stop_.load(std::memory_order_relaxed)) {
    pace_.next();
    const Time now = clock.now();  // taken after the wait: a command that expired while this thread slept must not act
    if (core_->phase() == Phase::kBooting) {
      show_life(false);  // zero frames of the watchdog process would corrupt a firmware upload
      static_cast<void>(core_->bring_up(watcher));  // the phase shows the result
    }
    if (!core_->step(now, client)) break;
    pace_.shift(client.next_shift());
    show_life(core_->motors_enabled());
    core_->record_round_trip(clock.now() - now);
    if (core_->counts().ticks % kPublishEvery == 1 && stats_lock_.try_lock()) {
      publish();
      stats_lock_.unlock();
    }
  }
  core_->send_zeros();
  show_life(false);
  const std::lock_guard lock(stats_lock_);
  publish();
}

DeviceStats DeviceThread::stats() const {
  const std::lock_guard lock(stats_lock_);
  return published_;
}

DeviceHistograms DeviceThread::histograms() const {
  if (!closed_.load(std::memory_order_acquire)) return {};
  return {.period = pace_.periods(), .round_trip = core_->round_trips()};
}

void DeviceThread::close() noexcept {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) {
    if (thread_.get_id() == std::this_thread::get_id()) return;  // the owner's close() or destructor joins
    thread_.join();
  } else if (!closed_.load()) {
    core_->send_zeros();  // brought up but never started
  }
  closed_.store(true, std::memory_order_release);
}

}  // namespace tandem::hal
