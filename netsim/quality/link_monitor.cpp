#include "netsim/quality/link_monitor.h"

#include <algorithm>
#include <memory>

namespace tandem::netsim {

LinkMonitor::LinkMonitor(Time from) : directions_{LinkQuality{from}, LinkQuality{from}}, answers_(kUnderWayMax) {
  for (std::size_t w = 0; w < kWindows; ++w) windows_[w].length = window_length(w);
}

void LinkMonitor::sent(Direction direction, Time at, std::uint64_t index) noexcept {
  directions_[static_cast<std::size_t>(direction)].sent(at, index);
  if (direction == Direction::kDown) answers_[index % kUnderWayMax] = {index, up_heard_ ? up_delay_ : Duration{-1}};
}

void LinkMonitor::lost(Direction direction, Time sent, std::uint64_t index) noexcept {
  directions_[static_cast<std::size_t>(direction)].lost(sent, index);
}

void LinkMonitor::arrived(Direction direction, Time sent, Time at, std::uint64_t index) noexcept {
  directions_[static_cast<std::size_t>(direction)].arrived(sent, at, index);
  if (direction == Direction::kUp) {
    if (up_heard_ && sent <= up_newest_) return;
    up_heard_ = true;
    up_newest_ = sent;
    up_delay_ = at - sent;
    return;
  }
  Answer& answer = answers_[index % kUnderWayMax];
  if (answer.index != index || answer.up < Duration::zero()) return;
  clock_.advance(at, [this](std::int64_t step) { judge(step); });
  round_trips_.add(clock_.place(at), answer.up + (at - sent));
  answer.up = Duration{-1};  // a copy does not count as a second answer
}

void LinkMonitor::judge(std::int64_t step) noexcept {
  round_trips_.close(step);
  for (std::size_t w = 0; w < kWindows; ++w) {
    const auto& window = round_trips_.window(w);
    if (window.count() == 0 || !clock_.full(step, kWindowSteps[w])) continue;
    const Duration p99 = window.quantile(99);
    MeasureSummary& measure = windows_[w].measures[static_cast<std::size_t>(Measure::kRoundTrip)];
    const Band band = note(measure, band_of(p99, kRoundTripLimits), seconds(p99), end_of_step(step));
    ++windows_[w].windows;
    ++windows_[w].bands[static_cast<std::size_t>(band)];
  }
}

LinkSummary LinkMonitor::summary() const {
  LinkSummary s;
  s.up = directions_[0].summary();
  s.down = directions_[1].summary();
  const auto copy = std::make_unique<LinkMonitor>(*this);
  copy->clock_.finish(std::max(s.up.until, s.down.until) - kWindowStep,
                      [&copy](std::int64_t step) { copy->judge(step); });
  s.round_trip.delay = copy->round_trips_.summary();
  s.round_trip.windows = copy->windows_;
  return s;
}

}  // namespace tandem::netsim
