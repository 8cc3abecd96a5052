#include "netsim/system/session_link_monitors.h"

namespace tandem::netsim {

void SessionLinkMonitors::start(Time now, Network& network) {
  for (std::uint32_t link = 0; link < network.links(); ++link)
    network.attach_monitor(link, monitors_.emplace_back(std::make_unique<LinkMonitor>(now)).get());
}

std::vector<NamedLink> SessionLinkMonitors::qualities(const SceneSpec& scene) const {
  std::vector<NamedLink> links;
  for (std::size_t i = 0; i < monitors_.size(); ++i) links.push_back({scene.seats[i].name, monitors_[i]->summary()});
  return links;
}

}  // namespace tandem::netsim
