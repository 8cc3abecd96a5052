#include "netsim/engine/network.h"

#include <algorithm>
#include <cstring>

#include "netsim/engine/delay_queue.h"
#include "netsim/engine/link_direction.h"
#include "netsim/engine/replay.h"
#include "netsim/engine/submit.h"

namespace tandem::netsim {
namespace {

std::size_t lane_number(std::uint32_t link, Direction direction) noexcept {
  return std::size_t{link} * kDirections + static_cast<std::size_t>(direction);
}

bool alike(const LinkSchedule& a, const LinkSchedule& b) {
  return a.initial == b.initial && std::ranges::equal(a.changes, b.changes, [](const auto& x, const auto& y) {
           return x.at == y.at && x.link == y.link;
         });
}

}  // namespace

struct Network::StoredDirection {
  StoredDirection(LinkDirection&& with, std::size_t slots) : path(std::move(with)), queue(slots) {
    path.attach_queue(queue);
  }
  [[nodiscard]] std::optional<Time> next_due() const noexcept {
    const auto due = queue.next_due(), settle = path.next_resolve();
    return due && settle ? std::min(*due, *settle) : due ? due : settle;
  }
  LinkDirection path;
  DelayQueue queue;
};

Network::Network(std::uint64_t seed) noexcept : seed_(seed) {}
Network::~Network() = default;

template <typename Make>
std::uint32_t Network::add(const Make& make, const std::vector<LinkSchedule::AddressChange>& rebinds,
                           std::optional<std::uint32_t> logged_link) {
  const auto number = static_cast<std::uint32_t>(links());
  std::array<std::unique_ptr<StoredDirection>, kDirections> both{make(Direction::kUp), make(Direction::kDown)};
  addresses_.emplace_back(rebinds);
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    auto& stored = directions_.emplace_back(std::move(both[static_cast<std::size_t>(direction)]));
    stored->path.tap = {.sink = sink_, .link = logged_link.value_or(number), .flow = number, .direction = direction};
  }
  return number;
}

std::uint32_t Network::add_link(const LinkSpec& spec) { return add_link(spec, links()); }

std::uint32_t Network::add_link(const LinkSpec& spec, std::uint64_t name) {
  return add_link(LinkSchedule{.initial = spec}, name);
}

std::uint32_t Network::add_link(const LinkSchedule& schedule, std::uint64_t name) {
  if (schedule.initial.shared) {
    const auto found =
        std::ranges::find_if(shared_, [&](const Shared& link) { return alike(link.schedule, schedule); });
    const auto number = static_cast<std::uint32_t>(found - shared_.begin());
    return add_flow(found == shared_.end() ? add_shared(schedule) : number, name, schedule.rebinds);
  }
  const auto make = [&](Direction direction) {
    return std::make_unique<StoredDirection>(LinkDirection(schedule, direction, seed_, name),
                                             slots_for(schedule, direction));
  };
  return add(make, schedule.rebinds);
}

std::uint32_t Network::add_shared(const LinkSchedule& schedule) {
  const auto number = static_cast<std::uint32_t>(shared_.size());
  Shared link{schedule, {}, 0, 0};
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    link.timelines[static_cast<std::size_t>(direction)] =
        std::make_shared<LinkTimeline>(schedule, direction, seed_, LinkTimeline::Shared{number});
  }
  shared_.push_back(std::move(link));
  return number;
}

std::uint32_t Network::add_flow(std::uint32_t shared, std::uint64_t name,
                                const std::vector<LinkSchedule::AddressChange>& rebinds) {
  Shared& link = shared_.at(shared);
  if (link.flows == 0) link.first = static_cast<std::uint32_t>(links());
  const auto make = [&](Direction direction) {
    const auto& timeline = link.timelines[static_cast<std::size_t>(direction)];
    timeline->join(link.flows, name);
    return std::make_unique<StoredDirection>(LinkDirection(timeline, link.flows), slots_for(link.schedule, direction));
  };
  const std::uint32_t number = add(make, rebinds, link.first);
  ++link.flows;
  return number;
}

std::uint32_t Network::add_replay(std::shared_ptr<const Replay> replay, std::uint32_t flow) {
  const auto make = [&](Direction direction) {
    return std::make_unique<StoredDirection>(LinkDirection(replay, flow, direction),
                                             slots_for(replay->delay_max(flow, direction), 1));
  };
  // A flow that is replayed under its own number keeps the recorded link number, also of a shared link.
  return add(make, {}, links() == flow ? std::optional{replay->link(flow)} : std::nullopt);
}

void Network::log_to(DecisionSink* sink) noexcept {
  sink_ = sink;
  for (const auto& each : directions_) each->path.tap.sink = sink;
}

std::optional<Time> Network::oldest_in_flight() const noexcept {
  std::optional<Time> oldest;
  for (const auto& each : directions_) {
    each->queue.for_each(
        [&](const DelayQueue::Item& item) { oldest = std::min(oldest.value_or(item.sent), item.sent); });
  }
  return oldest;
}

void Network::log_in_flight() const noexcept {
  for (const auto& each : directions_) {
    each->queue.for_each([&](const DelayQueue::Item& item) { log_undelivered(item, each->path.tap); });
  }
}

Outcome Network::send(Time now, std::uint32_t link, Direction direction, std::span<const std::byte> bytes) noexcept {
  if (link >= links()) return Outcome::kOverflow;
  Addresses& addresses = addresses_[link];
  return enter(now, link, direction,
               direction == Direction::kUp ? addresses.current(now) : addresses.newest_delivered(), bytes);
}

Outcome Network::send_to(Time now, std::uint32_t link, std::uint32_t address,
                         std::span<const std::byte> bytes) noexcept {
  return link >= links() ? Outcome::kOverflow : enter(now, link, Direction::kDown, address, bytes);
}

Outcome Network::enter(Time now, std::uint32_t link, Direction direction, std::uint32_t address,
                       std::span<const std::byte> bytes) noexcept {
  const std::size_t number = lane_number(link, direction);
  StoredDirection& to = *directions_[number];
  return to.path.enter(to.queue, {now, static_cast<std::uint32_t>(number), address}, bytes);
}

bool Network::rebind(Time now, std::uint32_t link, const Rebind& rebind) noexcept {
  return link < links() && addresses_[link].change(now, rebind);
}

std::optional<Delivery> Network::poll(Time now, std::uint32_t link, Direction direction,
                                      std::span<std::byte> buffer) noexcept {
  StoredDirection* const from = stored(link, direction);
  if (from == nullptr) return std::nullopt;
  return take(*from, now, buffer);
}

std::optional<Delivery> Network::poll_any(Time now, std::span<std::byte> buffer) noexcept {
  for (const auto& each : directions_) each->path.resolve(now);
  while (true) {  // a datagram to a dead address yields no delivery; continue
    StoredDirection* first = nullptr;
    Time first_due = now;
    for (const auto& candidate : directions_) {
      const auto due = candidate->queue.next_due();
      if (!due || *due > now) continue;
      if (first != nullptr && *due >= first_due) continue;
      first = candidate.get();
      first_due = *due;
    }
    if (first == nullptr) return std::nullopt;
    if (const auto delivery = take(*first, first_due, buffer)) return delivery;
  }
}

std::optional<Time> Network::next_due(std::uint32_t link, Direction direction) const noexcept {
  const StoredDirection* const of = stored(link, direction);
  return of == nullptr ? std::nullopt : of->next_due();
}

std::optional<Time> Network::next_due() const noexcept {
  std::optional<Time> next;
  for (const auto& candidate : directions_) {
    if (const auto due = candidate->next_due()) next = std::min(next.value_or(*due), *due);
  }
  return next;
}

const PathCounters& Network::counters(std::uint32_t link, Direction direction) const noexcept {
  static constexpr PathCounters kNothing;
  const StoredDirection* const of = stored(link, direction);
  return of == nullptr ? kNothing : of->path.counters;
}

void Network::attach_monitor(std::uint32_t link, LinkMonitor* monitor) noexcept {
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    if (StoredDirection* const of = stored(link, direction)) of->path.tap.monitor = monitor;
  }
}

std::uint64_t Network::replayed(std::uint32_t link, Direction direction) const noexcept {
  const StoredDirection* const of = stored(link, direction);
  return of == nullptr || of->path.replay() == nullptr ? 0 : of->path.replay()->matched();
}

Network::StoredDirection* Network::stored(std::uint32_t link, Direction direction) const noexcept {
  const std::size_t number = lane_number(link, direction);
  return number < directions_.size() ? directions_[number].get() : nullptr;
}

std::optional<Delivery> Network::take(StoredDirection& from, Time now, std::span<std::byte> buffer) noexcept {
  from.path.resolve(now);
  while (const auto item = from.queue.take(now)) {
    const auto link = item->path_index / static_cast<std::uint32_t>(kDirections);
    const auto direction = static_cast<Direction>(item->path_index % kDirections);
    const auto bytes = from.queue.bytes(*item);
    const std::size_t size = bytes.size();
    const bool dead = direction == Direction::kDown && addresses_[link].dead(item->tag, item->at);
    if (!dead) {
      const std::size_t fits = std::min(size, buffer.size());
      if (fits > 0) std::memcpy(buffer.data(), bytes.data(), fits);
      if (direction == Direction::kUp) addresses_[link].note_delivered(item->tag);
    }
    leave(*item, size, dead ? Outcome::kOldAddress : Outcome::kDeliver, from.path.counters, from.path.tap);
    from.queue.recycle(item->slot);
    if (!dead) return Delivery{link, direction, item->sent, item->at, item->index, size, item->tag};
  }
  return std::nullopt;
}

}  // namespace tandem::netsim
