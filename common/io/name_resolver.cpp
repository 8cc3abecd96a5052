#include "common/io/name_resolver.h"

#include <poll.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

#include "common/io/event_fd.h"
#include "common/io/thread_without_signals.h"

namespace tandem::io {

/// A lookup whose result no call has taken yet.
struct NameResolver::Pending {
  EventFd done;
  std::optional<std::expected<Addresses, std::string>> result;  ///< guarded by `Shared::mutex`
};

/// State that the threads share with the resolver, which they may outlive.
struct NameResolver::Shared {
  Lookup lookup;
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<Pending>> pending;
};

NameResolver::NameResolver(Lookup lookup) : shared_(std::make_shared<Shared>()) { shared_->lookup = std::move(lookup); }

const NameResolver& NameResolver::system() {
  static const NameResolver shared([](const std::string& text) { return resolve_addresses(text, 1); });
  return shared;
}

/// Returns the lookup of `text`, which it starts if there is none. @return null: too many lookups last
std::shared_ptr<NameResolver::Pending> NameResolver::pending(const std::string& text) const {
  const std::lock_guard lock(shared_->mutex);
  auto& all = shared_->pending;
  if (const auto known = all.find(text); known != all.end()) return known->second;
  if (all.size() >= kLookupsMax) std::erase_if(all, [](const auto& each) { return each.second->result.has_value(); });
  if (all.size() >= kLookupsMax) return nullptr;
  auto made = std::make_shared<Pending>();
  try {
    thread_without_signals([shared = shared_, made, text] {
      auto result = shared->lookup(text);
      {
        const std::lock_guard hold(shared->mutex);
        made->result = std::move(result);
      }
      made->done.signal();
    }).detach();
  } catch (const std::system_error&) {  // the system gives no thread
    return nullptr;
  }
  all.emplace(text, made);
  return made;
}

std::expected<NameResolver::Addresses, NameResolver::Failure> NameResolver::resolve(std::string_view text,
                                                                                    Duration wait, int signals) const {
  if (const auto address = numeric_address(text, 1)) return Addresses{*address};
  const std::string name{text};
  const auto lookup = pending(name);
  pollfd files[] = {{signals, POLLIN, 0}, {lookup ? lookup->done.get() : -1, POLLIN, 0}};
  const auto wait_ms = std::chrono::ceil<std::chrono::milliseconds>(wait).count();
  if (lookup) ::poll(files, 2, static_cast<int>(std::clamp<decltype(wait_ms)>(wait_ms, 0, 3'600'000)));
  if (files[0].revents != 0)
    return std::unexpected(Failure{Failure::Kind::kInterrupted, "\"" + name + "\": interrupted"});
  const std::lock_guard lock(shared_->mutex);
  if (!lookup || !lookup->result)
    return std::unexpected(Failure{Failure::Kind::kPending, "\"" + name + "\": no answer of the DNS server yet"});
  if (const auto known = shared_->pending.find(name); known != shared_->pending.end() && known->second == lookup)
    shared_->pending.erase(known);
  if (!*lookup->result) return std::unexpected(Failure{Failure::Kind::kUnknown, lookup->result->error()});
  return **lookup->result;
}

}  // namespace tandem::io
