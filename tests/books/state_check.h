#pragma once

#include <string>

#include "tests/books/state_story.h"
#include "tests/support/file_faults.h"

namespace tandem::test {

/// Starts anew from what a part of the story left in `folder`, without faults, and says everything that does not agree with what people
/// were told; empty: it is consistent. Every file is looked up in kStateFiles by its name.
[[nodiscard]] std::string wrong_with_server(const std::string& folder, const Story& story, const FileFault& fault);
[[nodiscard]] std::string wrong_with_session(const std::string& folder, const Story& story, const FileFault& fault);
[[nodiscard]] std::string wrong_with_workstation(const std::string& folder, const Story& story, const FileFault& fault);

/// Files in `folder` that kStateFiles does not know, one a line.
[[nodiscard]] std::string unknown_files(const std::string& folder);

}  // namespace tandem::test
