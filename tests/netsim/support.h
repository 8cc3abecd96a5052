#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/engine/path.h"
#include "netsim/models/path_spec.h"

/// Support for simulator tests. Times are written as 5 ms, 20 us.
namespace tandem::netsim::test {

using namespace std::chrono_literals;

inline constexpr std::size_t kSize = 128;

/// Returns bytes that differ between datagrams.
inline std::vector<std::byte> datagram(std::uint64_t number, std::size_t size = kSize) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(number >> (8 * (i % 8)));
  return bytes;
}

/// Returns a path as the n-th link of a network with this seed.
inline Path path_of(const PathSpec& spec, std::uint64_t seed = 7, std::uint64_t link = 0) {
  return {spec, Path::key_for(seed, link, Direction::kUp)};
}

/// Returns the verdicts of a path on `count` datagrams sent every `period` from time 0.
inline std::vector<PathDecision> decisions(Path path, std::size_t count, Duration period = 1ms,
                                           std::size_t size = kSize) {
  std::vector<PathDecision> all;
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(path.send(Time{period * static_cast<std::int64_t>(i)}, size));
    all.back().released = {};  // valid only until the next call
  }
  return all;
}

inline std::size_t count_of(const std::vector<PathDecision>& all, Outcome outcome) {
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [outcome](const PathDecision& v) { return v.outcome == outcome; }));
}

/// Returns the delays of delivered datagrams [ns], for datagrams sent every `period`.
inline std::vector<double> delays(const std::vector<PathDecision>& all, Duration period = 1ms) {
  std::vector<double> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (dropped(all[i].outcome)) continue;
    out.push_back(static_cast<double>((all[i].at - Time{period * static_cast<std::int64_t>(i)}).count()));
  }
  return out;
}

/// Returns the largest distance between the distribution of `samples` and `cdf` [Kolmogorov-Smirnov].
inline double ks_distance(std::vector<double> samples, const std::function<double(double)>& cdf) {
  std::sort(samples.begin(), samples.end());
  const double n = static_cast<double>(samples.size());
  double worst = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double f = cdf(samples[i]);
    const double below = static_cast<double>(i) / n;
    worst = std::max({worst, std::abs(f - below), std::abs(f - below - 1 / n)});
  }
  return worst;
}

inline double quantile(std::vector<double> samples, double q) {
  std::sort(samples.begin(), samples.end());
  return samples[static_cast<std::size_t>(q * static_cast<double>(samples.size() - 1))];
}

/// Returns whether k of n is within `sigmas` of a binomial distribution with probability p.
inline bool binomial_fits(std::size_t k, std::size_t n, double p, double sigmas = 4.9) {  // two-sided 1e-6
  const double mean = static_cast<double>(n) * p;
  return std::abs(static_cast<double>(k) - mean) <= sigmas * std::sqrt(mean * (1 - p)) + 1;
}

/// Returns a path with every model enabled, for property tests.
inline PathSpec everything() {
  PathSpec spec;
  spec.outages = {{.start = 2s, .length = 300ms, .period = 3s},
                  {.start = 1s, .length = 100ms, .period = 2s, .mode = OutageSpec::Mode::kHold, .hold_bytes = 8000}};
  spec.loss = {.probability = 0.02,
               .periods = BadPeriodsSpec{.good_mean = 500ms, .bad_mean = 20ms, .loss_good = 0, .loss_bad = 0.5}};
  spec.rate = {.bits_per_s = 2'000'000, .queue_bytes = 20'000, .queue_wait = 200ms};
  spec.floor = 5ms;
  spec.body = {.kind = BodySpec::Kind::kLogNormal, .scale = 4ms, .shape = 0.8, .cap = 60ms, .tau = 20ms};
  spec.stall = {.rate_per_s = 1, .length_min = 10ms, .alpha = 1.5, .cap = 200ms};
  spec.reorder = {.probability = 0.02, .displacement = 3, .hold_limit = 50ms};
  spec.duplicate = {.probability = 0.03, .delay_max = 2ms};
  return spec;
}

/// Running digest of decisions; equal digests mean equal logs.
class Digest {
 public:
  void add(std::uint64_t value) noexcept { state_ = mix64(state_ ^ value); }
  void add(const PathDecision& v) noexcept {
    add(v.index);
    add(static_cast<std::uint64_t>(v.outcome));
    add(static_cast<std::uint64_t>(v.at.time_since_epoch().count()));
    add(v.copied ? 1 + static_cast<std::uint64_t>(v.copy_delay.count()) : 0);
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return state_; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace tandem::netsim::test
