#pragma once

#include <expected>
#include <functional>
#include <string>
#include <vector>

#include "proto/spec/lesson.h"

namespace tandem::netsim {

/// One or more files that may be a lesson.
struct LessonFile {
  std::string name;
  bool of_folder = false;           ///< found in a folder that was named
  std::vector<std::string> more{};  ///< the further parts of a long recording, in their order
  std::string note{};               ///< why parts are missing; empty: none is
};

/// Reads a lesson: a recording (MCAP), its export as HDF5, rows of `--trace` as CSV, or a table of recorded motion
/// (netsim/score/motion_lesson.h). The content decides, not the name.
/// @param scene  file or shipped name of the scene of a trace; unused for other files
/// Error: one line with the file, and line, column and value where the content is wrong;
/// of HDF5 the dataset.
[[nodiscard]] std::expected<Lesson, std::string> load_lesson(const LessonFile& file, const std::string& scene);

/// Returns the lessons that the arguments name: files as they are, of a folder those that end in `.csv`, `.h5`,
/// `.hdf5` or `.mcap`, sorted by name. The parts of a long recording are one lesson: those that lie beside a part
/// belong to it. Error: a folder without recordings, or one that cannot be read.
[[nodiscard]] std::expected<std::vector<LessonFile>, std::string> lesson_files(const std::vector<std::string>& paths);

}  // namespace tandem::netsim
