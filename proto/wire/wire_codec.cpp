#include "proto/wire/wire_codec.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "proto/wire/force_flags.h"
#include "proto/wire/wire_fields.h"

namespace tandem::wire {
namespace {

/// Largest cumulative energy in telemetry [J]; larger values are implausible.
constexpr double kJouleMax = 1e9;
/// Largest gap and age of a link [ms]: eleven days.
constexpr double kMillisecondsMax = 1e9;

constexpr std::integral_constant<std::size_t, 3> kThree;

/// Calls `work` with the number of axes, as a compile-time constant for the usual number.
template <class Work>
decltype(auto) with_axes(std::size_t axes, Work&& work) noexcept {
  return axes == kThree ? work(kThree) : work(axes);
}

/// Enumerators and flags of a message in their wire form.
struct StateWords {
  std::uint32_t gate = 0, flags = 0;
};
struct ForceWords {
  std::uint32_t session = 0, flags = 0, surfaces = 0;
  bool told = false;  ///< `surfaces` is present
  bool ghost = false;
};

// The fields of each message in the order of their numbers (wire.proto), with the range that a receiver accepts.

template <class Values, class Message, class Words, class Axes>
void walk(Values& v, Message& s, Words& words, Axes axes, double position_max) noexcept {
  v.doubles(1, s.port.x, axes, position_max);
  v.doubles(2, s.port.v, axes, kVelocityMax);
  v.doubles(3, s.port.f, axes, kEffortMax);
  v.energies(4, s.port.e_in, axes, kEnergyMax);
  v.floats(5, s.telemetry.q, axes, kPositionMaxRad);
  v.floats(6, s.telemetry.x, kThree, kPositionMaxM);
  v.floats(7, s.telemetry.f_cmd, kThree, kEffortMax);
  v.floats(8, s.telemetry.f_out, kThree, kEffortMax);
  v.energies(9, s.telemetry.e_out, axes, kEnergyMax);
  v.number32(10, s.telemetry.dissipated_j, -kJouleMax, kJouleMax);
  v.number32(11, s.telemetry.refused_j, -kJouleMax, kJouleMax);
  v.number32(12, s.telemetry.delivered_j, -kJouleMax, kJouleMax);
  v.number32(13, s.telemetry.margin_min_j, -kJouleMax, kJouleMax);
  v.word(14, words.gate, static_cast<std::uint32_t>(GateState::kFault));
  v.word(15, words.flags, 15);
  v.word(16, s.gate_trips);
  v.word(17, s.late_ticks);
  v.word(18, s.seat_tick);
  v.floats(19, s.telemetry.f_env, kThree, kEffortMax);
  v.number32(20, s.telemetry.penetration_m, -kPositionMaxM, kPositionMaxM);
  v.number32(21, s.telemetry.down_loss_percent, 0, 100);
  v.number32(22, s.telemetry.down_longest_gap_ms, 0, kMillisecondsMax);
  v.number32(23, s.telemetry.down_age_p99_ms, 0, kMillisecondsMax);
  v.word(24, s.resume_stop);
  v.floats(25, s.port.a, axes, kAccelerationMax);
}

template <class Values, class Sample>
void walk_tie(Values& v, Sample& s, std::size_t axes, double position_max) noexcept {
  v.message(26, tool_state_body(axes));
  v.doubles(1, s.x, axes, position_max);
  v.floats(2, s.v, axes, kVelocityMax);
  v.floats(3, s.f, axes, kEffortMax);
  v.floats(4, s.a, axes, kAccelerationMax);
  v.energies(5, s.e_in, axes, kEnergyMax);
}

template <class Values, class Contact>
void walk_contact(Values& v, Contact& c) noexcept {
  v.message(17, kContactBody);
  v.word(1, c.id);
  v.singles(2, c.point, LocalContact::kPointMax);
  v.singles(3, c.normal, 2);
  v.single(4, c.k, LocalContact::kStiffnessMax);
  v.single(5, c.b, LocalContact::kDampingMax);
  v.single(6, c.mu, LocalContact::kFrictionMax);
}
/// Whether all contacts are valid surfaces with distinct ids.
bool are_surfaces(const LocalContactList& contacts, std::size_t axes) noexcept {
  for (std::uint32_t c = 0; c < contacts.size; ++c) {
    if (!is_surface(contacts.item[c], axes)) return false;
    for (std::uint32_t before = 0; before < c; ++before)
      if (contacts.item[before].id == contacts.item[c].id) return false;
  }
  return true;
}

template <class Values, class Tie, class Word>
void walk_tie_force(Values& v, Tie& t, Word& word, std::size_t axes, double position_max) noexcept {
  v.message(13, tool_force_body(axes));
  v.doubles(1, t.port.x, axes, position_max);
  v.floats(2, t.port.v, axes, kVelocityMax);
  v.floats(3, t.port.f, axes, kEffortMax);
  v.energies(4, t.port.e_in, axes, kEnergyMax);
  v.number32(5, t.alpha, 0, 1);
  v.word(6, word, kSurfacesMax);
}

template <class Values, class Message, class Words, class Axes>
[[gnu::always_inline]] inline void walk_force(Values& v, Message& f, Words& words, Axes axes,
                                              double position_max) noexcept {
  v.doubles(1, f.port.x, axes, position_max);
  v.doubles(2, f.port.v, axes, kVelocityMax);
  v.doubles(3, f.port.f, axes, kEffortMax);
  v.energies(4, f.port.e_in, axes, kEnergyMax);
  v.word(5, words.session, static_cast<std::uint32_t>(SessionState::kOverloaded));
  v.word(6, words.flags, kForceFlagsMax);
  v.word(7, f.session_tick);
  v.word(8, f.authority_version);
  v.word(9, f.missing, kSeatsMax);
  v.number64(10, f.alpha, 0, 1);
  v.word(11, f.stops);
  if (words.told) [[unlikely]]
    v.word(12, words.surfaces, kSurfacesMax);
}
template <class Values, class Message>
void walk_ghost(Values& v, Message& f) noexcept {
  v.word(14, f.ghost.leader, kMastersMax);
  v.singles(15, f.ghost.x, kPositionMaxM);
  v.singles(16, f.ghost.v, kVelocityMax);
}

template <class Values, class Message>
void walk_authority(Values& v, Message& a) noexcept {
  v.word(1, a.version);
  v.word(2, a.tool, kToolsMax - 1);
  v.word(3, a.masters, kMastersMax);
  v.doubles(4, a.alpha, std::integral_constant<std::size_t, kMastersMax>{}, 1);
}

template <class Axes>
void read_state(FieldReader& values, StateMessage& out, Axes axes, double position_max) noexcept {
  StateWords words;
  walk(values, out, words, axes, position_max);
  out.gate = static_cast<GateState>(words.gate);
  out.ready = (words.flags & 1U) != 0;
  out.engaged = (words.flags & 2U) != 0;
  out.stop = (words.flags & 4U) != 0;
  out.stop_all = (words.flags & 8U) != 0;
}

/// Decodes a surfaces word: number of contacts of this tool that follow, and relative stiffness of its slave's spring.
/// @param left  contacts in this FORCE not yet claimed by a word; bounds the count, whatever the word says
void read_surfaces(FieldReader& values, std::uint32_t word, std::size_t& left, ToolForce& out) noexcept {
  const std::uint32_t count = word & kCount;
  const bool good = count <= kLocalContactsMax && count <= left && (word & ~(kCount | kPull << kPullAt)) == 0;
  values.require(good);
  out.contacts.size = good ? count : 0;
  left -= out.contacts.size;
  out.slave_pull = static_cast<double>(word >> kPullAt & kPull) / kPull;
}
void read_contacts(FieldReader& values, std::size_t axes, LocalContactList& out) noexcept {
  for (std::uint32_t c = 0; c < out.size; ++c) walk_contact(values, out.item[c]);
  values.require(are_surfaces(out, axes));
}

static_assert(sizeof(Preamble) == kPreambleSize && std::is_trivially_copyable_v<Preamble>);

/// Writes the preamble, then the body by `values`. @param size  size of both  @return size; 0 if `out` is too small
template <class Write>
std::size_t write(const Preamble& preamble, std::size_t size, std::span<std::byte> out, Write&& values) noexcept {
  if (out.size() < size) return 0;
  std::memcpy(out.data(), &preamble, kPreambleSize);
  FieldWriter writer{out.subspan(kPreambleSize, size - kPreambleSize)};
  values(writer);
  return size;
}

Preamble read_preamble(std::span<const std::byte> in) noexcept {
  Preamble preamble;
  std::memcpy(&preamble, in.data(), kPreambleSize);
  return preamble;
}

/// Checks the size first, because every value has a fixed offset. The output of `values` is valid only without an
/// error.
template <class Read>
std::expected<Preamble, DecodeError> read_into(std::span<const std::byte> in, std::size_t size,
                                               Read&& values) noexcept {
  if (in.size() != size) return std::unexpected(DecodeError::kSize);
  FieldReader reader{in.subspan(kPreambleSize)};
  values(reader);
  if (!reader.well_formed()) [[unlikely]]
    return std::unexpected(DecodeError::kMalformed);
  if (!reader.finite()) [[unlikely]]
    return std::unexpected(DecodeError::kNotFinite);
  if (!reader.in_range()) [[unlikely]]
    return std::unexpected(DecodeError::kOutOfRange);
  return read_preamble(in);
}

/// A single result object with one return statement, so that the message is never copied.
template <class Message, class Read>
Decoded<Message> read(std::span<const std::byte> in, std::size_t size, Read&& values) noexcept {
  Decoded<Message> result{std::in_place};
  const auto preamble = read_into(in, size, [&](FieldReader& reader) { values(reader, result->message); });
  if (preamble) {
    result->preamble = *preamble;
  } else {
    result = std::unexpected(preamble.error());
  }
  return result;
}

}  // namespace

void Codec::configure(std::size_t axes, PortSpace port, std::size_t further) noexcept {
  axes_ = std::clamp<std::size_t>(axes, 1, kAxesMax);
  position_max_ = port == PortSpace::kTip ? kPositionMaxM : kPositionMaxRad;
  const bool tip = port == PortSpace::kTip && axes_ <= 3;
  further_ = tip ? std::min(further, kFurtherToolsMax) : 0;
  contacts_max_ = tip ? contacts_room(axes_, further_) : 0;
}

std::size_t Codec::encode(const Preamble& preamble, const StateMessage& in, std::span<std::byte> out) const noexcept {
  const StateWords words{static_cast<std::uint32_t>(in.gate),
                         (in.ready ? 1U : 0U) | (in.engaged ? 2U : 0U) | (in.stop ? 4U : 0U) | (in.stop_all ? 8U : 0U)};
  return with_axes(axes_, [&](auto axes) {
    return write(preamble, state_size(axes), out, [&](FieldWriter& values) { walk(values, in, words, axes, 0); });
  });
}

std::size_t Codec::encode(const Preamble& preamble, const StateWithTools& in, std::span<std::byte> out) const noexcept {
  if (in.further.size() != further_) return 0;
  const std::size_t first = encode(preamble, in.message, out), size = first + further_ * tool_state_size(axes_);
  if (first == 0 || out.size() < size) return 0;
  FieldWriter values{out.subspan(first, size - first)};
  for (const PortSample& sample : in.further) walk_tie(values, sample, axes_, 0);
  return size;
}

std::size_t Codec::encode(const Preamble& preamble, const ForceMessage& in, std::span<std::byte> out) const noexcept {
  if (further_ > 0 || in.contacts.size > kLocalContactsMax) return 0;
  const std::uint32_t surfaces = surfaces_word(in);
  const bool told = surfaces != 0;
  const bool ghost = in.ghost.leader != 0;
  const ForceWords words{static_cast<std::uint32_t>(in.session),
                         force_flags(in) | (told ? kSurfaces : 0U) | (ghost ? kGhost : 0U), surfaces, told, ghost};
  return with_axes(axes_, [&](auto axes) {
    if (!told && !ghost)
      return write(preamble, force_size(axes), out,
                   [&](FieldWriter& values) { walk_force(values, in, words, axes, 0); });
    return write(preamble, (told ? force_size(axes, in.contacts.size) : force_size(axes)) + (ghost ? kGhostSize : 0),
                 out, [&](FieldWriter& values) {
                   walk_force(values, in, words, axes, 0);
                   if (ghost) walk_ghost(values, in);
                   for (const LocalContact& contact : in.contacts.all()) walk_contact(values, contact);
                 });
  });
}

std::size_t Codec::encode(const Preamble& preamble, const ForceWithTools& with,
                          std::span<std::byte> out) const noexcept {
  const ForceMessage& in = with.message;
  if (further_ == 0 && with.further.empty()) return encode(preamble, in, out);
  if (with.further.size() != further_ || in.contacts.size > kLocalContactsMax) return 0;
  std::size_t contacts = in.contacts.size;
  for (const ToolForce& tie : with.further) {
    if (tie.contacts.size > kLocalContactsMax) return 0;
    contacts += tie.contacts.size;
  }
  if (contacts > contacts_max_) return 0;
  const bool ghost = in.ghost.leader != 0;
  const ForceWords words{static_cast<std::uint32_t>(in.session), force_flags(in) | kSurfaces | (ghost ? kGhost : 0U),
                         surfaces_word(in), true, ghost};
  return write(preamble, force_size(axes_, contacts) + further_ * tool_force_size(axes_) + (ghost ? kGhostSize : 0),
               out, [&](FieldWriter& values) {
                 walk_force(values, in, words, axes_, 0);
                 for (const ToolForce& tie : with.further) {
                   const std::uint32_t word = surfaces_word(tie);
                   walk_tie_force(values, tie, word, axes_, 0);
                 }
                 if (ghost) walk_ghost(values, in);
                 for (const LocalContact& contact : in.contacts.all()) walk_contact(values, contact);
                 for (const ToolForce& tie : with.further)
                   for (const LocalContact& contact : tie.contacts.all()) walk_contact(values, contact);
               });
}

std::size_t Codec::encode(const Preamble& preamble, const PathMessage& in, std::span<std::byte> out) const noexcept {
  return write(preamble, kPathSize, out, [&](FieldWriter& values) { values.long_word(1, in.token); });
}

std::size_t Codec::encode(const Preamble& preamble, const AuthorityMessage& in,
                          std::span<std::byte> out) const noexcept {
  if (in.masters > kMastersMax) return 0;
  AuthorityMessage all = in;
  std::fill(all.alpha.begin() + in.masters, all.alpha.end(), 0.0);
  return write(preamble, kAuthoritySize, out, [&](FieldWriter& values) { walk_authority(values, all); });
}

std::size_t Codec::encode(const Preamble& preamble, const CloseMessage& in, std::span<std::byte> out) const noexcept {
  return write(preamble, kCloseSize, out,
               [&](FieldWriter& values) { values.word(1, static_cast<std::uint32_t>(in.reason)); });
}

std::size_t Codec::encode(const Preamble& preamble, const PingMessage&, std::span<std::byte> out) const noexcept {
  return write(preamble, kPingSize, out, [](FieldWriter&) {});
}

std::expected<Preamble, DecodeError> Codec::decode_state(std::span<const std::byte> in,
                                                         StateMessage& out) const noexcept {
  return with_axes(axes_, [&](auto axes) {
    return read_into(in, state_size(axes), [&](FieldReader& values) { read_state(values, out, axes, position_max_); });
  });
}

std::expected<Preamble, DecodeError> Codec::decode_state(std::span<const std::byte> in, StateMessage& out,
                                                         std::span<PortSample> further) const noexcept {
  if (further.size() != further_) [[unlikely]]
    return std::unexpected(DecodeError::kSize);
  if (further.empty()) [[likely]]
    return decode_state(in, out);
  return read_into(in, state_size(axes_) + further_ * tool_state_size(axes_), [&](FieldReader& values) {
    read_state(values, out, axes_, position_max_);
    for (PortSample& sample : further) walk_tie(values, sample, axes_, position_max_);
  });
}

Decoded<StateMessage> Codec::decode_state(std::span<const std::byte> in) const noexcept {
  Decoded<StateMessage> result{std::in_place};
  const auto preamble = decode_state(in, result->message);
  if (preamble) {
    result->preamble = *preamble;
  } else {
    result = std::unexpected(preamble.error());
  }
  return result;
}

Decoded<ForceMessage> Codec::decode_force(std::span<const std::byte> in, std::span<ToolForce> further) const noexcept {
  if (further.size() != further_) [[unlikely]]
    return std::unexpected(DecodeError::kSize);
  return with_axes(axes_, [&](auto axes) {
    const std::uint32_t flags =
        in.size() >= force_size(axes) ? flags_of_force(in, axes) : 0;  // decides which parts follow, and so the size
    const bool told = (flags & kSurfaces) != 0, ghost = (flags & kGhost) != 0;
    if (further_ > 0 && !told) [[unlikely]]
      return Decoded<ForceMessage>{std::unexpected(DecodeError::kSize)};
    const std::size_t fixed = (told ? force_size(axes, 0) : force_size(axes)) + (ghost ? kGhostSize : 0) +
                              (further_ > 0 ? further_ * tool_force_size(axes) : 0);
    const std::size_t contacts =
        told && in.size() >= fixed ? std::min((in.size() - fixed) / kContactSize, contacts_max_) : 0;
    return read<ForceMessage>(in, fixed + contacts * kContactSize, [&](FieldReader& values, ForceMessage& out) {
      ForceWords words;
      words.told = told;
      words.ghost = ghost;
      walk_force(values, out, words, axes, position_max_);
      out.session = static_cast<SessionState>(words.session);
      values.require(read_force_flags(words.flags, out));
      std::size_t left = contacts;
      if (told) [[unlikely]] {
        values.require(words.surfaces != 0 || !further.empty());
        read_surfaces(values, words.surfaces, left, out);
        for (ToolForce& tie : further) {
          std::uint32_t word = 0;
          walk_tie_force(values, tie, word, axes, position_max_);
          read_surfaces(values, word, left, tie);
        }
      }
      if (ghost) walk_ghost(values, out);
      values.require((out.ghost.leader != 0) == ghost && left == 0);
      if (contacts == 0) [[likely]]
        return;
      read_contacts(values, axes, out.contacts);
      for (ToolForce& tie : further) read_contacts(values, axes, tie.contacts);
    });
  });
}

Decoded<PathMessage> Codec::decode_path(std::span<const std::byte> in) const noexcept {
  return read<PathMessage>(in, kPathSize,
                           [](FieldReader& values, PathMessage& out) { values.long_word(1, out.token); });
}

Decoded<AuthorityMessage> Codec::decode_authority(std::span<const std::byte> in) const noexcept {
  return read<AuthorityMessage>(in, kAuthoritySize, [](FieldReader& values, AuthorityMessage& out) {
    walk_authority(values, out);
    double sum = 0;
    for (std::size_t i = 0; i < kMastersMax; ++i) {
      values.require(i < out.masters ? out.alpha[i] >= 0 : out.alpha[i] == 0);
      sum += out.alpha[i];
    }
    values.require(std::abs(sum - 1) <= 1e-9);
  });
}

Decoded<CloseMessage> Codec::decode_close(std::span<const std::byte> in) const noexcept {
  return read<CloseMessage>(in, kCloseSize, [](FieldReader& values, CloseMessage& out) {
    std::uint32_t reason = 0;
    values.word(1, reason, kCloseReasonMax);
    out.reason = static_cast<CloseReason>(reason);
  });
}

Decoded<PingMessage> Codec::decode_ping(std::span<const std::byte> in) const noexcept {
  if (in.size() != kPingSize) return std::unexpected(DecodeError::kSize);
  return Received<PingMessage>{read_preamble(in), {}};
}

}  // namespace tandem::wire
