#include "server/service/service_directory.h"

#include <utility>

namespace tandem::server {

namespace {

constexpr Duration kWritePause = std::chrono::milliseconds(50);  // 32 values each: 256 sessions, twice a second

}  // namespace

ServiceDirectory::ServiceDirectory(std::string server, const std::string& prefix, directory::LeaseTimes times)
    : names(prefix),
      keys(prefix),
      ownership(std::move(server), "", times, names),
      catalogue(keys),
      tickets(ownership, names),
      writer(names, keys.writes(ownership.server()), kWritePause) {}

std::map<std::string, directory::ServerRecord> ServiceDirectory::members() const {
  std::map<std::string, directory::ServerRecord> members;
  for (const auto& [name, server] : ownership.view().servers())
    if (auto record = directory::parse_server_record(server.text)) members.emplace(name, std::move(*record));
  return members;
}

std::string ServiceDirectory::owner_of(std::string_view session) const {
  const auto* const seen = ownership.view().session(session);
  return seen != nullptr && seen->owner ? seen->owner->name : "";
}

}  // namespace tandem::server
