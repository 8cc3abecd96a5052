#pragma once

#include <string>
#include <string_view>

#include "proto/recording/lesson_source.h"
#include "server/export/io/pending_path.h"

namespace tandem::server {

/// Attribute `format` of the root.
inline constexpr std::string_view kHdf5Format = "tandem-lesson-1";
/// Divisors of the values of links. A quotient is rounded once, so a reader finds the recorded value.
inline constexpr double kMillisecondsPerSecond = 1e3, kPercent = 100;

/// Writes a lesson as HDF5: one dataset per signal in the groups `session`, `seats/NAME` and `tools/NAME`, in SI units,
/// with the attributes `unit`, `frame`, `description` and, for several numbers per tick, `columns`. Further datasets:
/// `gaps` (first missing tick, number of ticks), `links`, `events`, `marks`, `sheets`, `channels`, `scene`. Metadata
/// are attributes of the root and of the group `metadata`.
/// @pre lesson_problem(lesson).empty()
/// @return the error, empty if the file is complete
[[nodiscard]] std::string export_hdf5(LessonSource& lesson, const std::string& file, const ExportProgress& progress);

}  // namespace tandem::server
