#pragma once

#include <expected>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/profiles.h"
#include "netsim/script.h"
#include "proto/input_error.h"

namespace tandem {
struct ScriptEventSpec;
}

/// Scripts as text: proto/script.proto.
namespace tandem::netsim {

/// Finds the network that an event names: a shipped profile or a file, as the caller sees files.
using FindNetwork = std::function<std::expected<LinkSpec, InputErrors>(const std::string& name)>;

/// Turns events into the engine's numbers.
/// @return the events, in the order written, or every mistake: a profile that is not known is told at its place in the
/// script, followed by what is wrong inside its own file
[[nodiscard]] std::expected<std::vector<NetworkEvent>, InputErrors> network_events(
    std::span<const ScriptEventSpec> events, const FindNetwork& find);

/// Reads a script.
/// @param clients  names that may be written; none: whole numbers from 1, in order of arrival
/// @return the events, or every mistake found
[[nodiscard]] std::expected<std::vector<NetworkEvent>, InputErrors> parse_script(std::string_view text,
                                                                                 std::string_view file_name,
                                                                                 std::span<const std::string> clients,
                                                                                 const FindNetwork& find);

/// Shipped profiles only.
[[nodiscard]] std::expected<LinkSpec, InputErrors> find_shipped(const std::string& name);

}  // namespace tandem::netsim
