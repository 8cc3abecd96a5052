#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/port_sample.h"
#include "common/base/rng.h"

namespace tandem::test {

inline constexpr double kT = 0.001;  ///< tick [s]
inline constexpr std::size_t kDof = 3;

/// Hostile network: random delay up to 300 ms (so: reordering), duplicates, 90 % loss at times, 1 s holds, and energies
/// older than the positions.
class Enemy {
 public:
  explicit Enemy(std::uint64_t seed) : random_(seed), loss_(random_.below(3) == 0 ? 0.9 : random_.uniform(0, 0.5)) {}
  /// A friend: every sample arrives once, after the same delay [ticks].
  Enemy(std::uint64_t seed, int delay) : random_(seed), loss_(0), delay_(delay) {}

  void send(int now, const PortSample& sample) {
    if (delay_ > 0) {
      flying_.push_back({now + delay_, now, sample});
      return;
    }
    if (random_.below(1500) == 0) hold_until_ = now + 1000;
    if (random_.below(600) == 0)
      spread_ = random_.below(2) == 0 ? 300 : 1 + random_.below(30);  // stiffness falls and rises
    const int copies = random_.uniform() < loss_ ? 0 : random_.below(10) == 0 ? 3 : 1;
    past_[static_cast<std::size_t>(now) % past_.size()] = sample.e_in;
    for (int i = 0; i < copies; ++i) {
      Flying f{std::max(now + 1 + static_cast<int>(random_.below(spread_)), hold_until_), now, sample};
      if (random_.below(5) == 0)
        f.sample.e_in =
            past_[random_.below(std::min<std::uint64_t>(past_.size(), static_cast<std::uint64_t>(now) + 1))];
      flying_.push_back(f);
    }
  }
  /// Returns the sample accepted at `now`. Usually the newest sample wins; the network also replays old positions.
  std::optional<PortSample> receive(int now) {
    std::optional<PortSample> got;
    for (std::size_t i = 0; i < flying_.size();) {
      if (flying_[i].due > now) {
        ++i;
        continue;
      }
      if (flying_[i].sent > newest_ || random_.below(20) == 0) {
        newest_ = std::max(newest_, flying_[i].sent);
        age_at_arrival = (now - flying_[i].sent) * kT;
        got = flying_[i].sample;
      }
      flying_[i] = flying_.back();
      flying_.pop_back();
    }
    return got;
  }
  double age_at_arrival = 0.15;

 private:
  struct Flying {
    int due, sent;
    PortSample sample;
  };
  RandomStream random_;
  double loss_;
  int delay_ = 0;  ///< 0: hostile
  std::uint64_t spread_ = 300;
  int hold_until_ = 0, newest_ = -1;
  std::vector<Flying> flying_;
  std::array<EnergyArray, 2048> past_{};
};

}  // namespace tandem::test
