#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "proto/rpc/rpc_messages.h"

/// Messages of the gateway to the page, as JSON texts. A value that is not known is null. Texts of participants are
/// valid UTF-8 afterwards.
namespace tandem::console {

[[nodiscard]] std::string session_hex(const rpc::Id& session);
/// @param release  version of the program
[[nodiscard]] std::string hello_json(const rpc::Status& status, AccessRole role, std::string_view release);
[[nodiscard]] std::string scene_json(const rpc::Status& status);
/// @param n        number of the state, from 1
/// @param dropped  states that this browser did not get
/// @param wall_us  monotonic clock of the gateway [us]
[[nodiscard]] std::string state_json(const rpc::Status& status, std::uint64_t n, std::uint64_t dropped,
                                     std::int64_t wall_us);
[[nodiscard]] std::string event_json(const rpc::Id& session, const rpc::StatusEvent& event);
[[nodiscard]] std::string reply_json(std::optional<std::uint64_t> id, bool ok, std::string_view text);
/// @param level  info, warning or error
[[nodiscard]] std::string notice_json(std::string_view level, std::string_view text);

}  // namespace tandem::console
