#include "common/transport/ratchet.h"

namespace tandem::transport {

SendKeys::SendKeys(const Secret& secret, Cipher cipher, const RekeyPolicy& rule)
    : rule_(rule), secret_(secret), cipher_(cipher), aead_(key_of(secret, cipher)) {}

void SendKeys::step(Time now) noexcept {
  secret_ = next_secret(secret_);
  aead_.rekey(key_of(secret_, cipher_));
  ++phase_;
  first_ = counter_;
  since_ = now;
  confirmed_ = false;
}

bool SendKeys::seal(Time now, wire::Type type, std::uint32_t cid, std::span<std::byte> datagram) noexcept {
  if (datagram.size() < kHeaderSize + kTagSize) return false;
  if (!began_) {
    began_ = true;
    since_ = now;
  }
  if (confirmed_ && (counter_ - first_ >= rule_.packets || now - since_ >= rule_.time)) step(now);
  if (counter_ - first_ >= rule_.hard_stop) return false;
  write_header({type, static_cast<std::uint8_t>(phase_ & 0xff), cid, counter_}, datagram.first<kHeaderSize>());
  return aead_.seal(counter_++, datagram);
}

ReceiveKeys::ReceiveKeys(const Secret& secret, Cipher cipher)
    : cipher_(cipher),
      after_next_(next_secret(next_secret(secret))),
      previous_(key_of(secret, cipher)),
      present_(previous_),
      next_(key_of(next_secret(secret), cipher)) {}

bool ReceiveKeys::open(Time now, const Header& header, std::span<const std::byte> datagram,
                       std::span<std::byte> plaintext) noexcept {
  const auto ahead = static_cast<std::uint8_t>(header.key_phase - static_cast<std::uint8_t>(phase_ & 0xff));
  if (ahead == 0) return present_.open(header.counter, datagram, plaintext);
  if (ahead == 0xff)
    return phase_ > 0 && now - advanced_ <= kPreviousKeyLifetime && previous_.open(header.counter, datagram, plaintext);
  if (ahead != 1 || !next_.open(header.counter, datagram, plaintext)) return false;
  previous_ = present_;
  present_ = next_;
  next_.rekey(key_of(after_next_, cipher_));
  after_next_ = next_secret(after_next_);
  ++phase_;
  advanced_ = now;
  return true;
}

}  // namespace tandem::transport
