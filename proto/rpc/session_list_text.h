#pragma once

#include <string>
#include <vector>

#include "proto/rpc/rpc_messages.h"

/// Text and JSON of a session list.
namespace tandem {

/// One line per session and one per seat; a sentence if there is none.
/// @param codes  codes of the sessions in the same order, in display form; empty: unknown to the caller
[[nodiscard]] std::string session_list_text(const rpc::SessionList& list, const std::vector<std::string>& codes = {});

/// `{"sessions": [{"id", "name", "phase", "server"?, "code"?, "seats_free", "seats_taken", "seats": [{"name", "role",
/// "taken", "required"}]}], "more": false, "old"?: true}`
[[nodiscard]] std::string session_list_json(const rpc::SessionList& list, const std::vector<std::string>& codes = {});

}  // namespace tandem
