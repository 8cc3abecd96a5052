#include "proto/wire/wire_codec.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "proto/wire/message_body.h"
#include "proto/wire/wire_layout.h"

namespace tandem::wire {
namespace {

using namespace layout;
using body::read;
using body::read_into;
using body::read_preamble;
using body::write;

}  // namespace

void Codec::configure(const BodyLayout& layout) noexcept {
  layout_ = layout.valid();
  position_max_ = layout_.port == PortSpace::kTip ? kPositionMaxM : kPositionMaxRad;
  contacts_max_ = layout_.tool_copies ? contacts_room(layout_.axes, layout_.further) : 0;
  state_size_ = state_size(layout_, false);
  telemetry_state_size_ = state_size(layout_, true);
  smallest_force_ = force_size(layout_);
}

std::size_t Codec::encode(const Preamble& preamble, const StateMessage& in, std::span<std::byte> out) const noexcept {
  return encode(preamble, StateWithTools{in, {}}, out);
}

std::size_t Codec::encode(const Preamble& preamble, const StateWithTools& in, std::span<std::byte> out) const noexcept {
  const StateMessage& state = in.message;
  if (in.further.size() != layout_.further) return 0;
  const std::uint32_t flags = state_flags(state);
  return with_axes(layout_.axes, [&](auto axes) {
    return write(preamble, state.with_telemetry ? telemetry_state_size_ : state_size_, out, [&](FieldWriter& values) {
      walk_state(values, state, flags, axes, layout_, 0);
      for (const PortSample& sample : in.further) walk_further_sample(values, sample, axes, 0);
      if (state.with_telemetry) walk_telemetry(values, state.telemetry, axes, layout_);
      if (layout_.exact) walk_exact(values, kExactState, state.port, axes, 0);
    });
  });
}

std::size_t Codec::encode(const Preamble& preamble, const ForceMessage& in, std::span<std::byte> out) const noexcept {
  if (layout_.further > 0 || in.contacts.size > kLocalContactsMax) return 0;
  const std::uint32_t surfaces = surfaces_word(in);
  const bool surfaces_present = surfaces != 0;
  const bool ghost = in.ghost.leader != 0;
  if ((surfaces_present || ghost) && !layout_.tool_copies) return 0;
  const ForceWords words{session_word(in),
                         force_flags(in) | (surfaces_present ? kSurfaces : 0U) | (ghost ? kGhost : 0U), surfaces,
                         surfaces_present, ghost};
  return with_axes(layout_.axes, [&](auto axes) {
    if (!surfaces_present && !ghost)
      return write(preamble, smallest_force_, out,
                   [&](FieldWriter& values) { walk_force(values, in, words, axes, layout_.exact, 0); });
    return write(preamble,
                 (surfaces_present ? force_size(axes, in.contacts.size) : force_size(axes)) + (ghost ? kGhostSize : 0),
                 out, [&](FieldWriter& values) {
                   walk_force(values, in, words, axes, false, 0);
                   if (ghost) walk_ghost(values, in);
                   for (const LocalContact& contact : in.contacts.all()) walk_contact(values, contact);
                 });
  });
}

std::size_t Codec::encode(const Preamble& preamble, const ForceWithTools& with,
                          std::span<std::byte> out) const noexcept {
  const ForceMessage& in = with.message;
  const std::size_t axes = layout_.axes, further = layout_.further;
  if (further == 0 && with.further.empty()) return encode(preamble, in, out);
  if (with.further.size() != further || in.contacts.size > kLocalContactsMax) return 0;
  std::size_t contacts = in.contacts.size;
  for (const ToolForce& tool : with.further) {
    if (tool.contacts.size > kLocalContactsMax) return 0;
    contacts += tool.contacts.size;
  }
  if (contacts > contacts_max_) return 0;
  const bool ghost = in.ghost.leader != 0;
  const ForceWords words{session_word(in), force_flags(in) | kSurfaces | (ghost ? kGhost : 0U), surfaces_word(in), true,
                         ghost};
  return write(preamble, force_size(axes, contacts) + further * tool_force_size(axes) + (ghost ? kGhostSize : 0), out,
               [&](FieldWriter& values) {
                 walk_force(values, in, words, axes, false, 0);
                 for (const ToolForce& tool : with.further) {
                   const std::uint32_t word = surfaces_word(tool);
                   walk_further_force(values, tool, word, axes, 0);
                 }
                 if (ghost) walk_ghost(values, in);
                 for (const LocalContact& contact : in.contacts.all()) walk_contact(values, contact);
                 for (const ToolForce& tool : with.further)
                   for (const LocalContact& contact : tool.contacts.all()) walk_contact(values, contact);
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
  return decode_state(in, out, {});
}

std::expected<Preamble, DecodeError> Codec::decode_state(std::span<const std::byte> in, StateMessage& out,
                                                         std::span<PortSample> further) const noexcept {
  if (further.size() != layout_.further) [[unlikely]]
    return std::unexpected(DecodeError::kSize);
  out.with_telemetry = in.size() == telemetry_state_size_;
  return with_axes(layout_.axes, [&](auto axes) {
    return read_into(in, out.with_telemetry ? telemetry_state_size_ : state_size_, [&](FieldReader& values) {
      read_state(values, out, axes, layout_, position_max_);
      for (PortSample& sample : further) walk_further_sample(values, sample, axes, position_max_);
      if (out.with_telemetry) walk_telemetry(values, out.telemetry, axes, layout_);
      if (layout_.exact) walk_exact(values, kExactState, out.port, axes, position_max_);
    });
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
  const std::size_t tools = layout_.further;
  if (further.size() != tools) [[unlikely]]
    return std::unexpected(DecodeError::kSize);
  return with_axes(layout_.axes, [&](auto axes) {
    const std::uint32_t flags = in.size() >= smallest_force_ ? flags_of_force(in, axes, layout_.exact)
                                                             : 0;  // decides which parts follow, and so the size
    const bool surfaces_present = (flags & kSurfaces) != 0, ghost = (flags & kGhost) != 0;
    const bool impossible = layout_.tool_copies ? tools > 0 && !surfaces_present : surfaces_present || ghost;
    if (impossible) [[unlikely]]
      return Decoded<ForceMessage>{std::unexpected(DecodeError::kSize)};
    const std::size_t least = layout_.exact ? smallest_force_ : force_size(axes);
    const std::size_t fixed = (surfaces_present ? force_size(axes, 0) : least) + (ghost ? kGhostSize : 0) +
                              (tools > 0 ? tools * tool_force_size(axes) : 0);
    const std::size_t contacts =
        surfaces_present && in.size() >= fixed ? std::min((in.size() - fixed) / kContactSize, contacts_max_) : 0;
    return read<ForceMessage>(in, fixed + contacts * kContactSize, [&](FieldReader& values, ForceMessage& out) {
      ForceWords words;
      words.surfaces_present = surfaces_present;
      words.ghost = ghost;
      walk_force(values, out, words, axes, layout_.exact, position_max_);
      values.require(read_session_word(words.session, out));
      values.require(read_force_flags(words.flags, out));
      std::size_t left = contacts;
      if (surfaces_present) [[unlikely]] {
        values.require(words.surfaces != 0 || !further.empty());
        read_surfaces(values, words.surfaces, left, out);
        for (ToolForce& tool : further) {
          std::uint32_t word = 0;
          walk_further_force(values, tool, word, axes, position_max_);
          read_surfaces(values, word, left, tool);
        }
      }
      if (ghost) walk_ghost(values, out);
      values.require((out.ghost.leader != 0) == ghost && left == 0);
      if (contacts == 0) [[likely]]
        return;
      read_contacts(values, axes, out.contacts);
      for (ToolForce& tool : further) read_contacts(values, axes, tool.contacts);
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

std::size_t Codec::encode(const Preamble& preamble, const LinkProbe&, std::span<std::byte> out) const noexcept {
  return write(preamble, probe_size(layout_), out,
               [&](FieldWriter& values) { values.zeros(1, probe_padding(layout_)); });
}

std::size_t Codec::encode(const Preamble& preamble, const LinkReport& in, std::span<std::byte> out) const noexcept {
  return write(preamble, report_size(layout_), out, [&](FieldWriter& values) {
    walk_link_report(values, in);
    values.zeros(3, report_padding(layout_));
  });
}

Decoded<LinkProbe> Codec::decode_link_probe(std::span<const std::byte> in) const noexcept {
  return read<LinkProbe>(in, probe_size(layout_),
                         [&](FieldReader& values, LinkProbe&) { values.zeros(1, probe_padding(layout_)); });
}

Decoded<LinkReport> Codec::decode_link_report(std::span<const std::byte> in) const noexcept {
  return read<LinkReport>(in, report_size(layout_), [&](FieldReader& values, LinkReport& out) {
    walk_link_report(values, out);
    values.zeros(3, report_padding(layout_));
  });
}

}  // namespace tandem::wire
