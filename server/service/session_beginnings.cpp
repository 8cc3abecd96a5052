#include "server/service/session_beginnings.h"

#include <utility>
#include <variant>

namespace tandem::server {

void SessionBeginnings::keep(const std::string& session, MemberSession::Run run) {
  if (kept_.empty()) losses_before_ = loss_.losses();
  kept_[session] = std::move(run);
}

void SessionBeginnings::replace_kept(const std::string& session, std::optional<ServiceSession> next) {
  const auto found = kept_.find(session);
  if (found == kept_.end()) return;
  if (next)
    found->second = {.spec = std::move(*next)};
  else
    kept_.erase(found);
}

void SessionBeginnings::begin_configured() {
  for (const auto& [session, spec] : configured_) to_begin_.insert(session);
}

void SessionBeginnings::step(Time now, bool drains) {
  claim_kept(now);
  if (!drains) claim_configured(now);
}

/// Also while the server drains: no other one has their state. They move to others as soon as they are served.
void SessionBeginnings::claim_kept(Time now) {
  if (kept_.empty() || !loss_.known()) return;
  if (loss_.losses() == losses_before_) {  // an ordinary end of the lease: the next owner has the newest state
    kept_.clear();
    return;
  }
  if (!loss_.kept_may_begin(now) || !directory_.ready()) return;
  std::erase_if(kept_, [&](const auto& kept) {
    const auto& [session, run] = kept;
    if (sessions_.contains(session)) return false;  // its former run is not over
    const auto* const seen = directory_.ownership.view().session(session);
    const bool owned = seen != nullptr && seen->owner, ours = owned && seen->owner->name == directory_.server();
    const bool elsewhere = seen != nullptr && !ours && (owned || seen->standby);
    if (!elsewhere) sessions_.claim(session, MemberSession::Origin::kKept, run);
    return true;
  });
}

/// The server that runs first begins the sessions of the configuration. The others wait until they have seen that, as
/// it may end before a session has begun.
void SessionBeginnings::claim_configured(Time now) {
  if (to_begin_.empty() || !loss_.all_may_begin(now) || !directory_.ready()) return;
  std::erase_if(to_begin_, [&](const std::string& session) {
    if (sessions_.contains(session) || sessions_.refused(session)) return false;
    const auto* const seen = directory_.ownership.view().session(session);
    if (seen != nullptr && (seen->owner || seen->standby)) return directory_.catalogue.find(session) != nullptr;
    sessions_.claim(session, MemberSession::Origin::kConfigured, {.spec = configured_.at(session)});
    return false;
  });
}

std::string SessionBeginnings::kept_name(const rpc::SessionChoice& choice) const {
  const auto* const text = std::get_if<std::string>(&choice);
  const auto* const id = std::get_if<rpc::Id>(&choice);
  for (const auto& [session, kept] : kept_) {
    const bool named = text != nullptr && (*text == session || (!text->empty() && *text == kept.spec.code));
    const bool only = text == nullptr && id == nullptr && kept_.size() == 1;
    if (named || only || (id != nullptr && *id == kept.spec.id)) return session;
  }
  return {};
}

}  // namespace tandem::server
