#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "netsim/models/path_spec.h"

/// Schedule of network changes during a run, as requested by a script (proto/schema/script.proto), a scenario or a
/// test.
namespace tandem::netsim {

/// Change of the client's external address, for example by NAT expiry or a change of network. Later datagrams of the
/// client carry the new address. Datagrams to the old address still arrive for `dead_after`.
struct Rebind {
  Duration dead_after{};  ///< [0, 1 h]

  friend bool operator==(const Rebind&, const Rebind&) = default;
};

/// Change of the network at a time of network time (0 = start of the run or proxy). Exactly one of `outage`, `link` and
/// `rebind` is set.
struct NetworkEvent {
  Duration at{};                            ///< [0, 30 d]
  std::vector<std::string> clients = {};    ///< seats (simulation), or "1", "2" by arrival (proxy); empty: all
  std::optional<Direction> direction = {};  ///< empty: both; not used with `rebind`
  std::optional<OutageSpec> outage = {};    ///< its start is replaced by `at`
  std::optional<LinkSpec> link = {};        ///< in force from `at` on; only the half of `direction`
  std::optional<Rebind> rebind = {};
  std::string network = {};  ///< display name of `link`; may be empty
};

/// Link of one client over time.
struct LinkSchedule {
  /// Link in force from `at` until the next change. Every link of the schedule contains the outages of all events, so
  /// that a change never shortens an outage. Models are functions of network time: a link that is changed and changed
  /// back continues as if never interrupted.
  struct Change {
    Duration at{};
    LinkSpec link;
  };
  /// Change of the client's address at `at`.
  struct AddressChange {
    Duration at{};
    Rebind rebind;
  };
  LinkSpec initial;
  std::vector<Change> changes = {};         ///< `at` above 0 and ascending
  std::vector<AddressChange> rebinds = {};  ///< `at` ascending
};

/// Returns the schedule of one client. Events with equal times apply in the order of `events`.
/// @param client  name as in NetworkEvent::clients
[[nodiscard]] LinkSchedule schedule_for(const LinkSpec& base, std::span<const NetworkEvent> events,
                                        std::string_view client);

/// Returns all errors of one event: numbers out of range, not exactly one of outage, link and rebind, or an invalid
/// link. Empty if the event is valid.
[[nodiscard]] std::vector<SpecError> problems(const NetworkEvent& event);

/// Returns an error if events change a shared link for only some of its clients; else empty.
[[nodiscard]] std::string sharing_problem(const LinkSpec& base, std::span<const NetworkEvent> events);

/// Returns all errors of a schedule, with keys such as `changes[1].up.floor`.
[[nodiscard]] std::vector<SpecError> problems(const LinkSchedule& schedule);

}  // namespace tandem::netsim
