#include "server/directory/directory_view.h"

namespace tandem::directory {

bool DirectoryView::on_reply(const Reply& reply) {
  const auto news = follower_.on_reply(reply);
  if (!news) return false;
  if (news->all) {
    for (const auto& [name, entry] : sessions_) changed_.insert(name);
    sessions_.clear();
    servers_.clear();
  }
  for (const Change& change : news->changes) apply(change);
  return true;
}

void DirectoryView::apply(const Change& change) {
  const auto key = keys_.parse(change.entry.key);
  if (!key) {
    ++foreign_keys_;
    return;
  }
  if (key->kind == DirectoryKeys::Parsed::Kind::kServer) {
    if (change.erased)
      servers_.erase(key->name);
    else
      servers_[key->name] = {change.entry.value, change.entry.lease};
    return;
  }
  SessionEntry& session = sessions_[key->name];
  std::optional<Named>& named = key->kind == DirectoryKeys::Parsed::Kind::kOwner ? session.owner : session.standby;
  if (change.erased)
    named.reset();
  else
    named = Named{change.entry.value, change.entry.created, change.entry.lease};
  changed_.insert(key->name);
  if (!session.owner && !session.standby) sessions_.erase(key->name);
}

std::optional<std::string> DirectoryView::poll_changed() {
  if (changed_.empty()) return std::nullopt;
  std::string name = std::move(changed_.extract(changed_.begin()).value());
  return name;
}

const DirectoryView::SessionEntry* DirectoryView::session(std::string_view name) const {
  const auto found = sessions_.find(name);
  return found == sessions_.end() ? nullptr : &found->second;
}

const DirectoryView::ServerEntry* DirectoryView::server(std::string_view name) const {
  const auto found = servers_.find(name);
  return found == servers_.end() ? nullptr : &found->second;
}

}  // namespace tandem::directory
