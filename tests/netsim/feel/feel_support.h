#pragma once

#include "netsim/feel/probes.h"
#include "tests/support/simulation_run.h"

namespace tandem::netsim {

/// Returns the scene `contact` with ideal hands and a delay of `ms` each way. The law is `set_position` unless another
/// scene is given.
inline FeelSetup contact_over(int ms, SceneSpec scene = tandem::test::set_position("contact")) {
  FeelSetup setup{.scene = std::move(scene)};
  setup.network = link_from(tandem::test::delayed(ms));
  setup.hands = HandKind::kPlain;
  return setup;
}

}  // namespace tandem::netsim
