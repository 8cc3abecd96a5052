#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/path.h"

namespace tandem::netsim {

/// Largest datagram the stores keep: an Ethernet payload.
inline constexpr std::size_t kSlotBytes = 1500;

/// Keeps datagrams until they are due. Fixed number of slots, taken at construction; pages nobody used cost nothing.
/// Order: (time due, order of entering). Used by the virtual network (one per path) and the live proxy (one for all).
class DelayQueue {
 public:
  struct Item {
    Time at;  ///< due
    Time sent;
    std::uint64_t index = 0;    ///< on its path
    std::uint32_t lane = 0;     ///< caller's name of the path
    std::uint32_t slot = 0;     ///< where the bytes are
    std::uint32_t tag = 0;      ///< the caller's own
    std::uint32_t size_in = 0;  ///< [bytes] as sent; damage may have cut it
    bool copy = false;          ///< made by duplication
    bool held_back = false;     ///< to be reordered
    bool waiting = false;       ///< not decided yet: `at` is the time of sending
    Damage damage = {};         ///< done to the bytes
  };
  enum class Entered : std::uint8_t {
    kYes,
    kNoCopy,  ///< the datagram found room, its copy did not
    kNo,
  };

  /// @param slots  datagrams at the same time [1, 2^24]
  /// @param lanes  paths that share the queue; each may hold back 64 datagrams to reorder them
  explicit DelayQueue(std::size_t slots, std::size_t lanes = 1);

  /// Keeps a datagram according to its verdict (kDeliver, kHeldBack or kWaiting) and lets go those the verdict
  /// releases.
  /// @param bytes  at most kSlotBytes
  /// @param tag    comes out with the item
  Entered enter(const Verdict& verdict, Time sent, std::uint32_t lane, std::span<const std::byte> bytes,
                std::uint32_t tag = 0) noexcept TANDEM_REALTIME;

  /// The slot of the newest datagram that `enter` kept.
  [[nodiscard]] std::uint32_t newest() const noexcept { return newest_; }
  /// What waited in this slot comes out after all, as the verdict (kDeliver or kHeldBack) says.
  Entered decide(std::uint32_t slot, const Verdict& verdict) noexcept TANDEM_REALTIME;
  /// What waited in this slot will not come out: the slot is free.
  void revoke(std::uint32_t slot) noexcept TANDEM_REALTIME;
  /// What waits in this slot, as if due at `at`.
  [[nodiscard]] Item peek(std::uint32_t slot, Time at) const noexcept { return item_of(at, slot); }
  /// All that waits of a lane is gone, for good.
  void forget_waiting(std::uint32_t lane) noexcept;

  /// Removes the first item due at `now`. Its bytes stay until `recycle(item.slot)`.
  /// @param known  everything that came by then has entered [<= now]: what is held back for others to pass does not give
  ///               them up before
  std::optional<Item> take(Time now, Time known) noexcept TANDEM_REALTIME;
  std::optional<Item> take(Time now) noexcept TANDEM_REALTIME { return take(now, now); }
  [[nodiscard]] std::span<const std::byte> bytes(const Item& item) const noexcept;
  void recycle(std::uint32_t slot) noexcept TANDEM_REALTIME;

  [[nodiscard]] std::optional<Time> next_due() const noexcept;

  /// Calls `visit(item)` for everything that is in here, in no particular order; what is held back has its latest time.
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
  /// Datagrams kept, copies counted each; what was taken counts until it is recycled.
  [[nodiscard]] std::size_t size() const noexcept { return slots_ - free_.size(); }
  [[nodiscard]] std::size_t slots() const noexcept { return slots_; }

 private:
  struct Entry {
    Time at;
    std::uint64_t order = 0;
    std::uint32_t slot = 0;
  };
  struct Slot {
    Time sent;
    std::uint64_t index = 0;
    std::uint32_t lane = 0;
    std::uint32_t size = 0;
    std::uint32_t tag = 0;
    std::uint32_t size_in = 0;
    bool copy = false, held_back = false, waiting = false;
    Damage damage = {};
  };
  static constexpr std::uint32_t kNoSlot = ~std::uint32_t{0};
  struct HeldEntry {
    Time limit;
    std::uint64_t order = 0;
    std::uint32_t slot = 0;
    std::uint32_t copy_slot = kNoSlot;
    Duration copy_delay{};
  };

  std::optional<std::uint32_t> store(const Slot& about, std::span<const std::byte> bytes) noexcept;
  void release(const Verdict& verdict, std::uint32_t lane) noexcept;
  Entered admit(std::uint32_t slot, const Verdict& verdict) noexcept;
  [[nodiscard]] std::span<std::byte> room(std::uint32_t slot) noexcept {
    return {data_.get() + std::size_t{slot} * kSlotBytes, meta_[slot].size};
  }
  [[nodiscard]] Item item_of(Time at, std::uint32_t slot) const noexcept;
  [[nodiscard]] static bool later(const Entry& a, const Entry& b) noexcept;
  void push(Time at, std::uint64_t order, std::uint32_t slot) noexcept;
  void let_go(std::size_t position, Time at, std::uint64_t order) noexcept;
  void expire(Time now) noexcept;

  std::size_t slots_;
  std::uint64_t next_order_ = 0;
  std::uint32_t newest_ = 0;
  std::size_t waiting_ = 0;
  std::vector<Entry> heap_;      ///< binary heap, reserved once
  std::vector<HeldEntry> held_;  ///< few; waits for later datagrams to pass
  std::vector<std::uint32_t> free_;
  std::vector<Slot> meta_;
  std::unique_ptr<std::byte[]> data_;
};

}  // namespace tandem::netsim
