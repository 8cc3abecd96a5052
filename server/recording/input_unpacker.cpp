#include "server/recording/input_unpacker.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "common/mcap/byte_order.h"
#include "server/recording/input_block.h"
#include "server/recording/lesson_record.h"

namespace tandem::server {
namespace {

using namespace input_block;
using mcap::FieldReader;

/// Rows of a group, one after the other.
struct Table {
  std::size_t length = 0, next = 0;  ///< of a row [bytes]; row that was not used yet
  std::vector<std::byte> bytes;
};

struct PlacedLane : Lane {
  std::span<const std::byte> bytes;  ///< its planes
};

bool of_seat(const Lane& lane) noexcept {
  return lane.prediction == Prediction::kSeatValue || lane.prediction == Prediction::kFilter;
}

/// Rows of one seat with session ticks from `first` to `last`.
SeatRows rows_of(const Lesson& lesson, std::size_t seat, std::uint32_t first, std::uint32_t last) {
  SeatRows out;
  const auto begin = std::ranges::lower_bound(lesson.tick, first);
  const double scale = lesson.scene.seats[seat].motion_scale;
  for (auto row = static_cast<std::size_t>(begin - lesson.tick.begin());
       row < lesson.rows() && lesson.tick[row] <= last; ++row) {
    const SeatRecord record = seat_record(lesson, seat, row);
    out.add(record.sample_tick, seat_values(record, scale));
  }
  return out;
}

/// Reads the lanes of a row of `length` bytes. @return whether they are valid
bool read_lanes(FieldReader& fields, std::size_t length, std::vector<PlacedLane>& lanes) {
  for (std::size_t at = 0; at < length; at += lanes.back().width) {
    const unsigned code = fields.number<std::uint8_t>();
    PlacedLane lane;
    lane.at = at;
    lane.width = std::size_t{1} << (code >> 2 & 3);
    lane.planes = code >> 4;
    lane.prediction = static_cast<Prediction>(code & 3);
    const bool filter = lane.prediction == Prediction::kFilter;
    if (of_seat(lane)) lane.value = fields.number<std::uint8_t>();
    if (filter) {
      lane.keep = std::bit_cast<double>(fields.number<std::uint64_t>());
      lane.gain = std::bit_cast<double>(fields.number<std::uint64_t>());
    }
    const std::size_t values = lane.width == 4              ? SeatValues::kWords
                               : lane.width == 8 && !filter ? SeatValues::kLongs
                                                            : 0;
    if (!fields.ok() || lane.planes > lane.width || lane.width > length - at || (of_seat(lane) && lane.value >= values))
      return false;
    lanes.push_back(lane);
  }
  return true;
}

void fill_lane(const PlacedLane& lane, const std::vector<const SeatValues*>& values, std::size_t rows, Table& table) {
  std::uint64_t back = load(&table.bytes[lane.at], lane.width), back2 = back;
  for (std::size_t r = 1; r < rows; ++r) {
    std::uint64_t z = 0;
    for (std::size_t plane = 0; plane < lane.planes; ++plane)
      z |= std::to_integer<std::uint64_t>(lane.bytes[plane * (rows - 1) + r - 1]) << (8 * plane);
    const std::uint64_t value =
        (predict(lane, back, back2, values.empty() ? nullptr : values[r - 1], values.empty() ? nullptr : values[r]) +
         unfold(z, lane.width)) &
        mask(lane.width);
    std::memcpy(&table.bytes[r * table.length + lane.at], &value, lane.width);
    back2 = std::exchange(back, value);
  }
}

/// Reads a group of so many rows. @return whether it is whole
bool read_group(FieldReader& fields, const Lesson& lesson, std::uint32_t first, std::uint32_t last, std::size_t rows,
                std::size_t room, Table& table) {
  const std::size_t seat = fields.number<std::uint8_t>();
  table.length = fields.number<std::uint16_t>();
  const std::size_t key = fields.number<std::uint16_t>();
  if (!fields.ok() || rows == 0 || table.length == 0 || table.length > room / rows) return false;
  std::vector<PlacedLane> lanes;
  if (!read_lanes(fields, table.length, lanes)) return false;
  const auto first_row = fields.take(table.length);
  for (PlacedLane& lane : lanes) lane.bytes = fields.take(std::uint64_t{lane.planes} * (rows - 1));
  if (!fields.ok()) return false;
  table.bytes.resize(rows * table.length);
  std::ranges::copy(first_row, table.bytes.begin());
  std::vector<const SeatValues*> values;
  SeatRows seat_rows;
  if (key != kNoKey) {
    const auto lane = std::ranges::find(lanes, key, &PlacedLane::at);
    if (lane == lanes.end() || lane->width != 4 || of_seat(*lane) || seat >= lesson.seats.size()) return false;
    fill_lane(*lane, values, rows, table);
    seat_rows = rows_of(lesson, seat, first, last);
    const SeatValues* before = nullptr;
    for (std::size_t r = 0; r < rows; ++r) {
      before = seat_rows.of(static_cast<std::uint32_t>(load(&table.bytes[r * table.length + key], 4)), before);
      values.push_back(before);
    }
  }
  for (const PlacedLane& lane : lanes) fill_lane(lane, values, rows, table);
  return true;
}

}  // namespace

std::optional<std::span<const std::byte>> InputUnpacker::unpack(std::span<const std::byte> block) {
  FieldReader fields{block};
  const auto position = fields.take(sizeof(std::uint64_t));
  const auto first = fields.number<std::uint32_t>(), last = fields.number<std::uint32_t>();
  const auto order = fields.take(fields.number<std::uint32_t>());
  if (!fields.ok()) return std::nullopt;
  std::array<std::size_t, kGroupsMax + 1> rows{};
  std::vector<std::span<const std::byte>> plain;
  std::size_t size = 0;
  for (const std::byte group : order) {
    ++rows[std::to_integer<std::size_t>(group)];
    if (group != std::byte{kPlain}) continue;
    plain.push_back(fields.take(fields.number<std::uint32_t>()));
    size += plain.back().size();
  }
  std::vector<Table> tables(fields.number<std::uint8_t>());
  if (!fields.ok()) return std::nullopt;
  for (std::size_t g = tables.size(); g < kPlain; ++g)
    if (rows[g] > 0) return std::nullopt;
  for (std::size_t g = 0; g < tables.size(); ++g) {
    if (size > kPieceMax || !read_group(fields, *lesson_, first, last, rows[g], kPieceMax - size, tables[g]))
      return std::nullopt;
    size += tables[g].bytes.size();
  }
  if (!fields.ok() || !fields.empty()) return std::nullopt;
  piece_.assign(position.begin(), position.end());
  piece_.reserve(position.size() + size);
  auto next_plain = plain.begin();
  for (const std::byte group : order) {
    std::span<const std::byte> record;
    if (group == std::byte{kPlain}) {
      record = *next_plain++;
    } else {
      Table& table = tables[std::to_integer<std::size_t>(group)];
      record = std::span{table.bytes}.subspan(table.next++ * table.length, table.length);
    }
    piece_.insert(piece_.end(), record.begin(), record.end());
  }
  return piece_;
}

}  // namespace tandem::server
