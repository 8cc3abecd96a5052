#include "server/directory/io/etcd_options.h"

#include <charconv>

#include "common/base/format.h"

namespace tandem::directory {

namespace {

constexpr std::size_t kEndpointsMax = 9;

bool valid_endpoint(const std::string& endpoint) {
  const std::size_t colon = endpoint.rfind(':');
  if (colon == std::string::npos || colon == 0) return false;
  unsigned port = 0;
  const char* const end = endpoint.data() + endpoint.size();
  const auto [rest, error] = std::from_chars(endpoint.data() + colon + 1, end, port);
  return error == std::errc{} && rest == end && port > 0 && port < 65536 &&
         endpoint.find_first_of("/, ") == std::string::npos;
}

}  // namespace

std::optional<std::string> EtcdOptions::problem() const {
  if (endpoints.empty() || endpoints.size() > kEndpointsMax)
    return format("endpoints: %zu given, 1 to %zu are allowed", endpoints.size(), kEndpointsMax);
  for (const std::string& endpoint : endpoints)
    if (!valid_endpoint(endpoint)) return "endpoints: '" + endpoint + "' is not HOST:PORT";
  if (authority.empty() != certificate.empty() || authority.empty() != key.empty())
    return "certificates: give the authority, the certificate and its key, or none of them";
  if (answer_limit <= Duration{} || answer_limit > std::chrono::seconds(60))
    return format("answer_limit: %g s is not in (0, 60] s", seconds(answer_limit));
  return std::nullopt;
}

}  // namespace tandem::directory
