#pragma once

#include "common/auth/io/state_directory.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/session/session_snapshot.h"

namespace tandem::test {

inline SceneSpec story_scene() { return *parse_scene(find_shipped_scene("contact")->text, "contact.textproto"); }

/// Returns the session of the story, `lab`, with a checkpoint that fits its scene.
inline server::SessionSnapshot story_session(const SceneSpec& scene) {
  server::SessionSnapshot kept;
  server::Checkpoint& c = kept.checkpoint;
  c.scene = server::scene_hash(scene);
  c.session_tick = 12345;
  c.seats_n = static_cast<std::uint8_t>(scene.seats.size());
  c.masters_n = static_cast<std::uint8_t>(scene.masters());
  c.tools_n = static_cast<std::uint8_t>(scene.tools.size());
  c.dof = static_cast<std::uint8_t>(scene.dof);
  for (std::size_t i = 0; i < c.tools_n; ++i) c.tools[i].alpha[0] = 1;
  kept.name = "lab";
  kept.code = "ABCDEFGHJK";
  kept.written_s = auth::wall_seconds();
  return kept;
}

}  // namespace tandem::test
