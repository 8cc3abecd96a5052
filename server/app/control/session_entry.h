#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/auth/limiter.h"
#include "server/app/control/console_tickets.h"
#include "server/app/control/removed_workstations.h"
#include "server/app/control/seat_reservation.h"
#include "server/app/control/session_notes.h"
#include "server/app/control/slot_reservations.h"
#include "server/app/control/status_notices.h"
#include "server/app/process/live_session.h"
#include "server/app/process/shard.h"
#include "server/app/process/stored_orders.h"
#include "server/app/recording/recording_desk.h"

namespace tandem::server {

/// Session that clients can join.
struct SessionRegistration {
  std::string name;  ///< for users: 1 to 32 characters of A-Z a-z 0-9 _ -
  auth::Id16 id{};
  /// Session code, 10 characters of 0-9 A-Z, with which enrolled workstations may join. Empty: tickets only.
  std::string code;
  std::uint64_t epoch = 1;
  LiveSession* session = nullptr;             ///< valid until the session is over
  Shard* shard = nullptr;                     ///< serves the session, or will
  const SessionSnapshot* snapshot = nullptr;  ///< source of the restore, read when it is added; null: a new session
  /// Receives the full list of removed workstations whenever one is added; null: the list is not stored.
  std::function<void(const std::vector<RemovedWorkstations::Key>&)> on_removed{};
  Time resume_until{};  ///< former participants can resume until then; only with `snapshot`
  /// Receives the names of the persons at all seats whenever a client takes one; null: they are not stored.
  std::function<void(std::vector<std::string>)> on_persons{};
  /// Tickets of the consoles at the former owner of a session of a service: they return. Read when it is added.
  std::vector<auth::Id16> consoles{};
  /// Receives the tickets that return at the next owner whenever they change; null: they are not stored.
  std::function<void(std::vector<auth::Id16>)> on_consoles{};
  std::vector<AuthoredNote> notes{};             ///< marks and sheets of an earlier run of the server, oldest first
  std::shared_ptr<RecordingDesk> recording{};    ///< tells of the recording and takes notes for it; null: none
  std::string no_recording{};                    ///< why the server cannot record it, and the remedy; empty: it can
  std::shared_ptr<const StoredOrders> stored{};  ///< which orders a restart restores; null: it restores none
};

/// A registered session, and what the control plane alone knows about its clients.
struct SessionEntry {
  /// @param now  of the monotonic clock
  SessionEntry(SessionRegistration opening, Time now)
      : registration(std::move(opening)), consoles(std::exchange(registration.consoles, {}), now + kResumeLife) {
    seats.resize(scene().seats.size());
    const SessionSnapshot* const from = std::exchange(registration.snapshot, nullptr);  // the caller may destroy it
    removed =
        RemovedWorkstations(from == nullptr ? std::vector<RemovedWorkstations::Key>{} : from->removed_workstations,
                            registration.on_removed);
    for (std::size_t i = 0; from != nullptr && i < seats.size(); ++i)
      seats[i].restore(from->checkpoint.seats[i], registration.resume_until, now,
                       i < from->persons.size() ? from->persons[i] : std::string{});
    for (AuthoredNote& note : std::exchange(registration.notes, {})) notes.add(std::move(note));
    if (!consoles.returning_next().empty()) keep_consoles();  // for the owner after this one
  }

  [[nodiscard]] LiveSession& session() const noexcept { return *registration.session; }
  [[nodiscard]] const SceneSpec& scene() const noexcept { return registration.session->scene(); }
  /// Neither removed nor over.
  [[nodiscard]] bool open() const noexcept { return !closing && !registration.session->over(); }
  /// A seat is taken or being taken, or a console is joined.
  [[nodiscard]] bool in_use(Time now) const {
    constexpr Duration kStatusAge = std::chrono::seconds(1);  // more than that of the session's status
    const SessionStatus status = session().status();
    return !consoles.empty() || std::ranges::any_of(status.seats, &SeatStatus::taken) ||
           std::ranges::any_of(seats, [&](const SeatReservation& seat) {
             return seat.joining() || seat.admitted_since(now - kStatusAge);
           });
  }
  /// Stores the names of the persons at the seats.
  void keep_persons() const {
    if (!registration.on_persons) return;
    std::vector<std::string> names;
    for (const SeatReservation& seat : seats) names.push_back(seat.person());
    registration.on_persons(std::move(names));
  }
  /// Stores the tickets of the consoles.
  void keep_consoles() const {
    if (registration.on_consoles) registration.on_consoles(consoles.returning_next());
  }

  SessionRegistration registration;
  std::uint32_t number = 0;            ///< of this server, from 1: place in the list of sessions
  bool closing = false;                ///< the session is over and being removed: it gets no more requests
  bool given_up = false;               ///< it ends here only: another server of the service goes on with it
  std::vector<SeatReservation> seats;  ///< one per seat
  LinkTestSlots link_tests;
  WatcherSlots watchers;
  ConsoleTickets consoles;
  RemovedWorkstations removed;
  StatusNotices notices;
  SessionNotes notes;
  TokenBucket forbidden_events{1, 5};  ///< audit events of forbidden commands
};

}  // namespace tandem::server
