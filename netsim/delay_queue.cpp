#include "netsim/delay_queue.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>

namespace tandem::netsim {
namespace {

constexpr std::size_t kHeldPerLane = 64;
constexpr std::size_t kSlotsMax = std::size_t{1} << 24;

}  // namespace

DelayQueue::DelayQueue(std::size_t slots, std::size_t lanes) : slots_(slots) {
  if (slots == 0 || slots > kSlotsMax) throw std::invalid_argument("a delay queue has 1 to 2^24 slots");
  heap_.reserve(slots);
  held_.reserve(std::min(slots, kHeldPerLane * lanes));
  meta_.resize(slots);
  data_ = std::make_unique_for_overwrite<std::byte[]>(slots * kSlotBytes);
  free_.resize(slots);
  std::iota(free_.rbegin(), free_.rend(), 0U);  // slot 0 first: only as many pages are touched as are ever used at once
}

DelayQueue::Entered DelayQueue::enter(const Verdict& verdict, Time sent, std::uint32_t lane,
                                      std::span<const std::byte> bytes, std::uint32_t tag) noexcept {
  Slot about{.sent = sent,
             .index = verdict.index,
             .lane = lane,
             .tag = tag,
             .held_back = verdict.outcome == Outcome::kHeldBack};
  const auto slot = store(about, bytes);
  Entered entered = slot ? Entered::kYes : Entered::kNo;
  std::uint32_t copy = kNoSlot;
  if (slot && verdict.copied && !dropped(verdict.copy_outcome)) {
    about.copy = true;
    const auto second = store(about, bytes);
    if (second) copy = *second;
    if (!second) entered = Entered::kNoCopy;
  }
  if (slot && verdict.outcome == Outcome::kHeldBack && held_.size() < held_.capacity()) {
    held_.push_back({verdict.at, next_order_++, *slot, copy, verdict.copy_delay});
  } else if (slot) {
    push(verdict.at, next_order_++, *slot);
    if (copy != kNoSlot) push(verdict.at + verdict.copy_delay, next_order_++, copy);
  }
  for (const Release& release : verdict.released) {
    const auto found = std::find_if(held_.begin(), held_.end(), [&](const HeldEntry& held) {
      return meta_[held.slot].index == release.index && meta_[held.slot].lane == lane;
    });
    if (found != held_.end()) let_go(static_cast<std::size_t>(found - held_.begin()), release.at, next_order_++);
  }
  return entered;
}

std::optional<DelayQueue::Item> DelayQueue::take(Time now) noexcept {
  if (!held_.empty()) expire(now);
  if (heap_.empty() || heap_.front().at > now) return std::nullopt;
  const Entry first = heap_.front();
  std::pop_heap(heap_.begin(), heap_.end(), later);
  heap_.pop_back();
  return item_of(first.at, first.slot);
}

DelayQueue::Item DelayQueue::item_of(Time at, std::uint32_t slot) const noexcept {
  const Slot& about = meta_[slot];
  return {at, about.sent, about.index, about.lane, slot, about.tag, about.copy, about.held_back};
}

std::span<const std::byte> DelayQueue::bytes(const Item& item) const noexcept {
  return {data_.get() + std::size_t{item.slot} * kSlotBytes, meta_[item.slot].size};
}

void DelayQueue::recycle(std::uint32_t slot) noexcept { free_.push_back(slot); }

std::optional<Time> DelayQueue::next_due() const noexcept {
  std::optional<Time> next;
  if (!heap_.empty()) next = heap_.front().at;
  for (const HeldEntry& held : held_) next = std::min(next.value_or(held.limit), held.limit);
  return next;
}

std::optional<std::uint32_t> DelayQueue::store(const Slot& about, std::span<const std::byte> bytes) noexcept {
  if (free_.empty() || bytes.size() > kSlotBytes) return std::nullopt;
  const std::uint32_t slot = free_.back();
  free_.pop_back();
  meta_[slot] = about;
  meta_[slot].size = static_cast<std::uint32_t>(bytes.size());
  if (!bytes.empty()) std::memcpy(data_.get() + std::size_t{slot} * kSlotBytes, bytes.data(), bytes.size());
  return slot;
}

bool DelayQueue::later(const Entry& a, const Entry& b) noexcept {
  return a.at != b.at ? a.at > b.at : a.order > b.order;
}

void DelayQueue::push(Time at, std::uint64_t order, std::uint32_t slot) noexcept {
  heap_.push_back({at, order, slot});
  std::push_heap(heap_.begin(), heap_.end(), later);
}

void DelayQueue::let_go(std::size_t position, Time at, std::uint64_t order) noexcept {
  const HeldEntry held = held_[position];
  held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(position));
  push(at, order, held.slot);
  if (held.copy_slot != kNoSlot) push(at + held.copy_delay, next_order_++, held.copy_slot);
}

void DelayQueue::expire(Time now) noexcept {
  for (std::size_t i = held_.size(); i-- > 0;) {
    if (held_[i].limit <= now) let_go(i, held_[i].limit, held_[i].order);
  }
}

}  // namespace tandem::netsim
