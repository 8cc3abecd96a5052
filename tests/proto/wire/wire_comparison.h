#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <span>

#include "proto/wire/wire_codec.h"

/// Buffers of the codec, and comparison of the parts that all messages share, for tests.
namespace tandem::wire {

using Buffer = std::array<std::byte, kPlaintextMax>;

/// Returns the first `size` bytes of a buffer.
inline std::span<const std::byte> view(const Buffer& buffer, std::size_t size) { return std::span(buffer).first(size); }

inline void expect_same(const Preamble& a, const Preamble& b) {
  EXPECT_EQ(a.echo_counter, b.echo_counter);
  EXPECT_EQ(a.echo_age_us, b.echo_age_us);
  EXPECT_EQ(a.tick, b.tick);
}
/// Compares everything but the acceleration, which FORCE and ports of more than three axes do not carry.
inline void expect_same(const PortSample& a, const PortSample& b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.f, b.f);
  EXPECT_EQ(a.e_in, b.e_in);
}

}  // namespace tandem::wire
