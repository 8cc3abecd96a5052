#pragma once

#include <cstdint>
#include <vector>

#include "common/base/time.h"

/// Specifications of the varying delay models.
namespace tandem::netsim {

/// One component of a hyper-exponential distribution.
struct HyperPhase {
  double weight = 1;  ///< (0, 1]; weights add up to 1
  Duration mean{};    ///< (0, 60 s]

  friend bool operator==(const HyperPhase&, const HyperPhase&) = default;
};
/// Point of a tabulated quantile function: P(delay <= `delay`) = `p`.
struct QuantilePoint {
  double p = 0;      ///< [0, 1]
  Duration delay{};  ///< [0, 60 s]

  friend bool operator==(const QuantilePoint&, const QuantilePoint&) = default;
};

/// Distribution of the varying delay, which is added to the floor.
struct BodySpec {
  enum class Kind : std::uint8_t {
    kNone,
    kUniform,           ///< uniform in [`low`, `high`]
    kLogNormal,         ///< `scale` exp(`shape` z); `scale` is the median
    kLogLogistic,       ///< `scale` (u / (1 - u))^(1 / `shape`); `scale` is the median
    kTruncatedNormal,   ///< normal with mean `scale` and standard deviation `sd`, conditioned on [`low`, `cap`] (not
                        ///< clipped)
    kExponential,       ///< mean `scale`
    kGamma,             ///< `shape`, `scale`; the mean is shape times scale
    kHyperExponential,  ///< `phases`; mixture of exponentials
    kPareto,            ///< `scale` (1 - u)^(-1 / `shape`); `scale` is the minimum
    kEmpirical,         ///< `quantiles`, interpolated linearly
  };
  Kind kind = Kind::kNone;
  Duration low{}, high{};  ///< [0, 60 s], low <= high
  Duration scale{};        ///< (0, 60 s]; kTruncatedNormal [0, 60 s]
  double shape = 1;        ///< log-normal [0, 5], log-logistic, gamma, Pareto [0.5, 100]
  Duration cap{};          ///< longest value (0, 60 s]; mandatory for all kinds except kUniform and kEmpirical
  /// Correlation time of the underlying Gaussian process: 0, or [10 us, 10 s]. With 0 every datagram draws
  /// independently. The marginal distribution of the delay does not depend on tau. With tau > 0 the delay is a function
  /// of time and does not depend on the traffic.
  Duration tau{};
  Duration sd{};                              ///< (0, 60 s]
  std::vector<HyperPhase> phases = {};        ///< [1, 8]
  std::vector<QuantilePoint> quantiles = {};  ///< [2, 4096]; p ascends from 0 to 1; the delay never decreases

  [[nodiscard]] Duration longest() const noexcept {
    if (kind == Kind::kNone) return Duration::zero();
    if (kind == Kind::kUniform) return high;
    if (kind == Kind::kEmpirical) return quantiles.empty() ? Duration::zero() : quantiles.back().delay;
    return cap;
  }
  friend bool operator==(const BodySpec&, const BodySpec&) = default;
};

/// One regime of a network. A regime lasts an exponentially distributed time; its successor is any other regime with
/// equal probability.
struct RegimeSpec {
  Duration mean{};   ///< [1 ms, 1 h]
  Duration floor{};  ///< added to the floor of the path during this regime [0, 60 s]
  BodySpec body = {};

  friend bool operator==(const RegimeSpec&, const RegimeSpec&) = default;
};

/// Disturbance with a fixed period, for example satellite link rescheduling or beacons.
struct BoundarySpec {
  Duration period{};                   ///< 0: off; else [1 ms, 1 h]
  Duration phase{};                    ///< time of the first boundary [0, period)
  Duration stall_low{}, stall_high{};  ///< each boundary begins a stall of uniform length; high < period
  Duration floor_high{};               ///< between boundaries, an additional delay uniform in [0, floor_high] [0, 60 s]
  Duration loss_window{};  ///< `loss` applies to datagrams sent within this time after a boundary [0, period]
  double loss = 0;         ///< probability of loss in `loss_window` [0, 1]

  friend bool operator==(const BoundarySpec&, const BoundarySpec&) = default;
};

/// Aggregation: datagrams leave only at multiples of a period. Examples: 802.11 A-MPDU, TDD grids, USB polling.
struct SlotsSpec {
  Duration period{};            ///< 0: off; else [1 us, 10 s]
  std::uint32_t datagrams = 0;  ///< maximum per slot; 0: no limit
  std::uint64_t bytes = 0;      ///< maximum payload bytes per slot; 0: no limit. One datagram always fits.

  friend bool operator==(const SlotsSpec&, const SlotsSpec&) = default;
};

}  // namespace tandem::netsim
