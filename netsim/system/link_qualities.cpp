#include "netsim/system/link_qualities.h"

#include "netsim/quality/link_monitor.h"

namespace tandem::netsim {

std::vector<NamedLink> link_qualities(const Simulation& simulation) {
  std::vector<NamedLink> links;
  for (std::size_t i = 0; i < simulation.scene().seats.size(); ++i) {
    if (const LinkMonitor* const monitor = simulation.link_monitor(i))
      links.push_back({simulation.scene().seats[i].name, monitor->summary()});
  }
  return links;
}

}  // namespace tandem::netsim
