#include "netsim/system/link_qualities.h"

#include "netsim/quality/link_monitor.h"

namespace tandem::netsim {

std::vector<NamedLink> link_qualities(const Simulation& world) {
  std::vector<NamedLink> links;
  for (std::size_t i = 0; i < world.scene().seats.size(); ++i) {
    if (const LinkMonitor* const watch = world.link_monitor(i))
      links.push_back({world.scene().seats[i].name, watch->summary()});
  }
  return links;
}

}  // namespace tandem::netsim
