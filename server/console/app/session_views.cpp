#include "server/console/app/session_views.h"

#include <algorithm>
#include <utility>

namespace tandem::console {
namespace {

bool shows(const ServerLink& link, const rpc::Id& session) { return link.newest()->status.session_id == session; }

}  // namespace

std::shared_ptr<ServerLink> SessionViews::open(const std::string& name, ServerLink::Options options) {
  std::erase_if(opened_, [](const auto& other) { return other.second.expired(); });
  if (const auto found = opened_.find(name); found != opened_.end()) return found->second.lock();
  if (opened_.size() >= kOpenedMax) return nullptr;
  auto opened = std::make_shared<ServerLink>(std::move(options));
  opened_[name] = opened;
  return opened;
}

bool SessionViews::is_watched(const rpc::Id& session) const {
  return std::ranges::any_of(live(), [&](const auto& link) { return shows(*link, session); });
}

std::shared_ptr<ServerLink> SessionViews::best(const std::shared_ptr<ServerLink>& link) const {
  if (link->live()) return link;
  const rpc::Id session = link->newest()->status.session_id;
  for (auto& other : live())
    if (shows(*other, session)) return other;
  return link;
}

void SessionViews::each_live(const std::function<void(const ServerLink&)>& use) const {
  for (const auto& link : live()) use(*link);
}

void SessionViews::expire(const std::function<bool(const rpc::Id&)>& has_person) {
  std::erase_if(links_, [&](const std::shared_ptr<ServerLink>& link) {
    const auto picture = link->newest();
    return (!picture->connected && !picture->again) || !has_person(picture->status.session_id);
  });
}

std::vector<std::shared_ptr<ServerLink>> SessionViews::live() const {
  std::vector<std::shared_ptr<ServerLink>> found;
  for (const auto& link : links_)
    if (link->live()) found.push_back(link);
  for (const auto& [name, opened] : opened_)
    if (auto link = opened.lock(); link && link->live()) found.push_back(std::move(link));
  return found;
}

}  // namespace tandem::console
