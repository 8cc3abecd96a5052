#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/auth/io/server_keystore.h"
#include "common/io/socket_address.h"
#include "proto/spec/server_config_spec.h"
#include "server/app/service/service_options.h"

namespace tandem::server {

/// Options of a member of a service, with the certificates read. Adds all mistakes to `errors`.
/// @param listen  address of the control connections; nullopt: it is wrong, and reported already
/// @param path    path of a file that the configuration names
[[nodiscard]] std::optional<ServiceOptions> service_options_from(
    const ServerConfigSpec& config, const std::optional<io::SocketAddress>& listen,
    const std::function<std::string(const std::string&)>& path, InputErrors& errors);

/// Why a server with these keys cannot be the member that `options` state, with the remedy; empty: it can.
[[nodiscard]] std::string membership_error(const ServiceOptions& options, const auth::ServerKeystore& keys);

/// Warning for the operator from 30 days before the voucher expires on: date and the commands to run. Empty before.
/// @param server  key of this server  @param now  seconds since 1970, UTC
[[nodiscard]] std::string voucher_warning(const auth::ServiceMembership& membership, const auth::KeyFingerprint& server,
                                          std::int64_t now);

}  // namespace tandem::server
