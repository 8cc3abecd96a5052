#include "client/app/drain_target.h"

#include <algorithm>

#include "common/base/format.h"

namespace tandem::client {
namespace {

constexpr const char* kStop = "use `tandem-server stop` on its computer";

std::string given_servers(const JoinOptions& asked) {
  std::string text;
  for (const std::string& typed : asked.typed) text += (text.empty() ? "" : ",") + typed;
  return text.empty() ? io::to_text(asked.server) : text;
}

}  // namespace

std::string named(const DrainTarget& target) {
  return (target.name.empty() ? "the server" : "server " + target.name) + " at " + target.address;
}

std::string drain_text(const DrainTarget& target, std::uint32_t grace_s) {
  const bool moves = !target.others.empty();
  std::string text = named(target) + " is draining: new joins are rejected; ";
  if (moves && grace_s > 0)
    text +=
        "its sessions move to other servers of the service, and it ends when it has none; of those that find no "
        "room ";
  text += grace_s == 0 ? "all hands are released" : format("all hands are released in %u s", grace_s);
  text += ", then it ends";
  if (moves && grace_s == 0) text += "; other servers of the service take its sessions over";
  return text;
}

std::string drain_problem(const JoinOptions& asked, const DrainTarget& target, const std::string& session) {
  const std::string given = given_servers(asked);
  const auto has = [&](const std::string& address) {
    const auto is = [&](const io::SocketAddress& a) { return io::to_text(a) == address; };
    return is(asked.server) || std::ranges::any_of(asked.alternatives, is);
  };
  const bool meant = has(target.address);
  if (target.in_service && (asked.typed.size() > 1 || (meant && std::ranges::any_of(target.others, has))))
    return "drain: --server names several servers of a service, " + given +
           ", and a drain ends one of them. Name only the one that is to end; it must serve the session of the ticket" +
           (session.empty() ? "" : ", as " + named(target) + " serves session " + session) + ". To end another one, " +
           kStop;
  if (meant) return {};
  return "drain: --server names " + given + ", but session " + session + " is served by " + named(target) +
         ", and a drain ends the server that serves the session of its console. To end that one, give "
         "--server " +
         target.address + "; to end the one at " + given + ", " + kStop;
}

}  // namespace tandem::client
