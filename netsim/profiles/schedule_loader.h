#pragma once

#include <expected>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/engine/schedule.h"
#include "netsim/profiles/profile_loader.h"
#include "proto/spec/input_error.h"

namespace tandem {
struct ScriptEventSpec;
}

/// Parsing of scripts: proto/schema/script.proto.
namespace tandem::netsim {

/// Finds the network named by an event: a shipped profile, or a file relative to the caller's location.
using FindNetwork = std::function<std::expected<LinkSpec, InputErrors>(const std::string& name)>;

/// Converts events to the engine's specification.
/// @return events in the given order, or all errors. An unknown profile is reported at its place in the script,
/// followed by the errors inside its own file
[[nodiscard]] std::expected<std::vector<NetworkEvent>, InputErrors> network_events(
    std::span<const ScriptEventSpec> events, const FindNetwork& find);

/// Parses a script.
/// @param clients  allowed client names; empty: whole numbers from 1, in order of arrival
/// @return events, or all errors
[[nodiscard]] std::expected<std::vector<NetworkEvent>, InputErrors> parse_script(std::string_view text,
                                                                                 std::string_view file_name,
                                                                                 std::span<const std::string> clients,
                                                                                 const FindNetwork& find);

/// Finds shipped profiles only.
[[nodiscard]] std::expected<LinkSpec, InputErrors> find_shipped(const std::string& name);

}  // namespace tandem::netsim
