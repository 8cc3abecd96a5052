// Sessions that operators create and end at run time.
#include <algorithm>
#include <set>
#include <utility>

#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/processors.h"
#include "server/app/process/session_table.h"

namespace tandem::server {

using rpc::ErrorCode;
using rpc::ErrorReply;

void SessionTable::execute(SessionOrder order) {
  if (const auto* const wanted = std::get_if<rpc::CreateSession>(&order.body)) {
    reply(order, create_session(*wanted));
  } else if (std::holds_alternative<rpc::SceneListRequest>(order.body)) {
    reply(order, list_scenes(options_.scenes));
  } else if (const auto* const record = std::get_if<rpc::RecordSession>(&order.body)) {
    reply(order, record_session(*record));
  } else {
    end_session(std::move(order));
  }
}

void SessionTable::reply(const SessionOrder& order, rpc::Body body) {
  control_.change([&](SessionRegistry&, const auto& done) {
    order.answer(std::move(body));
    done();
  });
}

std::optional<ErrorReply> SessionTable::creation_problem() const {
  if (draining_) return ErrorReply{ErrorCode::kDraining, "this server is draining and creates no sessions", 10};
  const auto created = static_cast<std::size_t>(std::ranges::count_if(sessions_, [&](const auto& session) {
    return session->created() && std::ranges::find(options_.sessions, session->options().name, &SessionOptions::name) ==
                                     options_.sessions.end();
  }));
  if (created < options_.created_max) return std::nullopt;
  return ErrorReply{ErrorCode::kFull,
                    options_.created_max == 0
                        ? "this server creates no sessions (limits { created_sessions: 0 })"
                        : format("%zu created sessions are open, and this server allows %zu; end one first", created,
                                 options_.created_max),
                    0};
}

std::expected<std::size_t, ErrorReply> SessionTable::find_shard(double tick_hz) {
  if (const auto shard = least_loaded(expected_loads(), tick_hz)) return *shard;
  if (options_.service) {
    const auto added = shards_.add(tick_hz);
    if (!added)
      return std::unexpected(ErrorReply{
          ErrorCode::kFull, format("no thread ticks at %g Hz, and none can be added: ", tick_hz) + added.error(), 5});
    control_.change([&](SessionRegistry& registry, const auto& done) {
      registry.requests().watch(*shards_.all()[*added]);
      done();
    });
    return *added;
  }
  std::string known;
  for (const double rate : std::set<double>(shards_.rates().begin(), shards_.rates().end()))
    known += (known.empty() ? "" : ", ") + format("%g", rate);
  return std::unexpected(
      ErrorReply{ErrorCode::kNotAllowed,
                 format("the scene has tick_hz %g, and the threads of this server tick at ", tick_hz) + known +
                     " Hz; change the scene, or configure a session of this rate and restart the server",
                 0});
}

std::expected<SessionTable::Place, ErrorReply> SessionTable::find_place(const SceneSpec& scene) {
  if (sessions_.size() >= rpc::kSessionsMax)
    return std::unexpected(ErrorReply{ErrorCode::kFull,
                                      format("%zu sessions are open, and a server has at most %zu; end one first",
                                             sessions_.size(), rpc::kSessionsMax),
                                      0});
  const auto shard = find_shard(scene.tick_hz);
  if (!shard) return std::unexpected(shard.error());
  for (std::size_t slot = 0; slot < Shard::kSessionsMax; ++slot) {
    const bool taken =
        std::ranges::any_of(sessions_, [&](const auto& session) { return session->live_session().slot() == slot; });
    if (!taken) return Place{slot, *shard};
  }
  return std::unexpected(ErrorReply{ErrorCode::kFull, "all slots of sessions are in use; end one first", 0});
}

std::optional<ErrorReply> SessionTable::load_problem(double tick_hz) const {
  double all = 0;
  for (const auto& shard : shards_.all()) all += shard->load().cpu_share();
  Load own{};
  if (const auto shard = least_loaded(expected_loads(), tick_hz)) {
    const ShardLoad& load = shards_.all()[*shard]->load();
    own = {load.cpu_share(), load.state().level == ShedLevel::kNewJoins};
  }
  std::string why = rejection_reason(own, all, io::available_processors(), options_.control.load_limits);
  if (why.empty()) return std::nullopt;
  return ErrorReply{ErrorCode::kFull, std::move(why), 5};
}

rpc::Body SessionTable::create_session(const rpc::CreateSession& wanted) {
  if (auto problem = creation_problem()) return std::move(*problem);
  const bool configured =
      std::ranges::find(options_.sessions, wanted.name, &SessionOptions::name) != options_.sessions.end();
  if (configured || std::ranges::any_of(sessions_, [&](const auto& s) { return s->options().name == wanted.name; }))
    return ErrorReply{ErrorCode::kNotAllowed,
                      "a session " + wanted.name + " exists already; choose another name, or end that session first",
                      0};
  auto checked = created_session_options(wanted, options_.scenes);
  if (!checked) return std::move(checked.error());
  checked->reports = options_.reports;
  checked->record = options_.record;
  const auto options = std::make_shared<const SessionOptions>(std::move(*checked));
  const auto place = find_place(options->scene);
  if (!place) return place.error();
  if (auto problem = load_problem(options->scene.tick_hz)) return std::move(*problem);

  if (!shards_.assign(place->slot, place->shard))
    return ErrorReply{ErrorCode::kInternal, "the kernel gives no memory for the distribution of datagrams", 5};
  auto opened = SessionInstance::open(*options,
                                      {.slot = static_cast<std::uint8_t>(place->slot),
                                       .with_code = !control_.ephemeral_keys() && !options->tickets_only},
                                      inputs_);
  if (!opened)
    return ErrorReply{ErrorCode::kBadFrame, reply_text({{wanted.name, 0, 0, "", "", opened.error().texts.front()}}), 0};
  SessionInstance& session = **opened;
  session.keep_options(options, wanted.life_s == 0
                                    ? std::nullopt
                                    : std::optional(io::monotonic_now() + std::chrono::seconds(wanted.life_s)));
  rpc::SessionCreated created{.session = {}, .code = session.code(), .tickets = {}};
  auto served = serve_opened(std::move(*opened));
  if (!served)
    return ErrorReply{ErrorCode::kNotNow, "the thread of this tick rate takes no sessions at present; try again", 1};
  created.session = std::move(*served);
  return created;
}

std::optional<rpc::ListedSession> SessionTable::serve_opened(std::unique_ptr<SessionInstance> opened) {
  SessionInstance& session = *opened;
  hints_.set_several();
  std::optional<rpc::ListedSession> listed;
  control_.change([&](SessionRegistry& registry, const auto& done) {
    registry.add_running(registration_of(session), [&, done](bool accepted) {
      if (accepted) listed = SessionRegistry::listed(registry.entries().back());
      done();
    });
  });
  if (!listed) {
    control_.change([&](SessionRegistry& registry, const auto& done) { registry.remove(session.id(), done); });
    return std::nullopt;
  }
  sessions_.push_back(std::move(opened));
  announce(session);
  start_recording(session);
  return listed;
}

void SessionTable::end_session(SessionOrder order) {
  const rpc::EndSession& wanted = std::get<rpc::EndSession>(order.body);
  const auto found =
      std::ranges::find_if(sessions_, [&](const auto& session) { return session->id() == wanted.session_id; });
  if (found == sessions_.end())
    return reply(order, ErrorReply{ErrorCode::kNoSession, "this server has no such session", 0});
  SessionInstance& session = **found;
  const auth::Id16 id = session.id();
  if (session.end == EndReason::kGivenUp) return reply(order, goes_on_elsewhere(session));
  if (!session.end) {
    session.end = EndReason::kOperator;
    const std::string text = "ENDED by " + order.who + (wanted.why.empty() ? "" : ": " + wanted.why);
    report(session, session.live_session().status(), {"ended", "", text});
    control_.change([&](SessionRegistry& registry, const auto& done) {
      registry.end(id);
      done();
    });
  }
  endings_.push_back({id, std::move(order)});
}

std::vector<SessionOrder> SessionTable::take_endings(const auth::Id16& id) {
  std::vector<SessionOrder> taken;
  const auto rest = std::ranges::stable_partition(endings_, [&](const Ending& e) { return e.session != id; });
  for (Ending& ending : rest) taken.push_back(std::move(ending.order));
  endings_.erase(rest.begin(), rest.end());
  return taken;
}

ErrorReply SessionTable::goes_on_elsewhere(const SessionInstance& session) {
  return {ErrorCode::kNotNow,
          "session " + session.options().name +
              " is leaving this server and goes on at another one of the service; join it there and end it again",
          2};
}

}  // namespace tandem::server
