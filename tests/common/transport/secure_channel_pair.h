#pragma once

#include <cstdint>

#include "common/base/rng.h"
#include "common/transport/secure_channel.h"

namespace tandem::transport::test {

/// Returns secrets that depend on `number` only.
inline ConnectionSecrets secrets(std::uint64_t number, Cipher cipher = fastest_cipher()) {
  ConnectionSecrets s;
  s.cipher = cipher;
  RandomStream random{RandomKey{number}.derive(77)};
  for (auto* secret : {&s.to_server, &s.to_client})
    for (std::byte& b : secret->bytes) b = static_cast<std::byte>(random.below(256));
  return s;
}

inline SecureChannel::Params client_end(std::uint64_t number = 1, RekeyPolicy rekey = {}) {
  return {.outgoing = Direction::kToServer, .own_cid = 11, .peer_cid = 22, .secrets = secrets(number), .rekey = rekey};
}
inline SecureChannel::Params server_end(std::uint64_t number = 1, RekeyPolicy rekey = {}) {
  return {.outgoing = Direction::kToClient, .own_cid = 22, .peer_cid = 11, .secrets = secrets(number), .rekey = rekey};
}

/// Client end and server end of one connection.
struct Pair {
  SecureChannel client{client_end()};
  SecureChannel server{server_end()};
};

}  // namespace tandem::transport::test
