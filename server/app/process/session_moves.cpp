// Sessions on the shards of a server: their loads, and sessions that move from a strained shard to another.
#include <algorithm>

#include "common/base/format.h"
#include "server/app/process/session_table.h"

namespace tandem::server {

std::vector<ShardView> SessionTable::shard_views() const {
  std::vector<ShardView> views;
  for (std::size_t i = 0; i < shards_.all().size(); ++i)
    views.push_back({shards_.rates()[i], shards_.all()[i]->load().cpu_share()});
  return views;
}

/// The processor time of a thread has parts that belong to no session, and the kernel's part for datagrams. They are
/// divided in proportion to the measured time of each session's own work.
std::vector<SessionView> SessionTable::session_views(std::span<const ShardView> shards) const {
  std::vector<SessionView> views;
  std::vector<double> sums(shards.size());
  for (const auto& session : sessions_) {
    const std::size_t slot = session->live_session().slot(), shard = shards_.shard_of_slot(slot);
    views.push_back({slot, shard, session->live_session().over() ? 0 : session->live_session().cost()});
    sums[shard] += views.back().cost;
  }
  for (SessionView& view : views) view.cost *= sums[view.shard] > 0 ? shards[view.shard].load / sums[view.shard] : 0;
  return views;
}

std::vector<ShardView> SessionTable::expected_loads() const {
  std::vector<ShardView> loads = shard_views();
  const std::vector<SessionView> sessions = session_views(loads);
  for (ShardView& shard : loads) shard.load = 0;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const SceneSpec& scene = sessions_[i]->options().scene;
    // A session whose clients have not joined costs less than it soon will.
    const bool begun = sessions_[i]->live_session().status().state != wire::SessionState::kWaiting;
    const double expected = expected_cost({scene.tick_hz, scene.seats.size()});
    const double measured = sessions[i].cost;
    loads[sessions[i].shard].load += begun && measured > 0 ? measured : std::max(measured, expected);
  }
  return loads;
}

std::vector<SessionUse> SessionTable::uses() const {
  const std::vector<SessionView> views = session_views(shard_views());
  std::vector<SessionUse> uses;
  for (std::size_t i = 0; i < views.size(); ++i) {
    SessionInstance& session = *sessions_[i];
    if (session.live_session().over()) continue;
    const SceneSpec& scene = session.options().scene;
    const SessionStatus status = session.live_session().status();
    // It ends 10 s after the last participant has left, which its next owner would not know of.
    const bool ends_soon = scene.endless() && std::ranges::any_of(status.seats, &SeatStatus::ever_taken);
    uses.push_back({.name = session.options().name,
                    .measured = views[i].cost,
                    .expected = std::max(views[i].cost, expected_cost({scene.tick_hz, scene.seats.size()})),
                    .waiting = std::ranges::none_of(status.seats, &SeatStatus::taken) && !ends_soon});
  }
  return uses;
}

void SessionTable::balance(Time now) {
  if (draining_ || shards_.all().size() < 2) return;
  const std::vector<ShardView> shards = shard_views();
  const auto wanted = balancer_.step(now, shards, session_views(shards));
  if (!wanted) return;
  const auto found =
      std::ranges::find_if(sessions_, [&](const auto& s) { return s->live_session().slot() == wanted->slot; });
  SessionInstance& session = **found;
  const bool moved = move(session, wanted->to);
  report(session, session.live_session().status(),
         {.event = moved ? "session_moved" : "session_not_moved",
          .seat = "",
          .text = (moved ? "moved from " : "could not be moved from ") + shard_text(wanted->from) + ", which took " +
                  format("%.0f %% of a processor, to ", 100 * shards[wanted->from].load) + shard_text(wanted->to) +
                  format(" with %.0f %%", 100 * shards[wanted->to].load),
          .warning = !moved});
}

bool SessionTable::move(SessionInstance& session, std::size_t to) {
  const io::Steering changed = shards_.steering_with(session.live_session().slot(), to);
  const io::SteeringProgram there{changed}, before{shards_.steering()};
  bool moved = false;
  control_.change([&](SessionRegistry& registry, const auto& done) {
    registry.move(session.id(), *shards_.all()[to], there, before, [&moved, done](bool served) {
      moved = served;
      done();
    });
  });
  if (moved) shards_.set_steering(changed);
  return moved;
}

std::string SessionTable::shard_text(std::size_t shard) const {
  return format("thread %zu (%g Hz)", shard, shards_.rates()[shard]);
}

}  // namespace tandem::server
