#include "netsim/quality/link_quality.h"

#include <algorithm>
#include <memory>

namespace tandem::netsim {

LinkQuality::LinkQuality(Time from)
    : from_(from),
      steps_(kStepsKept),
      windows_{Window{kWindowSteps[0]}, Window{kWindowSteps[1]}, Window{kWindowSteps[2]}} {
  for (std::size_t w = 0; w < kWindows; ++w) counts_.windows[w].length = window_length(w);
}

LinkQuality::Step& LinkQuality::step_at(Time at) noexcept {
  return steps_[static_cast<std::size_t>(clock_.place(at)) % kStepsKept];
}

void LinkQuality::sent(Time at, std::uint64_t /*index*/) noexcept {
  if (at < from_) return;
  if (talked_) at = std::max(at, last_sent_);
  clock_.advance(at, [this](std::int64_t step) { close(step); });
  Step& step = step_at(at);
  if (!talked_) {
    talked_ = true;
    counts_.from = at;
  }
  if (counts_.sent == 0 || at - last_sent_ > PauseTracker::kPause) {
    if (counts_.sent > 0) {
      ++counts_.pauses;
      counts_.paused += at - last_sent_;
    }
    pauses_.add({at, counts_.sent > 0 ? last_sent_ : at});
    step.resumed = true;
    step.resume = at;
  }
  ++counts_.sent;
  ++step.sent;
  step.talked = true;
  step.last_sent = last_sent_ = at;
}

void LinkQuality::lost(Time sent, std::uint64_t /*index*/) noexcept {
  if (!talked_ || sent < counts_.from) return;
  ++counts_.lost;
  ++step_at(sent).lost;
}

void LinkQuality::arrived(Time sent, Time at, std::uint64_t index) noexcept {
  if (!talked_ || sent < counts_.from) return;  // its sending was not reported
  const SeenNumbers::Kind kind = seen_.insert(index);
  if (kind == SeenNumbers::Kind::kAgain) {
    ++counts_.duplicates;
    return;
  }
  if (heard_) at = std::max(at, last_arrival_);
  clock_.advance(at, [this](std::int64_t step) { close(step); });
  ++counts_.arrived;
  if (kind == SeenNumbers::Kind::kReordered) {
    ++counts_.reordered;
    counts_.reordered_by_max = std::max(counts_.reordered_by_max, seen_.newest() - index);
  }
  const Duration delay = at - sent;
  delay_min_ = heard_ ? std::min(delay_min_, delay) : delay;
  delays_.add(clock_.place(at), delay);
  count_gap(silent_since(sent), at);
  if (!heard_ || sent > newest_sent_) count_age(sent, at);
  last_arrival_ = at;
  heard_ = true;
  Step& step = step_at(at);
  step.heard = true;
  step.last_heard = at;
}

/// Returns the start of the silence that ends with the datagram sent at `sent`. It is the previous arrival, or the
/// earliest possible arrival of the first datagram after a pause of the sender.
Time LinkQuality::silent_since(Time sent) const noexcept {
  const PauseTracker::Resume* const resume = pauses_.last_in(newest_arrived(), sent);
  if (resume == nullptr) return last_arrival_;
  const Time due = resume->at + delay_min_;
  return heard_ ? std::max(last_arrival_, due) : due;
}

void LinkQuality::count_gap(Time from, Time until) noexcept {
  const Duration gap = until - from;
  if (gap <= Duration::zero()) return;
  Step& step = step_at(until);
  step.gap = std::max(step.gap, gap);
  note_gap(gap, from);
}

void LinkQuality::note_gap(Duration gap, Time from) noexcept {
  if (gap <= counts_.longest_gap) return;
  counts_.longest_gap = gap;
  counts_.longest_gap_at = from;
}

/// Adds the age of the datagram sent at `newest_sent_` up to now. Pauses of the sender do not increase the age.
void LinkQuality::count_age(Time sent, Time at) noexcept {
  if (heard_) {
    const PauseTracker::Resume* const resume = pauses_.first_in(newest_sent_, sent);
    const Time end = resume == nullptr ? at : std::clamp(resume->last_before, age_from_, at);
    age_.add(age_from_ - newest_sent_, end - newest_sent_, end);
  }
  newest_sent_ = sent;
  age_from_ = at;
}

void LinkQuality::close(std::int64_t step) noexcept {
  Step& closed = steps_[static_cast<std::size_t>(step) % kStepsKept];
  const auto [gap, since] = gaps_.close(closed, delay_min_);
  note_gap(gap, since);  // gaps that ended were counted at their arrival
  delays_.close(step);
  for (std::size_t w = 0; w < kWindows; ++w) {
    Window& window = windows_[w];
    const auto behind = static_cast<std::size_t>(step - static_cast<std::int64_t>(kWindowSteps[w]));
    const Step& left = steps_[behind % kStepsKept];
    window.sent += closed.sent - std::uint64_t{left.sent};
    window.lost += closed.lost - std::uint64_t{left.lost};
    const Duration longest = window.gap.add(step, gap);
    if (clock_.full(step, kWindowSteps[w])) judge(w, step, longest);
  }
  // Clears the ring entry of a future step. This step's own sums are needed until it leaves the last window.
  steps_[static_cast<std::size_t>(step + kStepsOpen + 1) % kStepsKept] = Step{};
}

void LinkQuality::judge(std::size_t w, std::int64_t step, Duration gap) noexcept {
  const Window& window = windows_[w];
  const auto& delays = delays_.window(w);
  if (window.sent == 0 && delays.count() == 0) return;
  WindowSummary& summary = counts_.windows[w];
  const Time end = end_of_step(step);
  const auto measure = [&summary](Measure m) -> MeasureSummary& {
    return summary.measures[static_cast<std::size_t>(m)];
  };
  Band band = note(measure(Measure::kGap), band_of(gap, kGapLimits), seconds(gap), end);
  if (window.sent > 0) {
    const double share = std::min(1.0, static_cast<double>(window.lost) / static_cast<double>(window.sent));
    band = worse(band, note(measure(Measure::kLoss), loss_band(window.lost, window.sent), share, end));
  }
  if (delays.count() > 0) {
    const Duration jitter = delays.quantile(99) - delays.quantile(50);
    band = worse(band, note(measure(Measure::kJitter), band_of(jitter, kJitterLimits), seconds(jitter), end));
  }
  ++summary.windows;
  ++summary.bands[static_cast<std::size_t>(band)];
}

void LinkQuality::finish() noexcept {
  if (!talked_) return;
  counts_.until = heard_ ? std::max(last_sent_, last_arrival_) : last_sent_;
  if (heard_) {
    count_gap(silent_since(last_sent_), last_sent_);
    count_age(last_sent_, std::max(age_from_, last_sent_));
  } else {
    counts_.longest_gap = last_sent_ - counts_.from;
    counts_.longest_gap_at = counts_.from;
  }
  // A window is full when its end has been reached; the step of the last event is not complete.
  clock_.finish(counts_.until - kWindowStep, [this](std::int64_t step) { close(step); });
}

DirectionSummary LinkQuality::summary() const {
  const auto copy = std::make_unique<LinkQuality>(*this);
  copy->finish();
  DirectionSummary s = copy->counts_;
  s.delay = copy->delays_.summary();
  s.age = copy->age_.summary();
  return s;
}

}  // namespace tandem::netsim
