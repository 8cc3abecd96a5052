#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "proto/rpc/rpc_messages.h"

namespace tandem::server {

/// Everything that a server of a service must know to open a session: the text of key `catalogue/NAME/spec`.
struct ServiceSession {
  rpc::Id id{};
  std::string code;           ///< session code; empty: tickets only
  std::string scene;          ///< text of the scene file
  std::string scene_name;     ///< of the scene, 1 to 255 bytes
  double duration_s = 0;      ///< replaces the duration of the scene [s]; 0: that of the scene
  bool tickets_only = false;  ///< no client joins by the code
  bool restart = false;       ///< when the session is over, a new one replaces it
  bool created = false;       ///< an operator created it at run time
  std::int64_t ends_s = 0;    ///< wall-clock time of its end [s since 1970, UTC]; 0: none
  /// The epoch of the session is the revision of its ownership plus this: its ownerships in a directory that was lost
  /// had higher revisions than those of the present one.
  std::int64_t epoch_base = 0;
  friend bool operator==(const ServiceSession&, const ServiceSession&) = default;
};

/// Longest texts that are read; an entry of etcd has at most 1.5 MiB.
inline constexpr std::size_t kServiceSessionMax = std::size_t{1} << 20;
inline constexpr std::size_t kListedTextMax = 16384;

/// As JSON.
[[nodiscard]] std::string to_text(const ServiceSession& session);
/// Reads any text. Returns nothing if a value is missing, has the wrong type or is out of range. Unknown keys are
/// ignored: they are of a newer version.
[[nodiscard]] std::optional<ServiceSession> parse_service_session(std::string_view text);

/// Phase and seats of a session for lists, without id and name: the text of key `catalogue/NAME/listed`.
[[nodiscard]] std::string listed_text(const rpc::ListedSession& session);
/// Reads any text into `session`. Returns false, and changes nothing, if it is no such text.
[[nodiscard]] bool read_listed(std::string_view text, rpc::ListedSession& session);

}  // namespace tandem::server
