#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/base/rng.h"
#include "common/transport/aead.h"
#include "common/transport/datagram.h"
#include "netsim/models/path_spec.h"
#include "proto/text/seat_setup.h"
#include "proto/wire/wire_codec.h"

namespace tandem::netsim {

/// Produces the hostile datagrams of one seat: replayed datagrams, random bytes and forged STATE messages. It models a
/// network attacker, a broken switch or a lying client; a lying client has its own keys.
class Attacker {
 public:
  /// @param seat  whose datagrams are attacked; `scene` says how many masters share authority
  Attacker(RandomKey key, const SceneSpec& scene, std::size_t seat)
      : key_(key),
        codec_(body_layout(seat_setup(scene, seat))),
        seat_index_(seat % kMastersMax),
        masters_(static_cast<std::uint32_t>(scene.masters())) {}

  /// Stores a datagram that passed; keeps the newest kRemembered of each direction.
  void remember(Direction direction, std::span<const std::byte> datagram) noexcept;
  /// Returns a random stored datagram; empty when there is none.
  [[nodiscard]] std::span<const std::byte> replayed(Direction direction) noexcept;
  /// Returns random bytes of random length. Every second result has a header with connection id `cid`.
  [[nodiscard]] std::span<const std::byte> random_bytes(std::uint32_t cid) noexcept;
  /// Sets the connection of the seat and its keys.
  void set_connection(std::uint32_t cid, const transport::ConnectionSecrets& secrets);
  /// Makes the energy account of a STATE run backwards, in place: well-formed, sealed, wrong. Other datagrams stay
  /// unchanged. Every second block of messages also claims that the user stopped the hand, although the hand stays
  /// engaged.
  /// @param cid  connection id at the server
  void forge_energy_account(std::uint32_t cid, std::span<std::byte> datagram) noexcept;
  /// Replaces a STATE by one that no client may send or no hand can produce, sealed with the client's own keys.
  /// Variants: absurd or non-finite positions, a truncated body, a request for all authority, the end of a stop.
  /// @param stops  number of the newest stop that the client received
  /// @return the datagram to send instead of `datagram`, in the same memory
  [[nodiscard]] std::span<const std::byte> forge_state(std::uint32_t cid, std::span<std::byte> datagram,
                                                       std::uint32_t stops) noexcept;

 private:
  static constexpr std::size_t kRemembered = 64;
  struct KeptDatagram {
    std::size_t size = 0;
    std::array<std::byte, transport::kDatagramMax> bytes{};
  };
  /// Decrypts a STATE to the server; nullopt for any other datagram.
  [[nodiscard]] std::optional<wire::Received<wire::StateMessage>> decrypt(std::uint32_t cid,
                                                                          std::span<const std::byte> datagram) noexcept;
  struct Keys {
    std::uint32_t cid;
    transport::Cipher cipher;
    transport::Secret secret;  ///< secret of the key phase that `seal` uses
    std::uint8_t phase;
    transport::Aead seal;
  };
  RandomKey key_;
  std::uint64_t draws_ = 0, forged_ = 0;
  wire::Codec codec_;
  std::size_t seat_index_;
  std::uint32_t masters_;
  std::array<std::array<KeptDatagram, kRemembered>, kDirections> kept_{};
  std::array<std::uint64_t, kDirections> count_{};
  std::array<std::byte, transport::kDatagramMax> random_bytes_{};
  std::optional<Keys> keys_;
};

}  // namespace tandem::netsim
