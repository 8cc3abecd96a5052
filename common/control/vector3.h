#pragma once

#include <array>

#include "common/base/axes.h"

namespace tandem::control {

/// A vector in the frame of the tool's port: position [m], velocity [m/s] or force [N].
using Vector3 = std::array<double, 3>;

/// Returns the scalar product.
[[nodiscard]] constexpr double dot(const Vector3& a, const Vector3& b) noexcept TANDEM_REALTIME {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace tandem::control
