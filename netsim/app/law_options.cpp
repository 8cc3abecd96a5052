#include "netsim/app/law_options.h"

#include "common/setup/channel_factory.h"
#include "proto/text/scene_text.h"
#include "server/session/session_invariant_checker.h"

namespace tandem::netsim {

void set_law(SceneSpec& scene, const std::string& channel, const std::string& mfs) {
  for (const LawKind law : {LawKind::kReplica, LawKind::kRaw, LawKind::kSetPosition})
    if (channel == setup::law_name(law)) choose_law(scene, law);
  for (const MfsMode mode : {MfsMode::kOpen, MfsMode::kTank, MfsMode::kSeed, MfsMode::kSeedSigned})
    if (mfs == server::mfs_name(mode)) scene.channel.mfs = mode;
}

std::string law_conflict(const SceneSpec& scene, const std::string& name) {
  const auto problem = law_problem(scene);
  return problem ? name + ": " + problem->key + ": " + problem->words : "";
}

}  // namespace tandem::netsim
