#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/base/axes.h"
#include "proto/recording/protobuf_fields.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// Bits of the numbers of a seat's record that a datagram of the seat may repeat, as datagrams carry them.
struct SeatValues {
  static constexpr std::size_t kWords = 32, kLongs = std::size_t{4} * 3 + 3 * kAxesMax;
  std::array<std::uint32_t, kWords> words{};  ///< numbers in single precision
  /// Energies e_in, e_out [nJ]; then numbers in double precision: x, v, f_cmd, f_out, q. NaN is 0.
  std::array<std::uint64_t, kLongs> longs{};
};

/// @param scale  motion scale of the seat: datagrams have the device's own motion and forces too
[[nodiscard]] inline SeatValues seat_values(const SeatRecord& r, double scale) noexcept {
  SeatValues out;
  std::size_t at = 0;
  const auto put = [&](double value) { out.words[at++] = std::bit_cast<std::uint32_t>(rec::to_single(value)); };
  for (const Triple* triple : {&r.x, &r.v, &r.f_cmd, &r.f_out})
    for (const double value : *triple) put(value);
  for (const double value : r.q) put(value);
  for (const double value : {r.dissipated_j, r.refused_j, r.margin_min_j, r.delivered_j}) put(value);
  for (const double value : r.x) put(value / scale);
  for (const double value : r.f_cmd) put(value * scale);
  for (const double value : r.f_out) put(value * scale);
  static_assert(SeatValues::kWords == std::size_t{4} * 3 + kAxesMax + 4 + std::size_t{3} * 3);
  for (std::size_t a = 0; a < kAxesMax; ++a) {
    out.longs[a] = r.e_in[a];
    out.longs[kAxesMax + a] = r.e_out[a];
  }
  at = 2 * kAxesMax;
  const auto put_long = [&](double value) {
    out.longs[at++] = std::isnan(value) ? 0 : std::bit_cast<std::uint64_t>(value);
  };
  for (const Triple* triple : {&r.x, &r.v, &r.f_cmd, &r.f_out})
    for (const double value : *triple) put_long(value);
  for (const double value : r.q) put_long(value);
  return out;
}

/// Values of one seat over some rows of a recording, found by the tick of its sample.
class SeatRows {
 public:
  void add(std::uint32_t sample_tick, const SeatValues& values) {
    by_sample_.try_emplace(sample_tick, static_cast<std::uint32_t>(rows_.size()));
    rows_.emplace_back(sample_tick, values);
  }
  /// Values of the first row with this sample; those of `before` if there is none.
  [[nodiscard]] const SeatValues* of(std::uint32_t sample_tick, const SeatValues* before) const {
    const auto found = by_sample_.find(sample_tick);
    return found == by_sample_.end() ? before : &rows_[found->second].second;
  }
  [[nodiscard]] bool has(std::uint32_t sample_tick) const { return by_sample_.contains(sample_tick); }
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }
  /// Removes all rows but the last `n`.
  void keep_last(std::size_t n) {
    if (rows_.size() > n) rows_.erase(rows_.begin(), rows_.end() - static_cast<std::ptrdiff_t>(n));
    by_sample_.clear();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      by_sample_.try_emplace(rows_[i].first, static_cast<std::uint32_t>(i));
  }

 private:
  std::vector<std::pair<std::uint32_t, SeatValues>> rows_;
  std::unordered_map<std::uint32_t, std::uint32_t> by_sample_;
};

}  // namespace tandem::server
