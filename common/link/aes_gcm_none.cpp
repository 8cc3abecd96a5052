#include "common/link/aes_gcm.h"

/// For processors Intel's library is not made for: connections are sealed with the other cipher (key_schedule.h, `fastest_cipher`).
namespace tandem::link {

bool AesGcm::available() { return false; }

void AesGcm::expand(const tandem::Secret<32>&) noexcept {}
void AesGcm::seal(const Nonce&, Header, std::span<std::byte> body, Tag) const noexcept { wipe(body); }
bool AesGcm::open(const Nonce&, Header, std::span<const std::byte>, std::span<const std::byte, kTagSize>,
                  std::span<std::byte>) const noexcept {
  return false;
}

}  // namespace tandem::link
