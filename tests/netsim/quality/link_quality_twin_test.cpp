// LinkQuality against its definition, computed directly from all events.
#include <gtest/gtest.h>

#include <map>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/quality/quality_support.h"

namespace tandem::netsim {
namespace {

using namespace test;

/// Returns datagrams of a network with jitter, burst loss, reordering, copies and stalls. No pause exceeds kPause.
std::vector<Sent> random_story(std::uint64_t seed, std::size_t count) {
  RandomStream random{seed};
  std::vector<Sent> all;
  Time at{from_seconds(random.uniform(0, 3))};
  const Duration base = from_seconds(random.uniform(0, 0.3)), jitter = from_seconds(random.uniform(0, 0.02));
  const bool fifo = random.uniform() < 0.5;
  bool bad = false;
  Time released{}, last{};
  for (std::size_t i = 0; i < count; ++i) {
    at += from_seconds(random.uniform() < 0.002 ? random.uniform(0, 0.09) : random.uniform(0, 0.002));
    bad = random.uniform() < (bad ? 0.97 : 0.002);
    if (random.uniform() < 0.0005) released = at + from_seconds(random.uniform(0, 0.4));
    Sent one{at, {}};
    if (!bad || random.uniform() < 0.3) {
      Time out = std::max(at + base + from_seconds(random.uniform() * random.uniform() * seconds(jitter)), released);
      if (fifo) out = std::max(out, last);
      last = out;
      one.delays.push_back(out - at);
      if (random.uniform() < 0.02) one.delays.push_back(out - at + from_seconds(random.uniform(0, 0.05)));
    }
    all.push_back(std::move(one));
  }
  return all;
}

struct Arrival {
  Time at, sent;
  std::uint64_t index;
};

class Twin {
 public:
  explicit Twin(const std::vector<Sent>& all) : all_(all) {
    std::vector<Arrival> every;
    for (const Told& event : story(all))
      if (event.kind == 1) every.push_back({event.when, event.when - event.delay, event.index});
    std::map<std::uint64_t, int> seen;
    for (const Arrival& a : every)
      if (++seen[a.index] == 1) arrivals_.push_back(a);
    duplicates = every.size() - arrivals_.size();
    std::uint64_t next = 0;
    for (const Arrival& a : arrivals_) {
      reordered += a.index < next ? 1 : 0;
      next = std::max(next, a.index + 1);
    }
    first_ = step_of(all.front().at);
    until_ = std::max(all.back().at, arrivals_.empty() ? Time{} : arrivals_.back().at);
    gaps();
    ages();
  }

  void expect_equal(const DirectionSummary& s) const {
    EXPECT_EQ(s.duplicates, duplicates);
    EXPECT_EQ(s.reordered, reordered);
    EXPECT_EQ(s.arrived, arrivals_.size());
    EXPECT_EQ(s.until, until_);
    EXPECT_EQ(s.longest_gap, longest_);
    EXPECT_EQ(s.age.max, age_max_);
    EXPECT_EQ(s.age.watched, watched_);
    EXPECT_NEAR(s.age.mean_s, age_mean_, 1e-9);
    EXPECT_NEAR(seconds(s.age.p50), age_p50_, 0.01 * age_p50_ + 2e-5);
    EXPECT_NEAR(seconds(s.age.p99), age_p99_, 0.01 * age_p99_ + 2e-5);
    for (std::size_t w = 0; w < kWindows; ++w) windows(w, s.windows[w]);
  }

  std::uint64_t duplicates = 0, reordered = 0;

 private:
  /// Longest silence in each step: silences that ended in it, and the open one at its end.
  void gaps() {
    for (std::size_t i = 1; i < arrivals_.size(); ++i) {
      const Duration gap = arrivals_[i].at - arrivals_[i - 1].at;
      Duration& here = gap_of_step_[step_of(arrivals_[i].at)];
      here = std::max(here, gap);
      longest_ = std::max(longest_, gap);
    }
    if (!arrivals_.empty()) {  // the first one counts against the smallest possible delay
      const Duration late = all_[arrivals_[0].index].at - all_[0].at;
      gap_of_step_[step_of(arrivals_[0].at)] = std::max(gap_of_step_[step_of(arrivals_[0].at)], late);
      longest_ = std::max({longest_, late, all_.back().at - arrivals_.back().at});
    }
    std::size_t s = 0, a = 0;
    for (std::int64_t step = first_; step < step_of(until_); ++step) {
      while (s < all_.size() && step_of(all_[s].at) <= step) ++s;
      while (a < arrivals_.size() && step_of(arrivals_[a].at) <= step) ++a;
      if (a == 0 || s == 0) continue;
      gap_of_step_[step] = std::max(gap_of_step_[step], all_[s - 1].at - arrivals_[a - 1].at);
    }
  }

  void ages() {
    std::vector<std::pair<double, double>> pieces;  // of the growth of the age [s]
    Time newest{}, since{};
    bool any = false;
    double integral = 0;
    const auto piece = [&](Time until) {
      if (!any || until <= since) return;
      const double from = seconds(since - newest), to = seconds(until - newest);
      pieces.emplace_back(from, to);
      integral += (to * to - from * from) / 2;
      watched_ += until - since;
      age_max_ = std::max(age_max_, until - newest);
    };
    for (const Arrival& a : arrivals_) {
      if (any && a.sent <= newest) continue;
      piece(a.at);
      newest = a.sent;
      since = a.at;
      any = true;
    }
    piece(all_.back().at);
    age_mean_ = integral / seconds(watched_);
    // Bisection finds x so that the intervals below x have the wanted share of the time.
    const auto quantile = [&](double share) {
      double lo = 0, hi = seconds(age_max_);
      for (int i = 0; i < 60; ++i) {
        const double x = (lo + hi) / 2;
        double below = 0;
        for (const auto& [from, to] : pieces) below += std::clamp(x - from, 0.0, to - from);
        (below < share * seconds(watched_) ? lo : hi) = x;
      }
      return hi;
    };
    age_p50_ = quantile(0.5);
    age_p99_ = quantile(0.99);
  }

  void windows(std::size_t w, const WindowSummary& found) const {
    WindowSummary expected;
    const auto steps = static_cast<std::int64_t>(kWindowSteps[w]);
    const auto note = [](MeasureSummary& m, Band band, double value, Time end) {
      ++m.windows[static_cast<std::size_t>(band)];
      if (value > m.worst) m = {m.windows, value, end};
      return band;
    };
    for (std::int64_t step = first_ + steps - 1; step < step_of(until_); ++step) {
      const Time begin = end_of_step(step - steps), end = end_of_step(step);
      std::uint64_t sent = 0, lost = 0;
      const auto first = std::partition_point(all_.begin(), all_.end(), [&](const Sent& s) { return s.at < begin; });
      for (auto s = first; s != all_.end() && s->at < end; ++s) {
        ++sent;
        lost += s->delays.empty() ? 1 : 0;
      }
      std::vector<Duration> delays;
      const auto from =
          std::partition_point(arrivals_.begin(), arrivals_.end(), [&](const Arrival& a) { return a.at < begin; });
      for (auto a = from; a != arrivals_.end() && a->at < end; ++a)
        delays.push_back(DelayScale::begin_of(DelayScale::bin_of(a->at - a->sent)));
      if (sent == 0 && delays.empty()) continue;
      Duration gap{};
      for (auto g = gap_of_step_.lower_bound(step - steps + 1); g != gap_of_step_.end() && g->first <= step; ++g)
        gap = std::max(gap, g->second);
      Band band = note(expected.measures[1], band_of(gap, kGapLimits), seconds(gap), end);
      if (sent > 0) {
        const double share = static_cast<double>(lost) / static_cast<double>(sent);
        const Band of = share <= 0.001 ? Band::kGreen : share <= 0.1 ? Band::kAmber : Band::kRed;
        band = std::max(band, note(expected.measures[0], of, share, end));
      }
      if (!delays.empty()) {
        const auto rank = [&](std::size_t percent) {
          const auto nth = delays.begin() + static_cast<std::ptrdiff_t>((delays.size() * percent + 99) / 100 - 1);
          std::nth_element(delays.begin(), nth, delays.end());
          return *nth;
        };
        const Duration jitter = rank(99) - rank(50);
        band = std::max(band, note(expected.measures[2], band_of(jitter, kJitterLimits), seconds(jitter), end));
      }
      ++expected.windows;
      ++expected.bands[static_cast<std::size_t>(band)];
    }
    SCOPED_TRACE(testing::Message() << "window " << w);
    EXPECT_EQ(found.windows, expected.windows);
    EXPECT_EQ(found.bands, expected.bands);
    for (std::size_t m = 0; m < 3; ++m) {
      SCOPED_TRACE(name(static_cast<Measure>(m)));
      EXPECT_EQ(found.measures[m].windows, expected.measures[m].windows);
      EXPECT_EQ(found.measures[m].worst, expected.measures[m].worst);
      EXPECT_EQ(found.measures[m].worst_at, expected.measures[m].worst_at);
    }
  }

  const std::vector<Sent>& all_;
  std::vector<Arrival> arrivals_;  ///< without duplicates, in order of time
  std::int64_t first_ = 0;
  Time until_;
  std::map<std::int64_t, Duration> gap_of_step_;
  Duration longest_{}, age_max_{}, watched_{};
  double age_mean_ = 0, age_p50_ = 0, age_p99_ = 0;
};

TEST(LinkQualityTwin, MatchesInEveryWindow) {
  const std::uint64_t count = tandem::test::seeds(12);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const auto all = random_story(seed, 13'000);
    const DirectionSummary found = judged(all).summary();
    ASSERT_GT(found.windows[2].windows, 100U);
    Twin(all).expect_equal(found);
    if (HasFailure()) return;
  }
}

TEST(LinkQualityTwin, MatchesForLateReports) {
  // A network is polled once per tick: arrivals are reported up to 5 ms after a later sending.
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const auto all = random_story(100 + seed, 13'000);
    auto told = story(all);
    std::stable_sort(told.begin(), told.end(), [](const Told& a, const Told& b) {
      const auto key = [](const Told& t) {
        return t.kind == 0 ? t.when : Time{(t.when.time_since_epoch() / 5ms + 1) * 5ms};
      };
      return key(a) < key(b);
    });
    LinkQuality quality;
    for (const Told& event : told) tell(quality, event, all);
    Twin(all).expect_equal(quality.summary());
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace tandem::netsim
