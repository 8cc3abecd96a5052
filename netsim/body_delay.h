#pragma once

#include <cstdint>
#include <optional>

#include "common/base/rng.h"
#include "common/base/time.h"
#include "netsim/gaussian_process.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// The varying part of the delay: a distribution, and how fast it changes (Gaussian copula: the marginal is kept).
class BodyDelay {
 public:
  BodyDelay(const BodySpec& spec, RandomKey key) noexcept;

  /// @param t      when the datagram leaves the queue
  /// @param index  of the datagram; used when tau = 0
  /// @return       [0, cap]
  [[nodiscard]] Duration at(Time t, std::uint64_t index) noexcept {
    return kind_ == BodySpec::Kind::kNone ? Duration::zero() : drawn(t, index);
  }

 private:
  [[nodiscard]] Duration drawn(Time t, std::uint64_t index) noexcept;

  BodySpec::Kind kind_;
  double low_, width_, scale_, shape_, cap_;  ///< [ns]
  RandomKey key_;
  std::optional<GaussianProcess> process_;
};

}  // namespace tandem::netsim
