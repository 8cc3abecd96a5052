#pragma once

#include <optional>
#include <string>

#include "proto/rpc/rpc_messages.h"

/// Words that tell participants of a recording. Texts of the server are sanitised.
namespace tandem::client {

/// Returns by whom a session is recorded, what the recording lost and why: `RECORDED by the server, without names`.
[[nodiscard]] std::string recording_text(const rpc::StatusRecording& recording);
/// The same in at most 20 characters, for a narrow screen.
[[nodiscard]] std::string recording_brief(const rpc::StatusRecording& recording);
/// Returns the change of a recording between two statuses; empty: none worth a line.
[[nodiscard]] std::string recording_change_text(const std::optional<rpc::StatusRecording>& before,
                                                const std::optional<rpc::StatusRecording>& now);
/// Returns a recording as JSON: `null` or `{"by_server", "by_recorders", "pseudonyms", "dropped_ticks", "trouble": null
/// or TEXT}`.
[[nodiscard]] std::string recording_json(const std::optional<rpc::StatusRecording>& recording);

}  // namespace tandem::client
