#include "server/app/process/shard_load.h"

#include <algorithm>
#include <utility>

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLateTick = 1ms;
/// Divisor of the lateness without real-time priority, when a busy machine is often 5 ms late. Hands are then released
/// after three ticks in a row that are 20 ms late, which is when their own gates release too.
constexpr int kLateUnpromised = 4;
constexpr std::uint64_t kLoadTicks = 1000;

}  // namespace

std::uint32_t ShardLoad::begin_tick(Time now, Duration late, bool serving) noexcept {
  const auto missed = static_cast<std::uint32_t>(late / period_);
  lateness_.add(std::max(late, Duration::zero()));
  machine_.late = late > kLateTick;
  if (serving) {
    if (machine_.late) late_ticks_.fetch_add(1, std::memory_order_relaxed);
    machine_.late_ticks += machine_.late ? 1 : 0;
    machine_.missed_ticks += missed;
  }
  const bool was_overloaded = machine_.load_state.overloaded;
  machine_.load_state = shedder_.step(now, machine_.realtime ? late : late / kLateUnpromised, used_, worked_);
  if (serving && machine_.load_state.overloaded && !was_overloaded) overloads_.fetch_add(1, std::memory_order_relaxed);
  shed_level_.store(machine_.load_state.level, std::memory_order_relaxed);
  overloaded_.store(machine_.load_state.overloaded, std::memory_order_relaxed);
  return missed;
}

void ShardLoad::end_tick(Time now, Duration before, Duration after) noexcept {
  used_ = after - before;
  worked_ = after - std::exchange(worked_until_, after);
  spent_.add(used_.count());
  lengths_.add(used_);
  if (spent_.count() >= kLoadTicks) {
    tick_share_.store(static_cast<double>(spent_.quantile(0.99)) / static_cast<double>(period_.count()),
                      std::memory_order_relaxed);
    spent_ = Histogram{};
  }
  if (core_since_ == Time{} || now - core_since_ >= 1s) {
    if (core_since_ != Time{})
      cpu_share_.store(seconds(after - core_used_) / seconds(now - core_since_), std::memory_order_relaxed);
    core_since_ = now;
    core_used_ = after;
  }
  last_tick_.store(now.time_since_epoch().count(), std::memory_order_relaxed);
}

}  // namespace tandem::server
