#include "tests/server/directory/model_check.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include "common/base/format.h"
#include "common/base/rng.h"
#include "server/directory/model_store.h"
#include "server/directory/ownership.h"
#include "tests/server/directory/guard_removal.h"
#include "tests/server/directory/simulated_world.h"

namespace tandem::directory::test {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t kClientsPerSession = 2;
class Run : SimulatedWorld {
 public:
  Run(const Schedule& schedule, Guard removed) : SimulatedWorld(schedule, removed) {
    store_rate_ = 1 + schedule.drift[0];
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      start(n);
      tick(n);
    }
    for (std::size_t n = 0; n < schedule.sessions * kClientsPerSession; ++n) {
      clients_.emplace_back().session = n / kClientsPerSession;
      ask_around(n);
    }
    for (std::size_t n = 0; n < schedule.sessions; ++n) present_tickets(n);
    for (const Fault& fault : schedule.faults) at(Time{} + fault.at, [this, fault] { begin(fault); });
    store_tick();
  }

  Verdict run() {
    const Time calm = Time{} + schedule_.calm;
    while (verdict_.violation.empty()) {
      events_.step();
      ++verdict_.events;
      check_owners();
      if (now() <= calm) continue;
      if (not_served().empty()) {
        verdict_.recovered = now() - calm;
        break;
      }
      if (now() > calm + kCalmLimit) fail(not_served());
    }
    for (const Node& node : nodes_)
      if (node.core) verdict_.doubtful += node.core->keeper().doubtful_renewals();
    return verdict_;
  }

 private:
  // ---- servers ----
  void start(std::size_t n) {
    Node& node = nodes_[n];
    ++node.incarnation;
    node.watches.clear();
    node.core = std::make_unique<Ownership>(server_name(n), "text", times_);
  }
  void tick(std::size_t n) {
    after(draw(20ms, 60ms), [this, n] {
      if (runs(nodes_[n])) pump(n);
      tick(n);
    });
  }
  /// Delivers to a process: never to a later one, and after a pause to a paused one.
  void deliver(std::size_t n, std::uint64_t incarnation, std::function<void()> what) {
    Node& node = nodes_[n];
    if (!node.core || node.incarnation != incarnation) return;
    if (now() < node.paused_until) {
      at(node.paused_until, [this, n, incarnation, what = std::move(what)] { deliver(n, incarnation, what); });
      return;
    }
    what();
    pump(n);
  }
  void pump(std::size_t n) {
    Node& node = nodes_[n];
    while (true) {
      const Duration out = delay(n), back = delay(n);
      // Counted from the arrival of the answer: the core gets that time as the time of sending.
      const Duration lie = removed_ == Guard::kSendingTime ? out + back : Duration{};
      auto operation = node.core->poll_operation(clock(node) + lie);
      if (!operation) break;
      send(n, operation->id, operation->request, out, back);
    }
    while (auto notice = node.core->poll_notice()) on_notice(n, *notice);
  }
  void on_notice(std::size_t n, const Notice& notice) {
    Node& node = nodes_[n];
    mix(n, static_cast<std::uint64_t>(notice.kind), static_cast<std::uint64_t>(notice.revision));
    if (notice.kind == Notice::Kind::kOwned) {
      ++verdict_.owners;
      const std::size_t standby = draws_.below(nodes_.size());
      if (chance(0.7)) node.core->set_standby(notice.session, server_name(standby));
    } else if (notice.kind == Notice::Kind::kElsewhere) {
      ++verdict_.elsewhere;
      refer(n, notice);
    } else if (notice.kind == Notice::Kind::kTicketAccepted) {
      ++verdict_.tickets;
      if (++accepted_[notice.other] > 1) fail("ticket " + notice.other + " was accepted twice");
      if (notice.other.starts_with("calm")) calm_tickets_.insert(notice.session);
    }
  }

  // ---- the store ----
  Time store_clock() const {
    return Time{} +
           Duration{static_cast<std::int64_t>(static_cast<double>(now().time_since_epoch().count()) * store_rate_)};
  }
  bool store_up() const { return now() >= store_down_until_; }
  void store_tick() {
    after(draw(10ms, 500ms), [this] {
      if (store_up()) {
        store_.advance(store_clock());
        send_changes();
      }
      store_tick();
    });
  }
  void send(std::size_t n, OperationId id, Request request, Duration out, Duration back) {
    const Node& node = nodes_[n];
    if (const auto own = answer_without_store(removed_, server_name(n), node.core->keeper().lease(), id, request))
      return reply(n, node.incarnation, *own, back);
    weaken(removed_, immortal_, request);
    const bool watch = std::holds_alternative<Watch>(request);
    if (watch && (now() < node.cut_store_until || now() < node.deposed_until || lost())) {
      return after(1s, [this, n, id, i = node.incarnation] { reply(n, i, broken(id), 0s); });
    }
    if (now() < node.cut_store_until || lost()) return;
    const int copies = !watch && chance(schedule_.duplicate) && !calm() ? 2 : 1;
    for (int copy = 0; copy < copies; ++copy) {
      const Duration extra = copy == 0 ? Duration{} : draw(0s, 5s);
      // No copy arrives in the calm phase: a late renewal would keep the lease of a server that is gone.
      if (copy > 0 && now() + out + extra > Time{} + schedule_.calm) continue;
      after(out + extra, [this, n, id, request, back, i = node.incarnation] { execute(n, i, id, request, back); });
    }
  }
  static Reply broken(OperationId id) {
    Reply reply;
    reply.operation = id;
    reply.outcome = Outcome::kUnknown;
    return reply;
  }
  void execute(std::size_t n, std::uint64_t incarnation, OperationId id, const Request& request, Duration back) {
    Node& node = nodes_[n];
    if (now() < node.deposed_until) {
      if (std::holds_alternative<Watch>(request)) return reply(n, incarnation, broken(id), back);
      if (const auto answer = store_.execute_deposed(id, request)) return reply(n, incarnation, *answer, back);
      // The member keeps the request until it learns of the new leader, or drops it.
      if (chance(0.5)) at(node.deposed_until, [=, this] { execute(n, incarnation, id, request, back); });
      return;
    }
    if (!store_up()) {
      if (std::holds_alternative<Watch>(request)) return reply(n, incarnation, broken(id), back);
      if (!chance(0.5)) return;
      return at(store_down_until_ + 1ms,
                [this, n, incarnation, id, request, back] { execute(n, incarnation, id, request, back); });
    }
    store_.advance(store_clock());
    if (std::holds_alternative<Watch>(request)) {
      const OperationId at_store = ++watch_ids_;
      Reply answer = store_.execute(at_store, request);
      answer.operation = id;
      if (answer.outcome == Outcome::kDone)
        node.watches[at_store] = id;
      else
        reply(n, incarnation, answer, back);
    } else {
      reply(n, incarnation, store_.execute(id, request), back);
    }
    send_changes();
  }
  void reply(std::size_t n, std::uint64_t incarnation, Reply answer, Duration back) {
    // The end of a watch is always reported, by the store or by the adapter.
    const bool end_of_watch = answer.outcome == Outcome::kUnknown || answer.outcome == Outcome::kCompacted;
    if (!end_of_watch && (now() < nodes_[n].cut_store_until || lost())) return;
    if (slow_until_ > now()) back += draw(0s, 1s);
    after(back, [this, n, incarnation, answer = std::move(answer)] {
      deliver(n, incarnation, [this, n, answer] {
        Reply changed = answer;
        weaken(removed_, server_name(n), nodes_[n].core->keeper().lease(), changed);
        nodes_[n].core->on_reply(clock(nodes_[n]), changed);
      });
    });
  }
  void send_changes() {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      Node& node = nodes_[n];
      for (auto watch = node.watches.begin(); watch != node.watches.end();) {
        auto changes = store_.take_changes(watch->first);
        if (!changes) {
          ++watch;
          continue;
        }
        changes->operation = watch->second;
        const bool cut = now() < node.cut_store_until || now() < node.deposed_until || lost();
        if (cut) *changes = broken(watch->second);
        const Time arrival = std::max(now() + (cut ? Duration{1s} : delay(n)), node.last_watch_delivery + 1ns);
        node.last_watch_delivery = arrival;
        at(arrival, [this, n, i = node.incarnation, reply = *changes] {
          deliver(n, i, [this, n, reply] { nodes_[n].core->on_reply(clock(nodes_[n]), reply); });
        });
        if (cut || changes->outcome != Outcome::kDone) {
          store_.close(watch->first);
          watch = node.watches.erase(watch);
        } else {
          ++watch;
        }
      }
    }
  }

  // ---- faults ----
  void begin(const Fault& fault) {
    Node& node = nodes_[fault.kind == Fault::Kind::kMove ? 0 : fault.who];
    const Time end = now() + fault.length;
    switch (fault.kind) {
      case Fault::Kind::kSuspend:
        if (removed_ == Guard::kSuspendedClock) at(end, [&node, length = fault.length] { node.offset -= length; });
        [[fallthrough]];
      case Fault::Kind::kPause:
        for (std::size_t s = 0; s < schedule_.sessions; ++s)
          node.acted_as[s] = acts(node, s) ? node.core->revision(session_name(s)) : 0;
        node.paused_until = std::max(node.paused_until, end);
        // A datagram that was almost sent when the pause began.
        return at(end, [this, who = fault.who] { send_old_forces(who); });
      case Fault::Kind::kCrash:
        node.core.reset();
        for (const auto& [watch, id] : node.watches) store_.close(watch);
        node.watches.clear();
        return at(end, [this, who = fault.who] {
          if (!nodes_[who].core) start(who);
        });
      case Fault::Kind::kCutStore:
        node.cut_store_until = std::max(node.cut_store_until, end);
        return;
      case Fault::Kind::kCutClients:
        node.cut_clients_until = std::max(node.cut_clients_until, end);
        return;
      case Fault::Kind::kWallClock:
        node.wall_offset += chance(0.5) ? draw(-10s, 10s) : (chance(0.5) ? -8760h : 8760h);
        return;
      case Fault::Kind::kElection:
      case Fault::Kind::kOutage:
        store_down_until_ = std::max(store_down_until_, end);
        return at(end, [this] {
          if (store_up()) store_.elect();
        });
      case Fault::Kind::kDeposed:
        if (!store_up()) return;
        store_.advance(store_clock());
        store_.elect();
        // The connection to the old leader stands for a time. Only what needs the quorum does not get through.
        node.deposed_until = std::min(end + 500ms, Time{} + schedule_.calm);
        return at(node.deposed_until + draw(10ms, 500ms),
                  [this, &node, end = std::min(end + 3500ms, Time{} + schedule_.calm)] {
                    node.cut_store_until = std::max(node.cut_store_until, end);
                  });
      case Fault::Kind::kSlowDisk:
        slow_until_ = std::max(slow_until_, end);
        return;
      case Fault::Kind::kCompact:
        if (store_up()) (void)store_.execute(0, Compact{store_.revision()});
        for (Node& each : nodes_) {
          for (const auto& [watch, id] : each.watches) {
            store_.close(watch);
            after(delay(static_cast<std::size_t>(&each - nodes_.data())), [this, &each, i = each.incarnation, id = id] {
              deliver(static_cast<std::size_t>(&each - nodes_.data()), i,
                      [this, &each, id] { each.core->on_reply(clock(each), broken(id)); });
            });
          }
          each.watches.clear();
        }
        return;
      case Fault::Kind::kMove:
        for (Node& each : nodes_)
          if (runs(each)) each.core->move(session_name(fault.who), server_name(fault.to));
        return;
    }
  }

  // ---- clients ----
  void to_server(std::size_t n, std::function<void()> what) {
    if (clients_cut(n) || lost()) return;
    after(delay(n), [this, n, what = std::move(what)] { deliver(n, nodes_[n].incarnation, what); });
  }
  void ask_around(std::size_t c) {
    after(draw(100ms, 400ms), [this, c] {
      Client& client = clients_[c];
      if (!client.server || now() - client.last_force > 1s) client.server = draws_.below(nodes_.size());
      ask(c);
      ask_around(c);
    });
  }
  void ask(std::size_t c) {
    const std::size_t n = *clients_[c].server;
    to_server(n, [this, c, n] { on_asked(c, n); });
  }
  void on_asked(std::size_t c, std::size_t n) {
    Node& node = nodes_[n];
    const std::string session = session_name(clients_[c].session);
    const SessionState state = node.core->state(session, clock(node));
    if (state == SessionState::kServing) return force(c, n, node.core->revision(session));
    if (state == SessionState::kLost) node.core->forget(session);
    if (state == SessionState::kLost || state == SessionState::kNone) node.core->claim(session);
  }
  void force(std::size_t c, std::size_t n, Revision revision) {
    if (clients_cut(n) || lost()) return;
    after(delay(n), [this, c, n, revision] {
      Client& client = clients_[c];
      if (revision < client.highest && removed_ != Guard::kHighestRevision) {
        ++verdict_.rejected;
        return;
      }
      if (revision < client.obeyed)
        fail(format("client %zu obeys revision %lld after a higher one", c, static_cast<long long>(revision)));
      client.highest = client.obeyed = std::max(client.obeyed, revision);
      client.last_force = now();
      client.server = n;
    });
  }
  void send_old_forces(std::size_t n) {
    for (std::size_t c = 0; c < clients_.size(); ++c)
      if (const Revision revision = nodes_[n].acted_as[clients_[c].session]; revision != 0) force(c, n, revision);
  }
  void refer(std::size_t n, const Notice& notice) {
    for (std::size_t c = 0; c < clients_.size(); ++c) {
      if (session_name(clients_[c].session) != notice.session || clients_cut(n) || lost()) continue;
      after(delay(n), [this, c, other = notice.other] {
        if (now() - clients_[c].last_force < 1s) return;
        for (std::size_t to = 0; to < nodes_.size(); ++to)
          if (server_name(to) == other) clients_[c].server = to;
        ask(c);
      });
    }
  }
  /// Presents tickets at random servers; each of them often, as a thief and a broken client do.
  void present_tickets(std::size_t s) {
    after(draw(50ms, 600ms), [this, s] {
      std::size_t n = draws_.below(nodes_.size());
      // An honest client in the calm phase goes to the owner.
      for (std::size_t owner = 0; calm() && owner < nodes_.size(); ++owner)
        if (acts(nodes_[owner], s)) n = owner;
      const std::string ticket = calm() ? format("calm-%llu", static_cast<unsigned long long>(++calm_ticket_))
                                        : format("ticket-%llu", static_cast<unsigned long long>(draws_.below(12)));
      to_server(n, [this, n, s, ticket] { nodes_[n].core->use_ticket(session_name(s), ticket); });
      present_tickets(s);
    });
  }

  // ---- checks ----
  void check_owners() {
    for (std::size_t s = 0; s < schedule_.sessions; ++s) {
      int acting = 0;
      for (Node& node : nodes_) {
        const bool really = acts(node, s);
        if (really) node.last_acted[s] = now();
        // The hands take kRamp, whatever the core was given.
        if (really || (runs(node) && now() - node.last_acted[s] < kRamp - times_.ramp)) ++acting;
      }
      if (acting > 1) fail(format("%d servers act for session %zu", acting, s));
    }
  }
  /// Says what is missing in the calm phase; empty: nothing.
  std::string not_served() const {
    for (std::size_t s = 0; s < schedule_.sessions; ++s) {
      if (std::ranges::none_of(nodes_, [&](const Node& node) { return acts(node, s); }))
        return format("session %zu has no owner in the calm phase", s);
      if (!calm_tickets_.contains(session_name(s))) return format("session %zu takes no ticket in the calm phase", s);
    }
    for (std::size_t c = 0; c < clients_.size(); ++c)
      if (clients_[c].last_force <= Time{} + schedule_.calm || now() - clients_[c].last_force >= 1s)
        return format("client %zu gets no force in the calm phase", c);
    return {};
  }
  ModelStore store_;
  double store_rate_ = 1;
  Time store_down_until_{}, slow_until_{};
  OperationId watch_ids_ = 0;
  LeaseId immortal_ = store_.execute(0, Grant{24h}).lease;
  std::vector<Client> clients_;
  std::uint64_t calm_ticket_ = 0;
  std::map<std::string, int> accepted_;
  std::set<std::string> calm_tickets_;
};

}  // namespace

Verdict run_schedule(const Schedule& schedule, Guard removed) { return Run(schedule, removed).run(); }

}  // namespace tandem::directory::test
