#include "netsim/app/law_options.h"

#include "common/control/channel.h"
#include "common/setup/channel_factory.h"
#include "proto/text/scene_text.h"
#include "server/session/session_invariant_checker.h"

namespace tandem::netsim {

void set_law(SceneSpec& scene, const std::string& channel, const std::string& mfs) {
  for (std::size_t law = 0; law < kLaws; ++law)
    if (channel == setup::law_name(static_cast<LawKind>(law))) choose_law(scene, static_cast<LawKind>(law));
  for (const MfsMode mode : {MfsMode::kOpen, MfsMode::kTank, MfsMode::kSeed, MfsMode::kSeedSigned})
    if (mfs == server::mfs_name(mode)) scene.channel.mfs = mode;
}

void set_coupling(SceneSpec& scene, const std::string& coupling) {
  for (std::size_t c = 0; c < control::kHandCouplings; ++c)
    if (coupling == control::row_of(static_cast<control::HandCoupling>(c)).name)
      scene.channel.coupling = static_cast<HandCouplingKind>(c);
}

std::vector<std::string> coupling_names() {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < control::kHandCouplings; ++c)
    names.emplace_back(control::row_of(static_cast<control::HandCoupling>(c)).name);
  return names;
}

std::string coupling_help() {
  std::string text =
      "coupling between the hands instead of the scene's, for comparison; all but esc need --channel "
      "set_position, pd or raw.";
  for (std::size_t c = 0; c < control::kHandCouplings; ++c) {
    const control::HandCouplingRow& row = control::row_of(static_cast<control::HandCoupling>(c));
    text +=
        " " + std::string(row.name) + ": " + std::string(row.summary) + (row.hands_max == 2 ? " (two hands)." : ".");
  }
  return text;
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const control::ChannelLaw& law : control::channel_laws()) names.emplace_back(law.name);
  return names;
}

std::string law_help() {
  std::string text = "channel law instead of the scene's. ";
  for (const control::ChannelLaw& law : control::channel_laws())
    text += std::string(law.name) + ": " + std::string(law.summary) +
            (law.name == setup::law_name(ChannelSpec{}.law) ? " (default of scenes that name none). " : ". ");
  text.resize(text.size() - 2);
  return text;
}

const char* law_option(const std::string& channel, const std::string& coupling) noexcept {
  return !coupling.empty() ? "--coupling" : !channel.empty() ? "--channel" : "--mfs";
}

std::string law_conflict(const SceneSpec& scene, const std::string& name) {
  const auto problem = law_problem(scene);
  return problem ? name + ": " + problem->key + ": " + problem->words : "";
}

}  // namespace tandem::netsim
