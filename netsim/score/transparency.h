#pragma once

#include <vector>

#include "netsim/score/part_scores.h"

namespace tandem::netsim::score {

/// Transparency of a hand in contact: the impedance that the hand feels over that of the environment, |Z_t / Z_e| with
/// Z = F / v along the surface's normal, median over the frequencies from 0.5 to 10 Hz at which force and velocity are
/// coherent (above 0.8) on both sides. 1 is ideal; above it the hand feels more than the tool.
/// Both impedances are S_vF / S_vv of the values as recorded, averaged to at most 100 Hz, over windows of 1.28 s
/// (Hann, half overlapping) of the contacts. NaN: fewer than 8 windows, or no coherent frequency.
/// Source: Lawrence 1993, "Stability and transparency in bilateral teleoperation" (Z_t, Z_e); Welch 1967 (spectra).
[[nodiscard]] double impedance_ratio(const PartInput& in);

}  // namespace tandem::netsim::score
