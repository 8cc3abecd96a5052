#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "netsim/path_spec.h"

/// A network that changes while it runs: what a script (proto/script.proto), a scenario or a test asks for.
namespace tandem::netsim {

/// The address that the outside sees of a client changes: a NAT forgot it, or it moved to another network. What the
/// client sends from then on carries a new address; what is sent down to the old one still arrives for `dead_after`.
struct Rebind {
  Duration dead_after{};  ///< [0, 1 h]

  friend bool operator==(const Rebind&, const Rebind&) = default;
};

/// A change of the network at a moment of network time (0 = start of the run or proxy). Exactly one of `outage`, `link`
/// and `rebind` is there.
struct NetworkEvent {
  Duration at{};                            ///< [0, 30 d]
  std::vector<std::string> clients = {};    ///< seats (virtual), or "1", "2" in order of arrival (proxy); empty: all
  std::optional<Direction> direction = {};  ///< empty: both. Not for `rebind`
  std::optional<OutageSpec> outage = {};    ///< its start is `at`
  std::optional<LinkSpec> link = {};        ///< from now on; of `direction` only that half is used
  std::optional<Rebind> rebind = {};
  std::string network = {};  ///< what `link` is called, for people; may be empty
};

/// One client's link over time.
struct LinkSchedule {
  /// From `at` on, until the next change. The outages of events are in every link of the schedule, so that a change
  /// never cuts one short. Models are functions of network time: a link that is changed away and back goes on as if it
  /// had been there all the time.
  struct Change {
    Duration at{};
    LinkSpec link;
  };
  struct AddressChange {
    Duration at{};
    Rebind rebind;
  };
  LinkSpec initial;
  std::vector<Change> changes = {};         ///< `at` above 0 and ascending
  std::vector<AddressChange> rebinds = {};  ///< `at` ascending
};

/// What events mean for one client. Equal times: the order of `events`.
/// @param client  a name as in NetworkEvent::clients
[[nodiscard]] LinkSchedule schedule_for(const LinkSpec& base, std::span<const NetworkEvent> events,
                                        std::string_view client);

/// All mistakes of one event: numbers out of range, none or several of outage, link, rebind, a link that cannot be
/// simulated. Empty: it can be used.
[[nodiscard]] std::vector<SpecProblem> problems(const NetworkEvent& event);

/// What is wrong about changing a link that clients share for some of them only; empty: nothing.
[[nodiscard]] std::string sharing_problem(const LinkSpec& base, std::span<const NetworkEvent> events);

/// All mistakes of a schedule, keys such as `changes[1].up.floor`.
[[nodiscard]] std::vector<SpecProblem> problems(const LinkSchedule& schedule);

}  // namespace tandem::netsim
