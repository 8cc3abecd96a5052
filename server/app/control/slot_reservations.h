#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "common/base/axes.h"
#include "proto/spec/registry_spec.h"
#include "server/session/link_test_peers.h"
#include "server/session/watchers.h"

namespace tandem::server {

/// Peers without a seat as the control plane knows them, link tests or watchers: joins in progress and the workstation
/// in each slot. The session knows which slots are free.
///
/// A join is `begin_join`, then `admit` or `cancel_join`. Joins in progress never exceed the number of slots.
/// @tparam kSlots       number of slots
/// @tparam kFirstPlace  first of the places in connection ids that these peers have
template <std::size_t kSlots, std::uint8_t kFirstPlace>
class SlotReservations {
 public:
  static constexpr std::size_t kMax = kSlots;
  static constexpr std::uint8_t kPlaces = 64;
  struct Slot {
    std::optional<WorkstationRow> owner{};  ///< last admitted peer; nullopt: none, or removed
    std::uint32_t cid = 0;                  ///< connection id of its datagrams
    bool recorder = false;                  ///< it gets every tick, to record the session
  };

  /// @return false if as many joins as slots are in progress
  [[nodiscard]] bool begin_join() noexcept {
    if (joining_ >= kMax) return false;
    ++joining_;
    return true;
  }
  /// Whether the free slots of the session suffice for all joins in progress.
  [[nodiscard]] bool enough(std::size_t free_slots) const noexcept { return free_slots >= joining_; }
  void cancel_join() noexcept { --joining_; }
  /// The session has admitted the peer to this slot.
  void admit(std::size_t slot, const WorkstationRow& owner, std::uint32_t cid, bool recorder = false) {
    --joining_;
    slots_[slot] = {owner, cid, recorder};
  }

  /// Place in the connection id of the next peer. The places are assigned in turn.
  [[nodiscard]] std::uint8_t next_place() noexcept {
    return static_cast<std::uint8_t>(kFirstPlace + next_place_++ % kPlaces);
  }
  [[nodiscard]] static constexpr bool has_place(std::uint8_t place) noexcept {
    return place >= kFirstPlace && place < kFirstPlace + kPlaces;
  }
  /// Slot of a connection; nullopt if it has none.
  [[nodiscard]] std::optional<std::size_t> find(std::uint32_t cid) const noexcept {
    const auto found = std::ranges::find_if(slots_, [cid](const Slot& s) { return s.cid == cid && s.owner; });
    if (found == slots_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - slots_.begin());
  }
  [[nodiscard]] const std::array<Slot, kMax>& slots() const noexcept { return slots_; }
  void remove(std::size_t slot) noexcept { slots_[slot].owner.reset(); }

 private:
  std::size_t joining_ = 0;
  std::uint8_t next_place_ = 0;
  std::array<Slot, kMax> slots_{};
};

inline constexpr std::uint8_t kLinkTestPlace = kSeatsMax + 1;
using LinkTestSlots = SlotReservations<LinkTestPeers::kMax, kLinkTestPlace>;
using WatcherSlots = SlotReservations<Watchers::kMax, kLinkTestPlace + LinkTestSlots::kPlaces>;

}  // namespace tandem::server
