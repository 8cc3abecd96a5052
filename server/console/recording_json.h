#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/rpc/rpc_limits.h"
#include "server/console/recording_outline.h"

/// Replies about recordings to the page, as JSON texts (PROTOCOL.md). A value that is not known is null. Texts of
/// participants are valid UTF-8 afterwards.
namespace tandem::console {

/// One recording of the list.
struct ListedRecording {
  std::string id{}, file{};            ///< `file` is for display
  std::uint64_t bytes = 0, files = 1;  ///< of all files
  std::string parts_problem{};         ///< which file is missing; empty: none is known to be
  std::string problem{};               ///< why it cannot be read; empty: it can, and the members below are valid
  std::string session{}, scene{};
  double start_s = 0;  ///< seconds since 1970; 0: unknown
  double duration_s = 0;
  std::uint64_t missing_ticks = 0;
  bool complete = true;
  std::vector<std::string> persons{};
};

struct RecordingList {
  std::vector<ListedRecording> recordings;
  std::uint64_t left_out = 0;           ///< recordings beyond those of the list
  std::uint64_t read = 0, to_read = 0;  ///< files of the folder that are being read; both 0: all of them were
  std::uint64_t unfinished = 0;         ///< files that are being written
  std::string problem;                  ///< why the folder cannot be read; empty: it can
};

[[nodiscard]] std::string list_json(const RecordingList& list);
/// @param share  part of the file that was read, 0 ... 1
[[nodiscard]] std::string progress_json(double share);
/// @param text  cause and remedy
[[nodiscard]] std::string problem_json(std::string_view text);
/// Files of a recording, for display.
struct RecordingFiles {
  std::string file{};  ///< the first
  std::uint64_t count = 1;
  std::string parts_problem{};  ///< as in ListedRecording
};
/// @pre !outline.empty()
[[nodiscard]] std::string outline_json(const RecordingOutline& outline, const rpc::Id& id, const RecordingFiles& files);

}  // namespace tandem::console
