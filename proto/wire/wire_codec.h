#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "common/base/axes.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/body_layout.h"
#include "proto/wire/link_test_messages.h"
#include "proto/wire/wire_messages.h"

/// Codec of a datagram's plaintext: Preamble (16 bytes, little-endian), then one protobuf message of
/// proto/schema/wire.proto.
namespace tandem::wire {

/// Reason for rejecting bytes. The receiver has one counter per reason; no exceptions, no log lines.
enum class DecodeError : std::uint8_t {
  kSize,        ///< none of the exact sizes of the type in this layout
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
  explicit Codec(const BodyLayout& layout = {}) noexcept { configure(layout); }
  /// A seat with all parts that such a port can have.
  Codec(std::size_t axes, PortSpace port, std::size_t further = 0) noexcept
      : Codec(BodyLayout{.axes = axes, .port = port, .further = further}) {}

  /// Changes the layout to `layout.valid()`. No heap.
  void configure(const BodyLayout& layout) noexcept;
  [[nodiscard]] const BodyLayout& layout() const noexcept { return layout_; }
  [[nodiscard]] std::size_t further() const noexcept { return layout_.further; }
  [[nodiscard]] std::size_t axes() const noexcept { return layout_.axes; }

  /// Writes preamble and body to the front of `out`. @return bytes written; 0 if `out` is too small or the message has
  /// a length beyond its array. Values are written unchecked; the receiver checks them. Unused axes are not sent.
  /// AUTHORITY carries kMastersMax values, 0 from `masters` on. Positions, velocities, efforts and accelerations are
  /// rounded to single precision, by at most 2^-24 of their magnitude (6e-8), unless `BodyLayout::exact`; energies and
  /// alpha are exact.
  [[nodiscard]] std::size_t encode(const Preamble&, const StateMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const ForceMessage&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  /// @return 0 also if the number of further tools is not as configured, if contacts exceed `contacts_room`, or if the
  /// layout has no place for surfaces or a ghost that the message has
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
  [[nodiscard]] std::size_t encode(const Preamble&, const LinkProbe&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t encode(const Preamble&, const LinkReport&,
                                   std::span<std::byte> out) const noexcept TANDEM_REALTIME;

  [[nodiscard]] Decoded<StateMessage> decode_state(std::span<const std::byte> plaintext) const noexcept TANDEM_REALTIME;
  /// The same without a copy: writes every value of the datagram into `out`. Values that the datagram does not carry
  /// keep what they were: axes and parts beyond the layout, and telemetry unless `with_telemetry`. After an error the
  /// contents of `out` are unspecified.
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
  [[nodiscard]] Decoded<LinkProbe> decode_link_probe(std::span<const std::byte> plaintext) const noexcept
      TANDEM_REALTIME;
  [[nodiscard]] Decoded<LinkReport> decode_link_report(std::span<const std::byte> plaintext) const noexcept
      TANDEM_REALTIME;

 private:
  BodyLayout layout_;
  double position_max_ = 0;                                ///< of a port sample [m] or [rad]
  std::size_t contacts_max_ = 0;                           ///< in a FORCE
  std::size_t state_size_ = 0, telemetry_state_size_ = 0;  ///< the two sizes of a STATE
  std::size_t smallest_force_ = 0;
};

}  // namespace tandem::wire
