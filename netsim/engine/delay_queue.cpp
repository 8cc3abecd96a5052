#include "netsim/engine/delay_queue.h"

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
  std::iota(free_.rbegin(), free_.rend(), 0U);  // slot 0 first, to touch as few pages as possible
}

DelayQueue::Entered DelayQueue::enter(const PathDecision& decision, Time sent, std::uint32_t path_index,
                                      std::span<const std::byte> bytes, std::uint32_t tag) noexcept {
  const bool waits = decision.outcome == Outcome::kWaiting;
  const auto slot = store({.sent = sent,
                           .index = decision.index,
                           .path_index = path_index,
                           .tag = tag,
                           .size_in = static_cast<std::uint32_t>(bytes.size()),
                           .waiting = waits},
                          bytes);
  if (!slot) {
    release(decision, path_index);
    return Entered::kNo;
  }
  newest_ = *slot;
  if (!waits) return admit(*slot, decision);
  ++waiting_;
  return Entered::kYes;
}

DelayQueue::Entered DelayQueue::decide(std::uint32_t slot, const PathDecision& decision) noexcept {
  meta_[slot].waiting = false;
  --waiting_;
  return admit(slot, decision);
}

void DelayQueue::revoke(std::uint32_t slot) noexcept {
  meta_[slot].waiting = false;
  --waiting_;
  recycle(slot);
}

void DelayQueue::discard_waiting(std::uint32_t path_index) noexcept {
  for (std::uint32_t slot = 0; waiting_ > 0 && slot < meta_.size(); ++slot) {
    if (!meta_[slot].waiting || meta_[slot].path_index != path_index) continue;
    revoke(slot);
  }
}

DelayQueue::Entered DelayQueue::admit(std::uint32_t slot, const PathDecision& decision) noexcept {
  Item& about = meta_[slot];
  about.held_back = decision.outcome == Outcome::kHeldBack;
  if (decision.corruption.kind != Corruption::Kind::kNone) {
    about.corruption = decision.corruption;
    about.size = static_cast<std::uint32_t>(apply_corruption(decision.corruption, room(slot)));
  }
  Entered entered = Entered::kYes;
  std::uint32_t copy = kNoSlot;
  if (decision.copied && !dropped(decision.copy_outcome)) {
    Item second = about;
    second.copy = true;
    if (const auto stored = store(second, room(slot))) copy = *stored;
    if (copy == kNoSlot) entered = Entered::kNoCopy;
  }
  if (decision.outcome == Outcome::kHeldBack && held_.size() < held_.capacity()) {
    held_.push_back({decision.at, next_order_++, slot, copy, decision.copy_delay});
  } else {
    push(decision.at, next_order_++, slot);
    if (copy != kNoSlot) push(decision.at + decision.copy_delay, next_order_++, copy);
  }
  release(decision, about.path_index);
  return entered;
}

void DelayQueue::release(const PathDecision& decision, std::uint32_t path_index) noexcept {
  for (const Release& release : decision.released) {
    const auto found = std::find_if(held_.begin(), held_.end(), [&](const HeldEntry& held) {
      return meta_[held.slot].index == release.index && meta_[held.slot].path_index == path_index;
    });
    if (found != held_.end()) release_held(static_cast<std::size_t>(found - held_.begin()), release.at, next_order_++);
  }
}

std::optional<DelayQueue::Item> DelayQueue::take(Time now, Time known) noexcept {
  if (!held_.empty()) expire(known);
  if (heap_.empty() || heap_.front().at > now) return std::nullopt;
  const Entry first = heap_.front();
  std::pop_heap(heap_.begin(), heap_.end(), later);
  heap_.pop_back();
  return item_of(first.at, first.slot);
}

DelayQueue::Item DelayQueue::item_of(Time at, std::uint32_t slot) const noexcept {
  Item item = meta_[slot];
  item.at = at;
  return item;
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

std::optional<std::uint32_t> DelayQueue::store(const Item& about, std::span<const std::byte> bytes) noexcept {
  if (free_.empty() || bytes.size() > kSlotBytes) return std::nullopt;
  const std::uint32_t slot = free_.back();
  free_.pop_back();
  meta_[slot] = about;
  meta_[slot].size = static_cast<std::uint32_t>(bytes.size());
  meta_[slot].slot = slot;
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

void DelayQueue::release_held(std::size_t position, Time at, std::uint64_t order) noexcept {
  const HeldEntry held = held_[position];
  held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(position));
  push(at, order, held.slot);
  if (held.copy_slot != kNoSlot) push(at + held.copy_delay, next_order_++, held.copy_slot);
}

void DelayQueue::expire(Time now) noexcept {
  for (std::size_t i = held_.size(); i-- > 0;) {
    if (held_[i].limit <= now) release_held(i, held_[i].limit, held_[i].order);
  }
}

}  // namespace tandem::netsim
