#include "netsim/quality/sliding_windows.h"

namespace tandem::netsim {
namespace {

std::size_t slot_of(std::int64_t step) noexcept {
  static_assert((kStepsKept & (kStepsKept - 1)) == 0);
  return static_cast<std::size_t>(step) & (kStepsKept - 1);
}

}  // namespace

Duration SlidingMax::add(std::int64_t step, Duration value) noexcept {
  const auto at = [this](std::size_t i) -> Entry& { return ring_[(begin_ + i) % ring_.size()]; };
  while (size_ > 0 && at(size_ - 1).value <= value) --size_;
  while (size_ > 0 && at(0).step <= step - steps_) {
    begin_ = (begin_ + 1) % ring_.size();
    --size_;
  }
  at(size_++) = {step, value};
  return at(0).value;
}

SlidingDelays::SlidingDelays() : samples_(kSamples), steps_(kStepsKept) {}

void SlidingDelays::add(std::int64_t step, Duration delay) noexcept {
  const std::size_t bin = DelayScale::bin_of(delay);
  all_.add(bin);
  sum_s_ += seconds(delay);
  max_ = std::max(max_, delay);
  if (pushed_ - entered_ == kSamples) return;  // the open steps alone exceed the capacity of a window
  if (pushed_ >= kSamples)
    for (Window& window : windows_) drop_until(window, pushed_ - kSamples + 1);
  samples_[pushed_++ % kSamples] = static_cast<std::uint16_t>(bin);
  ++steps_[slot_of(step)].samples;
}

void SlidingDelays::close(std::int64_t step) noexcept {
  Step& closed = steps_[slot_of(step)];
  const std::uint64_t end = entered_ + closed.samples;
  for (; entered_ < end; ++entered_)
    for (Window& window : windows_) window.counts.add(samples_[entered_ % kSamples]);
  closed = {0, entered_};
  for (std::size_t w = 0; w < kWindows; ++w) {
    const Step& left = steps_[slot_of(step - static_cast<std::int64_t>(kWindowSteps[w]))];
    drop_until(windows_[w], left.end);
  }
}

void SlidingDelays::drop_until(Window& window, std::uint64_t position) noexcept {
  for (; window.tail < position; ++window.tail) window.counts.remove(samples_[window.tail % kSamples]);
}

DelaySummary SlidingDelays::summary() const noexcept {
  if (all_.count() == 0) return {};
  return {.count = all_.count(),
          .mean_s = sum_s_ / static_cast<double>(all_.count()),
          .p5 = all_.quantile(5),
          .p50 = all_.quantile(50),
          .p95 = all_.quantile(95),
          .p99 = all_.quantile(99),
          .max = max_};
}

Band note(MeasureSummary& summary, Band band, double value, Time end) noexcept {
  ++summary.windows[static_cast<std::size_t>(band)];
  if (value > summary.worst) {
    summary.worst = value;
    summary.worst_at = end;
  }
  return band;
}

}  // namespace tandem::netsim
