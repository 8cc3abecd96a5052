#pragma once

#include <cstdint>
#include <vector>

#include "common/base/time.h"

/// Delay that varies, as plain numbers.
namespace tandem::netsim {

/// One of the exponentials of a hyper-exponential.
struct HyperPhase {
  double weight = 1;  ///< (0, 1]; weights add up to 1
  Duration mean{};    ///< (0, 60 s]

  friend bool operator==(const HyperPhase&, const HyperPhase&) = default;
};
struct QuantilePoint {
  double p = 0;      ///< [0, 1]
  Duration delay{};  ///< [0, 60 s]

  friend bool operator==(const QuantilePoint&, const QuantilePoint&) = default;
};

/// Delay that varies, added to the floor.
struct BodySpec {
  enum class Kind : std::uint8_t {
    kNone,
    kUniform,           ///< `low` ... `high`
    kLogNormal,         ///< `scale` exp(`shape` z): scale is the median
    kLogLogistic,       ///< `scale` (u / (1 - u))^(1 / `shape`): scale is the median
    kTruncatedNormal,   ///< normal of mean `scale` and `sd`, only what is in [`low`, `cap`]: drawn, not clipped
    kExponential,       ///< mean `scale`
    kGamma,             ///< `shape`, `scale`: mean shape scale
    kHyperExponential,  ///< `phases`: one of several exponentials
    kPareto,            ///< `scale` (1 - u)^(-1 / `shape`): scale is the least
    kEmpirical,         ///< `quantiles`, linear between
  };
  Kind kind = Kind::kNone;
  Duration low{}, high{};  ///< [0, 60 s], low <= high
  Duration scale{};        ///< (0, 60 s]; kTruncatedNormal [0, 60 s]
  double shape = 1;        ///< log-normal [0, 5], log-logistic, gamma, Pareto [0.5, 100]
  Duration cap{};          ///< longest value; mandatory for all kinds but kUniform and kEmpirical (0, 60 s]
  /// Correlation time of the underlying Gaussian process. The distribution of the delay does not depend on it, and its
  /// course is a function of time, not of the packets. 0: every datagram draws for itself. Else [10 us, 10 s].
  Duration tau{};
  Duration sd{};                              ///< (0, 60 s]
  std::vector<HyperPhase> phases = {};        ///< [1, 8]
  std::vector<QuantilePoint> quantiles = {};  ///< [2, 4096]; p ascends from 0 to 1, delay never falls

  [[nodiscard]] Duration longest() const noexcept {
    if (kind == Kind::kNone) return Duration::zero();
    if (kind == Kind::kUniform) return high;
    if (kind == Kind::kEmpirical) return quantiles.empty() ? Duration::zero() : quantiles.back().delay;
    return cap;
  }
  friend bool operator==(const BodySpec&, const BodySpec&) = default;
};

/// One of several states of a network, each lasting an exponential time; the next is any of the others, equally likely.
struct RegimeSpec {
  Duration mean{};   ///< [1 ms, 1 h]
  Duration floor{};  ///< added to the path's floor while it lasts [0, 60 s]
  BodySpec body = {};

  friend bool operator==(const RegimeSpec&, const RegimeSpec&) = default;
};

/// What happens again and again at the same moments: the link is planned anew (satellites), a beacon.
struct BoundarySpec {
  Duration period{};                   ///< 0: off; else [1 ms, 1 h]
  Duration phase{};                    ///< of the first boundary [0, period)
  Duration stall_low{}, stall_high{};  ///< nothing leaves for a uniform time from the boundary; high < period
  Duration floor_high{};               ///< between boundaries a delay uniform in [0, this] is added [0, 60 s]
  Duration loss_window{};              ///< what is sent within this from a boundary, is lost [0, period]
  double loss = 0;                     ///< with this probability [0, 1]

  friend bool operator==(const BoundarySpec&, const BoundarySpec&) = default;
};

/// Datagrams leave at multiples of a period only, as aggregates: 802.11 A-MPDU, TDD grids, USB polling.
struct SlotsSpec {
  Duration period{};            ///< 0: off; else [1 us, 10 s]
  std::uint32_t datagrams = 0;  ///< at most this many per slot; 0: no limit
  std::uint64_t bytes = 0;      ///< at most so many payload bytes; 0: no limit. One datagram always fits.

  friend bool operator==(const SlotsSpec&, const SlotsSpec&) = default;
};

}  // namespace tandem::netsim
