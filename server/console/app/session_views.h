#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/console/app/server_link.h"

namespace tandem::console {

/// The links of a gateway with the datagrams of sessions. A person with a ticket joins once, so the link of a person
/// who watched for all stays until the last person of its session has left. For the web thread.
class SessionViews {
 public:
  static constexpr std::size_t kOpenedMax = 16;  ///< further sessions that the gateway shows at the same time

  /// Adds a link that watches for all persons of its session, until `expire` ends it.
  void add(std::shared_ptr<ServerLink> link) { links_.push_back(std::move(link)); }
  /// Returns the link of a session that is joined by name, and joins if there is none. It ends with its last user.
  /// @return null: kOpenedMax others are in use
  [[nodiscard]] std::shared_ptr<ServerLink> open(const std::string& name, ServerLink::Options options);
  /// Whether the datagrams of a session arrive.
  [[nodiscard]] bool is_watched(const rpc::Id& session) const;
  /// Returns the link that shows the session of `link` best: `link` itself, or another one with datagrams.
  [[nodiscard]] std::shared_ptr<ServerLink> best(const std::shared_ptr<ServerLink>& link) const;
  /// Calls `use` for each link with datagrams.
  void each_live(const std::function<void(const ServerLink&)>& use) const;
  /// Ends added links that are lost, or whose session has no person. @param has_person  whether any is in a session
  void expire(const std::function<bool(const rpc::Id&)>& has_person);

 private:
  [[nodiscard]] std::vector<std::shared_ptr<ServerLink>> live() const;

  std::vector<std::shared_ptr<ServerLink>> links_;
  std::map<std::string, std::weak_ptr<ServerLink>> opened_;  ///< by name of the session
};

}  // namespace tandem::console
