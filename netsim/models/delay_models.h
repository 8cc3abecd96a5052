#pragma once

#include <cstdint>
#include <vector>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/models/body_delay.h"
#include "netsim/models/body_spec.h"

/// Delay models other than floor, body and stalls.
namespace tandem::netsim {

/// Sequence of regimes and their delay, as a function of time. Time is divided into blocks of 256 mean cycles. Each
/// block starts from the stationary distribution, so that a jump in time costs a bounded number of draws.
class Regimes {
 public:
  Regimes(const std::vector<RegimeSpec>& specs, RandomKey key);

  /// @param t  any time; cheap if non-decreasing over calls
  [[nodiscard]] Duration at(Time t, std::uint64_t index) noexcept {
    return regimes_.empty() ? Duration::zero() : drawn(t, index);
  }
  /// @param t  non-decreasing within a block
  [[nodiscard]] std::size_t state_at(Time t) noexcept;

 private:
  static constexpr std::uint64_t kDrawBits = 14;
  struct Regime {
    double mean;  ///< [ns]
    Duration floor;
    BodyDelay body;
  };
  [[nodiscard]] Duration drawn(Time t, std::uint64_t index) noexcept;
  void next() noexcept;

  std::vector<Regime> regimes_;
  RandomKey state_key_, length_key_;
  double mean_sum_ = 0;
  Duration block_length_{1};
  std::int64_t block_ = -1;
  std::uint64_t draw_ = 0;
  std::size_t state_ = 0;
  Time begin_{}, end_{};
};

/// Periodic disturbance, see BoundarySpec.
class Boundary {
 public:
  Boundary(const BoundarySpec& spec, RandomKey key) noexcept;

  [[nodiscard]] bool lost(Time now, std::uint64_t index) const noexcept {
    return spec_.loss > 0 && since(now) < spec_.loss_window && loss_key_.uniform(index) < spec_.loss;
  }
  /// Returns the delay added to the floor for a datagram sent at `t`.
  [[nodiscard]] Duration floor(Time t) const noexcept;
  /// Returns the departure time of a datagram that would otherwise leave at `t`.
  [[nodiscard]] Time release(Time t) const noexcept;

 private:
  /// Number of the last boundary at or before `t`, from 0; -1 before the first boundary.
  [[nodiscard]] std::int64_t number(Time t) const noexcept;
  [[nodiscard]] Duration since(Time t) const noexcept;

  BoundarySpec spec_;
  RandomKey loss_key_, stall_key_, floor_key_;
};

/// Aligns departures to a slot grid, see SlotsSpec.
class Slots {
 public:
  explicit Slots(const SlotsSpec& spec) noexcept : spec_(spec) {}

  /// @param due  non-decreasing over calls
  [[nodiscard]] Time release(Time due, std::size_t size) noexcept;

 private:
  SlotsSpec spec_;
  std::int64_t slot_ = -1;
  std::uint64_t datagrams_ = 0, bytes_ = 0;
};

}  // namespace tandem::netsim
