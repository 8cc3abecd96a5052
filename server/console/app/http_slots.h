#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "common/auth/pending_slots.h"
#include "common/auth/returning_addresses.h"

namespace tandem::console {

/// The open HTTP connections, in a bounded number. One more closes another: one of the network and address with most
/// of them, and first one that has sent no whole request (PendingSlots). A computer that opens many connections thus
/// takes those of no other one.
class HttpSlots {
 public:
  using Id = auth::PendingSlots::Id;

  /// @param places  an eighth of them is for addresses that `note` names
  explicit HttpSlots(std::size_t places) noexcept : slots_({.places = places}) {}
  HttpSlots(const HttpSlots&) = delete;
  HttpSlots& operator=(const HttpSlots&) = delete;

  /// Adds a connection. @param close  closes it; called at most once, and not after `leave`
  [[nodiscard]] Id arrive(const auth::Origin& origin, Time now, std::function<void()> close) {
    const auto placed = slots_.arrive(origin, known_.contains(origin, now), now);
    open_.emplace(placed.id, std::move(close));
    if (placed.evicted) open_.extract(*placed.evicted).mapped()();
    return placed.id;
  }
  /// The connection has sent a whole request.
  void on_request(Id id) noexcept { slots_.first_byte(id); }
  void leave(Id id) {
    open_.erase(id);
    slots_.leave(id);
  }
  /// A person who has signed in uses this address.
  void note(const auth::Origin& origin, Time now) { known_.note(origin, now); }

 private:
  auth::PendingSlots slots_;
  auth::ReturningAddresses known_;
  std::map<Id, std::function<void()>> open_;
};

}  // namespace tandem::console
