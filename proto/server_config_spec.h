#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/input_error.h"

/// What a server hosts, as plain structs that cannot be wrong (proto/server_config.proto).
namespace tandem {

/// A text as somebody wrote it, and where: for what only a later look can judge (an address, another file).
struct PlacedText {
  std::string text;  ///< empty: not written
  std::string key;
  int line = 0, column = 0;
  [[nodiscard]] InputError error(const std::string& file, std::string message) const { return {file, line, column, key, text, std::move(message)}; }
};

struct ConfiguredSessionSpec {
  std::string name;         ///< 1 to 32 of A-Z a-z 0-9 _ -, of this server only once
  PlacedText placed_name;   ///< the same, and where it was written
  PlacedText scene;         ///< name or file
  bool tickets_only = false;
  bool restart = true;
  double duration_s = 0;    ///< 0: the scene's
};

struct DoorLimitsSpec {
  double accepts_per_s = 10, accepts_burst = 100, accepts_per_s_all = 300;
  std::uint32_t pending = 256, connections = 2048;
  double deadline_s = 5;
  double load_percent = 60;
  double core_percent = 80;
};

struct LogSpec {
  enum class Level : std::uint8_t { kInfo, kWarn, kError };
  bool json = false;
  Level level = Level::kInfo;
};

struct AuditSpec {
  double file_mib = 8;
  std::uint32_t older_files = 7;
};

struct ServerConfigSpec {
  std::string file;
  PlacedText listen, state, metrics, reports;
  std::vector<std::string> metrics_hosts;
  std::vector<ConfiguredSessionSpec> sessions;  ///< at least one
  DoorLimitsSpec limits;
  LogSpec log;
  AuditSpec audit;
};

}  // namespace tandem
