#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "proto/wire/message_words.h"
#include "proto/wire/wire_codec.h"
#include "proto/wire/wire_fields.h"

/// Layout of the bodies of all messages: the fields in the order of their numbers (proto/schema/wire.proto), with the
/// range that a receiver accepts. Each function visits one message with a FieldWriter or a FieldReader, so that both
/// directions have the same layout. Private to wire_codec.cpp: internal linkage keeps the functions inlined there.
namespace tandem::wire::layout {

/// Largest cumulative energy in telemetry [J]; larger values are implausible.
inline constexpr double kJouleMax = 1e9;
/// Largest gap and age of a link [ms]: eleven days.
inline constexpr double kMillisecondsMax = 1e9;

inline constexpr std::integral_constant<std::size_t, 1> kOne;
inline constexpr std::integral_constant<std::size_t, 3> kThree;

/// Calls `work` with the number of axes, as a compile-time constant for the usual numbers.
template <class Work>
static decltype(auto) with_axes(std::size_t axes, Work&& work) noexcept {
  return axes == kThree ? work(kThree) : axes == kOne ? work(kOne) : work(axes);
}

/// Enumerators and flags of a FORCE in their wire form.
struct ForceWords {
  std::uint32_t session = 0, flags = 0, surfaces = 0;
  bool surfaces_present = false;
  bool ghost = false;
};

/// Position, velocity and effort of a port in single precision; in double precision behind all other fields.
template <class Values, class Port, class Axes>
[[gnu::always_inline]] static inline void walk_single(Values& v, Port& port, Axes axes, double position_max) noexcept {
  v.floats(1, port.x, axes, position_max);
  v.floats(2, port.v, axes, kVelocityMax);
  v.floats(3, port.f, axes, kEffortMax);
}
template <class Values, class Port, class Axes>
static void walk_exact(Values& v, std::uint32_t first, Port& port, Axes axes, double position_max) noexcept {
  v.doubles(first, port.x, axes, position_max);
  v.doubles(first + 1, port.v, axes, kVelocityMax);
  v.doubles(first + 2, port.f, axes, kEffortMax);
}
inline constexpr std::uint32_t kExactState = 11, kExactForce = 17;  ///< numbers of the first exact fields

template <class Values, class Message, class Word, class Axes>
[[gnu::always_inline]] static inline void walk_state(Values& v, Message& s, Word& flags, Axes axes,
                                                     const BodyLayout& layout, double position_max) noexcept {
  if (!layout.exact) walk_single(v, s.port, axes, position_max);
  v.energies(4, s.port.e_in, axes, kEnergyMax);
  v.word(5, flags, kStateFlagsMax);
  v.word(6, s.seat_tick);
  v.word(7, s.resume_stop);
  if (layout.tool_copies) v.floats(8, s.port.a, axes, kAccelerationMax);
}

template <class Values, class Telemetry, class Axes>
static void walk_telemetry(Values& v, Telemetry& t, Axes axes, const BodyLayout& layout) noexcept {
  v.message(10, telemetry_body(layout));
  v.floats(1, t.q, axes, kPositionMaxRad);
  v.floats(2, t.x, kThree, kPositionMaxM);
  v.floats(3, t.f_cmd, kThree, kEffortMax);
  v.floats(4, t.f_out, kThree, kEffortMax);
  v.energies(5, t.e_out, axes, kEnergyMax);
  v.number32(6, t.dissipated_j, -kJouleMax, kJouleMax);
  v.number32(7, t.refused_j, -kJouleMax, kJouleMax);
  v.number32(8, t.delivered_j, -kJouleMax, kJouleMax);
  v.number32(9, t.margin_min_j, -kJouleMax, kJouleMax);
  v.number32(10, t.down_loss_percent, 0, 100);
  v.number32(11, t.down_longest_gap_ms, 0, kMillisecondsMax);
  v.number32(12, t.down_age_p99_ms, 0, kMillisecondsMax);
  v.word(13, t.gate_trips);
  v.word(14, t.late_ticks);
  if (!layout.environment) return;
  v.floats(15, t.f_env, kThree, kEffortMax);
  v.number32(16, t.penetration_m, -kPositionMaxM, kPositionMaxM);
}

template <class Values, class Sample>
static void walk_further_sample(Values& v, Sample& s, std::size_t axes, double position_max) noexcept {
  v.message(9, tool_state_body(axes));
  v.floats(1, s.x, axes, position_max);
  v.floats(2, s.v, axes, kVelocityMax);
  v.floats(3, s.f, axes, kEffortMax);
  v.floats(4, s.a, axes, kAccelerationMax);
  v.energies(5, s.e_in, axes, kEnergyMax);
}

template <class Values, class Contact>
static void walk_contact(Values& v, Contact& c) noexcept {
  v.message(16, kContactBody);
  v.word(1, c.id);
  v.singles(2, c.point, LocalContact::kPointMax);
  v.singles(3, c.normal, 2);
  v.single(4, c.k, LocalContact::kStiffnessMax);
  v.single(5, c.b, LocalContact::kDampingMax);
  v.single(6, c.mu, LocalContact::kFrictionMax);
}
/// Whether all contacts are valid surfaces with distinct ids.
static bool are_surfaces(const LocalContactList& contacts, std::size_t axes) noexcept {
  for (std::uint32_t c = 0; c < contacts.size; ++c) {
    if (!is_surface(contacts.item[c], axes)) return false;
    for (std::uint32_t before = 0; before < c; ++before)
      if (contacts.item[before].id == contacts.item[c].id) return false;
  }
  return true;
}

template <class Values, class Force, class Word>
static void walk_further_force(Values& v, Force& t, Word& word, std::size_t axes, double position_max) noexcept {
  v.message(12, tool_force_body(axes));
  v.floats(1, t.port.x, axes, position_max);
  v.floats(2, t.port.v, axes, kVelocityMax);
  v.floats(3, t.port.f, axes, kEffortMax);
  v.energies(4, t.port.e_in, axes, kEnergyMax);
  v.number32(5, t.alpha, 0, 1);
  v.word(6, word, kSurfacesMax);
}

template <class Values, class Message, class Words, class Axes>
[[gnu::always_inline]] static inline void walk_force(Values& v, Message& f, Words& words, Axes axes, bool exact,
                                                     double position_max) noexcept {
  if (!exact) walk_single(v, f.port, axes, position_max);
  v.energies(4, f.port.e_in, axes, kEnergyMax);
  v.word(5, words.session, kSessionWordMax);
  v.word(6, words.flags, kForceFlagsMax);
  v.word(7, f.session_tick);
  v.word(8, f.authority_version);
  v.number64(9, f.alpha, 0, 1);
  v.word(10, f.stops);
  if (words.surfaces_present) [[unlikely]]
    v.word(11, words.surfaces, kSurfacesMax);
  if (exact) [[unlikely]]
    walk_exact(v, kExactForce, f.port, axes, position_max);
}
template <class Values, class Message>
static void walk_ghost(Values& v, Message& f) noexcept {
  v.word(13, f.ghost.leader, kMastersMax);
  v.singles(14, f.ghost.x, kPositionMaxM);
  v.singles(15, f.ghost.v, kVelocityMax);
}

template <class Values, class Message>
static void walk_link_report(Values& v, Message& r) noexcept {
  v.word(1, r.used);
  v.word(2, r.late);
}

template <class Values, class Message>
static void walk_authority(Values& v, Message& a) noexcept {
  v.word(1, a.version);
  v.word(2, a.tool, kToolsMax - 1);
  v.word(3, a.masters, kMastersMax);
  v.doubles(4, a.alpha, std::integral_constant<std::size_t, kMastersMax>{}, 1);
}

template <class Axes>
static void read_state(FieldReader& values, StateMessage& out, Axes axes, const BodyLayout& layout,
                       double position_max) noexcept {
  std::uint32_t flags = 0;
  walk_state(values, out, flags, axes, layout, position_max);
  values.require(read_state_flags(flags, out));
}

/// Decodes a surfaces word: number of contacts of this tool that follow, and relative stiffness of its slave's spring.
/// @param left  contacts in this FORCE not yet claimed by a word; bounds the count, whatever the word says
static void read_surfaces(FieldReader& values, std::uint32_t word, std::size_t& left, ToolForce& out) noexcept {
  const std::uint32_t count = word & kCount;
  const bool good = count <= kLocalContactsMax && count <= left && (word & ~(kCount | kPull << kPullAt)) == 0;
  values.require(good);
  out.contacts.size = good ? count : 0;
  left -= out.contacts.size;
  out.slave_pull = static_cast<double>(word >> kPullAt & kPull) / kPull;
}
static void read_contacts(FieldReader& values, std::size_t axes, LocalContactList& out) noexcept {
  for (std::uint32_t c = 0; c < out.size; ++c) walk_contact(values, out.item[c]);
  values.require(are_surfaces(out, axes));
}

}  // namespace tandem::wire::layout
