#pragma once

#include <span>
#include <string>

#include "proto/checker.h"
#include "proto/script_spec.h"

namespace tandem::pb {
class ScriptEvent;
}

/// Private to proto/*.cpp: one event, in a script or in a scenario.
namespace tandem {

/// @param key      of the event, such as `event[0]`; its mistakes go to `checker` under it
/// @param clients  names that may be written; none: whole numbers from 1
[[nodiscard]] ScriptEventSpec script_event_from(const pb::ScriptEvent& in, text::Checker& checker,
                                                const std::string& key, std::span<const std::string> clients);

}  // namespace tandem
