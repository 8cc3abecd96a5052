#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/engine/path.h"

namespace tandem::netsim {

/// Store of datagrams until they are due, ordered by (due time, order of entry). The constructor allocates a fixed
/// number of slots; the kernel backs only pages that are used. The virtual network uses one queue per path; the live
/// proxy uses one for all paths.
class DelayQueue {
 public:
  /// Stored datagram.
  struct Item {
    Time sent;
    std::uint64_t index = 0;       ///< index on its path
    std::uint32_t path_index = 0;  ///< the caller's number of the path
    std::uint32_t tag = 0;         ///< defined by the caller
    std::uint32_t size_in = 0;     ///< size as sent [bytes]; corruption may truncate the datagram
    bool copy = false;             ///< true: a copy made by duplication
    bool held_back = false;        ///< true: held back for reordering
    bool waiting = false;          ///< true: decision is open and `at` is the time of sending
    Corruption corruption = {};    ///< corruption applied to the bytes
    std::uint32_t size = 0;        ///< size of the bytes
    std::uint32_t slot = 0;        ///< storage location of the bytes
    Time at = {};                  ///< due time
  };
  /// Result of storing a datagram.
  enum class Entered : std::uint8_t {
    kYes,
    kNoCopy,  ///< the datagram is stored, its copy is not
    kNo,
  };

  /// @param slots  maximum number of stored datagrams [1, 2^24]
  /// @param lanes  number of paths that share the queue; each may hold back 64 datagrams for reordering
  explicit DelayQueue(std::size_t slots, std::size_t lanes = 1);

  /// Stores a datagram according to its decision (kDeliver, kHeldBack or kWaiting) and releases the datagrams listed in
  /// the decision.
  /// @param bytes  at most kSlotBytes
  /// @param tag    returned with the item
  Entered enter(const PathDecision& decision, Time sent, std::uint32_t lane, std::span<const std::byte> bytes,
                std::uint32_t tag = 0) noexcept TANDEM_REALTIME;

  /// Returns the slot of the newest datagram that `enter` stored.
  [[nodiscard]] std::uint32_t newest() const noexcept { return newest_; }
  /// Schedules the waiting datagram of this slot according to the decision (kDeliver or kHeldBack).
  Entered decide(std::uint32_t slot, const PathDecision& decision) noexcept TANDEM_REALTIME;
  /// Discards the waiting datagram of this slot and frees the slot.
  void revoke(std::uint32_t slot) noexcept TANDEM_REALTIME;
  /// Returns the waiting item of this slot with `at` as its due time.
  [[nodiscard]] Item peek(std::uint32_t slot, Time at) const noexcept { return item_of(at, slot); }
  /// Discards all waiting datagrams of one path.
  void discard_waiting(std::uint32_t lane) noexcept;

  /// Removes and returns the first item due at `now`; empty if there is none. Its bytes stay valid until
  /// `recycle(item.slot)`.
  /// @param known  all datagrams that arrived up to this time have entered [<= now]. Held-back datagrams expire at this
  /// time, not at `now`.
  std::optional<Item> take(Time now, Time known) noexcept TANDEM_REALTIME;
  std::optional<Item> take(Time now) noexcept TANDEM_REALTIME { return take(now, now); }
  [[nodiscard]] std::span<const std::byte> bytes(const Item& item) const noexcept;
  void recycle(std::uint32_t slot) noexcept TANDEM_REALTIME;

  [[nodiscard]] std::optional<Time> next_due() const noexcept;

  /// Calls `visit(item)` for every stored item, in unspecified order. Held-back items report their latest due time.
  template <typename Visit>
  void for_each(Visit visit) const {
    for (const Entry& entry : heap_) visit(item_of(entry.at, entry.slot));
    for (const HeldEntry& held : held_) {
      visit(item_of(held.limit, held.slot));
      if (held.copy_slot != kNoSlot) visit(item_of(held.limit + held.copy_delay, held.copy_slot));
    }
    for (std::uint32_t slot = 0; waiting_ > 0 && slot < meta_.size(); ++slot) {
      if (meta_[slot].waiting) visit(item_of(meta_[slot].sent, slot));
    }
  }
  /// Returns the number of stored datagrams; each copy counts. A taken item counts until it is recycled.
  [[nodiscard]] std::size_t size() const noexcept { return slots_ - free_.size(); }
  [[nodiscard]] std::size_t slots() const noexcept { return slots_; }

 private:
  struct Entry {
    Time at;
    std::uint64_t order = 0;
    std::uint32_t slot = 0;
  };
  static constexpr std::uint32_t kNoSlot = ~std::uint32_t{0};
  struct HeldEntry {
    Time limit;
    std::uint64_t order = 0;
    std::uint32_t slot = 0;
    std::uint32_t copy_slot = kNoSlot;
    Duration copy_delay{};
  };

  std::optional<std::uint32_t> store(const Item& about, std::span<const std::byte> bytes) noexcept;
  void release(const PathDecision& decision, std::uint32_t lane) noexcept;
  Entered admit(std::uint32_t slot, const PathDecision& decision) noexcept;
  [[nodiscard]] std::span<std::byte> room(std::uint32_t slot) noexcept {
    return {data_.get() + std::size_t{slot} * kSlotBytes, meta_[slot].size};
  }
  [[nodiscard]] Item item_of(Time at, std::uint32_t slot) const noexcept;
  [[nodiscard]] static bool later(const Entry& a, const Entry& b) noexcept;
  void push(Time at, std::uint64_t order, std::uint32_t slot) noexcept;
  void release_held(std::size_t position, Time at, std::uint64_t order) noexcept;
  void expire(Time now) noexcept;

  std::size_t slots_;
  std::uint64_t next_order_ = 0;
  std::uint32_t newest_ = 0;
  std::size_t waiting_ = 0;
  std::vector<Entry> heap_;      ///< binary heap, memory reserved by the constructor
  std::vector<HeldEntry> held_;  ///< datagrams held back for reordering; few
  std::vector<std::uint32_t> free_;
  std::vector<Item> meta_;  ///< by slot, without the due time
  std::unique_ptr<std::byte[]> data_;
};

}  // namespace tandem::netsim
