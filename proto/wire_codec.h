#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "common/base/axes.h"
#include "proto/scene_spec.h"
#include "proto/wire.h"

/// Plaintext of a datagram: Preamble (16 bytes, little-endian), then one protobuf message of proto/wire.proto.
namespace tandem::wire {

/// Header and tag around a plaintext (design notes, security 1.4).
inline constexpr std::size_t kDatagramMax = 1200;
inline constexpr std::size_t kDatagramOverhead = 32;
inline constexpr std::size_t kPlaintextMax = kDatagramMax - kDatagramOverhead;
inline constexpr std::size_t kPreambleSize = 16;

namespace detail {
/// Bytes of the fields of a message whose tags are one byte (numbers 1-15) or two.
constexpr std::size_t packed(std::size_t count, std::size_t each) { return 2 + count * each; }
constexpr std::size_t scalar(std::size_t count, std::size_t tag, std::size_t each) { return count * (tag + each); }
}  // namespace detail

/// Exact plaintext sizes [bytes]; a plaintext of another size is refused before it is parsed.
constexpr std::size_t state_size(std::size_t axes) {
  return kPreambleSize + 3 * detail::packed(axes, 8)           // x v f
         + detail::packed(axes, 8)                             // e_in
         + detail::packed(axes, 4)                             // q
         + 3 * detail::packed(3, 4)                            // tip x f_cmd f_out
         + detail::packed(axes, 8)                             // e_out
         + detail::scalar(4, 1, 4)                             // energies
         + detail::scalar(2, 1, 4) + detail::scalar(3, 2, 4)  // gate, flags; counts
         + 1 + detail::packed(3, 4) + detail::scalar(4, 2, 4)  // f_env; penetration, link down
         + detail::scalar(1, 2, 4)                            // resume_stop
         + 1 + detail::packed(axes, 4);                       // a
}
inline constexpr std::size_t kContactBody = detail::scalar(4, 1, 4) + 2 * detail::packed(3, 4);
inline constexpr std::size_t kContactSize = detail::packed(kContactBody, 1);
constexpr std::size_t force_size(std::size_t axes) {
  return kPreambleSize + 4 * detail::packed(axes, 8) + detail::scalar(5, 1, 4) + detail::scalar(1, 1, 8) + detail::scalar(1, 1, 4);
}
/// Of a FORCE that says something of surfaces.
constexpr std::size_t force_size(std::size_t axes, std::size_t contacts) { return force_size(axes) + detail::scalar(1, 1, 4) + contacts * kContactSize; }
/// What a ghost adds to a FORCE.
inline constexpr std::size_t kGhostSize = detail::scalar(1, 1, 4) + detail::packed(3, 4) + 1 + detail::packed(3, 4);
inline constexpr std::size_t kPathSize = kPreambleSize + detail::scalar(1, 1, 8);
inline constexpr std::size_t kAuthoritySize = kPreambleSize + detail::scalar(3, 1, 4) + 3 + kMastersMax * 8;
inline constexpr std::size_t kCloseSize = kPreambleSize + detail::scalar(1, 1, 4);
inline constexpr std::size_t kPingSize = kPreambleSize;

static_assert(state_size(3) <= 400 && state_size(kAxesMax) + kDatagramOverhead <= kDatagramMax);
static_assert(force_size(kAxesMax, kLocalContactsMax) + kGhostSize + kDatagramOverhead <= kDatagramMax);

/// Why bytes were refused. One counter each at the receiver; never an exception, never a log line.
enum class DecodeError : std::uint8_t {
  kSize,        ///< not the exact size of (type, axes, contacts, ghost), or more than the maximum
  kMalformed,   ///< not the encoding of this message: wrong, unknown, repeated or missing fields
  kNotFinite,   ///< a NaN or infinity
  kOutOfRange,  ///< a magnitude, count or enumerator that cannot be meant
};

/// Largest magnitudes a port sample or telemetry may carry.
inline constexpr double kPositionMaxM = 10, kPositionMaxRad = 100, kVelocityMax = 100, kEffortMax = 1e4, kAccelerationMax = 1e5;
/// Largest cumulative energy [nJ]: 2^62 nJ are 4.6 GJ, so sums of two never wrap.
inline constexpr std::uint64_t kEnergyMax = std::uint64_t{1} << 62;

template <class Message>
struct Received {
  Preamble preamble;
  Message message;
};
template <class Message>
using Decoded = std::expected<Received<Message>, DecodeError>;

struct PingMessage {};

/// Encodes and decodes everything in proto/wire.h. Every body has a fixed layout: tags and lengths that differ from it are refused, the
/// values are copied. Nothing allocates. Decoding is total: any bytes give a message with finite numbers in range, or an error.
class Codec {
 public:
  /// @param axes  axes of the port, 1 ... kAxesMax; used by STATE and FORCE only
  /// @param port  decides the range of positions: metres or radians
  explicit Codec(std::size_t axes = kAxesMax, PortSpace port = PortSpace::kJoint) noexcept { configure(axes, port); }

  /// Changes axes and port, as a client does when joining tells it the scene's. No heap. @pre 1 <= axes <= kAxesMax
  void configure(std::size_t axes, PortSpace port) noexcept;
  [[nodiscard]] std::size_t axes() const noexcept { return axes_; }

  /// Each writes preamble and body to the front of `out`. @return bytes written; 0 if `out` is too small or the message
  /// has a length beyond its array. Numbers are written as they are: judging them is the receiver's duty.
  /// Unused axes are not sent. AUTHORITY carries kMastersMax weights, those from `masters` on as 0.
  [[nodiscard]] std::size_t encode(const Preamble&, const StateMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const ForceMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const PathMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const AuthorityMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const CloseMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const PingMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;

  [[nodiscard]] Decoded<StateMessage> decode_state(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  /// The same without a copy: writes every number of a message into `out`, but axes that this codec does not use, which stay as they are.
  /// After an error `out` holds anything.
  [[nodiscard]] std::expected<Preamble, DecodeError> decode_state(std::span<const std::byte> plaintext, StateMessage& out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<ForceMessage> decode_force(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<PathMessage> decode_path(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  /// Weights are in [0, 1] and sum to 1 within 1e-9.
  [[nodiscard]] Decoded<AuthorityMessage> decode_authority(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<CloseMessage> decode_close(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<PingMessage> decode_ping(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;

 private:
  std::size_t axes_ = kAxesMax;
  double position_max_ = 0;  ///< of a port sample [m] or [rad]
  std::size_t contacts_max_ = 0;  ///< in a FORCE
};

}  // namespace tandem::wire
