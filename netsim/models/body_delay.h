#pragma once

#include <cstdint>
#include <optional>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/models/gaussian_process.h"
#include "netsim/models/path_spec.h"
#include "netsim/models/quantile_table.h"

namespace tandem::netsim {

/// Sampler of the varying part of the delay. The marginal distribution and the correlation time are set independently
/// (Gaussian copula).
class BodyDelay {
 public:
  BodyDelay(const BodySpec& spec, RandomKey key);

  /// @param t      time at which the datagram leaves the queue
  /// @param index  index of the datagram in its flow; used only when tau = 0
  /// @return       delay in [0, cap]
  [[nodiscard]] Duration at(Time t, std::uint64_t index) noexcept {
    return spec_.kind == BodySpec::Kind::kNone ? Duration::zero() : drawn(t, index);
  }

 private:
  [[nodiscard]] Duration drawn(Time t, std::uint64_t index) noexcept;
  [[nodiscard]] double value(double u) const noexcept;
  [[nodiscard]] double recorded(double u) const noexcept;

  BodySpec spec_;
  double low_, scale_, cap_;       ///< [ns]
  double u_low_ = 0, u_high_ = 1;  ///< kTruncatedNormal: range of u that the truncation keeps
  RandomKey key_;
  std::optional<GaussianProcess> process_;
  std::optional<QuantileTable> table_;
};

}  // namespace tandem::netsim
