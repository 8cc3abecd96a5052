#include "netsim/link_rate.h"

#include <algorithm>

namespace tandem::netsim {
namespace {

__extension__ using Wide = unsigned __int128;
constexpr std::uint64_t kBitNanoseconds = 8'000'000'000;  // one byte at 1 bit/s [ns]

}  // namespace

LinkRate::LinkRate(const RateSpec& spec) noexcept
    : bits_per_s_(spec.bits_per_s),
      overhead_(spec.overhead_bytes),
      queue_bytes_(spec.queue_bytes),
      wait_max_(std::min(spec.queue_wait.value_or(kWaitMax), kWaitMax)),
      competing_peak_(spec.competing_peak),
      competing_period_(spec.competing_period) {}

Duration LinkRate::others(Time now) const noexcept {
  if (competing_peak_ == Duration::zero()) return Duration::zero();
  const Duration into = now.time_since_epoch() % competing_period_;
  const Duration rise = competing_period_ - competing_peak_;
  if (into >= rise) return competing_period_ - into;
  const Wide filled = Wide{static_cast<std::uint64_t>(competing_peak_.count())} *
                      static_cast<std::uint64_t>(into.count()) / static_cast<std::uint64_t>(rise.count());
  return Duration{static_cast<std::int64_t>(filled)};
}

std::optional<Time> LinkRate::serve_queued(Time now, std::size_t size) noexcept {
  if (busy_until_ < now) {
    busy_until_ = now;
    busy_rest_ = 0;
  }
  const Duration shared = others(now);
  const Duration wait = busy_until_ - now + shared;
  if (wait > wait_max_ || (wait == wait_max_ && busy_rest_ > 0)) return std::nullopt;
  const std::uint64_t bytes = size + overhead_;
  if (queue_bytes_ > 0) {
    const Wide work = Wide{static_cast<std::uint64_t>(wait.count())} * bits_per_s_ + busy_rest_;
    const Wide waiting = (work + kBitNanoseconds - 1) / kBitNanoseconds;
    if (waiting + bytes > queue_bytes_) return std::nullopt;
  }
  const std::uint64_t work = bytes * kBitNanoseconds;
  busy_until_ += Duration{static_cast<std::int64_t>(work / bits_per_s_)};
  busy_rest_ += work % bits_per_s_;
  if (busy_rest_ >= bits_per_s_) {
    busy_rest_ -= bits_per_s_;
    busy_until_ += Duration{1};
  }
  return busy_until_ + shared + Duration{busy_rest_ > 0 ? 1 : 0};
}

}  // namespace tandem::netsim
