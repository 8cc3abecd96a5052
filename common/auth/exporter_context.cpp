#include "common/auth/exporter_context.h"

#include <algorithm>

#include "common/auth/key_fingerprint.h"
#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"

namespace tandem::auth {

std::array<std::byte, 32> digest_of(const ExporterContext& c) noexcept {
  std::array<std::byte, 16 + 8 + 4 + 1 + 1> head;
  std::ranges::copy(c.session_id, head.begin());
  for (std::size_t i = 0; i < 8; ++i) head[16 + i] = static_cast<std::byte>(c.epoch >> (8 * i) & 0xffU);
  for (std::size_t i = 0; i < 4; ++i) head[24 + i] = static_cast<std::byte>(c.server_cid >> (8 * i) & 0xffU);
  const std::string_view seat = c.seat.substr(0, 255);
  head[28] = static_cast<std::byte>(c.role);
  head[29] = static_cast<std::byte>(seat.size());
  return transport::sha256(head, bytes_of(seat));
}

}  // namespace tandem::auth
