#include "proto/wire/wire_codec.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/proto/wire/wire_comparison.h"
#include "tests/proto/wire/wire_samples.h"
#include "tests/support/alloc_guard.h"

namespace tandem::wire {
namespace {

TEST(WireCodec, RoundTripsState) {
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes) {
    Codec codec(axes, PortSpace::kTip);
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      SCOPED_TRACE(seed);
      RandomStream random(seed);
      const auto preamble = samples::preamble(random);
      const auto sent = samples::state(random, axes);
      Buffer buffer;
      const auto size = codec.encode(preamble, sent, buffer);
      ASSERT_EQ(size, state_size(samples::tip(axes), true));
      const auto got = codec.decode_state(view(buffer, size));
      ASSERT_TRUE(got.has_value()) << static_cast<int>(got.error());
      expect_same(got->preamble, preamble);
      expect_same(got->message.port, sent.port);
      EXPECT_EQ(got->message.telemetry.q, sent.telemetry.q);
      EXPECT_EQ(got->message.telemetry.x, sent.telemetry.x);
      EXPECT_EQ(got->message.telemetry.f_cmd, sent.telemetry.f_cmd);
      EXPECT_EQ(got->message.telemetry.f_out, sent.telemetry.f_out);
      EXPECT_EQ(got->message.telemetry.e_out, sent.telemetry.e_out);
      EXPECT_EQ(got->message.telemetry.dissipated_j, sent.telemetry.dissipated_j);
      EXPECT_EQ(got->message.telemetry.refused_j, sent.telemetry.refused_j);
      EXPECT_EQ(got->message.telemetry.delivered_j, sent.telemetry.delivered_j);
      EXPECT_EQ(got->message.telemetry.margin_min_j, sent.telemetry.margin_min_j);
      EXPECT_EQ(got->message.gate, sent.gate);
      EXPECT_EQ(got->message.ready, sent.ready);
      EXPECT_EQ(got->message.engaged, sent.engaged);
      EXPECT_EQ(got->message.stop, sent.stop);
      EXPECT_EQ(got->message.stop_all, sent.stop_all);
      EXPECT_EQ(got->message.resume_stop, sent.resume_stop);
      EXPECT_EQ(got->message.port.a, axes <= 3 ? sent.port.a : AxisArray{});
      EXPECT_EQ(got->message.telemetry.gate_trips, sent.telemetry.gate_trips);
      EXPECT_EQ(got->message.telemetry.late_ticks, sent.telemetry.late_ticks);
      EXPECT_TRUE(got->message.with_telemetry);
      EXPECT_EQ(got->message.seat_tick, sent.seat_tick);
    }
  }
}

TEST(WireCodec, RoundTripsForce) {
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes) {
    Codec codec(axes, PortSpace::kJoint);
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      SCOPED_TRACE(seed);
      RandomStream random(seed);
      const auto preamble = samples::preamble(random);
      const auto sent = samples::force(random, axes);
      Buffer buffer;
      const auto size = codec.encode(preamble, sent, buffer);
      ASSERT_EQ(size, force_size(axes));
      const auto got = codec.decode_force(view(buffer, size));
      ASSERT_TRUE(got.has_value()) << static_cast<int>(got.error());
      expect_same(got->preamble, preamble);
      expect_same(got->message.port, sent.port);
      EXPECT_EQ(got->message.session, sent.session);
      EXPECT_EQ(got->message.engage, sent.engage);
      EXPECT_EQ(got->message.session_tick, sent.session_tick);
      EXPECT_EQ(got->message.authority_version, sent.authority_version);
      EXPECT_EQ(got->message.missing, sent.missing);
      EXPECT_EQ(got->message.alpha, sent.alpha);
      EXPECT_EQ(got->message.stops, sent.stops);
      EXPECT_EQ(got->message.transfer, sent.transfer);
      EXPECT_EQ(got->message.transfer_ticks, sent.transfer_ticks);
      EXPECT_EQ(got->message.transfer_parties, sent.transfer_parties);
      EXPECT_EQ(got->message.touching, sent.touching);
      EXPECT_EQ(got->message.telemetry_every_tick, sent.telemetry_every_tick);
    }
  }
}

TEST(WireCodec, RoundTripsContacts) {
  for (std::size_t axes = 1; axes <= 3; ++axes) {
    Codec codec(axes, PortSpace::kTip);
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      SCOPED_TRACE(seed);
      RandomStream random(seed);
      auto sent = samples::force(random, axes);
      samples::contacts(random, axes, sent.contacts);
      if (seed % 2 == 0) sent.slave_pull = samples::slave_pull(random);
      Buffer buffer;
      const auto size = codec.encode({}, sent, buffer);
      const bool told = sent.contacts.size > 0 || sent.slave_pull > 0;
      ASSERT_EQ(size, told ? force_size(axes, sent.contacts.size) : force_size(axes));
      const auto got = codec.decode_force(view(buffer, size));
      ASSERT_TRUE(got.has_value()) << static_cast<int>(got.error());
      EXPECT_EQ(got->message.contacts.size, sent.contacts.size);
      EXPECT_EQ(got->message.contacts.item, sent.contacts.item);
      EXPECT_EQ(got->message.slave_pull, sent.slave_pull);
      EXPECT_EQ(got->message.stops, sent.stops);
    }
  }
}

/// Each case makes one field of one contact of a FORCE invalid.
TEST(WireCodec, RejectsContactsThatAreNoSurfaces) {
  Codec codec(3, PortSpace::kTip);
  const auto refused = [&](auto&& spoil) -> std::optional<DecodeError> {
    RandomStream random(5);
    ForceMessage m = samples::force(random, 3);
    for (std::uint32_t id = 1; id <= 3; ++id) m.contacts.add(samples::contact(random, 3, id));
    spoil(m.contacts.item[1]);
    Buffer buffer;
    const auto got = codec.decode_force(view(buffer, codec.encode({}, m, buffer)));
    return got ? std::nullopt : std::optional{got.error()};
  };
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refused([](LocalContact&) {}), std::nullopt);
  for (const float bad : {nan, inf, -inf}) {
    EXPECT_EQ(refused([&](LocalContact& c) { c.k = bad; }), DecodeError::kNotFinite);
    EXPECT_EQ(refused([&](LocalContact& c) { c.b = bad; }), DecodeError::kNotFinite);
    EXPECT_EQ(refused([&](LocalContact& c) { c.mu = bad; }), DecodeError::kNotFinite);
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_EQ(refused([&](LocalContact& c) { c.point[a] = bad; }), DecodeError::kNotFinite);
      EXPECT_EQ(refused([&](LocalContact& c) { c.normal[a] = bad; }), DecodeError::kNotFinite);
    }
  }
  const auto out_of_range = [&](auto&& spoil) { EXPECT_EQ(refused(spoil), DecodeError::kOutOfRange); };
  out_of_range([](LocalContact& c) { c.k = -1; });
  out_of_range([](LocalContact& c) { c.k = 1.01e6F; });
  out_of_range([](LocalContact& c) { c.b = -0.1F; });
  out_of_range([](LocalContact& c) { c.b = 1001; });
  out_of_range([](LocalContact& c) { c.mu = -0.1F; });
  out_of_range([](LocalContact& c) { c.mu = 2.1F; });
  out_of_range([](LocalContact& c) { c.point[2] = 10.1F; });
  out_of_range([](LocalContact& c) { c.normal = {}; });
  out_of_range([](LocalContact& c) { c.normal = {0, 0, 1.001F}; });
  out_of_range([](LocalContact& c) { c.normal = {0.7F, 0.7F, 0}; });
  out_of_range([](LocalContact& c) { c.id = 0; });
  out_of_range([](LocalContact& c) { c.id = 1; });  // id of another contact
}

TEST(WireCodec, AcceptsContactsOnlyOnATipPort) {
  RandomStream random(6);
  Buffer buffer;
  ForceMessage m;
  m.contacts.add(samples::contact(random, 3, 1));
  Codec tip(3, PortSpace::kTip), joints(3, PortSpace::kJoint), plane(2, PortSpace::kTip);
  EXPECT_TRUE(tip.decode_force(view(buffer, tip.encode({}, m, buffer))));
  EXPECT_EQ(joints.decode_force(view(buffer, joints.encode({}, m, buffer))).error(), DecodeError::kSize);
  EXPECT_EQ(plane.decode_force(view(buffer, plane.encode({}, m, buffer))).error(), DecodeError::kOutOfRange)
      << "a normal out of the plane";
  m.contacts.size = kLocalContactsMax + 1;
  EXPECT_EQ(tip.encode({}, m, buffer), 0u);
}

TEST(WireCodec, RoundTripsPathMessages) {
  Codec codec;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream random(seed);
    const auto sent = samples::path(random);
    Buffer buffer;
    const auto size = codec.encode(samples::preamble(random), sent, buffer);
    ASSERT_EQ(size, kPathSize);
    const auto got = codec.decode_path(view(buffer, size));
    ASSERT_TRUE(got.has_value());
    EXPECT_EQ(got->message.token, sent.token);
  }
}

TEST(WireCodec, RoundTripsAuthorityCloseAndPing) {
  Codec codec;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    const auto sent = samples::authority(random);
    Buffer buffer;
    auto size = codec.encode(samples::preamble(random), sent, buffer);
    ASSERT_EQ(size, kAuthoritySize);
    const auto got = codec.decode_authority(view(buffer, size));
    ASSERT_TRUE(got.has_value());
    EXPECT_EQ(got->message.version, sent.version);
    EXPECT_EQ(got->message.tool, sent.tool);
    EXPECT_EQ(got->message.masters, sent.masters);
    EXPECT_EQ(got->message.alpha, sent.alpha);

    const CloseMessage close{static_cast<CloseReason>(random.below(5))};
    size = codec.encode(samples::preamble(random), close, buffer);
    ASSERT_EQ(size, kCloseSize);
    EXPECT_EQ(codec.decode_close(view(buffer, size))->message.reason, close.reason);

    const auto preamble = samples::preamble(random);
    size = codec.encode(preamble, PingMessage{}, buffer);
    ASSERT_EQ(size, kPingSize);
    expect_same(codec.decode_ping(view(buffer, size))->preamble, preamble);
  }
}

TEST(WireCodec, ReconfiguringChangesAxesAndRanges) {
  Codec codec(7, PortSpace::kJoint);
  RandomStream random(1);
  StateMessage m = samples::state(random, 7);
  m.port.x = {50, 0, 0, 0, 0, 0, 0};
  Buffer buffer;
  auto size = codec.encode({}, m, buffer);
  EXPECT_TRUE(codec.decode_state(view(buffer, size)).has_value()) << "50 rad";
  codec.configure({.axes = 3, .port = PortSpace::kTip});
  EXPECT_EQ(codec.axes(), 3u);
  EXPECT_EQ(codec.decode_state(view(buffer, size)).error(), DecodeError::kSize);
  size = codec.encode({}, m, buffer);
  EXPECT_EQ(size, state_size(samples::tip(3), true));
  EXPECT_EQ(codec.decode_state(view(buffer, size)).error(), DecodeError::kOutOfRange) << "50 m";
}

TEST(WireCodec, RejectsOutOfRangeNumbers) {
  Codec codec(3, PortSpace::kTip);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto state = [&](auto change) {
    RandomStream random(7);
    StateMessage m = samples::state(random, 3);
    change(m);
    Buffer buffer;
    const auto got = codec.decode_state(view(buffer, codec.encode({}, m, buffer)));
    EXPECT_FALSE(got.has_value());
    return got.has_value() ? DecodeError::kSize : got.error();
  };
  EXPECT_EQ(state([&](auto& m) { m.port.x[2] = nan; }), DecodeError::kNotFinite);
  EXPECT_EQ(state([&](auto& m) { m.port.v[0] = inf; }), DecodeError::kNotFinite);
  EXPECT_EQ(state([&](auto& m) { m.port.f[1] = -inf; }), DecodeError::kNotFinite);
  EXPECT_EQ(state([&](auto& m) { m.telemetry.q[0] = nan; }), DecodeError::kNotFinite);
  EXPECT_EQ(state([&](auto& m) { m.telemetry.f_out[2] = inf; }), DecodeError::kNotFinite);
  EXPECT_EQ(state([&](auto& m) { m.telemetry.margin_min_j = nan; }), DecodeError::kNotFinite);
  EXPECT_EQ(state([&](auto& m) { m.telemetry.refused_j = 1e300; }), DecodeError::kNotFinite)
      << "beyond single precision";
  EXPECT_EQ(state([&](auto& m) { m.port.x[1] = 1e300; }), DecodeError::kNotFinite) << "beyond single precision";
  EXPECT_EQ(state([&](auto& m) { m.port.x[0] = 10.001; }), DecodeError::kOutOfRange);
  EXPECT_EQ(state([&](auto& m) { m.port.v[1] = -100.1; }), DecodeError::kOutOfRange);
  EXPECT_EQ(state([&](auto& m) { m.port.f[2] = 1.0001e4; }), DecodeError::kOutOfRange);
  EXPECT_EQ(state([&](auto& m) { m.port.e_in[0] = ~std::uint64_t{0}; }), DecodeError::kOutOfRange);
  EXPECT_EQ(state([&](auto& m) { m.telemetry.e_out[2] = kEnergyMax + 1; }), DecodeError::kOutOfRange);
  EXPECT_EQ(state([&](auto& m) { m.gate = static_cast<GateState>(7); }), DecodeError::kOutOfRange);

  const auto force = [&](auto change) {
    RandomStream random(8);
    ForceMessage m = samples::force(random, 3);
    change(m);
    Buffer buffer;
    const auto got = codec.decode_force(view(buffer, codec.encode({}, m, buffer)));
    EXPECT_FALSE(got.has_value());
    return got.has_value() ? DecodeError::kSize : got.error();
  };
  EXPECT_EQ(force([&](auto& m) { m.port.x[0] = nan; }), DecodeError::kNotFinite);
  EXPECT_EQ(force([&](auto& m) { m.alpha = nan; }), DecodeError::kNotFinite);
  EXPECT_EQ(force([&](auto& m) { m.alpha = 1.0000001; }), DecodeError::kOutOfRange);
  EXPECT_EQ(force([&](auto& m) { m.session = static_cast<SessionState>(7); }), DecodeError::kOutOfRange);
  EXPECT_EQ(force([&](auto& m) { m.missing = 25; }), DecodeError::kOutOfRange);
  const auto tells = [&](TransferNotice what, std::uint32_t ticks) {
    return force([&](auto& m) {
      m.transfer = what;
      m.transfer_ticks = ticks;
      m.transfer_parties = {};
    });
  };
  const auto names = [&](TransferNotice what, TransferParties parties) {
    return force([&](auto& m) {
      m.transfer = what;
      m.transfer_ticks = 0;
      m.transfer_parties = parties;
      m.touching = false;  // with it, one more set bit would already exceed the largest value
    });
  };
  EXPECT_EQ(names(TransferNotice::kGaining, {.by = kSeatsMax + 1}), DecodeError::kOutOfRange);
  EXPECT_EQ(names(TransferNotice::kGaining, {.to = kMastersMax + 1}), DecodeError::kOutOfRange);
  EXPECT_EQ(names(TransferNotice::kLosing, {.percent = 101}), DecodeError::kOutOfRange);
  static_assert(kToolsMax == 1 << 3);
  for (const std::uint32_t beyond : {1U, 2U, 3U})
    EXPECT_EQ(names(TransferNotice::kGaining, {.tool = beyond << 3}), DecodeError::kSize)
        << "bits 29 and 30 announce what does not follow";
  for (const TransferParties& who : {TransferParties{.by = 1}, {.to = 1}, {.percent = 1}, {.tool = 1}}) {
    EXPECT_EQ(names(TransferNotice::kNone, who), DecodeError::kOutOfRange) << "who gives what is not given";
    EXPECT_EQ(names(TransferNotice::kCancelled, who), DecodeError::kOutOfRange);
  }
  EXPECT_EQ(tells(TransferNotice::kGaining, kTransferNoticeTicks + 1), DecodeError::kOutOfRange);
  EXPECT_EQ(force([&](auto& m) {
              m.transfer = TransferNotice::kGaining;
              m.transfer_ticks = kTransferNoticeTicks + 1;
              m.touching = true;
            }),
            DecodeError::kOutOfRange);
  EXPECT_EQ(tells(TransferNotice::kNone, 1), DecodeError::kOutOfRange) << "nothing comes, and when?";
  EXPECT_EQ(tells(TransferNotice::kCancelled, 1), DecodeError::kOutOfRange);

  const auto authority = [&](auto change) {
    AuthorityMessage m;
    m.masters = 2;
    m.alpha[0] = 1;
    change(m);
    Buffer buffer;
    return codec.decode_authority(view(buffer, codec.encode({}, m, buffer))).has_value();
  };
  EXPECT_TRUE(authority([](auto&) {}));
  EXPECT_FALSE(authority([](auto& m) { m.alpha[0] = 0.9; })) << "sum";
  EXPECT_FALSE(authority([](auto& m) { m.alpha = {2, -1}; }));
  EXPECT_FALSE(authority([&](auto& m) { m.alpha[1] = nan; }));
  EXPECT_FALSE(authority([](auto& m) { m.tool = 8; }));
  EXPECT_FALSE(authority([](auto& m) { m.masters = 0; }));
}

TEST(WireCodec, WritesNothingIntoABufferThatIsTooSmall) {
  Codec codec(3, PortSpace::kTip);
  Buffer buffer;
  buffer.fill(std::byte{0x5a});
  RandomStream random(1);
  for (std::size_t size = 0; size < state_size(samples::tip(3), true); ++size) {
    EXPECT_EQ(codec.encode({}, samples::state(random, 3), std::span(buffer).first(size)), 0u);
  }
  EXPECT_EQ(buffer[0], std::byte{0x5a});
  AuthorityMessage authority;
  authority.masters = kMastersMax + 1;
  EXPECT_EQ(codec.encode({}, authority, buffer), 0u);
}

TEST(WireCodec, NeverAllocatesAfterConstruction) {
  Codec codec(3, PortSpace::kTip);
  RandomStream random(5);
  Buffer buffer;
  const test::AllocGuard guard;
  for (int i = 0; i < 1000; ++i) {
    codec.configure({.axes = 1 + static_cast<std::size_t>(random.below(kAxesMax)), .port = PortSpace::kTip});
    EXPECT_TRUE(codec.decode_state(view(buffer, codec.encode({}, samples::state(random, codec.axes()), buffer))));
    EXPECT_TRUE(codec.decode_force(view(buffer, codec.encode({}, samples::force(random, codec.axes()), buffer))));
    EXPECT_TRUE(codec.decode_path(view(buffer, codec.encode({}, samples::path(random), buffer))));
    EXPECT_TRUE(codec.decode_authority(view(buffer, codec.encode({}, samples::authority(random), buffer))));
    EXPECT_TRUE(codec.decode_close(view(buffer, codec.encode({}, CloseMessage{}, buffer))));
  }
  EXPECT_EQ(guard.count(), 0u);
}

TEST(WireGhost, IsSentOnlyWithAnotherLeaderAndInRange) {
  Codec codec(3, PortSpace::kTip);
  std::array<std::byte, kPlaintextMax> buffer;
  RandomStream random{9};
  ForceMessage sent = samples::force(random, 3);
  sent.ghost = samples::ghost(random);
  ASSERT_EQ(codec.encode({}, sent, buffer), force_size(3) + kGhostSize);
  auto got = codec.decode_force(std::span<const std::byte>(buffer).first(force_size(3) + kGhostSize));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->message.ghost, sent.ghost);
  sent.ghost.leader = 0;  // leader 0: the other fields of the ghost are ignored
  ASSERT_EQ(codec.encode({}, sent, buffer), force_size(3));
  got = codec.decode_force(std::span<const std::byte>(buffer).first(force_size(3)));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->message.ghost, Ghost{});

  const auto refused = [&](auto&& spoil, DecodeError why) {
    ForceMessage m = samples::force(random, 3);
    m.ghost = samples::ghost(random);
    spoil(m.ghost);
    const std::size_t size = codec.encode({}, m, buffer);
    const auto read = codec.decode_force(std::span<const std::byte>(buffer).first(size));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error(), why);
  };
  refused([](Ghost& g) { g.leader = kMastersMax + 1; }, DecodeError::kOutOfRange);
  refused([](Ghost& g) { g.x[1] = 10.1f; }, DecodeError::kOutOfRange);
  refused([](Ghost& g) { g.v[2] = -101; }, DecodeError::kOutOfRange);
  refused([](Ghost& g) { g.x[0] = std::numeric_limits<float>::quiet_NaN(); }, DecodeError::kNotFinite);
  refused([](Ghost& g) { g.v[0] = std::numeric_limits<float>::infinity(); }, DecodeError::kNotFinite);

  // A ghost without a leader: the number behind tag 13 is 0.
  sent.ghost = samples::ghost(random);
  const std::size_t size = codec.encode({}, sent, buffer);
  for (std::size_t k = 0; k < 4; ++k) buffer[force_size(3) + 1 + k] = std::byte{0};
  EXPECT_FALSE(codec.decode_force(std::span<const std::byte>(buffer).first(size)));
}

}  // namespace
}  // namespace tandem::wire
