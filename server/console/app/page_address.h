#pragma once

#include <optional>
#include <string>

#include "common/io/command_line.h"
#include "common/io/socket_address.h"
#include "common/io/usage_errors.h"
#include "server/console/app/tls_files.h"

namespace tandem::console {

/// Options of every command that serves the page.
struct PageAddressArguments {
  std::string listen = "127.0.0.1:7080", certificate, key;
};
void add_page_address_options(const io::Command& command, PageAddressArguments& arguments);

/// Where the page is served. `listen` is valid if no error was added.
struct PageAddress {
  io::SocketAddress listen{};
  std::optional<TlsFiles> tls{};  ///< empty: plain HTTP, on loopback only
};
[[nodiscard]] PageAddress page_address_of(const PageAddressArguments& arguments, io::UsageErrors& errors);

/// Prints the URL of the page. @param token  valid once; empty: persons sign in with tickets
void print_page_url(const std::string& url, const std::string& token);

}  // namespace tandem::console
