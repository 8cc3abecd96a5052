#include "common/transport/aes_gcm.h"

/// Stub for processors that Intel's library does not support: connections use the other cipher (key_schedule.h,
/// `fastest_cipher`).
namespace tandem::transport {

bool AesGcm::available() { return false; }

void AesGcm::expand(const tandem::Secret<32>&) noexcept {}
void AesGcm::seal(const Nonce&, Header, std::span<std::byte> body, Tag) const noexcept { wipe(body); }
bool AesGcm::open(const Nonce&, Header, std::span<const std::byte>, std::span<const std::byte, kTagSize>,
                  std::span<std::byte>) const noexcept {
  return false;
}

}  // namespace tandem::transport
