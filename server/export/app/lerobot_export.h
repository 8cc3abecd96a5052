#pragma once

#include <cstddef>
#include <expected>
#include <functional>
#include <memory>
#include <string>

#include "proto/recording/lesson_source.h"
#include "server/export/io/pending_path.h"
#include "server/export/lerobot_meta.h"

namespace tandem::server {

/// Lessons for a data set of LeRobot, each of which becomes an episode.
struct LerobotRequest {
  LerobotVersion version = LerobotVersion::k30;
  unsigned fps = 50;
  std::string task;          ///< subject of the lessons; empty: named after the scene of the first one
  std::size_t episodes = 0;  ///< at least 1
  /// Opens one lesson, in order, which has a row. @return the lesson, or the error with the name of its file
  std::function<std::expected<std::unique_ptr<LessonSource>, std::string>(std::size_t episode)> lesson;
};

/// Writes a data set into a new folder: `meta`, `data`, and `README.md` for the users of the data. All lessons must
/// have the seats, tools and rate of the first one.
/// @return the error, empty if the folder is complete
[[nodiscard]] std::string export_lerobot(const LerobotRequest& request, const std::string& folder,
                                         const ExportProgress& progress);

}  // namespace tandem::server
