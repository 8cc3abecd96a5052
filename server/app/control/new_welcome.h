#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/auth/ticket.h"
#include "common/transport/secure_channel.h"
#include "server/app/control/session_entry.h"
#include "server/session/connection_id.h"

namespace tandem::server {

/// Returns a Welcome with fresh connection id and resume secret. @param place  in the connection id
[[nodiscard]] inline rpc::Welcome make_welcome(const SessionEntry& entry, std::uint8_t place, AccessRole role,
                                               bool has_aes, const std::string& seat = {},
                                               std::vector<std::byte> setup = {}, std::string person = {}) {
  const SessionRegistration& session = entry.registration;
  const auto drawn = auth::random_bytes<std::array<std::byte, 2>>();
  const bool aes = has_aes && transport::fastest_cipher() == transport::Cipher::kAes256Gcm;
  return {.session_id = session.id,
          .session_name = session.name,
          .epoch = session.epoch,
          .server_cid = connection_id(static_cast<std::uint16_t>(std::to_integer<unsigned>(drawn[0]) << 8 |
                                                                 std::to_integer<unsigned>(drawn[1])),
                                      entry.session().slot(), place),
          .cipher = aes ? rpc::Cipher::kAes256Gcm : rpc::Cipher::kChaCha20Poly1305,
          .seat = seat,
          .role = role,
          .setup = std::move(setup),
          .udp_port = session.shard->address().port(),
          .resume_secret = Secret<32>{auth::random_bytes<std::array<std::byte, 32>>()},
          .limits = {},
          .person = std::move(person)};
}

}  // namespace tandem::server
