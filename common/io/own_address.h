#pragma once

#include <string>

#include "common/io/socket_address.h"

namespace tandem::io {

/// `HOST:PORT` that people type to reach what listens at `at`. For an address that cannot be dialled (0.0.0.0, [::]) it is the one by which this
/// machine reaches other networks, else any address of it that others may reach, else loopback. A machine with several networks has others
/// beside it.
[[nodiscard]] std::string dialable(const SocketAddress& at);
/// The same of an address as text; what is no address stays as it is.
[[nodiscard]] std::string dialable(const std::string& at);

}  // namespace tandem::io
