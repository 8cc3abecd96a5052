#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/base/rng.h"
#include "common/link/datagram.h"
#include "common/link/seal.h"
#include "netsim/path_spec.h"
#include "proto/wire_codec.h"

namespace tandem::netsim {

/// What an attacker, a broken switch or a lying client makes of one seat's datagrams: old ones once more, random bytes,
/// accounts that run backwards. The liar is the client himself, so he has its keys.
class WorldTamper {
 public:
  /// @param seat, masters  whose datagrams, and how many share authority
  WorldTamper(RandomKey key, const SceneSpec& scene, std::size_t seat)
      : key_(key), codec_(scene.dof, scene.port), own_(seat % kMastersMax), masters_(static_cast<std::uint32_t>(scene.masters())) {}

  /// Remembers a datagram that passed; the last kRemembered of each direction.
  void remember(Direction direction, std::span<const std::byte> datagram) noexcept;
  /// One of those remembered; empty when there is none.
  [[nodiscard]] std::span<const std::byte> again(Direction direction) noexcept;
  /// Random bytes of random length, every other one with a header that names `cid`.
  [[nodiscard]] std::span<const std::byte> junk(std::uint32_t cid) noexcept;
  /// The seat has a connection.
  void joined(std::uint32_t cid, const link::ConnectionSecrets& secrets);
  /// Turns the energy account of a STATE back, in place: well-formed, sealed, wrong. Other datagrams stay as they are. Now and then it
  /// also says that its person stopped his hand, and that this is engaged all the same.
  /// @param cid  connection at the server
  void lie(std::uint32_t cid, std::span<std::byte> datagram) noexcept;
  /// Makes of a STATE something nobody may send or no hand can be, sealed as the client's own: positions that are absurd or no
  /// numbers, a cut, another type, a wish for all authority or to end a stop. @param stops  the newest stop that the client was told of
  /// @return what goes out instead of `datagram`, in its place
  [[nodiscard]] std::span<const std::byte> attack(std::uint32_t cid, std::span<std::byte> datagram, std::uint32_t stops) noexcept;

 private:
  static constexpr std::size_t kRemembered = 64;
  struct Kept {
    std::size_t size = 0;
    std::array<std::byte, link::kDatagramMax> bytes{};
  };
  /// The plaintext of a STATE to the server, or nothing. @param plain  for it
  [[nodiscard]] std::optional<wire::Received<wire::StateMessage>> opened(std::uint32_t cid, std::span<const std::byte> datagram) noexcept;
  struct Keys {
    std::uint32_t cid;
    link::Cipher cipher;
    link::Secret secret;  ///< of the phase `seal` has
    std::uint8_t phase;
    link::Seal seal;
  };
  RandomKey key_;
  std::uint64_t draws_ = 0, lies_ = 0;
  wire::Codec codec_;
  std::size_t own_;
  std::uint32_t masters_;
  std::array<std::array<Kept, kRemembered>, kDirections> kept_{};
  std::array<std::uint64_t, kDirections> count_{};
  std::array<std::byte, link::kDatagramMax> junk_{};
  std::optional<Keys> keys_;
};

}  // namespace tandem::netsim
