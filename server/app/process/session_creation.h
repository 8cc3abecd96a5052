#pragma once

#include <cstddef>
#include <expected>
#include <string>

#include "proto/rpc/rpc_messages.h"
#include "server/app/process/session_instance.h"

/// Sessions that operators create at run time: their options, checked completely.
namespace tandem::server {

/// Sessions created at run time that are open at a time, unless the configuration states another number.
inline constexpr std::size_t kCreatedSessionsDefault = 16;

/// Returns the options of a session that an operator wants, or why they are rejected: an unknown scene, every mistake
/// in its text that fits into a reply (file, line, column, key), a name with the form of a session code, a holder of an
/// unknown seat.
/// @param scenes  folder of further scenes, NAME.textproto; empty: shipped scenes only
[[nodiscard]] std::expected<SessionOptions, rpc::ErrorReply> created_session_options(const rpc::CreateSession& wanted,
                                                                                     const std::string& scenes);

/// Names of the scenes from which an operator may create sessions: the shipped ones, and the files NAME.textproto of a
/// folder, of which at most 4096 entries are read. A folder that cannot be read has none. With the names come the seats
/// of the scenes, as many as a reply has place for.
/// @param scenes  folder of further scenes; empty: shipped scenes only
[[nodiscard]] rpc::SceneList list_scenes(const std::string& scenes);

/// Mistakes as one text for a reply: as many as fit into rpc::kTextMax, and the number of the others.
[[nodiscard]] std::string reply_text(const InputErrors& errors);

}  // namespace tandem::server
