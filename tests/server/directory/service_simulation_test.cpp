#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <map>
#include <memory>
#include <set>

#include "common/base/format.h"
#include "server/directory/model_store.h"
#include "server/directory/ownership.h"
#include "server/directory/placement/move_planner.h"
#include "server/directory/placement/placement.h"
#include "server/directory/placement/server_record.h"
#include "tests/common/base/counts.h"

namespace tandem::directory {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kServers = 100, kSessions = 10'000, kZones = 10;
constexpr Duration kStep = 20ms;  ///< a request, or a reply, takes this long

/// A service of many servers with the cores of ownership and placement, in virtual time. Clients without an owner ask a
/// random server once in a while.
class Service {
 public:
  explicit Service(std::uint64_t seed) : draws_(seed) {
    for (std::size_t n = 0; n < kServers; ++n) {
      servers_.push_back(std::make_unique<Server>(seed * 1000 + n));
      start(n);
    }
    for (std::size_t s = 0; s < kSessions; ++s) {
      // A session ticks for 2 to 10 seats' share; all together use 60 % of 100 cores.
      sessions_.push_back(
          {format("session-%zu", s), draws_.uniform(0.002, 0.010), Time{} + from_seconds(draws_.uniform(2, 20))});
      index_[sessions_.back().name] = s;
    }
  }

  void crash(std::size_t n) {
    Server& server = *servers_[n];
    for (const auto& [s, since] : server.owned) lose(s);
    server.owned.clear();
    server.core.reset();
    server.directory.reset();
    server.replies.clear();
  }
  void start(std::size_t n) {
    Server& server = *servers_[n];
    server.used = 0;
    server.directory = std::make_unique<ModelDirectory>(store_);
    server.core = std::make_unique<Ownership>(name(n), text(n), LeaseTimes{});
  }
  void elect() { store_.elect(); }

  void pass(Duration time) {
    for (const Time end = now_ + time; now_ < end;) {
      now_ += kStep;
      store_.advance(now_);
      for (std::size_t n = 0; n < kServers; ++n)
        if (servers_[n]->core) step(n);
      for (std::size_t s = 0; s < kSessions; ++s) ask(s);
    }
  }

  /// Largest use of a running server, as a multiple of the mean.
  [[nodiscard]] double spread() const {
    double most = 0, sum = 0;
    std::size_t running = 0;
    for (const auto& server : servers_) {
      if (!server->core) continue;
      most = std::max(most, server->used);
      sum += server->used;
      ++running;
    }
    return most * static_cast<double>(running) / sum;
  }
  /// Longest time for which a session that clients want had no owner, also if it has none yet.
  [[nodiscard]] Duration longest_without_owner() const {
    Duration longest = longest_;
    for (const Session& session : sessions_)
      if (session.owners == 0 && session.wanted <= now_)
        longest = std::max(longest, now_ - (session.began ? session.unowned_since : session.wanted));
    return longest;
  }
  [[nodiscard]] bool two_owners() const { return two_owners_; }
  [[nodiscard]] std::uint64_t writes() const { return store_.writes(); }
  [[nodiscard]] std::uint64_t requests() const { return requests_; }
  [[nodiscard]] std::uint64_t moves() const { return moves_; }

 private:
  struct Server {
    explicit Server(std::uint64_t seed) : placement(RandomKey{seed}), planner(RandomKey{seed + 1'000'000}) {}
    std::unique_ptr<Ownership> core;
    std::unique_ptr<ModelDirectory> directory;
    std::deque<Reply> replies;  ///< on their way
    Placement placement;
    MovePlanner planner;
    std::map<std::size_t, Time> owned;  ///< since
    double used = 0, published = 0;
    Time next_publication{}, next_plan{};
  };
  struct Session {
    std::string name;
    double cost = 0;
    Time wanted{};  ///< clients come
    std::size_t owners = 0;
    Time unowned_since{}, next_question{};
    bool began = false;
  };

  static std::string name(std::size_t n) { return format("server-%zu", n); }
  std::string text(std::size_t n) const {
    return to_text({"10.0.0.1:7000", "key", "1", format("zone-%zu", n % kZones), 1.0, servers_[n]->used, false,
                    servers_[n]->used});
  }
  std::vector<Candidate> candidates(const Server& server) const {
    std::vector<Candidate> out;
    for (const auto& [each, entry] : server.core->view().servers())
      if (const auto record = parse_server_record(entry.text))
        out.push_back({each, record->zone, record->capacity, record->used, record->drains});
    return out;
  }

  void step(std::size_t n) {
    Server& server = *servers_[n];
    for (; !server.replies.empty(); server.replies.pop_front()) server.core->on_reply(now_, server.replies.front());
    while (const auto notice = server.core->poll_notice()) on_notice(n, *notice);
    publish(n);
    plan(n);
    while (const auto operation = server.core->poll_operation(now_)) {
      server.directory->begin(operation->id, operation->request);
      ++requests_;
    }
    while (auto reply = server.directory->poll()) server.replies.push_back(std::move(*reply));
  }
  void on_notice(std::size_t n, const Notice& notice) {
    Server& server = *servers_[n];
    if (notice.kind == Notice::Kind::kLost) server.core->forget(notice.session);
    const auto found = index_.find(notice.session);
    if (found == index_.end()) return;
    const std::size_t s = found->second;
    Session& session = sessions_[s];
    if (notice.kind == Notice::Kind::kOwned) {
      if (session.began) longest_ = std::max(longest_, now_ - session.unowned_since);
      session.began = true;
      two_owners_ |= ++session.owners > 1;
      server.owned[s] = now_;
      server.used += session.cost;
      if (const auto standby = server.placement.place_standby(candidates(server), session.cost, name(n)))
        server.core->set_standby(session.name, *standby);
    } else if (notice.kind == Notice::Kind::kLost || notice.kind == Notice::Kind::kReleased) {
      if (server.owned.erase(s) == 0) return;
      server.used -= session.cost;
      lose(s);
      // The time in which the old owner ramped out belongs to the gap.
      if (notice.kind == Notice::Kind::kReleased) session.unowned_since -= LeaseTimes{}.ramp;
    } else if (notice.kind == Notice::Kind::kStandbyRefused) {
      if (const auto standby = server.placement.place_standby(candidates(server), session.cost, name(n)))
        server.core->set_standby(session.name, *standby);
    }
  }
  void lose(std::size_t s) {
    --sessions_[s].owners;
    sessions_[s].unowned_since = now_;
    sessions_[s].next_question = now_ + 1s + from_seconds(draws_.uniform(0, 0.5));
  }
  void publish(std::size_t n) {
    Server& server = *servers_[n];
    if (now_ < server.next_publication || std::abs(server.used - server.published) < 0.01) return;
    server.next_publication = now_ + 1s;
    server.published = server.used;
    server.core->describe(text(n));
  }
  void plan(std::size_t n) {
    Server& server = *servers_[n];
    if (now_ < server.next_plan || now_ < Time{} + 25s) return;
    server.next_plan = now_ + 500ms;
    std::vector<PlacedSession> own;
    for (const auto& [s, since] : server.owned)
      own.push_back({sessions_[s].name, sessions_[s].cost, sessions_[s].cost, false, false, since});
    std::vector<Candidate> servers = candidates(server);
    for (Candidate& candidate : servers)
      if (candidate.server == name(n)) candidate.used = candidate.expected = server.used;
    const auto move = server.planner.step(now_, servers, name(n), own);
    if (move && server.core->move(move->session, move->server)) ++moves_;
  }
  void ask(std::size_t s) {
    Session& session = sessions_[s];
    if (session.owners > 0 || now_ < session.wanted || now_ < session.next_question) return;
    session.next_question = now_ + 500ms + from_seconds(draws_.uniform(0, 0.5));
    const Server& asked = *servers_[draws_.below(kServers)];
    if (!asked.core || !asked.core->keeper().registered()) return;
    const DirectoryView::SessionEntry* known = asked.core->view().session(session.name);
    if (known && known->owner) return;  // the client is sent to the owner, and finds it gone
    Placement placement(RandomKey{draws_.bits()});
    const auto chosen = placement.place(candidates(asked), session.cost);
    for (std::size_t n = 0; chosen && n < kServers; ++n)
      if (name(n) == *chosen && servers_[n]->core) servers_[n]->core->claim(session.name);
  }

  RandomStream draws_;
  ModelStore store_;
  Time now_{};
  std::vector<std::unique_ptr<Server>> servers_;
  std::vector<Session> sessions_;
  std::map<std::string, std::size_t, std::less<>> index_;
  Duration longest_{};
  bool two_owners_ = false;
  std::uint64_t requests_ = 0, moves_ = 0;
};

/// Spread of the load (largest / mean) at several times, and what the run cost. One value per seed.
struct Figures {
  std::vector<double> placed, balanced, crashes, without_zone, back, ownerless_s, moves, calm_writes, calm_requests,
      failing_writes;
};

void print(const char* what, const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  std::printf("[ service  ] %-52s mean %.3f worst %.3f\n", what, sum / static_cast<double>(values.size()),
              *std::ranges::max_element(values));
}

/// A service that starts, rests, loses ten servers one after the other, then a whole zone, then the store's leader.
void run(std::uint64_t seed, Figures& figures) {
  Service service(seed);
  service.pass(30s);
  figures.placed.push_back(service.spread());
  const std::uint64_t writes = service.writes(), requests = service.requests();
  service.pass(30s);
  figures.calm_writes.push_back(static_cast<double>(service.writes() - writes) / 30);
  figures.calm_requests.push_back(static_cast<double>(service.requests() - requests) / 30);
  figures.balanced.push_back(service.spread());
  double worst = 0;
  const std::uint64_t before = service.writes();
  for (std::size_t n = 0; n < 10; ++n) {
    service.crash(11 * n);
    service.pass(4s);
    worst = std::max(worst, service.spread());
    service.start(11 * n);
    service.pass(6s);
    worst = std::max(worst, service.spread());
  }
  figures.crashes.push_back(worst);
  figures.failing_writes.push_back(static_cast<double>(service.writes() - before) / 100);
  for (std::size_t n = 3; n < kServers; n += kZones) service.crash(n);
  service.pass(10s);
  figures.without_zone.push_back(service.spread());
  service.elect();
  service.pass(10s);
  for (std::size_t n = 3; n < kServers; n += kZones) service.start(n);
  service.pass(60s);
  figures.back.push_back(service.spread());
  figures.ownerless_s.push_back(seconds(service.longest_without_owner()));
  figures.moves.push_back(static_cast<double>(service.moves()));
  EXPECT_FALSE(service.two_owners());
}

TEST(ServiceSimulation, HundredServersCarryTenThousandSessionsThroughFailures) {
  const std::size_t seeds = tandem::test::draws(1, 20, 20);
  Figures all;
  for (std::size_t seed = 1; seed <= seeds; ++seed) run(seed, all);
  std::printf("[ service  ] %zu of 20 seeds; spread of the load: largest / mean\n", seeds);
  print("spread as placed", all.placed);
  print("spread after 30 s of balance", all.balanced);
  print("largest spread around 10 crashes", all.crashes);
  print("spread 10 s after the loss of a zone", all.without_zone);
  print("spread with all servers back", all.back);
  print("longest time of a session without owner [s]", all.ownerless_s);
  print("moves", all.moves);
  print("writes a second at rest", all.calm_writes);
  print("requests a second at rest", all.calm_requests);
  print("writes a second with a crash each 10 s", all.failing_writes);
  for (const auto* spread : {&all.placed, &all.balanced, &all.without_zone, &all.back})
    EXPECT_LE(*std::ranges::max_element(*spread), 1.2);
  EXPECT_LE(*std::ranges::max_element(all.ownerless_s), 7);
}

}  // namespace
}  // namespace tandem::directory
