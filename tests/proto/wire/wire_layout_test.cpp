// Tests of the parts that a layout decides (precision, telemetry, optional fields), and of the messages of a link test.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "proto/wire/wire_codec.h"
#include "tests/proto/wire/wire_comparison.h"
#include "tests/proto/wire/wire_samples.h"

namespace tandem::wire {
namespace {

/// Single precision: at most 2^-24 of the magnitude; energies are exact.
TEST(WireCodec, RoundsByItsStatedBoundAndKeepsEnergiesExact) {
  const Codec codec(3, PortSpace::kTip);
  Buffer buffer;
  const auto near = [](const AxisArray& got, const AxisArray& sent) {
    for (std::size_t a = 0; a < 3; ++a) EXPECT_LE(std::abs(got[a] - sent[a]), std::ldexp(std::abs(sent[a]), -24));
  };
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    StateMessage state = samples::state(random, 3);
    ForceMessage force = samples::force(random, 3);
    for (PortSample* p : {&state.port, &force.port})
      for (std::size_t a = 0; a < 3; ++a) {
        const double scale = std::pow(10, random.uniform(-6, 0));
        p->x[a] = scale * random.uniform(-10, 10);
        p->v[a] = scale * random.uniform(-100, 100);
        p->f[a] = scale * random.uniform(-1e4, 1e4);
        p->a[a] = scale * random.uniform(-1e5, 1e5);
      }
    const auto s = codec.decode_state(view(buffer, codec.encode({}, state, buffer)));
    ASSERT_TRUE(s);
    near(s->message.port.x, state.port.x);
    near(s->message.port.v, state.port.v);
    near(s->message.port.f, state.port.f);
    near(s->message.port.a, state.port.a);
    EXPECT_EQ(s->message.port.e_in, state.port.e_in);
    EXPECT_EQ(s->message.telemetry.e_out, state.telemetry.e_out);
    force.alpha = random.uniform();
    const auto f = codec.decode_force(view(buffer, codec.encode({}, force, buffer)));
    ASSERT_TRUE(f);
    near(f->message.port.x, force.port.x);
    near(f->message.port.v, force.port.v);
    near(f->message.port.f, force.port.f);
    EXPECT_EQ(f->message.port.e_in, force.port.e_in);
    EXPECT_EQ(f->message.alpha, force.alpha);
  }
}

/// The flow sources SEED and SEED_SIGNED compare an energy with 0, so nothing is rounded there.
TEST(WireCodec, RoundsNothingInAnExactLayout) {
  for (std::size_t axes = 1; axes <= kAxesMax; ++axes) {
    const BodyLayout layout{.axes = axes, .port = PortSpace::kJoint, .tool_copies = false, .exact = true};
    const Codec codec(layout);
    Buffer buffer;
    RandomStream random(axes);
    StateMessage state = samples::state(random, axes);
    ForceMessage force = samples::force(random, axes);
    for (PortSample* p : {&state.port, &force.port})
      for (std::size_t a = 0; a < axes; ++a) p->x[a] = random.uniform(-1, 1), p->v[a] = random.uniform(-1, 1);
    for (const bool telemetry : {false, true}) {
      state.with_telemetry = telemetry;
      const std::size_t size = codec.encode({}, state, buffer);
      EXPECT_EQ(size, state_size(layout, telemetry));
      const auto got = codec.decode_state(view(buffer, size));
      ASSERT_TRUE(got);
      expect_same(got->message.port, state.port);
    }
    const std::size_t size = codec.encode({}, force, buffer);
    EXPECT_EQ(size, force_size(layout));
    const auto got = codec.decode_force(view(buffer, size));
    ASSERT_TRUE(got);
    expect_same(got->message.port, force.port);
    for (std::size_t cut = 0; cut < size; ++cut) EXPECT_FALSE(codec.decode_force(view(buffer, cut)));
    force.port.x[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(codec.decode_force(view(buffer, codec.encode({}, force, buffer))).error(), DecodeError::kNotFinite);
  }
}

TEST(WireCodec, KeepsTheTelemetryThatADatagramDoesNotCarry) {
  const Codec codec(3, PortSpace::kTip);
  Buffer buffer;
  RandomStream random(3);
  StateMessage sent = samples::state(random, 3), got = samples::state(random, 3);
  const Telemetry before = got.telemetry;
  sent.with_telemetry = false;
  const std::size_t size = codec.encode({}, sent, buffer);
  ASSERT_EQ(size, state_size(samples::tip(3), false));
  ASSERT_TRUE(codec.decode_state(view(buffer, size), got));
  EXPECT_FALSE(got.with_telemetry);
  EXPECT_EQ(got.port.x, sent.port.x);
  EXPECT_EQ(got.telemetry.q, before.q);
  EXPECT_EQ(got.telemetry.e_out, before.e_out);
  EXPECT_EQ(got.telemetry.gate_trips, before.gate_trips);

  // Bit 7 of the flags and the size must agree.
  constexpr std::size_t kFlagsAt = 16 + 3 * 14 + 26 + 1;
  buffer[kFlagsAt] ^= std::byte{0x80};
  EXPECT_EQ(codec.decode_state(view(buffer, size)).error(), DecodeError::kOutOfRange);
  sent.with_telemetry = true;
  const std::size_t whole = codec.encode({}, sent, buffer);
  EXPECT_TRUE(codec.decode_state(view(buffer, whole)));
  buffer[kFlagsAt] ^= std::byte{0x80};
  EXPECT_EQ(codec.decode_state(view(buffer, whole)).error(), DecodeError::kOutOfRange);
}

/// The layout comes from the seat's setup; bytes that announce other parts are rejected.
TEST(WireCodec, RejectsPartsThatTheLayoutHasNot) {
  const BodyLayout plain{.axes = 3, .port = PortSpace::kTip, .tool_copies = false, .environment = false};
  const Codec sender(3, PortSpace::kTip), receiver(plain);
  Buffer buffer;
  RandomStream random(4);
  StateMessage state = samples::state(random, 3);
  for (const bool telemetry : {false, true}) {
    state.with_telemetry = telemetry;
    EXPECT_EQ(receiver.decode_state(view(buffer, sender.encode({}, state, buffer))).error(), DecodeError::kSize);
    EXPECT_EQ(sender.decode_state(view(buffer, receiver.encode({}, state, buffer))).error(), DecodeError::kSize);
  }
  ForceMessage force = samples::force(random, 3);
  EXPECT_TRUE(receiver.decode_force(view(buffer, sender.encode({}, force, buffer))));
  ForceMessage ghost = force, surfaces = force, pull = force;
  ghost.ghost = samples::ghost(random);
  surfaces.contacts.add(samples::contact(random, 3, 1));
  pull.slave_pull = 1;
  for (const ForceMessage& m : {ghost, surfaces, pull}) {
    EXPECT_EQ(receiver.encode({}, m, buffer), 0u);
    const std::size_t size = sender.encode({}, m, buffer);
    EXPECT_TRUE(sender.decode_force(view(buffer, size)));
    EXPECT_EQ(receiver.decode_force(view(buffer, size)).error(), DecodeError::kSize);
  }
}

TEST(WireCodec, RoundTripsLinkTestMessages) {
  const Codec codec(3, PortSpace::kTip);
  Buffer buffer;
  RandomStream random(2);
  const Preamble preamble = samples::preamble(random);
  const std::size_t probe = codec.encode(preamble, LinkProbe{}, buffer);
  ASSERT_TRUE(codec.decode_link_probe(view(buffer, probe)));
  expect_same(codec.decode_link_probe(view(buffer, probe))->preamble, preamble);
  buffer[probe - 1] = std::byte{1};
  EXPECT_EQ(codec.decode_link_probe(view(buffer, probe)).error(), DecodeError::kMalformed) << "padding is zero";
  const std::size_t report = codec.encode(preamble, LinkReport{5, 4294967295U}, buffer);
  const auto got = codec.decode_link_report(view(buffer, report));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->message.used, 5u);
  EXPECT_EQ(got->message.late, 4294967295U);
  EXPECT_FALSE(codec.decode_force(view(buffer, report)));
  EXPECT_FALSE(codec.decode_link_report(view(buffer, report - 1)));
}

}  // namespace
}  // namespace tandem::wire
