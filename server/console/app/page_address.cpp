#include "server/console/app/page_address.h"

#include <cstdio>
#include <utility>

namespace tandem::console {
namespace {

/// Certificate and key as given; nothing, and perhaps an error, without them.
std::optional<TlsFiles> tls_of(const PageAddressArguments& arguments, const io::SocketAddress& listen,
                               io::UsageErrors& errors) {
  if (arguments.certificate.empty() != arguments.key.empty()) {
    errors.add("--certificate and --key belong together; the other one is missing");
    return std::nullopt;
  }
  if (arguments.certificate.empty()) {
    if (!listen.loopback())
      errors.add("--listen: " + arguments.listen +
                 " is reachable by other computers, which needs TLS; give --certificate FILE and --key FILE, or "
                 "listen on 127.0.0.1 or [::1]");
    return std::nullopt;
  }
  auto files = TlsFiles::load(arguments.certificate, arguments.key);
  if (files) return std::move(*files);
  errors.add(files.error());
  return std::nullopt;
}

}  // namespace

void add_page_address_options(const io::Command& command, PageAddressArguments& arguments) {
  command
      .add_option("--listen", arguments.listen,
                  "address of the page; port 0: a free one; default 127.0.0.1:7080. Beyond loopback it needs TLS")
      .value_name("HOST:PORT");
  command.add_option("--certificate", arguments.certificate, "TLS certificate of the page, a chain in PEM format")
      .value_name("FILE");
  command.add_option("--key", arguments.key, "private key of the certificate, in PEM format without a password")
      .value_name("FILE");
}

PageAddress page_address_of(const PageAddressArguments& arguments, io::UsageErrors& errors) {
  PageAddress out;
  const auto listen = io::parse_address(arguments.listen, 0);
  if (!listen) {
    errors.add("--listen", listen.error());
    return out;
  }
  out.listen = *listen;
  out.tls = tls_of(arguments, *listen, errors);
  return out;
}

void print_page_url(const std::string& url, const std::string& token) {
  if (token.empty()) {
    std::printf("sign in with a ticket: %sjoin\n", url.c_str());
  } else {
    std::printf("open within 10 minutes, once: %s?token=%s\n", url.c_str(), token.c_str());
  }
  std::fflush(stdout);
}

}  // namespace tandem::console
