#include "netsim/proxy/proxy_core.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tandem::netsim {
namespace {

void add(PathCounters& to, const PathCounters& from) noexcept {
  to.in += from.in;
  to.copies += from.copies;
  to.out += from.out;
  for (std::size_t i = 0; i < kOutcomes; ++i) to.by_outcome[i] += from.by_outcome[i];
  to.bytes_in += from.bytes_in;
  to.bytes_out += from.bytes_out;
  to.delay_sum_ns += from.delay_sum_ns;
  to.flipped += from.flipped;
  to.truncated += from.truncated;
}

}  // namespace

ProxyCore::ProxyCore(const LinkSpec& spec, std::uint64_t seed, const std::vector<NetworkEvent>& events)
    : spec_(spec), links_(spec, seed, events), queue_(kSlots, kClientsMax * kDirections) {
  update_may_defer(spec);
  for (const NetworkEvent& event : events) {
    if (event.link) update_may_defer(*event.link);
    if (event.outage && event.outage->mode == OutageSpec::Mode::kHoldLast) may_defer_ = true;
  }
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    // An invalid spec is rejected here, before the first client arrives.
    static_cast<void>(Path(spec[direction], RandomKey{seed}));
    for (const NetworkEvent& event : events) {
      if (event.link) static_cast<void>(Path((*event.link)[direction], RandomKey{seed}));
    }
    if (links_.shared()) shared_[static_cast<std::size_t>(direction)] = links_.shared_link(spec, direction);
  }
}

std::optional<std::uint32_t> ProxyCore::add_client(PreparedLink* prepared) {
  if (clients_.size() == kClientsMax) return std::nullopt;
  std::optional<PreparedLink> late;
  if (prepared == nullptr || !fits(*prepared))
    prepared = &late.emplace(links_.prepare_client(spec_, version_, clients_.seen()));
  const std::uint32_t place = *clients_.add();
  ClientTable::Client& client = clients_[place];
  std::swap(client.addresses, prepared->addresses);
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    const auto d = static_cast<std::size_t>(direction);
    auto& link = client.directions[d];
    if (links_.shared()) {
      shared_[d]->join(place, client.number);
      link.emplace(shared_[d], place);
    } else {
      link = std::move(prepared->directions[d]);
    }
    link->attach_queue(queue_);
    const auto name = static_cast<std::uint32_t>(client.number);
    link->tap = {.sink = sink_, .link = links_.shared() ? 0 : name, .flow = name, .direction = direction};
  }
  return place;
}

void ProxyCore::remove_client(std::uint32_t place) noexcept {
  if (!clients_.present(place)) return;
  if (sink_ != nullptr) {  // the queue would report them only when due; this log entry is final
    queue_.for_each([&](const DelayQueue::Item& item) {
      const auto flow = clients_.find(item.path_index);
      if (!flow || flow->place != place) return;
      PathCounters unused;
      leave(item, queue_.bytes(item).size(), Outcome::kClientGone, unused, clients_.link(place, flow->direction)->tap);
    });
  }
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    LinkDirection& link = *clients_.link(place, direction);
    link.counters.by_outcome[static_cast<std::size_t>(Outcome::kClientGone)] += link.counters.in_flight();
    add(departed_counters_[static_cast<std::size_t>(direction)], link.counters);
    link.detach();
    queue_.discard_waiting(clients_.path_index(place, direction));
  }
  clients_.remove(place);
}

void ProxyCore::log_to(DecisionSink* sink) noexcept {
  sink_ = sink;
  clients_.for_each([&](LinkDirection& link) { link.tap.sink = sink; });
}

void ProxyCore::log_in_flight() const noexcept {
  queue_.for_each([&](const DelayQueue::Item& item) {
    if (const auto flow = clients_.find(item.path_index))
      log_undelivered(item, clients_.link(flow->place, flow->direction)->tap);
  });
}

void ProxyCore::change(Time now, LinkChange& change) {
  update_may_defer(change.link);
  if (change.for_new) {
    std::swap(spec_, *change.for_new);
    ++version_;
  }
  if (links_.shared()) {
    for (std::size_t d = 0; d < kDirections; ++d) shared_[d]->change(now, change.shared[d]);
    return;
  }
  for (std::uint32_t place = 0; place < kClientsMax; ++place) {
    if (!clients_.present(place)) continue;
    ClientTable::Client& client = clients_[place];
    auto found = std::ranges::find(change.clients, client.number, &LinkChange::Client::number);
    if (found == change.clients.end()) {
      if (!change.for_new) continue;
      const std::uint64_t number[] = {client.number};
      LinkChange late = links_.prepare_change(spec_, number, false);
      change.clients.push_back(std::move(late.clients.front()));
      found = std::prev(change.clients.end());
    }
    for (std::size_t d = 0; d < kDirections; ++d) client.directions[d]->change(now, found->paths[d]);
  }
}

bool ProxyCore::rebind(Time now, std::uint32_t client, const Rebind& rebind) noexcept {
  return clients_.present(client) && clients_[client].addresses.change(now, rebind);
}

std::uint32_t ProxyCore::address(Time now, std::uint32_t client) noexcept {
  return clients_.present(client) ? clients_[client].addresses.current(now) : 0;
}

Outcome ProxyCore::ingress(Time now, std::uint32_t client, Direction direction, std::span<const std::byte> bytes,
                           std::uint32_t address) noexcept {
  LinkDirection* const link = clients_.link(client, direction);
  if (link == nullptr) return Outcome::kOverflow;
  const std::uint64_t free = queue_.slots() - std::min(queue_.slots(), queue_.size());
  // A flooding client must not use the space of others.
  if (link->counters.in_flight() >= std::min(kPerDirectionMax, free)) {
    PathDecision decision = link->send(now, bytes.size());  // takes its index and uses the link
    decision.outcome = Outcome::kOverflow;
    decision.at = now;
    decision.copied = false;
    return link->enter(decision, queue_, {now}, bytes);
  }
  if (direction == Direction::kUp) address = clients_[client].addresses.current(now);
  return link->enter(queue_, {now, clients_.path_index(client, direction), address}, bytes);
}

void ProxyCore::resolve(Time now) noexcept {
  clients_.for_each([&](LinkDirection& link) { link.resolve(now); });
}

std::optional<Time> ProxyCore::next_due() const noexcept {
  std::optional<Time> next = queue_.next_due();
  if (!may_defer_) return next;
  clients_.for_each([&](const LinkDirection& link) {
    if (const auto resolved = link.next_resolve()) next = std::min(next.value_or(*resolved), *resolved);
  });
  return next;
}

std::optional<ProxyCore::Egress> ProxyCore::take(Time now, Time known) noexcept {
  if (may_defer_) resolve(known);
  while (const auto item = queue_.take(now, known)) {
    const auto flow = clients_.find(item->path_index);
    if (!flow) {  // its client left; it was counted at that time
      queue_.recycle(item->slot);
      continue;
    }
    const auto [client, direction] = *flow;
    LinkDirection& link = *clients_.link(client, direction);
    const auto bytes = queue_.bytes(*item);
    const bool dead = direction == Direction::kDown && clients_.dead(item->at, client, item->tag);
    leave(*item, bytes.size(), dead ? Outcome::kOldAddress : Outcome::kDeliver, link.counters, link.tap);
    if (dead) {
      queue_.recycle(item->slot);
      continue;
    }
    return Egress{client, direction, bytes, *item, item->tag};
  }
  return std::nullopt;
}

void ProxyCore::attach_monitor(std::uint32_t client, LinkMonitor* monitor) noexcept {
  for (const Direction direction : {Direction::kUp, Direction::kDown})
    if (LinkDirection* const link = clients_.link(client, direction)) link->tap.monitor = monitor;
}

const PathCounters& ProxyCore::counters(std::uint32_t client, Direction direction) const noexcept {
  static constexpr PathCounters kNothing;
  const LinkDirection* const link = clients_.link(client, direction);
  return link != nullptr ? link->counters : kNothing;
}

Duration ProxyCore::queue_wait(Time now, std::uint32_t client, Direction direction) const noexcept {
  const LinkDirection* const link = clients_.link(client, direction);
  return link != nullptr ? link->queue_wait(now) : Duration{};
}

PathCounters ProxyCore::total(Direction direction) const noexcept {
  PathCounters sum = departed_counters_[static_cast<std::size_t>(direction)];
  clients_.for_each([&](const LinkDirection& link) {
    if (link.tap.direction == direction) add(sum, link.counters);
  });
  return sum;
}

}  // namespace tandem::netsim
