#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/console/session_picture.h"

/// Messages `scene` and `state` of the gateway to the page (PROTOCOL.md), as JSON texts. A value that is not known is
/// null, never 0.
namespace tandem::console {

/// @pre picture.number > 0
[[nodiscard]] std::string scene_json(const LivePicture& picture);

/// Members of `state` that are the same for all browsers, without braces. It is written once per picture.
/// @pre picture.number > 0
[[nodiscard]] std::string state_members(const LivePicture& picture);

/// Members of `state` that differ between browsers.
struct StateHead {
  std::uint64_t n = 0;                                   ///< number of the state, from 1
  std::uint64_t dropped = 0;                             ///< states that this browser did not get
  std::int64_t wall_us = 0;                              ///< monotonic clock of the gateway [us]
  std::optional<double> age_ms;                          ///< since the newest datagram [ms]; nullopt: none
  const std::optional<rpc::StatusStop>* stop = nullptr;  ///< as this person sees it; not null
};
/// @param members  of state_members
[[nodiscard]] std::string state_json(const StateHead& head, const std::string& members);

}  // namespace tandem::console
