#include "server/service/service_catalogue.h"

#include "server/directory/directory_keys.h"

namespace tandem::server {

bool ServiceCatalogue::on_reply(const directory::Reply& reply) {
  const auto news = follower_.on_reply(reply);
  if (!news) return false;
  if (news->all) entries_.clear();
  if (news->all || !news->changes.empty()) ++version_;
  for (const directory::Change& change : news->changes) apply(change);
  return true;
}

void ServiceCatalogue::apply(const directory::Change& change) {
  const std::string folder = keys_.catalogue();
  std::string_view name = change.entry.key;
  if (!name.starts_with(folder)) return;
  name.remove_prefix(folder.size());
  const char* const kind = name.ends_with(ServiceKeys::kSpec)     ? ServiceKeys::kSpec
                           : name.ends_with(ServiceKeys::kListed) ? ServiceKeys::kListed
                           : name.ends_with(ServiceKeys::kMove)   ? ServiceKeys::kMove
                           : name.ends_with(ServiceKeys::kHome)   ? ServiceKeys::kHome
                                                                  : nullptr;
  if (kind == nullptr) {
    ++rejected_;
    return;
  }
  name.remove_suffix(std::string_view(kind).size());
  if (!directory::DirectoryKeys::valid_name(name)) {
    ++rejected_;
    return;
  }
  auto found = entries_.find(name);
  if (found == entries_.end()) {
    if (change.erased) return;
    if (entries_.size() >= kSessionsMax) {
      ++rejected_;
      return;
    }
    found = entries_.emplace(std::string(name), Entry{}).first;
  }
  Entry& entry = found->second;
  const std::string text = change.erased ? std::string{} : change.entry.value;
  (kind == ServiceKeys::kSpec     ? entry.spec_text
   : kind == ServiceKeys::kListed ? entry.listed_text
   : kind == ServiceKeys::kMove   ? entry.move_to
                                  : entry.home) = text;
  if (kind == ServiceKeys::kSpec) {
    entry.spec = parse_service_session(text);
    if (!entry.spec && !text.empty()) ++rejected_;
  }
  if (entry.spec_text.empty() && entry.listed_text.empty() && entry.move_to.empty() && entry.home.empty())
    entries_.erase(found);
}

const ServiceSession* ServiceCatalogue::find(std::string_view name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() || !found->second.spec ? nullptr : &*found->second.spec;
}

std::string ServiceCatalogue::name_of(const rpc::SessionChoice& choice) const {
  if (const auto* const text = std::get_if<std::string>(&choice)) {
    for (const auto& [name, entry] : entries_)
      if (entry.spec && (name == *text || (!entry.spec->code.empty() && entry.spec->code == *text))) return name;
    return {};
  }
  if (const auto* const id = std::get_if<rpc::Id>(&choice)) {
    for (const auto& [name, entry] : entries_)
      if (entry.spec && entry.spec->id == *id) return name;
    return {};
  }
  std::string only;
  for (const auto& [name, entry] : entries_) {
    if (!entry.spec) continue;
    if (!only.empty()) return {};
    only = name;
  }
  return only;
}

}  // namespace tandem::server
