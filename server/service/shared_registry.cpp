#include "server/service/shared_registry.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace tandem::server {
namespace {

const std::string kNone;
const std::string kMark = ".mark";  // no name of a workstation has a point

const std::string& text_in(const RegistryEntries& entries, const std::string& name) {
  const auto found = entries.find(name);
  return found == entries.end() ? kNone : found->second;
}

}  // namespace

std::string to_text(const RegistryAgreement& agreed) {
  return nlohmann::json{{"mark", agreed.mark},         {"created", agreed.created},
                        {"revision", agreed.revision}, {"epoch_base", agreed.epoch_base},
                        {"waits", agreed.waits},       {"entries", agreed.entries},
                        {"spent_codes", agreed.spent}}
             .dump(1) +
         "\n";
}

std::optional<RegistryAgreement> parse_registry_agreement(std::string_view text) {
  const auto in = nlohmann::json::parse(text, nullptr, false);
  if (!in.is_object() || !in.contains("mark") || !in["mark"].is_string() || !in.contains("entries") ||
      !in["entries"].is_object())
    return std::nullopt;
  RegistryAgreement agreed{in["mark"].get<std::string>(), {}};
  if (!directory::DirectoryMark::valid(agreed.mark)) return std::nullopt;
  const std::pair<const char*, std::int64_t&> numbers[] = {
      {"created", agreed.created}, {"revision", agreed.revision}, {"epoch_base", agreed.epoch_base}};
  for (const auto& [key, number] : numbers) {
    const auto found = in.find(key);
    if (found == in.end()) continue;
    if (!found->is_number_integer()) return std::nullopt;
    number = found->get<std::int64_t>();
  }
  if (const auto waits = in.find("waits"); waits != in.end()) {
    if (!waits->is_boolean()) return std::nullopt;
    agreed.waits = waits->get<bool>();
  }
  if (const auto spent = in.find("spent_codes"); spent != in.end()) {
    if (!spent->is_object() || spent->size() > SpentCodes::kMax) return std::nullopt;
    for (const auto& [code, not_after] : spent->items()) {
      if (!not_after.is_number_integer()) return std::nullopt;
      agreed.spent[code] = not_after.get<std::int64_t>();
    }
  }
  for (const auto& [name, value] : in["entries"].items()) {
    if (!value.is_string() || !readable_entry(value.get<std::string>())) return std::nullopt;
    agreed.entries[name] = value.get<std::string>();
  }
  return agreed;
}

const std::string& SharedRegistry::stored_text(const std::string& name) const {
  const auto found = stored_.find(name);
  return found == stored_.end() ? kNone : found->second.text;
}

bool SharedRegistry::unreadable(const std::string& name) const {
  const auto found = stored_.find(name);
  return found != stored_.end() && found->second.text.empty();
}

std::string SharedRegistry::merged(const std::string& name) const {
  const std::string &before = text_in(agreed_, name), &local = text_in(local_, name);
  if (unreadable(name)) return local;
  std::string stored = spent_.without(name, stored_text(name));
  // Revoked here while the lost directory did not answer; another server has brought the row into the new one.
  if (local.empty() && before.empty() && !stored.empty() && stored == text_in(lost_, name)) return kNone;
  if (local == before) return stored;
  if (stored == before || local == stored) return local;
  return local.empty() || stored.empty() ? kNone : merged_entry(before, local, stored);  // a revocation wins
}

std::vector<std::string> SharedRegistry::names() const {
  std::set<std::string> all;
  for (const auto& [name, text] : agreed_) all.insert(name);
  for (const auto& [name, text] : local_) all.insert(name);
  for (const auto& [name, entry] : stored_) all.insert(name);
  all.erase(kMark);
  return {all.begin(), all.end()};
}

directory::Request SharedRegistry::change(const std::string& name, std::string text, Time now,
                                          directory::OperationId operation) {
  operation_ = operation;
  sent_ = now;
  changing_ = name;
  change_ = std::move(text);
  const auto known = stored_.find(name);
  directory::Transaction change{
      {{prefix_ + name, directory::Condition::Of::kModified, known == stored_.end() ? 0 : known->second.modified}},
      {},
      {directory::Read{mark_.key()}}};
  if (name != kMark) change.conditions.push_back({mark_.key(), directory::Condition::Of::kModified, mark().modified});
  if (change_.empty()) {
    change.then.push_back(directory::Erase{prefix_ + name});
  } else {
    change.then.push_back(directory::Put{prefix_ + name, change_, 0});
  }
  return change;
}

std::optional<directory::Request> SharedRegistry::poll_request(Time now, directory::OperationId operation,
                                                               Duration retry_after) {
  if (auto request = follower_.poll_request(now, operation, retry_after)) return request;
  if (operation_ != 0 && now - sent_ >= retry_after) operation_ = 0;  // a later answer is ignored; the follower tells
  if (refused_) {
    refused_ = false;
    next_ = now + kPause;
  }
  if (!follower_.follows() || !local_known_ || operation_ != 0 || now < next_) return std::nullopt;
  if (unmarked()) return change(kMark, mark_.draw(), now, operation);
  agree();
  for (const std::string& name : names())
    if (std::string wanted = merged(name); !unreadable(name) && wanted != stored_text(name))
      return change(name, std::move(wanted), now, operation);
  return std::nullopt;
}

bool SharedRegistry::on_reply(const directory::Reply& reply) {
  if (const auto news = follower_.on_reply(reply)) {
    on_news(*news);
    return true;
  }
  if (operation_ == 0 || reply.operation != operation_) return false;
  operation_ = 0;
  // If it was not written, another server has changed the name meanwhile, of which the follower tells.
  refused_ = reply.outcome != directory::Outcome::kDone || !reply.held;
  if (refused_) {
    const bool told = reply.outcome == directory::Outcome::kDone && !reply.found.empty();
    const directory::Revision modified = told && !reply.found[0].empty() ? reply.found[0][0].modified : 0;
    if (told && mark().modified != 0 && modified != mark().modified) read_again();
    return true;
  }
  if (change_.empty()) {
    stored_.erase(changing_);
  } else {
    Stored& stored = stored_[changing_];
    stored = {change_, reply.revision, stored.created == 0 ? reply.revision : stored.created};
  }
  return true;
}

SharedRegistry::Stored SharedRegistry::mark() const {
  const auto found = stored_.find(kMark);
  return found == stored_.end() ? Stored{} : found->second;
}

bool SharedRegistry::as_agreed() const {
  const Stored now = mark();
  return mark_.is_known({now.text, now.created});
}

bool SharedRegistry::unmarked() const {
  const std::string& text = stored_text(kMark);
  return text.empty() || mark_.is_outdated(text);
}

void SharedRegistry::begin_again() {
  mark_.lose();
  for (auto& [name, text] : agreed_)
    if (!local_known_ || !local_.contains(name)) lost_[name] = std::move(text);
  agreed_.clear();
}

void SharedRegistry::on_news(const directory::PrefixFollower::News& news) {
  const Stored before = mark();
  if (news.all) stored_.clear();
  for (const directory::Change& change : news.changes) apply(change);
  if (news.back || ((news.all || !before.text.empty()) && !as_agreed())) begin_again();
  // The changes of another directory do not fit to the copy of the one before.
  const bool other = !before.text.empty() && (before.text != mark().text || before.modified != mark().modified);
  if (!news.all && other) read_again();
}

void SharedRegistry::apply(const directory::Change& change) {
  const std::string name = change.entry.key.substr(prefix_.size());
  if (change.erased) {
    stored_.erase(name);
    return;
  }
  const bool readable = name == kMark ? directory::DirectoryMark::valid(change.entry.value)
                                      : auth::is_valid_name(name) && readable_entry(change.entry.value);
  if (!readable) ++rejected_;
  stored_[name] = {readable ? change.entry.value : "", change.entry.modified, change.entry.created};
}

void SharedRegistry::set_local(RegistryEntries local) {
  local_ = std::move(local);
  local_known_ = true;
  for (const auto& [name, text] : local_) lost_.erase(name);
  agree();
}

void SharedRegistry::agree() {
  if (!follower_.follows() || !local_known_ || unmarked()) return;
  if (!as_agreed()) begin_again();
  mark_.set_known({mark().text, mark().created});
  for (const std::string& name : names()) {
    const std::string& local = text_in(local_, name);
    if (unreadable(name) || local != stored_text(name)) continue;
    spent_.note(name, text_in(agreed_, name), local);
    if (local.empty()) {
      agreed_.erase(name);
    } else {
      agreed_[name] = local;
    }
  }
}

std::optional<RegistryEntries> SharedRegistry::wanted() const {
  if (!follower_.follows() || !local_known_ || mark_.known().text.empty() || !as_agreed()) return std::nullopt;
  RegistryEntries all;
  for (const std::string& name : names())
    if (std::string text = merged(name); !text.empty()) all[name] = std::move(text);
  if (all != local_) all = tenable(all, local_);
  return all == local_ ? std::nullopt : std::optional(std::move(all));
}

}  // namespace tandem::server
