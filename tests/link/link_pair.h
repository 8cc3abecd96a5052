#pragma once

#include <cstdint>

#include "common/base/rng.h"
#include "common/link/link.h"

namespace tandem::link::test {

/// Secrets that are always the same for the same number.
inline ConnectionSecrets secrets(std::uint64_t number, Cipher cipher = fastest_cipher()) {
  ConnectionSecrets s;
  s.cipher = cipher;
  RandomStream random{RandomKey{number}.derive(77)};
  for (auto* secret : {&s.to_server, &s.to_client})
    for (std::byte& b : secret->bytes) b = static_cast<std::byte>(random.below(256));
  return s;
}

inline Link::Params client_end(std::uint64_t number = 1, RekeyRule rekey = {}) {
  return {.outgoing = Direction::kToServer, .own_cid = 11, .peer_cid = 22, .secrets = secrets(number), .rekey = rekey};
}
inline Link::Params server_end(std::uint64_t number = 1, RekeyRule rekey = {}) {
  return {.outgoing = Direction::kToClient, .own_cid = 22, .peer_cid = 11, .secrets = secrets(number), .rekey = rekey};
}

/// Client and server of one connection.
struct Pair {
  Link client{client_end()};
  Link server{server_end()};
};

}  // namespace tandem::link::test
