#include "netsim/proxy/proxy_core.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace tandem::netsim {
namespace {

// Layout of a path index in the queue: generation of the place, place, direction.
constexpr std::uint32_t kDirectionBits = 1;
constexpr std::uint32_t kPlaceBits = 6;
static_assert(ProxyCore::kClientsMax == std::size_t{1} << kPlaceBits);

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

ProxyCore::ProxyCore(const LinkSpec& spec, std::uint64_t seed, std::vector<NetworkEvent> events)
    : spec_(spec),
      sharing_(spec.shared),
      seed_(seed),
      events_(std::move(events)),
      queue_(kSlots, kClientsMax * kDirections),
      places_(kClientsMax) {
  // The constructor rejects an invalid spec, before the first client arrives.
  std::ranges::copy_if(events_, std::back_inserter(outages_),
                       [](const NetworkEvent& e) { return e.outage.has_value(); });
  update_may_defer(spec);
  for (const NetworkEvent& event : events_) {
    if (event.link) update_may_defer(*event.link);
    if (event.outage && event.outage->mode == OutageSpec::Mode::kHoldLast) may_defer_ = true;
  }
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    static_cast<void>(Path(spec[direction], RandomKey{seed}));
    for (const NetworkEvent& event : events_) {
      if (event.link) static_cast<void>(Path((*event.link)[direction], RandomKey{seed}));
    }
    if (!sharing_) continue;
    // Events that name a client do not apply to a link that all clients share.
    shared_[static_cast<std::size_t>(direction)] = std::make_shared<LinkTimeline>(
        schedule_for(spec, events_, ""), direction, seed, LinkTimeline::Shared{.flows = kClientsMax});
  }
}

LinkSchedule ProxyCore::schedule(const LinkSpec& link, std::uint64_t number) const {
  return schedule_for(link, events_, std::to_string(number + 1));
}

ProxyCore::PreparedClient ProxyCore::prepare_client(const LinkSpec& link, std::uint64_t version,
                                                    std::uint64_t number) const {
  const LinkSchedule over_time = schedule(link, number);
  PreparedClient made{version, number, Addresses{over_time.rebinds}};
  if (sharing_) return made;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    made.directions[static_cast<std::size_t>(direction)].emplace(over_time, direction, seed_, number);
  }
  return made;
}

std::optional<std::uint32_t> ProxyCore::add_client(PreparedClient* made) {
  for (std::uint32_t number = 0; number < kClientsMax; ++number) {
    Client& place = places_[number];
    if (place.directions[0]) continue;
    std::optional<PreparedClient> late;
    if (made == nullptr || !fits(*made)) made = &late.emplace(prepare_client(spec_, version_, clients_seen_));
    place.number = clients_seen_;
    std::swap(place.addresses, made->addresses);
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      auto& lane = place.directions[static_cast<std::size_t>(direction)];
      if (sharing_) {
        const auto& course = shared_[static_cast<std::size_t>(direction)];
        course->join(number, clients_seen_);
        lane.emplace(course, number);
      } else {
        lane = std::move(made->directions[static_cast<std::size_t>(direction)]);
      }
      lane->attach_queue(queue_);
      const auto name = static_cast<std::uint32_t>(clients_seen_);
      lane->tap = {.sink = sink_, .link = sharing_ ? 0 : name, .flow = name, .direction = direction};
    }
    ++clients_;
    ++clients_seen_;
    return number;
  }
  return std::nullopt;
}

void ProxyCore::remove_client(std::uint32_t client) noexcept {
  if (!present(client)) return;
  Client& place = places_[client];
  if (sink_ != nullptr) {  // the queue would report them only when due; this log entry is final
    queue_.for_each([&](const DelayQueue::Item& item) {
      const auto direction = static_cast<Direction>(item.path_index & 1U);
      if (item.path_index != path_index(client, direction)) return;
      PathCounters unused;
      leave(item, queue_.bytes(item).size(), Outcome::kClientGone, unused,
            place.directions[static_cast<std::size_t>(direction)]->tap);
    });
  }
  for (std::size_t direction = 0; direction < kDirections; ++direction) {
    PathCounters& counters = place.directions[direction]->counters;
    counters.by_outcome[static_cast<std::size_t>(Outcome::kClientGone)] += counters.in_flight();
    add(departed_counters_[direction], counters);
    place.directions[direction]->detach();
    queue_.discard_waiting(path_index(client, static_cast<Direction>(direction)));
    place.directions[direction].reset();
  }
  ++place.generation;
  --clients_;
}

void ProxyCore::log_to(DecisionSink* sink) noexcept {
  sink_ = sink;
  for (Client& place : places_) {
    for (auto& lane : place.directions) {
      if (lane) lane->tap.sink = sink;
    }
  }
}

void ProxyCore::log_in_flight() const noexcept {
  queue_.for_each([&](const DelayQueue::Item& item) {
    const auto direction = static_cast<Direction>(item.path_index & 1U);
    const std::uint32_t client = (item.path_index >> kDirectionBits) & (kClientsMax - 1);
    if (!present(client) || item.path_index != path_index(client, direction)) return;
    const auto& lane = places_[client].directions[static_cast<std::size_t>(direction)];
    log_undelivered(item, lane->tap);
  });
}

std::optional<std::uint64_t> ProxyCore::number(std::uint32_t client) const noexcept {
  return present(client) ? std::optional{places_[client].number} : std::nullopt;
}

LinkChange ProxyCore::prepare(const LinkSpec& link, std::span<const std::uint64_t> numbers, bool all) const {
  LinkChange change{.for_new = all ? std::optional{link} : std::nullopt, .link = link};
  if (sharing_) {
    if (!all) throw std::invalid_argument("all clients share this link: it can be changed for all of them only");
    const LinkSpec with_outages = schedule_for(link, outages_, "").initial;
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      change.shared[static_cast<std::size_t>(direction)] =
          make_path(with_outages, direction, seed_, LinkTimeline::Shared{.flows = kClientsMax});
    }
    return change;
  }
  for (const std::uint64_t number : numbers) {
    // Of the events only outages are inserted here; the others take effect at their own times.
    const LinkSpec with_outages = schedule_for(link, outages_, std::to_string(number + 1)).initial;
    LinkChange::Client& client = change.clients.emplace_back();
    client.number = number;
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      client.paths[static_cast<std::size_t>(direction)] = make_path(with_outages, direction, seed_, number);
    }
  }
  return change;
}

void ProxyCore::change(Time now, LinkChange& change) {
  update_may_defer(change.link);
  if (change.for_new) {
    std::swap(spec_, *change.for_new);
    ++version_;
  }
  if (sharing_) {
    for (std::size_t d = 0; d < kDirections; ++d) shared_[d]->change(now, change.shared[d]);
    return;
  }
  for (std::uint32_t i = 0; i < kClientsMax; ++i) {
    if (!present(i)) continue;
    Client& place = places_[i];
    auto found = std::ranges::find(change.clients, place.number, &LinkChange::Client::number);
    if (found == change.clients.end()) {
      if (!change.for_new) continue;
      const std::uint64_t newcomer[] = {place.number};
      LinkChange late = prepare(spec_, newcomer, false);
      change.clients.push_back(std::move(late.clients.front()));
      found = std::prev(change.clients.end());
    }
    for (std::size_t d = 0; d < kDirections; ++d) place.directions[d]->change(now, found->paths[d]);
  }
}

bool ProxyCore::rebind(Time now, std::uint32_t client, const Rebind& rebind) noexcept {
  return present(client) && places_[client].addresses.change(now, rebind);
}

std::uint32_t ProxyCore::address(Time now, std::uint32_t client) noexcept {
  return present(client) ? places_[client].addresses.current(now) : 0;
}

bool ProxyCore::dead(Time now, std::uint32_t client, std::uint32_t address) const noexcept {
  return present(client) && places_[client].addresses.dead(address, now);
}

Outcome ProxyCore::ingress(Time now, std::uint32_t client, Direction direction, std::span<const std::byte> bytes,
                           std::uint32_t address) noexcept {
  if (!present(client)) return Outcome::kOverflow;
  auto& lane = places_[client].directions[static_cast<std::size_t>(direction)];
  const std::uint64_t free = queue_.slots() - std::min(queue_.slots(), queue_.size());
  // A flooding client must not use the space of others.
  if (lane->counters.in_flight() >= std::min(kPerDirectionMax, free)) {
    Verdict verdict = lane->send(now, bytes.size());  // takes its index and uses the link
    verdict.outcome = Outcome::kOverflow;
    verdict.at = now;
    verdict.copied = false;
    return lane->enter(verdict, queue_, {now}, bytes);
  }
  if (direction == Direction::kUp) address = places_[client].addresses.current(now);
  return lane->enter(queue_, {now, path_index(client, direction), address}, bytes);
}

void ProxyCore::resolve(Time now) noexcept {
  for (Client& place : places_) {
    for (auto& lane : place.directions) {
      if (lane) lane->resolve(now);
    }
  }
}

std::optional<Time> ProxyCore::next_due() const noexcept {
  std::optional<Time> next = queue_.next_due();
  for (const Client& place : places_) {
    if (!may_defer_) break;
    for (const auto& lane : place.directions) {
      const auto settle = lane ? lane->next_resolve() : std::nullopt;
      if (settle) next = std::min(next.value_or(*settle), *settle);
    }
  }
  return next;
}

std::optional<ProxyCore::Egress> ProxyCore::take(Time now, Time known) noexcept {
  if (may_defer_) resolve(known);
  while (const auto item = queue_.take(now, known)) {
    const auto direction = static_cast<Direction>(item->path_index & 1U);
    const std::uint32_t client = (item->path_index >> kDirectionBits) & (kClientsMax - 1);
    auto& lane = places_[client].directions[static_cast<std::size_t>(direction)];
    if (!lane || item->path_index != path_index(client, direction)) {  // its client left; it was counted at that time
      queue_.recycle(item->slot);
      continue;
    }
    const auto bytes = queue_.bytes(*item);
    const bool dead = direction == Direction::kDown && places_[client].addresses.dead(item->tag, item->at);
    leave(*item, bytes.size(), dead ? Outcome::kOldAddress : Outcome::kDeliver, lane->counters, lane->tap);
    if (dead) {
      queue_.recycle(item->slot);
      continue;
    }
    return Egress{client, direction, bytes, *item, item->tag};
  }
  return std::nullopt;
}

void ProxyCore::attach_monitor(std::uint32_t client, LinkMonitor* watch) noexcept {
  if (!present(client)) return;
  for (auto& lane : places_[client].directions) lane->tap.monitor = watch;
}

const PathCounters& ProxyCore::counters(std::uint32_t client, Direction direction) const noexcept {
  static constexpr PathCounters kNothing;
  if (client >= kClientsMax) return kNothing;
  const auto& lane = places_[client].directions[static_cast<std::size_t>(direction)];
  return lane ? lane->counters : kNothing;
}

Duration ProxyCore::queue_wait(Time now, std::uint32_t client, Direction direction) const noexcept {
  return present(client) ? places_[client].directions[static_cast<std::size_t>(direction)]->queue_wait(now)
                         : Duration{};
}

PathCounters ProxyCore::total(Direction direction) const noexcept {
  PathCounters sum = departed_counters_[static_cast<std::size_t>(direction)];
  for (const Client& place : places_) {
    if (const auto& lane = place.directions[static_cast<std::size_t>(direction)]) add(sum, lane->counters);
  }
  return sum;
}

std::uint32_t ProxyCore::path_index(std::uint32_t client, Direction direction) const noexcept {
  return (places_[client].generation << (kPlaceBits + kDirectionBits)) | (client << kDirectionBits) |
         static_cast<std::uint32_t>(direction);
}

}  // namespace tandem::netsim
