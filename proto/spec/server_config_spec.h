#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/spec/input_error.h"

/// Validated configuration of a server as plain structs (proto/schema/server_config.proto).
namespace tandem {

/// A text and its location in the file, for values that only a later check can validate (an address, another file).
struct LocatedText {
  std::string text;  ///< empty: absent
  std::string key;
  int line = 0, column = 0;
  [[nodiscard]] InputError error(const std::string& file, std::string message) const {
    return {file, line, column, key, text, std::move(message)};
  }
};

struct ConfiguredSessionSpec {
  std::string name;         ///< 1 to 32 of A-Z a-z 0-9 _ -, unique in this server
  LocatedText placed_name;  ///< the name with its location in the file
  LocatedText scene;        ///< name of a shipped scene, or a file
  bool tickets_only = false;
  bool restart = true;
  double duration_s = 0;  ///< 0: the duration of the scene
  LocatedText record;     ///< folder or file of recordings; absent: that of the server
};

struct ConnectionLimitsSpec {
  double accepts_per_s = 10, accepts_burst = 100, accepts_per_s_all = 300;
  std::uint32_t pending = 256, connections = 2048;
  double deadline_s = 5;
  double core_percent = 85;  ///< LoadLimits::busy (server/policy/admission_control.h)
  std::uint32_t created_sessions = 16;
  std::uint32_t threads = 0;  ///< 0: as many as the server may use processors
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

/// How sessions are recorded.
struct RecordingSpec {
  bool pseudonyms = false;   ///< P1, P2 ... instead of names of participants and workstations
  bool from_start = true;    ///< a recording starts with its session, not by an order
  double file_mib = 256;     ///< [MiB] of one file
  double file_minutes = 10;  ///< [min] of one file
  double total_mib = 65536;  ///< [MiB] of all files of a run; then the recording ends
  double mib_per_min = 128;  ///< [MiB/min]; further ticks are left out and counted
  double inputs_mib = 1024;  ///< [MiB] of inputs kept per session for a recording that begins later; 0: none
};

/// How a server is a member of a service of several servers.
struct DirectorySpec {
  std::vector<LocatedText> endpoints;               ///< "HOST:PORT" of members of etcd, at least one
  std::string prefix = "/tandem/v1/";               ///< of all keys of the service
  LocatedText authority, certificate, private_key;  ///< files in PEM; all or none
  std::string name_in_certificate;                  ///< of etcd; empty: the host of the endpoint
  LocatedText server;                               ///< name of this server; absent: the name in its member file
  LocatedText address;                              ///< HOST:PORT for clients; absent: the address it listens at
  std::string zone;                                 ///< empty: none
  std::uint32_t ttl_s = 3;                          ///< [s] of the server's lease
  bool balance = true;                              ///< sessions move to less used servers by themselves
  LocatedText whole;                                ///< location of the block
};

struct ServerConfigSpec {
  std::string file;
  LocatedText listen, state, metrics, reports, scenes, record;
  std::vector<std::string> metrics_hosts;
  std::vector<ConfiguredSessionSpec> sessions;  ///< at least one
  ConnectionLimitsSpec limits;
  LogSpec log;
  AuditSpec audit;
  RecordingSpec recording;
  std::optional<DirectorySpec> directory;  ///< absent: the server is alone
};

}  // namespace tandem
