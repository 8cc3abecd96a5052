#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "tests/proto/wire/wire_samples.h"
#include "tests/support/alloc_guard.h"

/// Hostile bytes: every prefix, every flipped byte and bit, noise. The result is an error or a message in range.
namespace tandem::wire {
namespace {

using Bytes = std::vector<std::byte>;

void expect_in_range(const PortSample& p, double x_max) {
  for (std::size_t i = 0; i < kAxesMax; ++i) {
    ASSERT_LE(std::abs(p.x[i]), x_max);
    ASSERT_LE(std::abs(p.v[i]), kVelocityMax);
    ASSERT_LE(std::abs(p.f[i]), kEffortMax);
    ASSERT_LE(p.e_in[i], kEnergyMax);
  }
}

struct Case {
  std::string name;
  Bytes bytes;
  bool (*decode)(Codec&, std::span<const std::byte>);
};

std::vector<Case> cases(Codec& codec) {
  RandomStream random(11);
  std::array<std::byte, kPlaintextMax> buffer;
  const auto bytes = [&](const auto& message) {
    const auto size = codec.encode(samples::preamble(random), message, buffer);
    return Bytes(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
  };
  return {
      {"STATE", bytes(samples::state(random, 3)),
       [](Codec& c, std::span<const std::byte> in) {
         const auto got = c.decode_state(in);
         if (got) {
           expect_in_range(got->message.port, kPositionMaxM);
           EXPECT_LE(got->message.gate, GateState::kFault);
           for (const double v : got->message.telemetry.x) EXPECT_TRUE(std::isfinite(v));
         }
         return got.has_value();
       }},
      {"STATE without telemetry", bytes([&] {
         StateMessage m = samples::state(random, 3);
         m.with_telemetry = false;
         return m;
       }()),
       [](Codec& c, std::span<const std::byte> in) {
         const auto got = c.decode_state(in);
         if (got) expect_in_range(got->message.port, kPositionMaxM);
         return got.has_value();
       }},
      {"FORCE", bytes(samples::force(random, 3)),
       [](Codec& c, std::span<const std::byte> in) {
         const auto got = c.decode_force(in);
         if (got) {
           expect_in_range(got->message.port, kPositionMaxM);
           EXPECT_TRUE(got->message.alpha >= 0 && got->message.alpha <= 1);
           EXPECT_LE(got->message.session, SessionState::kOverloaded);
         }
         return got.has_value();
       }},
      {"FORCE with contacts", bytes([&] {
         ForceMessage m = samples::force(random, 3);
         for (std::uint32_t id = 1; id <= kLocalContactsMax; ++id) m.contacts.add(samples::contact(random, 3, id));
         return m;
       }()),
       [](Codec& c, std::span<const std::byte> in) {
         const auto got = c.decode_force(in);
         if (got) {
           EXPECT_LE(got->message.contacts.size, kLocalContactsMax);
           for (const LocalContact& contact : got->message.contacts.all())
             EXPECT_TRUE(is_surface(contact, 3) && in_range(contact));
         }
         return got.has_value();
       }},
      {"STATE with ties",
       [&] {
         Codec several(3, PortSpace::kTip, 2);
         const StateMessage m = samples::state(random, 3);
         const auto ties = samples::tie_states(random, 3, 2);
         const auto size = several.encode({}, StateWithTools{m, ties}, buffer);
         return Bytes(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
       }(),
       [](Codec&, std::span<const std::byte> in) {
         const Codec several(3, PortSpace::kTip, 2);
         StateMessage m;
         std::array<PortSample, 2> ties;
         const bool got = several.decode_state(in, m, ties).has_value();
         if (got)
           for (const PortSample& tie : ties) expect_in_range(tie, kPositionMaxM);
         return got;
       }},
      {"FORCE with ties",
       [&] {
         Codec several(3, PortSpace::kTip, 2);
         ForceMessage m = samples::force(random, 3);
         m.contacts.add(samples::contact(random, 3, 1));
         const auto ties = samples::tie_forces(random, 3, 2, 4);
         const auto size = several.encode({}, ForceWithTools{m, ties}, buffer);
         return Bytes(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
       }(),
       [](Codec&, std::span<const std::byte> in) {
         const Codec several(3, PortSpace::kTip, 2);
         std::array<ToolForce, 2> ties;
         const auto got = several.decode_force(in, ties);
         if (got)
           for (const ToolForce& tie : ties) {
             expect_in_range(tie.port, kPositionMaxM);
             EXPECT_TRUE(tie.alpha >= 0 && tie.alpha <= 1 && tie.slave_pull >= 0 && tie.slave_pull <= 1);
             EXPECT_LE(tie.contacts.size, kLocalContactsMax);
             for (const LocalContact& contact : tie.contacts.all())
               EXPECT_TRUE(is_surface(contact, 3) && in_range(contact));
           }
         return got.has_value();
       }},
      {"FORCE with a ghost", bytes([&] {
         ForceMessage m = samples::force(random, 3);
         m.contacts.add(samples::contact(random, 3, 1));
         m.ghost = samples::ghost(random);
         return m;
       }()),
       [](Codec& c, std::span<const std::byte> in) {
         const auto got = c.decode_force(in);
         if (got) {
           EXPECT_LE(got->message.ghost.leader, kMastersMax);
           for (const float x : got->message.ghost.x) EXPECT_LE(std::abs(x), kPositionMaxM);
           for (const float v : got->message.ghost.v) EXPECT_LE(std::abs(v), kVelocityMax);
         }
         return got.has_value();
       }},
      {"PATH", bytes(samples::path(random)),
       [](Codec& c, std::span<const std::byte> in) { return c.decode_path(in).has_value(); }},
      {"AUTHORITY", bytes(samples::authority(random)),
       [](Codec& c, std::span<const std::byte> in) {
         const auto got = c.decode_authority(in);
         if (got) {
           EXPECT_TRUE(got->message.tool < kToolsMax && got->message.masters <= kMastersMax);
         }
         return got.has_value();
       }},
      {"LINK_PROBE", bytes(LinkProbe{}),
       [](Codec& c, std::span<const std::byte> in) { return c.decode_link_probe(in).has_value(); }},
      {"LINK_REPORT", bytes(LinkReport{7, 9}),
       [](Codec& c, std::span<const std::byte> in) { return c.decode_link_report(in).has_value(); }},
      {"CLOSE", bytes(CloseMessage{}),
       [](Codec& c, std::span<const std::byte> in) { return c.decode_close(in).has_value(); }},
  };
}

TEST(WireHostile, RejectsPrefixesAndExtensions) {
  Codec codec(3, PortSpace::kTip);
  for (const auto& c : cases(codec)) {
    SCOPED_TRACE(c.name);
    ASSERT_TRUE(c.decode(codec, c.bytes));
    for (std::size_t size = 0; size < c.bytes.size(); ++size) {
      // A buffer of its own, so that sanitizers detect a read beyond its end.
      const Bytes prefix(c.bytes.begin(), c.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_FALSE(c.decode(codec, prefix)) << size;
    }
    for (const std::size_t more : {1u, 2u, 8u, 100u}) {
      Bytes longer = c.bytes;
      longer.resize(longer.size() + more);
      EXPECT_FALSE(c.decode(codec, longer)) << more;
    }
  }
}

TEST(WireHostile, GivesAnErrorOrAValidMessageForEveryFlippedByte) {
  Codec codec(3, PortSpace::kTip);
  for (const auto& c : cases(codec)) {
    SCOPED_TRACE(c.name);
    for (std::size_t at = 0; at < c.bytes.size(); ++at) {
      for (int value = 0; value < 256; ++value) {
        Bytes changed = c.bytes;
        changed[at] = static_cast<std::byte>(value);
        c.decode(codec, changed);
      }
    }
    EXPECT_TRUE(c.decode(codec, c.bytes)) << "the codec has taken no harm";
  }
}

/// The tags and lengths of a message with a fixed layout have exactly one valid value.
TEST(WireHostile, ReportsChangedStructureAsMalformed) {
  Codec codec(3, PortSpace::kTip);
  const auto all = cases(codec);
  const auto of = [&](std::string_view name) -> const Case& { return *std::ranges::find(all, name, &Case::name); };
  // FORCE, 3 axes: tag and length of x, v, f, e_in, then tags of four fixed32, a double and a fixed32.
  const std::vector<std::size_t> structure{16, 17, 30, 31, 44, 45, 58, 59, 84, 89, 94, 99, 104, 113};
  const Case& force = of("FORCE");
  ASSERT_EQ(force.bytes.size(), 118u);
  for (const auto at : structure) {
    for (int value = 0; value < 256; ++value) {
      Bytes changed = force.bytes;
      if (changed[at] == static_cast<std::byte>(value)) continue;
      changed[at] = static_cast<std::byte>(value);
      const auto got = codec.decode_force(changed);
      ASSERT_FALSE(got.has_value());
      EXPECT_EQ(got.error(), DecodeError::kMalformed) << at << " " << value;
    }
  }
}

/// Some bits of the words in STATE and FORCE must be 0.
TEST(WireHostile, RejectsUndefinedBits) {
  Codec codec(3, PortSpace::kTip);
  const auto all = cases(codec);
  const auto of = [&](std::string_view name) -> const Case& { return *std::ranges::find(all, name, &Case::name); };
  constexpr std::size_t kSurfacesAt = 119, kSessionAt = 85, kForceFlagsAt = 90, kStateFlagsAt = 85;
  for (std::uint32_t bit = 0; bit < 32; ++bit) {
    Bytes changed = of("FORCE with contacts").bytes;
    changed[kSurfacesAt + bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_EQ(codec.decode_force(changed).has_value(), bit >= 8 && bit < 24) << bit;
  }
  for (std::uint32_t bit = 7; bit < 32; ++bit) {
    Bytes changed = of("STATE").bytes;
    changed[kStateFlagsAt + bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_FALSE(codec.decode_state(changed).has_value()) << bit;
  }
  for (std::uint32_t bit = 17; bit < 32; ++bit) {
    Bytes changed = of("FORCE").bytes;
    changed[kSessionAt + bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_FALSE(codec.decode_force(changed).has_value()) << bit;
  }
  Bytes none = of("FORCE").bytes;
  none[kForceFlagsAt + 3] ^= static_cast<std::byte>(1U << 5);  // bit 29 of the flags: surface fields follow
  EXPECT_FALSE(codec.decode_force(none).has_value());
}

TEST(WireHostile, DecodesNoiseOfTheRightSizeWithoutHeap) {
  Codec codec(3, PortSpace::kTip);
  const auto all = cases(codec);
  for (std::size_t i = 0; i < all.size(); ++i) {
    SCOPED_TRACE(all[i].name);
    Bytes noise = all[i].bytes;
    RandomStream random(i + 1);
    const test::AllocGuard guard;
    int accepted = 0;
    for (int round = 0; round < 20000; ++round) {
      for (auto& byte : noise) byte = static_cast<std::byte>(random.bits());
      accepted += all[i].decode(codec, noise) ? 1 : 0;
    }
    EXPECT_EQ(guard.count(), 0u);
    if (all[i].name != "PATH") {  // all bytes of a PATH but one are values; it is sealed like all messages
      EXPECT_EQ(accepted, 0);
    }
  }
}

TEST(WireHostile, RejectsNoiseOfAnySize) {
  Codec codec(3, PortSpace::kTip);
  const auto all = cases(codec);
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    RandomStream random(seed);
    Bytes noise(static_cast<std::size_t>(random.below(1300)));
    for (auto& byte : noise) byte = static_cast<std::byte>(random.bits());
    for (const auto& c : all) EXPECT_FALSE(c.decode(codec, noise)) << c.name << " seed " << seed;
  }
}

}  // namespace
}  // namespace tandem::wire
