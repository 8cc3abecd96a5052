#include "server/service/move_targets.h"

#include <algorithm>

namespace tandem::server {

void MoveTargets::on_sent(Time now, const std::string& session, const std::string& server) {
  targets_.try_emplace(server);
  sent_[session] = {server, now};
}

std::vector<std::string> MoveTargets::step(Time now, const ServiceDirectory& directory) {
  const directory::DirectoryView& view = directory.ownership.view();
  std::vector<std::string> given_back;
  std::erase_if(targets_, [&](const auto& target) { return view.server(target.first) == nullptr; });
  std::erase_if(sent_, [&](const auto& entry) {
    const auto& [session, sent] = entry;
    const auto target = targets_.find(sent.server);
    if (target == targets_.end()) return true;
    const auto* const seen = view.session(session);
    if (seen == nullptr) {  // from its release here on it has had its target as standby or owner
      if (directory.catalogue.find(session) == nullptr) return true;  // it has ended there
      target->second = {.keeps = false, .refused = now};
      given_back.push_back(session);
      return true;
    }
    if (now - sent.at < kTrial) return false;
    target->second.keeps = target->second.keeps || (seen->owner && seen->owner->name == sent.server);
    return true;
  });
  return given_back;
}

bool MoveTargets::takes(Time now, const std::string& server) const {
  const auto target = targets_.find(server);
  if (target == targets_.end()) return true;
  const auto& [keeps, refused] = target->second;
  if (refused && now - *refused < kPause) return false;
  return keeps || std::ranges::none_of(sent_, [&](const auto& sent) { return sent.second.server == server; });
}

}  // namespace tandem::server
