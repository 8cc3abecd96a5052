#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "server/service/service_directory.h"

namespace tandem::server {

/// Judges the servers to which this server moves sessions. A server cannot say beforehand that it will not open a
/// session, so its first one is a trial: it gets no further one until it has kept that for a moment. A server that
/// gives a session back gets none for minutes. Both end with its registration. Pure.
class MoveTargets {
 public:
  static constexpr Duration kTrial = std::chrono::seconds(3), kPause = std::chrono::minutes(5);

  /// This server has released a session for another one.
  void on_sent(Time now, const std::string& session, const std::string& server);
  /// Follows the sessions that were sent. Returns those that no server owns because their target gave them back.
  [[nodiscard]] std::vector<std::string> step(Time now, const ServiceDirectory& directory);
  /// All sessions that were sent have been kept or given back.
  [[nodiscard]] bool judged() const noexcept { return sent_.empty(); }
  /// Whether a session may move to the server.
  [[nodiscard]] bool takes(Time now, const std::string& server) const;

 private:
  struct Target {
    bool keeps = false;  ///< a session that it got
    std::optional<Time> refused{};
  };
  struct Sent {
    std::string server;
    Time at{};
  };

  std::map<std::string, Target> targets_;  ///< registered servers that got a session
  std::map<std::string, Sent> sent_;       ///< by session, for kTrial
};

}  // namespace tandem::server
