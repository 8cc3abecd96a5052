#pragma once

#include <algorithm>
#include <cstddef>

#include "common/base/axes.h"
#include "common/base/local_contact.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/wire_messages.h"

/// Layout and sizes of the bodies of STATE and FORCE (proto/schema/wire.proto). A seat's setup decides which parts its
/// datagrams can have (`body_layout` in proto/text/seat_setup.h); no byte from the network adds one.
namespace tandem::wire {

/// Largest datagram, and size of header and tag around a plaintext [bytes] (common/transport/FORMAT.md).
inline constexpr std::size_t kDatagramMax = 1200;
inline constexpr std::size_t kDatagramOverhead = 32;
inline constexpr std::size_t kPlaintextMax = kDatagramMax - kDatagramOverhead;
inline constexpr std::size_t kPreambleSize = 16;

/// Contents of the STATEs and FORCEs of one seat. Both ends derive them from the seat's setup.
struct BodyLayout {
  std::size_t axes = kAxesMax;         ///< of the port, 1 ... kAxesMax
  PortSpace port = PortSpace::kJoint;  ///< decides the range of positions: metres or radians
  std::size_t further = 0;             ///< coupled tools beyond the first; only with `tool_copies`
  /// Law REPLICA, MASTER seats: STATE has accelerations; FORCE may have surfaces, a pull of the slave, and a ghost.
  bool tool_copies = true;
  bool environment = true;  ///< SLAVE seats: telemetry has force and depth of the environment
  /// Positions, velocities and efforts in double precision: flow sources SEED and SEED_SIGNED compare an energy with 0,
  /// which decides about the rest of a session. Never with `tool_copies`.
  bool exact = false;

  /// Returns the nearest layout that can exist: copies of tools need a TIP port of up to 3 axes.
  [[nodiscard]] constexpr BodyLayout valid() const noexcept {
    BodyLayout out = *this;
    out.axes = std::clamp<std::size_t>(axes, 1, kAxesMax);
    out.tool_copies = tool_copies && port == PortSpace::kTip && out.axes <= 3;
    out.exact = exact && !out.tool_copies;
    out.further = out.tool_copies ? std::min(further, kFurtherToolsMax) : 0;
    return out;
  }
  friend bool operator==(const BodyLayout&, const BodyLayout&) = default;
};

namespace detail {
/// Encoded size of packed fields and of scalar fields [bytes]. Tags take one byte (field numbers 1-15) or two.
constexpr std::size_t packed(std::size_t count, std::size_t each) { return 2 + count * each; }
constexpr std::size_t scalar(std::size_t count, std::size_t tag, std::size_t each) { return count * (tag + each); }
/// A nested message with a tag of one byte; its length takes one byte up to 127.
constexpr std::size_t nested(std::size_t body) { return (body < 128 ? 2 : 3) + body; }
}  // namespace detail

// Exact plaintext sizes [bytes]. The codec rejects a plaintext of another size before it parses.

constexpr std::size_t telemetry_body(const BodyLayout& l) {
  return detail::packed(l.axes, 4)    // q
         + 3 * detail::packed(3, 4)   // tip x f_cmd f_out
         + detail::packed(l.axes, 8)  // e_out
         + detail::scalar(4, 1, 4)    // energies
         + detail::scalar(3, 1, 4)    // link down
         + detail::scalar(2, 1, 4)    // counts
         + (l.environment ? detail::packed(3, 4) + detail::scalar(1, 2, 4) : 0);
}
/// Sizes per coupled tool beyond the first, in STATE and FORCE; up to 3 axes.
constexpr std::size_t tool_state_body(std::size_t axes) {
  return 4 * detail::packed(axes, 4) + detail::packed(axes, 8);
}
constexpr std::size_t tool_state_size(std::size_t axes) { return detail::nested(tool_state_body(axes)); }
constexpr std::size_t state_size(const BodyLayout& l, bool telemetry) {
  return kPreambleSize + 3 * detail::packed(l.axes, l.exact ? 8 : 4)  // x v f
         + detail::packed(l.axes, 8)                                  // e_in
         + detail::scalar(3, 1, 4)                                    // flags, seat_tick, resume_stop
         + (l.tool_copies ? detail::packed(l.axes, 4) : 0)            // a
         + l.further * tool_state_size(l.axes) + (telemetry ? detail::nested(telemetry_body(l)) : 0);
}

inline constexpr std::size_t kContactBody = detail::scalar(4, 1, 4) + 2 * detail::packed(3, 4);
inline constexpr std::size_t kContactSize = 1 + detail::nested(kContactBody);  // a tag of two bytes
/// Size that a ghost adds to a FORCE.
inline constexpr std::size_t kGhostSize = detail::scalar(1, 1, 4) + 2 * detail::packed(3, 4);
constexpr std::size_t tool_force_body(std::size_t axes) {
  return 3 * detail::packed(axes, 4) + detail::packed(axes, 8) + detail::scalar(2, 1, 4);
}
constexpr std::size_t tool_force_size(std::size_t axes) { return detail::nested(tool_force_body(axes)); }
/// Size of a FORCE without surfaces and ghost. @pre no further tools
constexpr std::size_t force_size(std::size_t axes) {
  return kPreambleSize + 3 * detail::packed(axes, 4) + detail::packed(axes, 8) + detail::scalar(4, 1, 4) +
         detail::scalar(1, 1, 8) + detail::scalar(1, 1, 4);
}
/// Size of a FORCE with `surfaces` or with further tools, without ghost and those tools.
constexpr std::size_t force_size(std::size_t axes, std::size_t contacts) {
  return force_size(axes) + detail::scalar(1, 1, 4) + contacts * kContactSize;
}
/// Smallest FORCE of this layout. The exact fields have tags of two bytes.
constexpr std::size_t force_size(const BodyLayout& l) {
  if (l.exact) return force_size(l.axes) + 3 * (1 + 4 * l.axes);
  return l.further == 0 ? force_size(l.axes) : force_size(l.axes, 0) + l.further * tool_force_size(l.axes);
}
/// Largest number of contacts, over all tools, in one FORCE.
constexpr std::size_t contacts_room(std::size_t axes, std::size_t further) {
  return std::min(kLocalContactsMax * (1 + further),
                  (kPlaintextMax - force_size(axes, 0) - kGhostSize - further * tool_force_size(axes)) / kContactSize);
}

inline constexpr std::size_t kPathSize = kPreambleSize + detail::scalar(1, 1, 8);
inline constexpr std::size_t kAuthoritySize = kPreambleSize + detail::scalar(3, 1, 4) + 3 + kMastersMax * 8;
inline constexpr std::size_t kCloseSize = kPreambleSize + detail::scalar(1, 1, 4);
inline constexpr std::size_t kPingSize = kPreambleSize;

/// Number of zeros in field `padding` with which a body of `rest` bytes before it reaches `plaintext` bytes. One size
/// cannot be reached, because of the padding's length field; the message is then one byte longer.
constexpr std::size_t padding_for(std::size_t plaintext, std::size_t rest) {
  const std::size_t room = plaintext - kPreambleSize - rest;  // with tag and length
  return room <= 129 ? room - 2 : std::max<std::size_t>(room - 3, 128);
}
/// LINK_PROBE is as long as the seat's STATE without telemetry, LINK_REPORT as its FORCE.
constexpr std::size_t probe_padding(const BodyLayout& l) { return padding_for(state_size(l, false), 0); }
constexpr std::size_t probe_size(const BodyLayout& l) { return kPreambleSize + detail::nested(probe_padding(l)); }
constexpr std::size_t report_padding(const BodyLayout& l) {
  return padding_for(force_size(l), detail::scalar(2, 1, 4));
}
constexpr std::size_t report_size(const BodyLayout& l) {
  return kPreambleSize + detail::scalar(2, 1, 4) + detail::nested(report_padding(l));
}

namespace detail {
inline constexpr BodyLayout kThreeAxes{.axes = 3, .port = PortSpace::kTip, .environment = false};
inline constexpr BodyLayout kLargest{};
inline constexpr BodyLayout kMostTools{.axes = 3, .port = PortSpace::kTip, .further = kFurtherToolsMax};
}  // namespace detail
/// One tool and three axes at 1 kHz: at most 150 bytes, sealed.
static_assert(state_size(detail::kThreeAxes, false) + kDatagramOverhead <= 150 &&
              force_size(detail::kThreeAxes) + kDatagramOverhead <= 150);
static_assert(state_size(detail::kLargest, true) <= kPlaintextMax &&
              state_size(detail::kMostTools, true) <= kPlaintextMax);
static_assert(force_size(kAxesMax, kLocalContactsMax) + kGhostSize <= kPlaintextMax &&
              contacts_room(3, kFurtherToolsMax) >= kLocalContactsMax);

}  // namespace tandem::wire
