#pragma once

#include <span>

#include "proto/spec/lesson.h"

namespace tandem::netsim::score {

/// Volume of the convex hull of points [m^3]. Points in one plane, or fewer than four, have none: 0.
/// Points that are not finite are left out. Computed by Qhull [Barber, Dobkin & Huhdanpaa 1996].
[[nodiscard]] double hull_volume(std::span<const LessonTriple> points);

}  // namespace tandem::netsim::score
