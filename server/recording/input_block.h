#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "server/recording/seat_values.h"

/// Layout of a block of inputs: the data of a message tandem.recording.Inputs. It has a piece of the input journal
/// (server/session/input_records.h) without loss, arranged so that zstd finds little in it. A STATE repeats the numbers
/// that the recording has of its seat, and most others change slowly.
///
/// Records of the journal that are alike form a group: a table with a row per record and equal lengths. A lane is a
/// column of 1, 4 or 8 bytes of it. Its values are predicted, and the block has the differences, lowest bytes of all
/// rows first. All numbers are little-endian and unsigned:
///
///   u64 position of the piece in the journal [bytes]
///   u32 first, u32 last: session ticks of the rows of the recording that predict values; first > last: none
///   u32 n, n x u8: the group of each record, in their order; kPlain: it belongs to none
///   for each record without a group: u32 length, its bytes
///   u8 number of groups, then for each:
///     u8 seat whose rows predict values; kNoSeat: none
///     u16 length of a row, u16 place of the key in it (kNoKey: none)
///     lanes from the first byte of a row to its end, each: u8 code; with kSeatValue and kFilter u8 index of the value;
///       with kFilter f64 keep, f64 gain
///     the bytes of the first row
///     for each lane, for each of its planes: u8 of every row but the first
///
/// Code of a lane: bits 0-1 Prediction, bits 2-3 logarithm of its width to base 2, bits 4-7 number of planes. A
/// difference d of w bytes has d = 2^(8w) - (z + 1) / 2 for odd z and z / 2 for even z; planes have the bytes of z from
/// the lowest one on, the other bytes are 0. A value is its prediction plus d, modulo 2^(8w).
///
/// The key of a row is the u32 at its place: a sample tick of the seat. Values of the seat are those of the first row
/// of the recording with this sample; of the row before if there is none, and 0 if that has none either.
namespace tandem::server::input_block {

enum class Prediction : std::uint8_t {
  kPrevious = 0,   ///< the value of the row before
  kLinear = 1,     ///< twice that value minus the one before it; in the second row as kPrevious
  kSeatValue = 2,  ///< a number of the seat: SeatValues::words for 4 bytes, SeatValues::longs for 8
  kFilter = 3,     ///< keep * the value before + gain * the change of a number of the seat, all as floats, computed in
                   ///< doubles; NaN counts as 0. It predicts the filtered acceleration of a hand from its velocity
};

inline constexpr std::uint8_t kPlain = 255, kNoSeat = 255;
inline constexpr std::size_t kGroupsMax = 255;
inline constexpr std::uint16_t kNoKey = 0xffff;
inline constexpr std::size_t kHead = 8 + 4 + 4;                  ///< [bytes]
inline constexpr std::size_t kPieceMax = std::size_t{64} << 20;  ///< longest piece that is read [bytes]

struct Lane {
  std::size_t at = 0, width = 1, planes = 0;
  Prediction prediction = Prediction::kPrevious;
  std::uint8_t value = 0;     ///< of the seat
  double keep = 0, gain = 0;  ///< of kFilter
};

[[nodiscard]] inline std::uint64_t load(const std::byte* at, std::size_t width) noexcept {
  std::uint64_t value = 0;
  std::memcpy(&value, at, width);
  return value;
}
[[nodiscard]] constexpr std::uint64_t mask(std::size_t width) noexcept { return ~std::uint64_t{0} >> (64 - 8 * width); }

/// A number in single precision from its bits.
[[nodiscard]] inline double number_of(std::uint64_t bits) noexcept {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
}

/// @param back    value of the row before
/// @param back2   value two rows before; that of the row before in the second row
/// @param before  numbers of the seat in the row before; null: there are none, also for `values`
[[nodiscard]] inline std::uint64_t predict(const Lane& lane, std::uint64_t back, std::uint64_t back2,
                                           const SeatValues* before, const SeatValues* values) noexcept {
  switch (lane.prediction) {
    case Prediction::kPrevious:
      return back;
    case Prediction::kLinear:
      return (2 * back - back2) & mask(lane.width);
    case Prediction::kSeatValue:
      return values == nullptr ? 0 : lane.width == 4 ? values->words[lane.value] : values->longs[lane.value];
    case Prediction::kFilter: {
      if (values == nullptr || before == nullptr) return 0;
      const double change = number_of(values->words[lane.value]) - number_of(before->words[lane.value]);
      const double value = lane.keep * number_of(back) + lane.gain * change;
      return std::isnan(value) ? 0 : std::bit_cast<std::uint32_t>(rec::to_single(value));
    }
  }
  return 0;
}

/// z of a difference, and back.
[[nodiscard]] constexpr std::uint64_t fold(std::uint64_t difference, std::size_t width) noexcept {
  const std::uint64_t sign = difference >> (8 * width - 1) & 1;
  return ((difference << 1) ^ (0 - sign)) & mask(width);
}
[[nodiscard]] constexpr std::uint64_t unfold(std::uint64_t z, std::size_t width) noexcept {
  return ((z >> 1) ^ (0 - (z & 1))) & mask(width);
}

}  // namespace tandem::server::input_block
