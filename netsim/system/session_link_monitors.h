#pragma once

#include <memory>
#include <vector>

#include "netsim/engine/network.h"
#include "netsim/quality/link_monitor.h"
#include "netsim/quality/quality_text.h"
#include "proto/spec/scene_spec.h"

namespace tandem::netsim {

/// Link statistics of every seat during a session. Joins are slower and wait for participants, so that the statistics
/// begin with the session.
class SessionLinkMonitors {
 public:
  [[nodiscard]] bool started() const noexcept { return !monitors_.empty(); }
  /// Attaches a monitor to each link of the network, which must not outlive this object. Call it once.
  /// @param now  the session begins
  void start(Time now, Network& network);
  /// Returns the link quality of every seat, in the order of the scene. Empty before `start`.
  [[nodiscard]] std::vector<NamedLink> qualities(const SceneSpec& scene) const;

 private:
  std::vector<std::unique_ptr<LinkMonitor>> monitors_;  ///< by seat, which is the number of its link
};

}  // namespace tandem::netsim
