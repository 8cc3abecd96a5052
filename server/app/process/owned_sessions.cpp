// Sessions that this server owns in a service of several servers.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "common/io/clock.h"
#include "server/app/process/session_table.h"

namespace tandem::server {
namespace {

constexpr std::int64_t kSnapshotAgeMax = 86'400;  // [s] by two clocks: more is their difference

}  // namespace

std::string SessionTable::open_owned(OwnedSession owned) {
  if (draining_) return "this server is draining and takes no sessions";
  const std::string& name = owned.options->name;
  if (std::ranges::any_of(sessions_, [&](const auto& s) { return s->options().name == name; }))
    return "this server has a session " + name + " that is not over yet";
  const auto place = find_place(owned.options->scene);
  if (!place) return place.error().text;
  if (!shards_.assign(place->slot, place->shard)) return "the kernel gives no memory for the distribution of datagrams";
  CheckpointStore::Found found;
  std::optional<std::int64_t> age_s;
  if (owned.snapshot) {
    // Another machine wrote the time. Clocks may differ, so participants have the whole time to come back from now on.
    const std::int64_t now = auth::wall_seconds();
    if (const std::int64_t age = now - owned.snapshot->written_s; age >= 0 && age <= kSnapshotAgeMax) age_s = age;
    owned.snapshot->written_s = now;
    found.incompatibility = incompatibility(*owned.snapshot, name, owned.options->scene, owned.snapshot->written_s);
    if (found.incompatibility.empty()) {
      // For the same reason the session has the rest of its time that its former owner counted.
      if (const auto left = owned.snapshot->life_left_s; left && owned.ends_at)
        owned.ends_at = io::monotonic_now() + std::chrono::seconds(*left);
      found.snapshot = std::move(owned.snapshot);
    }
  }
  auto opened = SessionInstance::open(*owned.options,
                                      {.slot = static_cast<std::uint8_t>(place->slot),
                                       .epoch = owned.revision,
                                       .with_code = !owned.code.empty(),
                                       .kept = found.snapshot ? &*found.snapshot : nullptr,
                                       .id = owned.id,
                                       .code = owned.code},
                                      inputs_);
  if (!opened) return opened.error().texts.front();
  SessionInstance& session = **opened;
  session.keep_options(std::move(owned.options), owned.ends_at);
  session.set_keeper(owned.keeper);
  session.set_owned(std::move(owned.on_over), std::move(owned.consoles));
  session.live_session().set_act_limit(std::move(owned.act_limit));
  if (!serve_opened(std::move(*opened))) return "the thread of this tick rate takes no sessions at present";
  report_restored(session, found, age_s);
  return {};
}

void SessionTable::give_up(const std::string& name) {
  end_here(name,
           {"given_up", "", "GIVEN UP: this server owns the session no more; its clients join the next owner", true});
}

bool SessionTable::hand_over(const std::string& name, std::string text) {
  const auto found = std::ranges::find_if(sessions_, [&](const auto& s) { return s->options().name == name; });
  if (found == sessions_.end()) return false;
  const bool leaves = (*found)->end == EndReason::kGivenUp;
  if (!leaves && ((*found)->end || (*found)->live_session().ends())) return false;
  end_here(name, {"moves", "", std::move(text), false});
  return true;
}

void SessionTable::end_here(const std::string& name, const PresenceTracker::Event& event) {
  const auto found = std::ranges::find_if(
      sessions_, [&](const auto& s) { return s->options().name == name && s->on_over() != nullptr; });
  if (found == sessions_.end()) return;
  SessionInstance& session = **found;
  session.live_session().stop_acting();
  if (session.end == EndReason::kGivenUp) return;
  session.end = EndReason::kGivenUp;
  report(session, session.live_session().status(), event);
  control_.change([&](SessionRegistry& registry, const auto& done) {
    registry.end(session.id(), wire::CloseReason::kServerReturns);
    done();
  });
}

}  // namespace tandem::server
