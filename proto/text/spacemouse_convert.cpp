#include "proto/text/spacemouse_convert.h"

#include "proto/schema/spacemouse.pb.h"

namespace tandem {

SpaceMouseSpec spacemouse_from(const pb::SpaceMouseFile& in) {
  SpaceMouseSpec spec;
  if (in.has_speed_m_s()) spec.speed = in.speed_m_s();
  if (in.has_turn_rad_s()) spec.turn = in.turn_rad_s();
  const std::array<const pb::SpaceMouseAxis*, 6> axes{&in.x(),      &in.y(),      &in.z(),
                                                      &in.turn_x(), &in.turn_y(), &in.turn_z()};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i]->has_full_counts()) spec.full[i] = axes[i]->full_counts();
    if (axes[i]->reversed()) spec.sign[i] = -spec.sign[i];
  }
  return spec;
}

}  // namespace tandem
