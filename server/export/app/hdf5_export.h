#pragma once

#include <string>

#include "proto/spec/lesson.h"
#include "server/export/app/pending_path.h"

namespace tandem::server {

/// Writes a lesson as HDF5: one dataset per signal in the groups `session`, `seats/NAME` and `tools/NAME`, in SI units,
/// with the attributes `unit`, `frame`, `description` and, for several numbers per tick, `columns`. Further datasets:
/// `gaps` (first missing tick, number of ticks), `links`, `events`, `marks`, `sheets`, `channels`, `scene`. Metadata
/// are attributes of the root and of the group `metadata`.
/// @pre lesson_problem(lesson).empty()
/// @return the error, empty if the file is complete
[[nodiscard]] std::string export_hdf5(const Lesson& lesson, const std::string& file, const ExportProgress& progress);

}  // namespace tandem::server
