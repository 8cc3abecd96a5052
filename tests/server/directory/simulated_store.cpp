#include "tests/server/directory/simulated_store.h"

#include <algorithm>

namespace tandem::directory::test {

void SimulatedStore::begin_ticks() {
  for (std::size_t n = 0; n < nodes_.size(); ++n) tick(n);
  store_tick();
}

void SimulatedStore::tick(std::size_t n) {
  after(draw(20ms, 60ms), [this, n] {
    if (runs(nodes_[n])) pump(n);
    tick(n);
  });
}

void SimulatedStore::store_tick() {
  after(draw(10ms, 500ms), [this] {
    if (store_up()) {
      store_.advance(store_clock());
      send_changes();
      const bool wanted =
          std::ranges::any_of(schedule_.faults, [](const Fault& fault) { return fault.kind == Fault::Kind::kPutBack; });
      if (wanted && (copies_.empty() || now() - copies_.back().first >= 1s)) copies_.emplace_back(now(), store_);
    }
    store_tick();
  });
}

void SimulatedStore::deliver(std::size_t n, std::uint64_t incarnation, std::function<void()> what) {
  Node& node = nodes_[n];
  if (!node.up || node.incarnation != incarnation) return;
  if (now() < node.paused_until) {
    at(node.paused_until, [this, n, incarnation, what = std::move(what)] { deliver(n, incarnation, what); });
    return;
  }
  what();
  pump(n);
}

void SimulatedStore::send(std::size_t n, OperationId id, const Request& request, Duration out, Duration back) {
  const Node& node = nodes_[n];
  const bool watch = std::holds_alternative<Watch>(request);
  const bool cut = now() < node.cut_store_until || (watch && now() < node.deposed_until) || lost();
  if (cut && watch) after(1s, [this, n, id, i = node.incarnation] { reply(n, i, broken(id), 0s); });
  if (cut) return;
  const int copies = !watch && chance(schedule_.duplicate) && !calm() ? 2 : 1;
  for (int copy = 0; copy < copies; ++copy) {
    const Duration extra = copy == 0 ? Duration{} : draw(0s, 5s);
    // No copy arrives in the calm phase: a late renewal would keep the lease of a server that is gone.
    if (copy > 0 && now() + out + extra > Time{} + schedule_.calm) continue;
    // A request on its way to a store that loses its data ends with the connection.
    after(out + extra, [this, n, id, request, back, i = node.incarnation, losses = losses_] {
      if (losses == losses_) return execute(n, i, id, request, back);
      if (std::holds_alternative<Watch>(request)) reply(n, i, broken(id), back);
    });
  }
}

void SimulatedStore::execute(std::size_t n, std::uint64_t incarnation, OperationId id, const Request& request,
                             Duration back) {
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
    return at(store_down_until_ + 1ms, [this, n, incarnation, id, request, back, losses = losses_] {
      if (losses == losses_) execute(n, incarnation, id, request, back);
    });
  }
  store_.advance(store_clock());
  if (std::holds_alternative<Watch>(request)) {
    if (node.incarnation != incarnation) return;  // its connection has ended with the process
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

void SimulatedStore::reply(std::size_t n, std::uint64_t incarnation, Reply answer, Duration back) {
  // The end of a watch is always reported, by the store or by the adapter.
  const bool end_of_watch = answer.outcome == Outcome::kUnknown || answer.outcome == Outcome::kCompacted;
  if (!end_of_watch && (now() < nodes_[n].cut_store_until || lost())) return;
  if (slow_until_ > now()) back += draw(0s, 1s);
  after(back, [this, n, incarnation, answer = std::move(answer)] {
    deliver(n, incarnation, [this, n, answer] { take(n, answer); });
  });
}

void SimulatedStore::send_changes() {
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
      at(arrival,
         [this, n, i = node.incarnation, reply = *changes] { deliver(n, i, [this, n, reply] { take(n, reply); }); });
      if (cut || changes->outcome != Outcome::kDone) {
        store_.close(watch->first);
        watch = node.watches.erase(watch);
      } else {
        ++watch;
      }
    }
  }
}

void SimulatedStore::break_watches() {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    for (const auto& [watch, id] : nodes_[n].watches) {
      store_.close(watch);
      after(delay(n),
            [this, n, i = nodes_[n].incarnation, id = id] { deliver(n, i, [this, n, id] { take(n, broken(id)); }); });
    }
    nodes_[n].watches.clear();
  }
}

/// The store begins again from a copy of this age, or from nothing.
void SimulatedStore::lose_data(Duration age) {
  ++losses_;
  break_watches();
  const auto fits = [&](const auto& copy) {
    return now() - copy.first >= age && store_.revision() - copy.second.revision() >= kRevisionsLost;
  };
  while (!copies_.empty() && !fits(copies_.back())) copies_.pop_back();
  if (age == Duration::max() || copies_.empty()) {
    copies_.clear();
    store_ = ModelStore();
  } else {
    store_ = copies_.back().second;
    for (OperationId watch = 1; watch <= watch_ids_; ++watch) store_.close(watch);
  }
  store_.resume(store_clock(), 1'000'000 * losses_);
}

void SimulatedStore::begin(const Fault& fault) {
  const bool of_server = fault.kind != Fault::Kind::kMove;
  Node& node = nodes_[of_server ? fault.who : 0];
  const Time end = now() + fault.length;
  switch (fault.kind) {
    case Fault::Kind::kSuspend:
      if (removed_ == Guard::kSuspendedClock) at(end, [&node, length = fault.length] { node.offset -= length; });
      [[fallthrough]];
    case Fault::Kind::kPause:
      on_pause(fault.who);
      node.paused_until = std::max(node.paused_until, end);
      return at(end, [this, who = fault.who] { on_pause_end(who); });
    case Fault::Kind::kDiskLost:
    case Fault::Kind::kCrash:
      stop(fault.who);
      if (fault.kind == Fault::Kind::kDiskLost) lose_disk(fault.who);
      node.up = false;
      for (const auto& [watch, id] : node.watches) store_.close(watch);
      node.watches.clear();
      return at(end, [this, who = fault.who] {
        if (!nodes_[who].up) start_process(who);
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
      return break_watches();
    case Fault::Kind::kMove:
      return move(fault.who, fault.to);
    case Fault::Kind::kEmptied:
    case Fault::Kind::kPutBack:
      store_down_until_ = std::max(store_down_until_, end);
      return lose_data(fault.kind == Fault::Kind::kEmptied ? Duration::max() : fault.age);
  }
}

}  // namespace tandem::directory::test
