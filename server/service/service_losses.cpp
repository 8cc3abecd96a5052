// Sessions of a server whose directory has lost its data.
#include <algorithm>
#include <utility>

#include "server/service/service_member.h"

namespace tandem::server {

namespace {

constexpr const char* kLostText = "the directory of the service was begun from nothing; try again in some seconds";

}  // namespace

/// Everything that this server knows of the directory is of the lost one, its ownerships too.
void ServiceMember::on_directory_lost(Time now) {
  ownership_.begin_again();
  take_notices(now);
  learn_bases();
  loss_.on_loss(now);
  describe(record_);
  if (!registry_.agreed().mark.empty()) registry_.begin_again();
  registry_losses_ = registry_.losses();
  registry_.read_again();
  catalogue_.read_again();
  tickets_.forget_leases();
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    // A claim, or a session that was being written or erased: it has no run here.
    const Phase phase = entry->second.phase;
    if (phase == Phase::kLosing) {
      ++entry;
      continue;
    }
    refuse(entry->second, entry->first, kLostText);
    entry = entries_.erase(entry);
  }
  refused_until_.clear();
  begin_configured();
}

void ServiceMember::follow_losses(Time now) {
  if (registry_losses_ != registry_.losses()) on_directory_lost(now);
  if (loss_.kept().empty() || !loss_.known()) return;
  if (loss_.losses() == kept_since_losses_) {  // an ordinary end of the lease: the next owner has the newest state
    loss_.kept().clear();
    return;
  }
  if (!loss_.kept_may_begin(now) || !ownership_.keeper().registered() || !ownership_.view().follows() ||
      !catalogue_.follows())
    return;
  std::erase_if(loss_.kept(), [&](auto& kept) {
    auto& [session, as] = kept;
    if (entries_.contains(session)) return false;  // its former run is not over
    const auto* const seen = ownership_.view().session(session);
    const bool owned = seen != nullptr && seen->owner, ours = owned && seen->owner->name == options_.server;
    const bool elsewhere = seen != nullptr && !ours && (owned || seen->standby);
    if (elsewhere || leaving_ || record_.drains || !ownership_.claim(session)) return true;
    Entry entry;
    entry.spec = based(std::move(as.spec));
    entry.snapshot = std::move(as.snapshot);
    entry.consoles = std::move(as.consoles);
    entry.kept = true;
    entries_[session] = std::move(entry);
    return true;
  });
}

void ServiceMember::keep(const std::string& session, Entry& entry) {
  if (loss_.kept().empty()) kept_since_losses_ = loss_.losses();
  if (entry.served) loss_.keep(session, {std::move(*entry.served), entry.snapshot, entry.consoles});
  entry.served.reset();
  loss_.doubt();
}

void ServiceMember::learn_bases() {
  for (const auto& [session, entry] : catalogue_.entries())
    if (entry.spec) loss_.on_base(entry.spec->epoch_base);
  for (const auto& [name, server] : members()) loss_.on_base(server.epoch_base);
}

ServiceSession ServiceMember::based(ServiceSession spec) {
  learn_bases();
  spec.epoch_base = std::max(spec.epoch_base, loss_.epoch_base());
  return spec;
}

std::string ServiceMember::kept_name(const rpc::SessionChoice& choice) const {
  const auto* const text = std::get_if<std::string>(&choice);
  const auto* const id = std::get_if<rpc::Id>(&choice);
  for (const auto& [session, kept] : loss_.kept()) {
    const bool named = text != nullptr && (*text == session || (!text->empty() && *text == kept.spec.code));
    const bool only = text == nullptr && id == nullptr && loss_.kept().size() == 1;
    if (named || only || (id != nullptr && *id == kept.spec.id)) return session;
  }
  return {};
}

}  // namespace tandem::server
