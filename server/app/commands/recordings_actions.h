#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/archive/recording_row.h"
#include "server/export/lerobot_meta.h"

/// The actions of `tandem-server recordings`, called after the arguments were checked. Each returns the exit code.
namespace tandem::server {

/// Formats of an export.
enum class ExportFormat : std::uint8_t { kCsv, kHdf5, kLerobot21, kLerobot30 };

struct RecordingsTask {
  std::string folder;              ///< --dir
  std::vector<std::string> names;  ///< files, or a person
  std::string state;               ///< --state
  bool yes = false, json = false;
  RetentionLimits limits;
  ExportFormat format = ExportFormat::kCsv;
  std::string to, task;
  unsigned fps = 50;
  bool one_file = false;  ///< --one-file: each named file is a lesson of its own
};

[[nodiscard]] int list_recordings(const RecordingsTask& task);
[[nodiscard]] int show_recordings(const RecordingsTask& task);
[[nodiscard]] int delete_recordings(const RecordingsTask& task);
[[nodiscard]] int retain_recordings(const RecordingsTask& task);
[[nodiscard]] int forget_person(const RecordingsTask& task);
[[nodiscard]] int export_recordings(const RecordingsTask& task);

}  // namespace tandem::server
