#pragma once

#include <algorithm>
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
inline constexpr std::size_t kContactSize = 1 + detail::packed(kContactBody, 1);
constexpr std::size_t force_size(std::size_t axes) {
  return kPreambleSize + 4 * detail::packed(axes, 8) + detail::scalar(5, 1, 4) + detail::scalar(1, 1, 8) + detail::scalar(1, 1, 4);
}
/// Of a FORCE that says something of surfaces, or of further ties.
constexpr std::size_t force_size(std::size_t axes, std::size_t contacts) { return force_size(axes) + detail::scalar(1, 1, 4) + contacts * kContactSize; }
/// What a ghost adds to a FORCE.
inline constexpr std::size_t kGhostSize = detail::scalar(1, 1, 4) + detail::packed(3, 4) + 1 + detail::packed(3, 4);
/// What a hand that is tied to several tools says, and is told, of each beyond the first; up to 3 axes.
constexpr std::size_t tie_state_body(std::size_t axes) { return 2 * detail::packed(axes, 8) + 3 * detail::packed(axes, 4); }
constexpr std::size_t tie_state_size(std::size_t axes) { return 1 + detail::packed(tie_state_body(axes), 1); }
constexpr std::size_t tie_force_body(std::size_t axes) { return 2 * detail::packed(axes, 8) + 2 * detail::packed(axes, 4) + detail::scalar(2, 1, 4); }
constexpr std::size_t tie_force_size(std::size_t axes) { return detail::packed(tie_force_body(axes), 1); }
/// Of all ties, that one FORCE has room for.
constexpr std::size_t contacts_room(std::size_t axes, std::size_t further) {
  return std::min(kLocalContactsMax * (1 + further), (kPlaintextMax - force_size(axes, 0) - kGhostSize - further * tie_force_size(axes)) / kContactSize);
}
inline constexpr std::size_t kPathSize = kPreambleSize + detail::scalar(1, 1, 8);
inline constexpr std::size_t kAuthoritySize = kPreambleSize + detail::scalar(3, 1, 4) + 3 + kMastersMax * 8;
inline constexpr std::size_t kCloseSize = kPreambleSize + detail::scalar(1, 1, 4);
inline constexpr std::size_t kPingSize = kPreambleSize;

static_assert(state_size(3) <= 400 && state_size(kAxesMax) + kDatagramOverhead <= kDatagramMax);
static_assert(force_size(kAxesMax, kLocalContactsMax) + kGhostSize + kDatagramOverhead <= kDatagramMax);
static_assert(state_size(3) + kFurtherTiesMax * tie_state_size(3) <= kPlaintextMax && contacts_room(3, kFurtherTiesMax) >= kLocalContactsMax);

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

/// STATE and FORCE of a hand that is tied to several tools.
struct StateWithTies {
  const StateMessage& message;
  std::span<const PortSample> further;
};
struct ForceWithTies {
  const ForceMessage& message;
  std::span<const TieForce> further;
};

/// Encodes and decodes everything in proto/wire.h. Every body has a fixed layout: tags and lengths that differ from it are refused, the
/// values are copied. Nothing allocates. Decoding is total: any bytes give a message with finite numbers in range, or an error.
class Codec {
 public:
  /// @param axes  axes of the port, 1 ... kAxesMax; used by STATE and FORCE only
  /// @param port  decides the range of positions: metres or radians
  explicit Codec(std::size_t axes = kAxesMax, PortSpace port = PortSpace::kJoint, std::size_t further = 0) noexcept { configure(axes, port, further); }

  /// Changes axes and port, as a client does when joining tells it the scene's. No heap. @pre 1 <= axes <= kAxesMax
  /// @param further  ties of the hand beyond the first, up to kFurtherTiesMax; only with a TIP port of up to 3 axes
  void configure(std::size_t axes, PortSpace port, std::size_t further = 0) noexcept;
  [[nodiscard]] std::size_t further() const noexcept { return further_; }
  [[nodiscard]] std::size_t axes() const noexcept { return axes_; }

  /// Each writes preamble and body to the front of `out`. @return bytes written; 0 if `out` is too small or the message
  /// has a length beyond its array. Numbers are written as they are: judging them is the receiver's duty.
  /// Unused axes are not sent. AUTHORITY carries kMastersMax weights, those from `masters` on as 0.
  [[nodiscard]] std::size_t encode(const Preamble&, const StateMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const ForceMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  /// @return 0 also where the ties are not as many as configured; of contacts, where they are more than `contacts_room`
  [[nodiscard]] std::size_t encode(const Preamble&, const StateWithTies&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const ForceWithTies&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const PathMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const AuthorityMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const CloseMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const PingMessage&, std::span<std::byte> out) const noexcept TANDEM_REALTIME;

  [[nodiscard]] Decoded<StateMessage> decode_state(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  /// The same without a copy: writes every number of a message into `out`, but axes that this codec does not use, which stay as they are.
  /// After an error `out` holds anything.
  [[nodiscard]] std::expected<Preamble, DecodeError> decode_state(std::span<const std::byte> plaintext, StateMessage& out) const noexcept TANDEM_REALTIME;
  /// @param further  written by a codec for several ties, as many as it is configured for; after an error it holds anything
  [[nodiscard]] std::expected<Preamble, DecodeError> decode_state(std::span<const std::byte> plaintext, StateMessage& out, std::span<PortSample> further) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<ForceMessage> decode_force(std::span<const std::byte> plaintext, std::span<TieForce> further = {}) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<PathMessage> decode_path(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  /// Weights are in [0, 1] and sum to 1 within 1e-9.
  [[nodiscard]] Decoded<AuthorityMessage> decode_authority(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<CloseMessage> decode_close(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<PingMessage> decode_ping(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;

 private:
  std::size_t axes_ = kAxesMax;
  double position_max_ = 0;  ///< of a port sample [m] or [rad]
  std::size_t contacts_max_ = 0;  ///< in a FORCE
  std::size_t further_ = 0;
};

}  // namespace tandem::wire
