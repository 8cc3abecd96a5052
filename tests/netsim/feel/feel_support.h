#pragma once

#include "netsim/feel/probes.h"
#include "tests/support/world_run.h"

namespace tandem::netsim {

/// The scene `contact` with ideal hands, `ms` each way; of law `set_position` unless another scene is given.
inline FeelSetup contact_over(int ms, SceneSpec scene = tandem::test::set_position("contact")) {
  FeelSetup setup{.scene = std::move(scene)};
  setup.network = link_from(tandem::test::delayed(ms));
  setup.hands = HandKind::kPlain;
  return setup;
}

}  // namespace tandem::netsim
