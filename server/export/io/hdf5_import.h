#pragma once

#include <expected>
#include <string>

#include "proto/spec/lesson.h"

namespace tandem::server {

/// Reads a lesson from an HDF5 file that export_hdf5 wrote. Scores of it equal those of the recording, value for value.
/// Type and size of every dataset, ranges of whole numbers, the order of ticks and the list of gaps are checked.
/// libhdf5 1.10 crashes on some damaged files, so a child process reads each file first, and a crash there is an error.
/// @pre the process has one thread
/// @return the lesson, or one line with file, dataset, value and next step: libhdf5 is missing, another kind of file,
/// a dataset that is missing or damaged, a scene that is not valid
/// @throws std::bad_alloc  a row takes about 0.4 kB per seat and tool; a file has at most one row per byte
[[nodiscard]] std::expected<Lesson, std::string> import_hdf5(const std::string& file);

}  // namespace tandem::server
