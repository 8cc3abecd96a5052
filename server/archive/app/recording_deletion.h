#pragma once

#include <expected>
#include <functional>
#include <string>

#include "server/archive/app/recording_index.h"

namespace tandem::server {

/// Writes one audit line: event, name, detail. @return the error, empty if the line is on disk
using AuditLine = std::function<std::string(const char* event, const std::string& name, const std::string& detail)>;

/// Deletes a recording and its row. The audit line `recording_deleted` is on disk before the file is gone; without it
/// nothing is deleted. If the file then cannot be deleted, the line `recording_kept` follows. A process killed in
/// between leaves a file without a row or a row without a file, which the next scan corrects.
/// @param reason  part of the audit line, without names of persons: `on request`, `retention`, `a person's request`
/// @return        the error, empty if file and row are gone
[[nodiscard]] std::string delete_recording(const std::string& folder, RecordingIndex& index, const RecordingRow& row,
                                           const std::string& reason, const AuditLine& audit);

}  // namespace tandem::server
