#pragma once

#include <cstdint>
#include <span>

#include "common/base/time.h"
#include "common/link/seal.h"

namespace tandem::link {

/// When a sender takes the next key. Counters run on across keys, so a nonce never comes twice under one.
struct RekeyRule {
  std::uint64_t packets = std::uint64_t{1} << 20;      ///< under one key: 17.5 min at 1 kHz
  Duration time = std::chrono::minutes(15);
  std::uint64_t hard_stop = std::uint64_t{1} << 23;    ///< nothing is sealed beyond [limit of QUIC for AES-GCM, RFC 9001 6.6]
};

/// The sending half. Steps to the next key only after the peer echoed a counter of the present one: then the peer has it and holds
/// the next ready, and however long an outage was, both ends are at most one key apart.
class SendKeys {
 public:
  SendKeys(const Secret& secret, Cipher cipher, const RekeyRule& rule = {});

  /// Writes the header with phase and counter, seals. @return false: the key is used up, or there is no room.
  [[nodiscard]] bool seal(Time now, wire::Type type, std::uint32_t cid, std::span<std::byte> datagram) noexcept TANDEM_REALTIME;
  /// The peer used this counter of ours.
  void echoed(std::uint64_t counter) noexcept { confirmed_ = confirmed_ || (counter >= first_ && counter < counter_); }

  [[nodiscard]] std::uint64_t next_counter() const noexcept { return counter_; }
  [[nodiscard]] std::uint64_t phase() const noexcept { return phase_; }

 private:
  void step(Time now) noexcept;

  RekeyRule rule_;
  Secret secret_;
  Cipher cipher_;
  Seal seal_;
  std::uint64_t phase_ = 0, counter_ = 0;
  std::uint64_t first_ = 0;  ///< first counter under the present key
  Time since_{};
  bool began_ = false, confirmed_ = false;
};

/// The receiving half: the present key, the next one, and for a second the one before. Advances only on what authenticates.
class ReceiveKeys {
 public:
  ReceiveKeys(const Secret& secret, Cipher cipher);

  /// @param header  of `datagram`  @return whether the tag is right; `plaintext` holds the body then
  [[nodiscard]] bool open(Time now, const Header& header, std::span<const std::byte> datagram, std::span<std::byte> plaintext) noexcept
      TANDEM_REALTIME;
  [[nodiscard]] std::uint64_t phase() const noexcept { return phase_; }

 private:
  static constexpr Duration kKeepsPrevious = std::chrono::seconds(1);

  Cipher cipher_;
  Secret after_next_;  ///< of phase + 2
  Seal previous_, present_, next_;
  std::uint64_t phase_ = 0;
  Time advanced_{};
};

}  // namespace tandem::link
