#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tandem::server {

/// Facts about a session that its recording states.
struct RecordingInfo {
  std::string session;     ///< name of the session
  std::string scene_text;  ///< of scene_file_text (proto/text/scene_bytes.h): every value in force
  /// Version, commit, seed, hash of the scene, law, clock and others, by name. The names `session`, `format` and
  /// `start_unix_ns` are the writer's.
  std::map<std::string, std::string> metadata;
  std::int64_t start_unix_ns = 0;  ///< wall clock at TickRecord::time_ns = 0, not negative; 0: not known
  bool round_tools = false;        ///< values of tools (rec::round_tool), with a digest of the exact ones for a replay
  std::vector<std::string> persons;  ///< participant of each seat, in the order of the scene; empty: not known
  std::vector<bool> workstations{};  ///< seats whose name in `persons` is that of a workstation; empty: none
};

}  // namespace tandem::server
