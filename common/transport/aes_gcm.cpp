#include "common/transport/aes_gcm.h"

#include <intel-ipsec-mb.h>
#include <sodium.h>

#include <atomic>
#include <cstring>

#include "common/base/raw_bytes.h"

namespace tandem::transport {

namespace {

constexpr std::size_t kLeftBehind = 4096;  ///< [bytes] of stack to wipe: more than any function of the library uses

static_assert(sizeof(gcm_key_data) <= 1024 && alignof(gcm_key_data) <= 64);
gcm_key_data* key_data(std::byte* p) noexcept { return reinterpret_cast<gcm_key_data*>(p); }
const gcm_key_data* key_data(const std::byte* p) noexcept { return reinterpret_cast<const gcm_key_data*>(p); }

const IMB_MGR* choose_code() {
  IMB_MGR* const manager = alloc_mb_mgr(0);
  if (manager == nullptr) return nullptr;
  init_mb_mgr_auto(manager, nullptr);
  constexpr std::uint64_t kNeeded = IMB_FEATURE_AESNI | IMB_FEATURE_PCLMULQDQ | IMB_FEATURE_SELF_TEST_PASS;
  if (imb_get_errno(manager) == 0 && (manager->features & kNeeded) == kNeeded) return manager;
  free_mb_mgr(manager);
  return nullptr;
}
/// The code for this processor; null if none suits, or before the first `available`. Callers only read it, so all
/// threads share one.
std::atomic<const IMB_MGR*> chosen_code{nullptr};
const IMB_MGR* code() noexcept { return chosen_code.load(std::memory_order_acquire); }

using TagBytes = std::array<std::byte, kTagSize>;
/// Compares in constant time.
bool equal(std::span<const std::byte, kTagSize> a, const TagBytes& b) noexcept {
  std::array<std::uint64_t, 2> x, y;
  static_assert(sizeof x == kTagSize);
  std::memcpy(x.data(), a.data(), sizeof x);
  std::memcpy(y.data(), b.data(), sizeof y);
  return ((x[0] ^ y[0]) | (x[1] ^ y[1])) == 0;
}

}  // namespace

bool AesGcm::available() {
  static const IMB_MGR* const chosen = choose_code();
  chosen_code.store(chosen, std::memory_order_release);
  return chosen != nullptr;
}

void AesGcm::expand(const tandem::Secret<32>& key) noexcept {
  IMB_AES256_GCM_PRE(code(), raw(key.bytes.data()), key_data(expanded_.data()));
  sodium_stackzero(kLeftBehind);  // the library leaves parts of the key there
}

void AesGcm::seal(const Nonce& nonce, Header header, std::span<std::byte> body, Tag tag) const noexcept {
  gcm_context_data context;
  IMB_AES256_GCM_ENC(code(), key_data(expanded_.data()), &context, raw(body.data()), raw(body.data()), body.size(),
                     raw(nonce.data()), raw(header.data()), header.size(), raw(tag.data()), tag.size());
}

bool AesGcm::open(const Nonce& nonce, Header header, std::span<const std::byte> body,
                  std::span<const std::byte, kTagSize> tag, std::span<std::byte> plaintext) const noexcept {
  gcm_context_data context;
  TagBytes found;
  IMB_AES256_GCM_DEC(code(), key_data(expanded_.data()), &context, raw(plaintext.data()), raw(body.data()), body.size(),
                     raw(nonce.data()), raw(header.data()), header.size(), raw(found.data()), found.size());
  if (equal(tag, found)) [[likely]]
    return true;
  wipe(plaintext);  // decryption and check are one pass, so the unauthenticated plaintext must be wiped
  return false;
}

}  // namespace tandem::transport
