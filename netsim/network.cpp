#include "netsim/network.h"

#include <algorithm>
#include <cstring>

namespace tandem::netsim {
namespace {

/// Room for 10 s of 1 kHz traffic besides everything that is under way for the longest delay of the models, doubled
/// when everything may come twice. Never more than two minutes' worth: what comes on top is counted as overflow.
std::size_t slots_for(const PathSpec& spec) noexcept {
  constexpr double kPerSecond = 1000;
  const double room = kPerSecond * (10.5 + 1.1 * seconds(delay_max(spec)));
  const double copies = 1 + spec.duplicate.probability;
  return static_cast<std::size_t>(std::min(room * copies, 120'000.0));
}

std::size_t lane_number(std::uint32_t link, Direction direction) noexcept {
  return std::size_t{link} * kDirections + static_cast<std::size_t>(direction);
}

}  // namespace

Network::Lane::Lane(const PathSpec& spec, const Path::Keys& keys)
    : path(spec, keys), queue(slots_for(spec)) {}

std::uint32_t Network::add_link(const LinkSpec& spec) { return add_link(spec, links()); }

std::uint32_t Network::add_link(const LinkSpec& spec, std::uint64_t name) {
  const auto link = static_cast<std::uint32_t>(links());
  auto up = std::make_unique<Lane>(spec.up, Path::keys_for(seed_, name, Direction::kUp));
  auto down = std::make_unique<Lane>(spec.down, Path::keys_for(seed_, name, Direction::kDown));
  lanes_.reserve(lanes_.size() + kDirections);
  lanes_.push_back(std::move(up));
  lanes_.push_back(std::move(down));
  return link;
}

Outcome Network::send(Time now, std::uint32_t link, Direction direction, std::span<const std::byte> bytes) noexcept {
  Lane* const to = lane(link, direction);
  if (to == nullptr) return Outcome::kOverflow;
  const auto number = static_cast<std::uint32_t>(lane_number(link, direction));
  return submit(to->path, to->queue, to->counters, now, number, bytes);
}

std::optional<Delivery> Network::poll(Time now, std::uint32_t link, Direction direction,
                                      std::span<std::byte> buffer) noexcept {
  Lane* const from = lane(link, direction);
  if (from == nullptr) return std::nullopt;
  return take(*from, now, buffer);
}

std::optional<Delivery> Network::poll_any(Time now, std::span<std::byte> buffer) noexcept {
  Lane* first = nullptr;
  Time first_due = now;
  for (const auto& candidate : lanes_) {
    const auto due = candidate->queue.next_due();
    if (!due || *due > now) continue;
    if (first != nullptr && *due >= first_due) continue;
    first = candidate.get();
    first_due = *due;
  }
  if (first == nullptr) return std::nullopt;
  return take(*first, now, buffer);
}

std::optional<Time> Network::next_due(std::uint32_t link, Direction direction) const noexcept {
  const Lane* const of = lane(link, direction);
  return of == nullptr ? std::nullopt : of->queue.next_due();
}

std::optional<Time> Network::next_due() const noexcept {
  std::optional<Time> next;
  for (const auto& candidate : lanes_) {
    if (const auto due = candidate->queue.next_due()) next = std::min(next.value_or(*due), *due);
  }
  return next;
}

const PathCounters& Network::counters(std::uint32_t link, Direction direction) const noexcept {
  static constexpr PathCounters kNothing;
  const Lane* const of = lane(link, direction);
  return of == nullptr ? kNothing : of->counters;
}

Network::Lane* Network::lane(std::uint32_t link, Direction direction) const noexcept {
  const std::size_t number = lane_number(link, direction);
  return number < lanes_.size() ? lanes_[number].get() : nullptr;
}

std::optional<Delivery> Network::take(Lane& from, Time now, std::span<std::byte> buffer) noexcept {
  const auto item = from.queue.take(now);
  if (!item) return std::nullopt;
  const auto bytes = from.queue.bytes(*item);
  const std::size_t fits = std::min(bytes.size(), buffer.size());
  if (fits > 0) std::memcpy(buffer.data(), bytes.data(), fits);
  from.counters.left(*item, bytes.size());
  from.queue.recycle(item->slot);
  return Delivery{item->lane / static_cast<std::uint32_t>(kDirections),
                  static_cast<Direction>(item->lane % kDirections),
                  item->sent,
                  item->at,
                  item->index,
                  bytes.size()};
}

}  // namespace tandem::netsim
