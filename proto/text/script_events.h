#pragma once

#include <span>
#include <string>

#include "proto/spec/script_spec.h"
#include "proto/text/message_validator.h"

namespace tandem::pb {
class ScriptEvent;
}

/// Private to proto/text: one event of a script or a scenario.
namespace tandem {

/// Converts an event.
/// @param key      key of the event, such as `event[0]`; its errors go to `validator` under this key
/// @param clients  allowed names; empty: whole numbers from 1
[[nodiscard]] ScriptEventSpec script_event_from(const pb::ScriptEvent& in, text::MessageValidator& validator,
                                                const std::string& key, std::span<const std::string> clients);

}  // namespace tandem
