#pragma once

#include <string>

#include "server/app/process/session_table.h"
#include "server/app/service/service_options.h"
#include "server/service/service_session.h"

/// Options of sessions to their specs in the directory, and back.
namespace tandem::server {

/// Spec of a new run of a session, with a random id and code.
[[nodiscard]] ServiceSession spec_of(const SessionOptions& session);
/// Sets everything of `session` that the spec has; files and recordings stay. @return the error; empty: none
[[nodiscard]] std::string read_spec(const ServiceSession& spec, SessionOptions& session);
/// Whether the table has a session of this name that is not finished.
[[nodiscard]] bool serves(const SessionTable& sessions, const std::string& name);
/// For messages: endpoints with commas.
[[nodiscard]] std::string joined_endpoints(const directory::EtcdOptions& etcd);

}  // namespace tandem::server
