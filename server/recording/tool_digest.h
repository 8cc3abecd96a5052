#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "common/base/rng.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// Digest of the values of tools, bit for bit, over some ticks. Two sequences that differ in one bit have different
/// digests, others by chance in 2^64. It is no defence against forgery.
class ToolDigest {
 public:
  /// @param tools  number of tools of the scene
  void add(const TickRecord& record, std::size_t tools) noexcept {
    add(record.tick);
    for (std::size_t j = 0; j < tools; ++j) {
      const ToolRecord& tool = record.tools[j];
      for (const Triple* values : {&tool.x, &tool.x_tool, &tool.f_cmd, &tool.f_env, &tool.e_p_axis_j})
        for (const double value : *values) add(std::bit_cast<std::uint64_t>(value));
      for (const double value : tool.q) add(std::bit_cast<std::uint64_t>(value));
      for (const double value : {tool.penetration, tool.mfs_j, tool.e_p_j}) add(std::bit_cast<std::uint64_t>(value));
    }
  }
  /// Returns the digest of the ticks since the last call; 0: there were none.
  [[nodiscard]] std::uint64_t take() noexcept { return std::exchange(value_, 0); }

 private:
  void add(std::uint64_t bits) noexcept { value_ = mix64(value_ + bits) | 1; }

  std::uint64_t value_ = 0;
};

}  // namespace tandem::server
