// Compares the codec, which copies values at fixed offsets, with the protobuf library: the library reads messages of
// the codec and writes messages for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "proto/schema/wire.pb.h"
#include "proto/wire/wire_codec.h"
#include "tests/proto/wire/wire_samples.h"

namespace tandem::wire {
namespace {

using Buffer = std::array<std::byte, kPlaintextMax>;

template <class Repeated, std::size_t N>
void expect_same(const Repeated& theirs, const std::array<double, N>& ours, std::size_t count) {
  ASSERT_EQ(static_cast<std::size_t>(theirs.size()), count);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_EQ(theirs.Get(static_cast<int>(i)), static_cast<std::remove_cvref_t<decltype(theirs.Get(0))>>(ours[i]));
}
void expect_same(const google::protobuf::RepeatedField<std::uint64_t>& theirs, const EnergyArray& ours,
                 std::size_t count) {
  ASSERT_EQ(static_cast<std::size_t>(theirs.size()), count);
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(theirs.Get(static_cast<int>(i)), ours[i]);
}

/// Expects that the library's own encoding of `body`, behind our preamble, equals our bytes.
template <class Body>
void expect_written_back(const Body& body, std::span<const std::byte> ours) {
  std::string again;
  ASSERT_TRUE(body.SerializeToString(&again));
  ASSERT_EQ(again.size() + kPreambleSize, ours.size());
  EXPECT_TRUE(std::ranges::equal(again, ours.subspan(kPreambleSize),
                                 [](char a, std::byte b) { return static_cast<std::byte>(a) == b; }));
}

template <class Body>
Body parsed(std::span<const std::byte> ours) {
  Body body;
  const auto rest = ours.subspan(kPreambleSize);
  EXPECT_TRUE(body.ParseFromArray(rest.data(), static_cast<int>(rest.size())));
  return body;
}

/// The library's copy of the telemetry. @param slave  whether the environment is part of it
void expect_same(const pb::Telemetry& theirs, const Telemetry& ours, std::size_t axes, bool slave) {
  expect_same(theirs.q(), ours.q, axes);
  expect_same(theirs.tip_x(), ours.x, 3);
  expect_same(theirs.f_cmd(), ours.f_cmd, 3);
  expect_same(theirs.f_out(), ours.f_out, 3);
  expect_same(theirs.e_out(), ours.e_out, axes);
  EXPECT_EQ(theirs.dissipated_j(), static_cast<float>(ours.dissipated_j));
  EXPECT_EQ(theirs.refused_j(), static_cast<float>(ours.refused_j));
  EXPECT_EQ(theirs.delivered_j(), static_cast<float>(ours.delivered_j));
  EXPECT_EQ(theirs.margin_min_j(), static_cast<float>(ours.margin_min_j));
  EXPECT_EQ(theirs.down_loss_percent(), static_cast<float>(ours.down_loss_percent));
  EXPECT_EQ(theirs.down_longest_gap_ms(), static_cast<float>(ours.down_longest_gap_ms));
  EXPECT_EQ(theirs.down_age_p99_ms(), static_cast<float>(ours.down_age_p99_ms));
  EXPECT_EQ(theirs.gate_trips(), ours.gate_trips);
  EXPECT_EQ(theirs.late_ticks(), ours.late_ticks);
  EXPECT_EQ(theirs.has_penetration_m(), slave);
  expect_same(theirs.f_env(), ours.f_env, slave ? 3 : 0);
  EXPECT_EQ(theirs.penetration_m(), slave ? static_cast<float>(ours.penetration_m) : 0);
}

TEST(WireTwin, MatchesTheLibraryForState) {
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes) {
    for (std::uint64_t seed = 1; seed <= 80; ++seed) {
      SCOPED_TRACE(std::to_string(axes) + " axes, seed " + std::to_string(seed));
      RandomStream random{seed};
      const bool slave = seed % 2 == 0, copies = seed % 4 < 2 && axes <= 3, exact = seed % 5 == 0 && !copies;
      const Codec codec(BodyLayout{
          .axes = axes, .port = PortSpace::kTip, .tool_copies = copies, .environment = slave, .exact = exact});
      StateMessage m = samples::state(random, axes);
      m.with_telemetry = seed % 8 < 4;
      Buffer buffer;
      const auto bytes = std::span<const std::byte>(buffer).first(codec.encode(samples::preamble(random), m, buffer));
      const auto s = parsed<pb::State>(bytes);
      expect_written_back(s, bytes);
      expect_same(s.x(), m.port.x, exact ? 0 : axes);
      expect_same(s.v(), m.port.v, exact ? 0 : axes);
      expect_same(s.f(), m.port.f, exact ? 0 : axes);
      expect_same(s.x_exact(), m.port.x, exact ? axes : 0);
      expect_same(s.v_exact(), m.port.v, exact ? axes : 0);
      expect_same(s.f_exact(), m.port.f, exact ? axes : 0);
      expect_same(s.e_in(), m.port.e_in, axes);
      EXPECT_EQ(s.flags(), (m.ready ? 1U : 0U) + (m.engaged ? 2U : 0U) + (m.stop ? 4U : 0U) + (m.stop_all ? 8U : 0U) +
                               16 * static_cast<std::uint32_t>(m.gate) + (m.with_telemetry ? 128U : 0U));
      EXPECT_EQ(s.seat_tick(), m.seat_tick);
      EXPECT_EQ(s.resume_stop(), m.resume_stop);
      expect_same(s.a(), m.port.a, copies ? axes : 0);
      ASSERT_EQ(s.has_telemetry(), m.with_telemetry);
      if (m.with_telemetry) expect_same(s.telemetry(), m.telemetry, axes, slave);
    }
  }
}

TEST(WireTwin, MatchesTheLibraryForForce) {
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      SCOPED_TRACE(std::to_string(axes) + " axes, seed " + std::to_string(seed));
      RandomStream random{seed};
      Codec codec(axes, PortSpace::kTip);
      ForceMessage m = samples::force(random, axes);
      if (axes <= 3 && seed % 3 > 0) samples::contacts(random, axes, m.contacts);
      if (axes <= 3 && seed % 3 == 2) m.slave_pull = samples::slave_pull(random);
      if (axes <= 3 && seed % 2 == 1) m.ghost = samples::ghost(random);
      Buffer buffer;
      const auto bytes = std::span<const std::byte>(buffer).first(codec.encode(samples::preamble(random), m, buffer));
      const auto f = parsed<pb::Force>(bytes);
      expect_written_back(f, bytes);
      expect_same(f.x(), m.port.x, axes);
      expect_same(f.v(), m.port.v, axes);
      expect_same(f.f(), m.port.f, axes);
      expect_same(f.e_in(), m.port.e_in, axes);
      EXPECT_EQ(f.session(),
                static_cast<std::uint32_t>(m.session) + 256 * m.missing + (m.telemetry_every_tick ? 65536U : 0U));
      const TransferParties& p = m.transfer_parties;
      EXPECT_EQ(f.flags(),
                (m.engage ? 1U : 0U) + 2 * static_cast<unsigned>(m.transfer) + 8 * m.transfer_ticks + 512 * p.by +
                    16384 * p.to + 524288 * p.percent + 67108864 * p.tool + (m.touching ? 1U << 31 : 0U) +
                    (m.contacts.size > 0 || m.slave_pull > 0 ? 1U << 29 : 0U) + (m.ghost.leader > 0 ? 1U << 30 : 0U));
      EXPECT_EQ(f.session_tick(), m.session_tick);
      EXPECT_EQ(f.authority_version(), m.authority_version);
      EXPECT_EQ(f.alpha(), m.alpha);
      EXPECT_EQ(f.stops(), m.stops);
      EXPECT_EQ(f.has_surfaces(), m.contacts.size > 0 || m.slave_pull > 0);
      EXPECT_EQ(f.surfaces(), m.contacts.size + 256 * static_cast<std::uint32_t>(std::lround(m.slave_pull * 65535)));
      EXPECT_EQ(f.has_leader(), m.ghost.leader > 0);
      EXPECT_EQ(f.leader(), m.ghost.leader);
      EXPECT_TRUE(std::ranges::equal(
          f.ghost_x(), m.ghost.leader > 0 ? std::span<const float>(m.ghost.x) : std::span<const float>{}));
      EXPECT_TRUE(std::ranges::equal(
          f.ghost_v(), m.ghost.leader > 0 ? std::span<const float>(m.ghost.v) : std::span<const float>{}));
      ASSERT_EQ(static_cast<std::uint32_t>(f.contact_size()), m.contacts.size);
      for (int c = 0; c < f.contact_size(); ++c) {
        const LocalContact& ours = m.contacts.item[static_cast<std::size_t>(c)];
        EXPECT_EQ(f.contact(c).id(), ours.id);
        EXPECT_TRUE(std::ranges::equal(f.contact(c).point(), ours.point));
        EXPECT_TRUE(std::ranges::equal(f.contact(c).normal(), ours.normal));
        EXPECT_EQ(f.contact(c).k(), ours.k);
        EXPECT_EQ(f.contact(c).b(), ours.b);
        EXPECT_EQ(f.contact(c).mu(), ours.mu);
      }
    }
  }
}

TEST(WireTwin, MatchesTheLibraryForExactForce) {
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes) {
    RandomStream random{axes};
    const Codec codec(BodyLayout{.axes = axes, .port = PortSpace::kTip, .tool_copies = false, .exact = true});
    const ForceMessage m = samples::force(random, axes);
    Buffer buffer;
    const auto bytes = std::span<const std::byte>(buffer).first(codec.encode({}, m, buffer));
    const auto f = parsed<pb::Force>(bytes);
    expect_written_back(f, bytes);
    EXPECT_EQ(f.x_size() + f.v_size() + f.f_size(), 0);
    expect_same(f.x_exact(), m.port.x, axes);
    expect_same(f.v_exact(), m.port.v, axes);
    expect_same(f.f_exact(), m.port.f, axes);
    expect_same(f.e_in(), m.port.e_in, axes);
    EXPECT_EQ(f.stops(), m.stops);
  }
}

TEST(WireTwin, MatchesTheLibraryForFurtherTools) {
  for (std::size_t axes = 1; axes <= 3; ++axes)
    for (std::size_t further = 1; further <= kFurtherToolsMax; ++further)
      for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(std::to_string(axes) + " axes, " + std::to_string(further) + " further, seed " +
                     std::to_string(seed));
        RandomStream random{seed};
        Codec codec(axes, PortSpace::kTip, further);
        Buffer buffer;
        const auto states = samples::tie_states(random, axes, further);
        const StateMessage state = samples::state(random, axes);
        auto bytes = std::span<const std::byte>(buffer).first(
            codec.encode(samples::preamble(random), StateWithTools{state, states}, buffer));
        const auto s = parsed<pb::State>(bytes);
        expect_written_back(s, bytes);
        expect_same(s.x(), state.port.x, axes);
        ASSERT_EQ(static_cast<std::size_t>(s.tie_size()), further);
        for (std::size_t k = 0; k < further; ++k) {
          const auto& tie = s.tie(static_cast<int>(k));
          expect_same(tie.x(), states[k].x, axes);
          expect_same(tie.v(), states[k].v, axes);
          expect_same(tie.f(), states[k].f, axes);
          expect_same(tie.a(), states[k].a, axes);
          expect_same(tie.e_in(), states[k].e_in, axes);
        }

        ForceMessage force = samples::force(random, axes);
        samples::contacts(random, axes, force.contacts);
        const auto ties =
            samples::tie_forces(random, axes, further, contacts_room(axes, further) - force.contacts.size);
        bytes = std::span<const std::byte>(buffer).first(
            codec.encode(samples::preamble(random), ForceWithTools{force, ties}, buffer));
        const auto f = parsed<pb::Force>(bytes);
        expect_written_back(f, bytes);
        expect_same(f.x(), force.port.x, axes);
        EXPECT_NE(f.flags() & 1U << 29, 0u);
        ASSERT_EQ(static_cast<std::size_t>(f.tie_size()), further);
        int contact = 0;
        for (const LocalContact& c : force.contacts.all()) EXPECT_EQ(f.contact(contact++).id(), c.id);
        for (std::size_t k = 0; k < further; ++k) {
          const auto& tie = f.tie(static_cast<int>(k));
          expect_same(tie.x(), ties[k].port.x, axes);
          expect_same(tie.v(), ties[k].port.v, axes);
          expect_same(tie.f(), ties[k].port.f, axes);
          expect_same(tie.e_in(), ties[k].port.e_in, axes);
          EXPECT_EQ(static_cast<double>(tie.alpha()), ties[k].alpha);
          EXPECT_EQ(tie.surfaces(),
                    ties[k].contacts.size + 256 * static_cast<std::uint32_t>(std::lround(ties[k].slave_pull * 65535)));
          for (const LocalContact& c : ties[k].contacts.all()) EXPECT_EQ(f.contact(contact++).id(), c.id);
        }
        EXPECT_EQ(contact, f.contact_size());
      }
}

TEST(WireTwin, MatchesTheLibraryForSmallMessages) {
  Codec codec;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream random{seed};
    Buffer buffer;
    const AuthorityMessage a = samples::authority(random);
    auto bytes = std::span<const std::byte>(buffer).first(codec.encode({}, a, buffer));
    const auto theirs = parsed<pb::AuthorityChange>(bytes);
    expect_written_back(theirs, bytes);
    EXPECT_EQ(theirs.version(), a.version);
    EXPECT_EQ(theirs.tool(), a.tool);
    EXPECT_EQ(theirs.masters(), a.masters);
    for (std::size_t i = 0; i < kMastersMax; ++i)
      EXPECT_EQ(theirs.alpha(static_cast<int>(i)), i < a.masters ? a.alpha[i] : 0);

    const PathMessage p = samples::path(random);
    bytes = std::span<const std::byte>(buffer).first(codec.encode({}, p, buffer));
    expect_written_back(parsed<pb::Path>(bytes), bytes);
    EXPECT_EQ(parsed<pb::Path>(bytes).token(), p.token);

    const Codec seat(samples::tip(1 + seed % 3));
    bytes = std::span<const std::byte>(buffer).first(seat.encode({}, LinkProbe{}, buffer));
    const auto probe = parsed<pb::LinkProbe>(bytes);
    expect_written_back(probe, bytes);
    EXPECT_EQ(probe.padding(), std::string(probe.padding().size(), '\0'));
    const LinkReport r{static_cast<std::uint32_t>(random.bits()), static_cast<std::uint32_t>(random.bits())};
    bytes = std::span<const std::byte>(buffer).first(seat.encode({}, r, buffer));
    const auto report = parsed<pb::LinkReport>(bytes);
    expect_written_back(report, bytes);
    EXPECT_EQ(report.used(), r.used);
    EXPECT_EQ(report.late(), r.late);
    EXPECT_EQ(report.padding(), std::string(report.padding().size(), '\0'));

    bytes = std::span<const std::byte>(buffer).first(codec.encode({}, CloseMessage{CloseReason::kServerStops}, buffer));
    expect_written_back(parsed<pb::Close>(bytes), bytes);
    EXPECT_EQ(parsed<pb::Close>(bytes).reason(), static_cast<std::uint32_t>(CloseReason::kServerStops));
  }
}

}  // namespace
}  // namespace tandem::wire
