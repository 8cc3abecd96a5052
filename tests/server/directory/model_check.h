#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"

/// Model check of the ownership protocol: real `Ownership` cores and a `ModelStore` under a seeded scheduler, with
/// faulty networks, machines and clocks, in virtual time.
namespace tandem::directory::test {

/// A guard of the protocol that a run leaves out. Each is taken out beside the core: in its parameters, in the requests
/// and replies on their way, in the clock that it is given, or in the clients.
enum class Guard {
  kNone,
  kSendingTime,        ///< renewals count from the arrival of their answer
  kHold,               ///< sessions are not held when renewals fail
  kRamp,               ///< the time of the ramp is not counted
  kClaimCondition,     ///< a claim does not ask whether the key exists
  kReleaseCondition,   ///< a release does not compare the revision
  kTicketCondition,    ///< a ticket is used without asking whether it was
  kLeaseIdentity,      ///< keys with the server's name count as its own, whatever their lease
  kKeyUnderLease,      ///< owner keys have no lease
  kConfirmedRenewal,   ///< renewals count without a transaction after them
  kSameTerm,           ///< renewals count whatever the term of that transaction
  kMonotonicClock,     ///< the wall clock measures leases
  kSuspendedClock,     ///< the clock stops while the machine is suspended
  kAdoption,           ///< a server does not recognise its own key after a lost answer
  kStandbyUnderLease,  ///< standby keys outlive their server
  kHighestRevision,    ///< clients obey every revision
};
inline constexpr Guard kGuards[] = {Guard::kSendingTime,
                                    Guard::kHold,
                                    Guard::kRamp,
                                    Guard::kClaimCondition,
                                    Guard::kReleaseCondition,
                                    Guard::kTicketCondition,
                                    Guard::kLeaseIdentity,
                                    Guard::kKeyUnderLease,
                                    Guard::kConfirmedRenewal,
                                    Guard::kSameTerm,
                                    Guard::kMonotonicClock,
                                    Guard::kSuspendedClock,
                                    Guard::kAdoption,
                                    Guard::kStandbyUnderLease,
                                    Guard::kHighestRevision};
[[nodiscard]] const char* to_text(Guard guard);

struct Fault {
  enum class Kind {
    kPause,       ///< the process is stopped (SIGSTOP) and goes on
    kSuspend,     ///< the machine sleeps
    kCrash,       ///< the process ends and is started again
    kCutStore,    ///< no message between the server and the store
    kCutClients,  ///< no message between the server and clients
    kWallClock,   ///< the server's wall clock jumps
    kElection,    ///< the store has no leader for a while, then a new one
    kDeposed,     ///< a new leader; the old one answers this server's renewals for a while; then the server is cut off
    kOutage,      ///< the store is gone for a while
    kSlowDisk,    ///< the store answers up to 1 s late
    kCompact,     ///< the store forgets its history, and all watches break
    kMove,        ///< an operator moves a session
    // Only in schedules with losses:
    kEmptied,   ///< the store is gone for a while, and begins from nothing
    kPutBack,   ///< the same, from a copy of some age
    kDiskLost,  ///< a crash after which the server knows nothing of before
  };
  Kind kind{};
  std::size_t who = 0, to = 0;  ///< server or session, and target of a move
  Duration at{}, length{};
  Duration age{};  ///< kPutBack: of the copy
};

/// A schedule as data: it can be shortened and run again.
struct Schedule {
  std::uint64_t seed = 0;
  std::size_t servers = 2, sessions = 1;
  double loss = 0, duplicate = 0;
  Duration delay_max{}, answer_limit{};
  std::optional<std::size_t> slow;  ///< the one server with long delays; empty: all have them
  std::vector<double> drift;        ///< of the store, then of each server
  std::vector<Fault> faults;
  Duration calm{};  ///< from here on no fault
};

struct Verdict {
  std::string violation;  ///< empty: passed
  Duration recovered{};   ///< from the begin of the calm phase until every session was served
  std::uint64_t events = 0, tickets = 0, owners = 0, elsewhere = 0, rejected = 0, doubtful = 0;
  std::uint64_t losses = 0;       ///< of the store, that servers have noticed
  std::uint64_t fingerprint = 0;  ///< hash of the run: same schedule, same number
};

/// Time after which every session is served again when all faults have ended.
inline constexpr Duration kCalmLimit = std::chrono::seconds(7);
/// Longest age of a copy from which the store is put back, and shortest time that this takes: then no server acts by
/// its lease any more.
inline constexpr Duration kAgeMax = std::chrono::seconds(10), kRestoreMin = std::chrono::milliseconds(2500);

[[nodiscard]] Schedule draw_schedule(std::uint64_t seed);
/// The same, in which the store loses its data once or twice.
[[nodiscard]] Schedule draw_schedule_with_losses(std::uint64_t seed);
[[nodiscard]] Verdict run_schedule(const Schedule& schedule, Guard removed = Guard::kNone);
/// Leaves out faults as long as the schedule still fails.
[[nodiscard]] Schedule shrink(Schedule schedule, const std::function<Verdict(const Schedule&)>& run);
[[nodiscard]] std::string to_text(const Schedule& schedule);

}  // namespace tandem::directory::test
