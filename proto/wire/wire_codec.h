#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "common/base/axes.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/wire_messages.h"

/// Codec of a datagram's plaintext: Preamble (16 bytes, little-endian), then one protobuf message of
/// proto/schema/wire.proto.
namespace tandem::wire {

/// Largest datagram, and size of header and tag around a plaintext [bytes] (common/transport/FORMAT.md).
inline constexpr std::size_t kDatagramMax = 1200;
inline constexpr std::size_t kDatagramOverhead = 32;
inline constexpr std::size_t kPlaintextMax = kDatagramMax - kDatagramOverhead;
inline constexpr std::size_t kPreambleSize = 16;

namespace detail {
/// Encoded size of packed fields and of scalar fields [bytes]. Tags take one byte (field numbers 1-15) or two.
constexpr std::size_t packed(std::size_t count, std::size_t each) { return 2 + count * each; }
constexpr std::size_t scalar(std::size_t count, std::size_t tag, std::size_t each) { return count * (tag + each); }
}  // namespace detail

/// Exact plaintext sizes [bytes]. The codec rejects a plaintext of another size before it parses.
constexpr std::size_t state_size(std::size_t axes) {
  return kPreambleSize + 3 * detail::packed(axes, 8)           // x v f
         + detail::packed(axes, 8)                             // e_in
         + detail::packed(axes, 4)                             // q
         + 3 * detail::packed(3, 4)                            // tip x f_cmd f_out
         + detail::packed(axes, 8)                             // e_out
         + detail::scalar(4, 1, 4)                             // energies
         + detail::scalar(2, 1, 4) + detail::scalar(3, 2, 4)   // gate, flags; counts
         + 1 + detail::packed(3, 4) + detail::scalar(4, 2, 4)  // f_env; penetration, link down
         + detail::scalar(1, 2, 4)                             // resume_stop
         + 1 + detail::packed(axes, 4);                        // a
}
inline constexpr std::size_t kContactBody = detail::scalar(4, 1, 4) + 2 * detail::packed(3, 4);
inline constexpr std::size_t kContactSize = 1 + detail::packed(kContactBody, 1);
constexpr std::size_t force_size(std::size_t axes) {
  return kPreambleSize + 4 * detail::packed(axes, 8) + detail::scalar(5, 1, 4) + detail::scalar(1, 1, 8) +
         detail::scalar(1, 1, 4);
}
/// Size of a FORCE with `surfaces` or with further tools.
constexpr std::size_t force_size(std::size_t axes, std::size_t contacts) {
  return force_size(axes) + detail::scalar(1, 1, 4) + contacts * kContactSize;
}
/// Size that a ghost adds to a FORCE.
inline constexpr std::size_t kGhostSize = detail::scalar(1, 1, 4) + detail::packed(3, 4) + 1 + detail::packed(3, 4);
/// Sizes per coupled tool beyond the first, in STATE and FORCE; up to 3 axes.
constexpr std::size_t tool_state_body(std::size_t axes) {
  return 2 * detail::packed(axes, 8) + 3 * detail::packed(axes, 4);
}
constexpr std::size_t tool_state_size(std::size_t axes) { return 1 + detail::packed(tool_state_body(axes), 1); }
constexpr std::size_t tool_force_body(std::size_t axes) {
  return 2 * detail::packed(axes, 8) + 2 * detail::packed(axes, 4) + detail::scalar(2, 1, 4);
}
constexpr std::size_t tool_force_size(std::size_t axes) { return detail::packed(tool_force_body(axes), 1); }
/// Largest number of contacts, over all tools, in one FORCE.
constexpr std::size_t contacts_room(std::size_t axes, std::size_t further) {
  return std::min(kLocalContactsMax * (1 + further),
                  (kPlaintextMax - force_size(axes, 0) - kGhostSize - further * tool_force_size(axes)) / kContactSize);
}
inline constexpr std::size_t kPathSize = kPreambleSize + detail::scalar(1, 1, 8);
inline constexpr std::size_t kAuthoritySize = kPreambleSize + detail::scalar(3, 1, 4) + 3 + kMastersMax * 8;
inline constexpr std::size_t kCloseSize = kPreambleSize + detail::scalar(1, 1, 4);
inline constexpr std::size_t kPingSize = kPreambleSize;

static_assert(state_size(3) <= 400 && state_size(kAxesMax) + kDatagramOverhead <= kDatagramMax);
static_assert(force_size(kAxesMax, kLocalContactsMax) + kGhostSize + kDatagramOverhead <= kDatagramMax);
static_assert(state_size(3) + kFurtherToolsMax * tool_state_size(3) <= kPlaintextMax &&
              contacts_room(3, kFurtherToolsMax) >= kLocalContactsMax);

/// Reason for rejecting bytes. The receiver has one counter per reason; no exceptions, no log lines.
enum class DecodeError : std::uint8_t {
  kSize,        ///< not the exact size of (type, axes, contacts, ghost), or more than the maximum
  kMalformed,   ///< not the encoding of this message: unknown, repeated, missing or malformed fields
  kNotFinite,   ///< a NaN or infinity
  kOutOfRange,  ///< an implausible magnitude, count or enumerator
};

/// Largest magnitudes of a port sample or of telemetry.
inline constexpr double kPositionMaxM = 10, kPositionMaxRad = 100, kVelocityMax = 100, kEffortMax = 1e4,
                        kAccelerationMax = 1e5;
/// Largest cumulative energy [nJ]: 2^62 nJ is 4.6 GJ, so a sum of two never wraps.
inline constexpr std::uint64_t kEnergyMax = std::uint64_t{1} << 62;

template <class Message>
struct Received {
  Preamble preamble;
  Message message;
};
template <class Message>
using Decoded = std::expected<Received<Message>, DecodeError>;

struct PingMessage {};

/// STATE and FORCE of a seat that is coupled to several tools.
struct StateWithTools {
  const StateMessage& message;
  std::span<const PortSample> further;
};
struct ForceWithTools {
  const ForceMessage& message;
  std::span<const ToolForce> further;
};

/// Encodes and decodes the messages of proto/wire/wire_messages.h. Every body has a fixed layout: the codec rejects
/// other tags and lengths and copies the values. It never allocates. Decoding is total: any input gives a message with
/// finite numbers in range, or an error.
class Codec {
 public:
  /// @param axes  axes of the port, 1 ... kAxesMax; used by STATE and FORCE only
  /// @param port  decides the range of positions: metres or radians
  explicit Codec(std::size_t axes = kAxesMax, PortSpace port = PortSpace::kJoint, std::size_t further = 0) noexcept {
    configure(axes, port, further);
  }

  /// Changes axes and port. A client calls it with the scene's values after joining. No heap.
  /// @pre 1 <= axes <= kAxesMax
  /// @param further  coupled tools beyond the first, up to kFurtherToolsMax; only with a TIP port of up to 3 axes
  void configure(std::size_t axes, PortSpace port, std::size_t further = 0) noexcept;
  [[nodiscard]] std::size_t further() const noexcept { return further_; }
  [[nodiscard]] std::size_t axes() const noexcept { return axes_; }

  /// Writes preamble and body to the front of `out`. @return bytes written; 0 if `out` is too small or the message has
  /// a length beyond its array. Values are written unchecked; the receiver checks them. Unused axes are not sent.
  /// AUTHORITY carries kMastersMax values, 0 from `masters` on.
  [[nodiscard]] std::size_t encode(const Preamble&, const StateMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const ForceMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  /// @return 0 also if the number of further tools is not as configured, or if contacts exceed `contacts_room`
  [[nodiscard]] std::size_t encode(const Preamble&, const StateWithTools&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const ForceWithTools&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const PathMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const AuthorityMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const CloseMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const PingMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;

  [[nodiscard]] Decoded<StateMessage> decode_state(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  /// The same without a copy: writes every value of the message into `out`. Axes that this codec does not use keep
  /// their value. After an error the contents of `out` are unspecified.
  [[nodiscard]] std::expected<Preamble, DecodeError> decode_state(std::span<const std::byte> plaintext,
                                                                  StateMessage& out) const noexcept TANDEM_REALTIME;
  /// @param further  one element per configured further tool; after an error its contents are unspecified
  [[nodiscard]] std::expected<Preamble, DecodeError> decode_state(
      std::span<const std::byte> plaintext, StateMessage& out,
      std::span<PortSample> further) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<ForceMessage> decode_force(std::span<const std::byte> plaintext,
                                                   std::span<ToolForce> further = {}) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<PathMessage> decode_path(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  /// Rejects authority outside [0, 1] and sums that differ from 1 by more than 1e-9.
  [[nodiscard]] Decoded<AuthorityMessage> decode_authority(std::span<const std::byte> plaintext) const noexcept
      TANDEM_REALTIME;
  [[nodiscard]] Decoded<CloseMessage> decode_close(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Decoded<PingMessage> decode_ping(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;

 private:
  std::size_t axes_ = kAxesMax;
  double position_max_ = 0;       ///< of a port sample [m] or [rad]
  std::size_t contacts_max_ = 0;  ///< in a FORCE
  std::size_t further_ = 0;
};

}  // namespace tandem::wire
