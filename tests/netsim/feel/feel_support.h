#pragma once

#include "netsim/feel/probes.h"
#include "tests/support/world_run.h"

namespace tandem::netsim {

/// The scene `contact` with ideal hands, `ms` each way.
inline FeelSetup contact_over(int ms) {
  FeelSetup setup{.scene = tandem::test::shipped("contact")};
  setup.network = link_from(tandem::test::delayed(ms));
  setup.hands = HandKind::kPlain;
  return setup;
}

}  // namespace tandem::netsim
