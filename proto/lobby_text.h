#pragma once

#include <string>
#include <vector>

#include "proto/control_messages.h"

/// The sessions of a server as people and machines read them.
namespace tandem {

/// One line per session and one per seat; a sentence if there is none.
/// @param codes  of the sessions, in their order, as people read them; empty: not known to the reader
[[nodiscard]] std::string lobby_text(const control::SessionList& list, const std::vector<std::string>& codes = {});

/// `{"sessions": [{"id", "name", "phase", "code"?, "seats_free", "seats_taken", "seats": [{"name", "role", "taken", "required"}]}], "more": false}`
[[nodiscard]] std::string lobby_json(const control::SessionList& list, const std::vector<std::string>& codes = {});

}  // namespace tandem
