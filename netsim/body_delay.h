#pragma once

#include <cstdint>
#include <optional>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/gaussian_process.h"
#include "netsim/path_spec.h"
#include "netsim/quantile_table.h"

namespace tandem::netsim {

/// The varying part of the delay: a distribution, and how fast it changes (Gaussian copula: the marginal is kept).
class BodyDelay {
 public:
  BodyDelay(const BodySpec& spec, RandomKey key);

  /// @param t      when the datagram leaves the queue
  /// @param index  of the datagram; used when tau = 0
  /// @return       [0, cap]
  [[nodiscard]] Duration at(Time t, std::uint64_t index) noexcept {
    return spec_.kind == BodySpec::Kind::kNone ? Duration::zero() : drawn(t, index);
  }

 private:
  [[nodiscard]] Duration drawn(Time t, std::uint64_t index) noexcept;
  [[nodiscard]] double value(double u) const noexcept;
  [[nodiscard]] double recorded(double u) const noexcept;

  BodySpec spec_;
  double low_, scale_, cap_;       ///< [ns]
  double u_low_ = 0, u_high_ = 1;  ///< kTruncatedNormal: the part of the normal that is kept
  RandomKey key_;
  std::optional<GaussianProcess> process_;
  std::optional<QuantileTable> table_;
};

}  // namespace tandem::netsim
