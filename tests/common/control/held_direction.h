#pragma once

#include <algorithm>
#include <cstdint>

#include "common/control/send_pace.h"
#include "tests/common/control/energy_oracle.h"
#include "tests/common/control/hostile_network.h"

namespace tandem::test {

/// One direction of the channel: holds samples back at the sender and predicts them at the receiver, if the trial asks
/// for it.
class HeldDirection {
 public:
  HeldDirection(const Trial& trial, bool to_client, double stiffness)
      : trial_(&trial), to_client_(to_client), held_(kHeartbeat * kT, trial.order) {
    control::SendPace::Params p;
    p.heartbeat = kHeartbeat;
    p.order = trial.order;
    p.stiffness = stiffness;
    p.energy = static_cast<std::uint64_t>(1e8 * kInitialEnergy);
    p.force_is_place = to_client && trial.law == "replica";
    p.force_acts = trial.law != "replica";
    pace_ = control::SendPace(p, 1);
  }
  /// Whether the sample of this tick is sent.
  bool due(int now, const PortSample& sample) {
    const auto tick = static_cast<std::uint32_t>(now);
    ++ticks_;
    const bool authority_moved = to_client_ && sample.a[0] != authority_;  // travels in `a`
    if (trial_->dead_band && !authority_moved && !pace_.overdue(tick) && !pace_.noticeable(tick, 0, sample, 0))
      return false;
    authority_ = sample.a[0];
    pace_.record(0, sample);
    pace_.sent(tick);
    ++sent_;
    return true;
  }
  /// Takes a sample that arrived.
  void received(const PortSample& sample) {
    for (std::size_t a = 0; a < kDof; ++a)
      rate_[a] = static_cast<double>(std::max(sample.e_in[a], energy_[a]) - energy_[a]) /
                 std::max(1.0, silence_ / kT);  // [nJ per tick]
    energy_ = sample.e_in;
    silence_ = 0;
    held_.restart();
  }
  /// Advances the newest sample at the receiver by one tick. @return time by which its age is reduced [s]
  double predict(PortSample& sample) {
    if (!trial_->dead_band) return 0;
    silence_ += kT;
    const double step = held_.advance(silence_);
    held_.predict(sample, kDof, step);
    for (std::size_t a = 0; trial_->predicts_energy && a < kDof; ++a)
      sample.e_in[a] += static_cast<std::uint64_t>(rate_[a] * step / kT);
    return held_.held();
  }
  [[nodiscard]] double share() const { return sent_ / ticks_; }

 private:
  static constexpr std::uint32_t kHeartbeat = 16;
  const Trial* trial_;
  bool to_client_;
  control::SendPace pace_{{}, 1};
  control::HeldSample held_;
  double silence_ = 0, authority_ = 1, sent_ = 0, ticks_ = 0;
  EnergyArray energy_{};
  std::array<double, kDof> rate_{};
};

}  // namespace tandem::test
