#pragma once

#include <cstdint>
#include <span>

#include "common/base/time.h"
#include "common/transport/aead.h"

namespace tandem::transport {

/// Conditions under which a sender takes the next key. Counters continue across keys, so a nonce never repeats under a
/// key.
struct RekeyPolicy {
  std::uint64_t packets = std::uint64_t{1} << 20;  ///< under one key: 17.5 min at 1 kHz
  Duration time = std::chrono::minutes(15);
  std::uint64_t hard_stop = std::uint64_t{1}
                            << 23;  ///< a key seals at most this many [limit of QUIC for AES-GCM, RFC 9001 6.6]
};

/// The sending half. It takes the next key only after the peer echoed a counter of the present one. The peer then has
/// the present key and holds the next one ready. Both ends are therefore at most one key apart, for any duration of an
/// outage.
class SendKeys {
 public:
  SendKeys(const Secret& secret, Cipher cipher, const RekeyPolicy& rule = {});

  /// Writes the header with phase and counter, and seals. @return false if the key is used up or the datagram is too
  /// small.
  [[nodiscard]] bool seal(Time now, wire::Type type, std::uint32_t cid,
                          std::span<std::byte> datagram) noexcept TANDEM_REALTIME;
  /// Records that the peer used this counter of this end.
  void echoed(std::uint64_t counter) noexcept { confirmed_ = confirmed_ || (counter >= first_ && counter < counter_); }

  [[nodiscard]] std::uint64_t next_counter() const noexcept { return counter_; }
  [[nodiscard]] std::uint64_t phase() const noexcept { return phase_; }

 private:
  void step(Time now) noexcept;

  RekeyPolicy rule_;
  Secret secret_;
  Cipher cipher_;
  Aead aead_;
  std::uint64_t phase_ = 0, counter_ = 0;
  std::uint64_t first_ = 0;  ///< first counter under the present key
  Time since_{};
  bool began_ = false, confirmed_ = false;
};

/// The receiving half: holds the present key, the next one and, for one second, the previous one. It advances only on
/// authenticated datagrams.
class ReceiveKeys {
 public:
  ReceiveKeys(const Secret& secret, Cipher cipher);

  /// Opens a datagram.
  /// @param header  of `datagram`  @return whether the tag is right; `plaintext` then holds the body
  [[nodiscard]] bool open(Time now, const Header& header, std::span<const std::byte> datagram,
                          std::span<std::byte> plaintext) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::uint64_t phase() const noexcept { return phase_; }

 private:
  static constexpr Duration kPreviousKeyLifetime = std::chrono::seconds(1);

  Cipher cipher_;
  Secret after_next_;  ///< of phase + 2
  Aead previous_, present_, next_;
  std::uint64_t phase_ = 0;
  Time advanced_{};
};

}  // namespace tandem::transport
