#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "netsim/system/observed_seat.h"
#include "netsim/system/simulation.h"
#include "tests/support/simulation_run.h"

namespace tandem::netsim {

/// A simulation whose checkers can be given another scene than the one that it runs. Judged by a stricter scene, a
/// correct system breaks rules.
class ObservedRun {
 public:
  explicit ObservedRun(const SimulationConfig& config) : judged(config.scene), simulation_(*Simulation::make(config)) {}
  explicit ObservedRun(const SceneSpec& scene) : ObservedRun(SimulationConfig{.scene = scene}) {}

  /// Runs for `length_s` and calls `check` for every seat after each tick.
  void run(double length_s, const std::function<void(const ObservedSeat&)>& check = {}) {
    const Time end = simulation_->now() + from_seconds(length_s);
    was_active_.resize(judged.seats.size());
    while (simulation_->now() < end && simulation_->step()) {
      for (std::size_t i = 0; i < judged.seats.size(); ++i) {
        const ObservedSeat seat = observed(i);
        if (check) check(seat);
        if (seat.client.seat() != nullptr && seat.client.ran_in_tick()) was_active_[i] = seat.core().gate().active();
      }
    }
  }
  /// Runs likewise, and calls `check` only where the client ran.
  void run_clients(double length_s, const std::function<void(const ObservedSeat&)>& check) {
    run(length_s, [&](const ObservedSeat& seat) {
      if (seat.client.seat() != nullptr && seat.client.ran_in_tick()) check(seat);
    });
  }
  [[nodiscard]] ObservedSeat observed(std::size_t i) {
    return {judged,
            i,
            simulation_->client(i),
            simulation_->session(),
            violations,
            i < was_active_.size() && was_active_[i]};
  }
  /// Returns the number of violations of an invariant, at all seats.
  [[nodiscard]] std::uint64_t count(std::string_view invariant) const {
    std::uint64_t sum = 0;
    for (const server::Violation& v : violations.list()) sum += v.invariant == invariant ? v.count : 0;
    return sum;
  }
  [[nodiscard]] Simulation& simulation() noexcept { return *simulation_; }

  SceneSpec judged;  ///< scene of the checkers
  server::Violations violations;

 private:
  std::unique_ptr<Simulation> simulation_;
  std::vector<bool> was_active_;
};

}  // namespace tandem::netsim
