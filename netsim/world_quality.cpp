#include "netsim/world_quality.h"

#include "netsim/link_watch.h"

namespace tandem::netsim {

std::vector<NamedLink> link_qualities(const World& world) {
  std::vector<NamedLink> links;
  for (std::size_t i = 0; i < world.scene().seats.size(); ++i) {
    if (const LinkWatch* const watch = world.quality(i)) links.push_back({world.scene().seats[i].name, watch->summary()});
  }
  return links;
}

}  // namespace tandem::netsim
