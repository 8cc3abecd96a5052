#include "server/app/service/registry_mirror.h"

#include <optional>
#include <utility>

#include "common/base/raw_bytes.h"

namespace tandem::server {

RegistryAgreement RegistryMirror::read_agreement(const auth::StateDirectory& folder) {
  const auto bytes = folder.read(kFile);
  if (!bytes || !*bytes) return {};
  return parse_registry_agreement(text_of(std::as_const(**bytes).bytes())).value_or(RegistryAgreement{});
}

void RegistryMirror::start() {
  stored_ = read_agreement(*keys_.folder());
  task_.start();
}

void RegistryMirror::stop() {
  task_.stop();
  stops_ = true;
  if (const std::string problem = compare(); !problem.empty()) on_trouble_(problem);
}

bool RegistryMirror::worth_storing(const RegistryAgreement& agreed, const RegistryAgreement& stored, Duration age) {
  RegistryAgreement known = agreed;
  known.revision = stored.revision;
  return known != stored || (agreed.revision != stored.revision && age >= kRevisionInterval);
}

std::string RegistryMirror::compare() {
  const bool fresh = keys_.registry().changed() || !lists_;
  if (fresh) {
    auto lists = keys_.registry().lists();
    if (!lists) {
      lists_.reset();
      return lists.error();
    }
    lists_ = std::move(*lists);
  }
  std::optional<RegistryEntries> wanted;
  RegistryAgreement agreed;
  service_.quietly([&](ServiceMember& member, Time now) {
    if (fresh) member.registry().set_local(entries_of(*lists_));
    member.registry().forget_expired_codes(auth::wall_seconds());
    wanted = member.registry().wanted();
    agreed = member.agreement(now);
  });
  if (wanted) {
    const auto replaced = keys_.registry().replace(*lists_, lists_of(*wanted), auth::wall_seconds());
    if (!replaced) return replaced.error();
    // At once, so that a change of the files from now on counts as a change of what both sides had.
    if (*replaced)
      service_.quietly([&](ServiceMember& member, Time) { member.registry().set_local(std::move(*wanted)); });
    return {};
  }
  const auto now = std::chrono::steady_clock::now();
  const Duration age = stops_ ? Duration::max() : now - stored_at_;
  if (agreed.mark.empty() || !worth_storing(agreed, stored_, age)) return {};
  if (std::string problem = keys_.folder()->replace(kFile, std::string_view(to_text(agreed))); !problem.empty())
    return problem;
  stored_ = std::move(agreed);
  stored_at_ = now;
  return {};
}

}  // namespace tandem::server
