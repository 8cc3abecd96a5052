#include "hal/io/periodic_timer.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "common/io/clock.h"

namespace tandem::hal {
namespace {

constexpr int kPriority = 60;
constexpr Duration kLateLimit = std::chrono::milliseconds(1);

}  // namespace

Time MonotonicClock::now() noexcept { return io::monotonic_now(); }

void MonotonicClock::wait_until(Time at) noexcept {
  const auto ns = at.time_since_epoch().count();
  const timespec t{static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

bool request_realtime() noexcept {
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  const sched_param p{kPriority};
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &p) == 0;
}

void PeriodicTimer::begin() noexcept { due_ = last_ = io::monotonic_now(); }

void PeriodicTimer::shift(Duration by) noexcept {
  const Duration most = period_ / 100;
  due_ += std::clamp(by, -most, most);
}

PeriodicTimer::WakeUp PeriodicTimer::next() noexcept {
  due_ += period_;
  MonotonicClock{}.wait_until(due_);
  const Time now = io::monotonic_now();
  const Duration late = now - due_;
  const auto missed = late > Duration::zero() ? static_cast<std::uint64_t>(late / period_) : 0;
  due_ += missed * period_;
  late_ += late > kLateLimit ? 1 : 0;
  missed_ += missed;
  periods_.add((now - last_).count());
  last_ = now;
  return {due_, missed};
}

void PeriodicTimer::report(DeviceStats& stats) const noexcept {
  stats.late = late_;
  stats.missed = missed_;
  stats.period_p50_s = 1e-9 * static_cast<double>(periods_.quantile(0.50));
  stats.period_p99_s = 1e-9 * static_cast<double>(periods_.quantile(0.99));
  stats.period_max_s = 1e-9 * static_cast<double>(periods_.max());
}

}  // namespace tandem::hal
