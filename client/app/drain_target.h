#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/app/join_client.h"

namespace tandem::client {

/// Server that a drain of a console ends: the one that the console is connected to.
struct DrainTarget {
  std::string name;     ///< in its service; empty: it has none, or the name is not known
  std::string address;  ///< HOST:PORT
  bool in_service = false;
  std::vector<std::string> others{};  ///< HOST:PORT of the other servers of its service, to which its sessions move
};

/// Returns `server a at HOST:PORT`, or `the server at HOST:PORT` without a name.
[[nodiscard]] std::string named(const DrainTarget& target);
/// Returns the confirmation of a drain. @param grace_s  until all hands are released [s]
[[nodiscard]] std::string drain_text(const DrainTarget& target, std::uint32_t grace_s);

/// Returns why a drain is not sent to this server: the user has named another one, or several of a service, if only by
/// one DNS name. Empty: the user has named it.
/// @param asked    options as the user gave them
/// @param session  name of the console's session; empty: not known, and the server is one that the user has named
[[nodiscard]] std::string drain_problem(const JoinOptions& asked, const DrainTarget& target,
                                        const std::string& session);

}  // namespace tandem::client
