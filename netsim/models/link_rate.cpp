#include "netsim/models/link_rate.h"

#include <algorithm>

namespace tandem::netsim {
namespace {

__extension__ using Wide = unsigned __int128;
constexpr std::size_t kBacklogMax = 65'536;
constexpr std::uint64_t kBitNanoseconds = 8'000'000'000;  // one byte at 1 bit/s [ns]

}  // namespace

LinkRate::LinkRate(const RateSpec& spec)
    : limited_(spec.present()),
      bits_per_s_(spec.bits_per_s),
      overhead_(spec.overhead_bytes),
      queue_bytes_(spec.drop == RateSpec::Drop::kHead ? 0 : spec.queue_bytes),
      wait_max_(spec.drop == RateSpec::Drop::kHead ? kWaitMax : std::min(spec.queue_wait.value_or(kWaitMax), kWaitMax)),
      competing_peak_(spec.competing_peak),
      competing_period_(spec.competing_period),
      capacity_(spec.trace) {
  // A drop-head queue enforces the limits itself (head_drop.h).
  if (spec.drop == RateSpec::Drop::kHead) return;
  // The backlog of a recorded capacity does not follow from time alone, so it is stored.
  if (spec.queue_datagrams > 0) {
    backlog_.emplace(spec.queue_datagrams);
  } else if (spec.trace && spec.queue_bytes > 0) {
    backlog_.emplace(kBacklogMax);
  }
  if (spec.codel) codel_.emplace(*spec.codel);
}

Duration LinkRate::competing_wait(Time now) const noexcept {
  if (competing_peak_ == Duration::zero()) return Duration::zero();
  const Duration into = now.time_since_epoch() % competing_period_;
  const Duration rise = competing_period_ - competing_peak_;
  if (into >= rise) return competing_period_ - into;
  const Wide filled = Wide{static_cast<std::uint64_t>(competing_peak_.count())} *
                      static_cast<std::uint64_t>(into.count()) / static_cast<std::uint64_t>(rise.count());
  return Duration{static_cast<std::int64_t>(filled)};
}

std::optional<Time> LinkRate::serve_queued(Time now, std::size_t size) noexcept {
  const std::uint64_t bytes = size + overhead_;
  if (backlog_) {
    backlog_->advance(now);
    if (backlog_->full()) return std::nullopt;
  }
  const auto sent = capacity_.present() ? by_trace(now, bytes) : at_rate(now, bytes);
  if (sent && backlog_) backlog_->add(*sent, bytes);
  return sent;
}

Time LinkRate::begins(Time now, std::uint64_t bytes_before) noexcept {
  if (capacity_.present()) return capacity_.offer(std::max(now, not_before_), bytes_before + 1);
  const bool busy = busy_until_ >= now;
  const Wide work = Wide{bytes_before} * kBitNanoseconds + (busy ? busy_rest_ : 0) + bits_per_s_ - 1;
  return (busy ? busy_until_ : now) + Duration{static_cast<std::int64_t>(work / bits_per_s_)};
}

std::optional<std::uint64_t> LinkRate::unsent(Time now) const noexcept {
  if (capacity_.present()) return std::nullopt;
  if (busy_until_ < now) return 0;
  const Wide work = Wide{static_cast<std::uint64_t>((busy_until_ - now).count())} * bits_per_s_ + busy_rest_;
  return static_cast<std::uint64_t>((work + kBitNanoseconds - 1) / kBitNanoseconds);
}

std::optional<Time> LinkRate::by_trace(Time now, std::uint64_t bytes) noexcept {
  if (queue_bytes_ > 0 && backlog_->bytes() + bytes > queue_bytes_) return std::nullopt;
  const Time sent = capacity_.offer(std::max(now, not_before_), bytes);
  if (sent - now > wait_max_ || (codel_ && codel_->drops(sent, sent - now))) return std::nullopt;
  capacity_.accept();
  busy_until_ = sent;
  return sent;
}

void LinkRate::replace(const LinkRate& before, Time at) noexcept {
  if (backlog_ && before.backlog_) backlog_->replace(*before.backlog_);
  if (!limited_ || !before.limited_) return;
  busy_until_ = std::max(before.busy_until_, at);
  not_before_ = busy_until_;
  if (capacity_.present() || before.capacity_.present()) return;  // no rate to convert the unsent work
  const Wide left = Wide{static_cast<std::uint64_t>((busy_until_ - at).count())} * before.bits_per_s_ +
                    (before.busy_until_ >= at ? before.busy_rest_ : 0);
  busy_until_ = at + Duration{static_cast<std::int64_t>(left / bits_per_s_)};
  busy_rest_ = static_cast<std::uint64_t>(left % bits_per_s_);
}

std::optional<Time> LinkRate::at_rate(Time now, std::uint64_t bytes) noexcept {
  if (busy_until_ < now) {
    busy_until_ = now;
    busy_rest_ = 0;
  }
  const Duration shared = competing_wait(now);
  const Duration wait = busy_until_ - now + shared;
  if (wait > wait_max_ || (wait == wait_max_ && busy_rest_ > 0)) return std::nullopt;
  if (queue_bytes_ > 0) {
    const Wide work = Wide{static_cast<std::uint64_t>(wait.count())} * bits_per_s_ + busy_rest_;
    const Wide waiting = (work + kBitNanoseconds - 1) / kBitNanoseconds;
    if (waiting + bytes > queue_bytes_) return std::nullopt;
  }
  if (codel_ && codel_->drops(now + wait, wait)) return std::nullopt;
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
