#pragma once

#include <cmath>
#include <limits>

#include "proto/spec/lesson.h"

/// Arithmetic of triples, for the scores.
namespace tandem::netsim::score {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr LessonTriple kUnknownTriple{kUnknown, kUnknown, kUnknown};

[[nodiscard]] inline double dot(const LessonTriple& a, const LessonTriple& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline double length(const LessonTriple& a) noexcept { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline LessonTriple minus(const LessonTriple& a, const LessonTriple& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline double distance(const LessonTriple& a, const LessonTriple& b) noexcept {
  return length(minus(a, b));
}
[[nodiscard]] inline bool known(const LessonTriple& a) noexcept {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}
/// Returns the value at a share `w` [0, 1] of the way from `a` to `b`. At an end the other value does not matter, even
/// if it is NaN.
[[nodiscard]] inline double interpolated(double a, double b, double w) noexcept {
  return w == 0 ? a : w == 1 ? b : a + w * (b - a);
}
[[nodiscard]] inline LessonTriple interpolated(const LessonTriple& a, const LessonTriple& b, double w) noexcept {
  return {interpolated(a[0], b[0], w), interpolated(a[1], b[1], w), interpolated(a[2], b[2], w)};
}

}  // namespace tandem::netsim::score
