#pragma once

#include <span>
#include <vector>

#include "proto/spec/lesson.h"

/// Filters and derivatives of evenly sampled signals, after the fact. Pure functions.
namespace tandem::netsim::score {

/// Low-pass without phase: a Butterworth filter of order 2 runs forward and backward, so that order 4 results. The
/// amplitude at `cutoff_hz` is 1/sqrt(2) of the input's after both passes. The signal is continued at its ends by its
/// point reflection. Signals of fewer than 4 values, and rates below 2.5 times the cut-off, stay as they are.
/// Source: Winter, "Biomechanics and Motor Control of Human Movement", chapter 3 (filter, and correction for 2 passes).
void low_pass(std::span<double> signal, double cutoff_hz, double rate_hz);

/// The same for each component.
void low_pass(std::span<LessonTriple> signal, double cutoff_hz, double rate_hz);

/// First derivative by central differences, one-sided at both ends [1/s].
[[nodiscard]] std::vector<LessonTriple> derivative(std::span<const LessonTriple> signal, double rate_hz);
[[nodiscard]] std::vector<double> derivative(std::span<const double> signal, double rate_hz);

/// Squared length of the third derivative by central differences [1/s^6]. The result has 4 values less; value k belongs
/// to sample k + 2. Fewer than 5 samples: empty.
[[nodiscard]] std::vector<double> squared_jerk(std::span<const LessonTriple> position, double rate_hz);

}  // namespace tandem::netsim::score
