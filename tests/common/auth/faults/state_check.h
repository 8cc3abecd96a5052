#pragma once

#include <string>

#include "tests/common/auth/faults/state_workload.h"
#include "tests/support/file_faults.h"

namespace tandem::test {

/// Restarts without faults from the files that a part of the story left in `folder`. @return every contradiction to the
/// answers in `story`, one a line; empty: consistent. Every file name is looked up in kStateFiles.
[[nodiscard]] std::string wrong_with_server(const std::string& folder, const Story& story, const FileFault& fault);
[[nodiscard]] std::string wrong_with_session(const std::string& folder, const Story& story, const FileFault& fault);
[[nodiscard]] std::string wrong_with_workstation(const std::string& folder, const Story& story, const FileFault& fault);

/// Returns the files in `folder` that kStateFiles does not contain, one a line.
[[nodiscard]] std::string unknown_files(const std::string& folder);

}  // namespace tandem::test
