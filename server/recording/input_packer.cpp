#include "server/recording/input_packer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "common/base/raw_bytes.h"
#include "common/mcap/byte_order.h"
#include "server/recording/input_block.h"
#include "server/session/input_records.h"

namespace tandem::server {
namespace {

using namespace input_block;
using mcap::put;

constexpr std::size_t kRowsAlike = 8;    // fewer records alike are no group
constexpr std::size_t kRowMax = 4096;    // [bytes]; longer records are in no group
constexpr std::size_t kSampleRows = 24;  // from which the lanes are chosen
constexpr std::size_t kKeysTried = 3;
constexpr std::size_t kBlocksLeast = 2;  // that use a division before another one is chosen,
constexpr std::size_t kBlocksMost = 8;   // and at most
constexpr std::size_t kWorseBytes = 10;  // tenths of a byte per row
constexpr std::size_t kNoisyBits = 10;   // of a value, from which a filter is tried
constexpr std::size_t kFiltered = 6;     // numbers of a seat that may be filtered: position and velocity
constexpr double kNearly = 1e-3;         // relative error of rows that follow a filter
constexpr std::size_t kLaneBits = 2;     // cost of a lane in each row, so that equal costs give wide lanes

/// Size of the record that the bytes begin with; zeros between two records are one. nullopt: it is not whole. 0: it is
/// none that the journal has.
std::optional<std::size_t> record_size(std::span<const std::byte> bytes) {
  const auto after = [&](std::size_t fixed, std::size_t at, std::size_t width,
                         std::size_t each) -> std::optional<std::size_t> {
    if (bytes.size() < at + width) return std::nullopt;
    return fixed + each * static_cast<std::size_t>(load(&bytes[at], width));
  };
  std::optional<std::size_t> size = 0;
  constexpr std::size_t kCommand = 1 + 8 + 1 + 1 + 4;
  switch (static_cast<InputRecord>(bytes[0])) {
    case InputRecord::kBegin:
      size = after(3, 1, 2, 1);
      break;
    case InputRecord::kAdmit:
      size = 1 + 1 + 1 + 8 + 4 * 4 + 1 + 5 * 8;
      break;
    case InputRecord::kDatagram: {
      const std::size_t flags = bytes.size() < 2 ? 0 : std::to_integer<std::size_t>(bytes[1]);
      size =
          after(6 + 8 + 8 + ((flags & input::kNewAddress) != 0 ? 8 : 0) + ((flags & input::kTokenTaken) != 0 ? 8 : 0),
                4, 2, 1);
      break;
    }
    case InputRecord::kStop:
    case InputRecord::kPause:
      size = kCommand;
      break;
    case InputRecord::kResume:
      size = kCommand + 4;
      break;
    case InputRecord::kAuthority:
      size = after(kCommand + 4 + 4 + 1, kCommand + 8, 1, 8);
      break;
    case InputRecord::kRemove:
      size = 3;
      break;
    case InputRecord::kEnd:
    case InputRecord::kContacts:
      size = 2;
      break;
    case InputRecord::kTick: {
      constexpr std::size_t kMask = 1 + 8 + 4;
      if (bytes.size() < kMask + 4) return std::nullopt;
      size = kMask + 4 + 2 * static_cast<std::size_t>(std::popcount(load(&bytes[kMask], 4)));
      break;
    }
    case InputRecord::kSettings:
      size = 1 + 1 + 1 + 4;
      break;
    case InputRecord::kOverflow:
      size = 1 + 8;
      break;
    default:
      if (bytes[0] == std::byte{0}) {
        const auto end = std::ranges::find_if(bytes, [](std::byte b) { return b != std::byte{0}; });
        return static_cast<std::size_t>(end - bytes.begin());
      }
      return 0;
  }
  return size && *size > bytes.size() ? std::nullopt : size;
}

/// Rows of equal length.
struct Rows {
  std::vector<const std::byte*> rows;
  std::size_t length = 0;
};

std::size_t bits(std::uint64_t z) noexcept { return static_cast<std::size_t>(std::bit_width(z)); }

/// Predicts the values of a group, and chooses the lanes for it.
class Predictor {
 public:
  Predictor(const Rows& group, const SeatRows* seat) : group_(&group), seat_(seat) {
    const std::size_t rows = group.rows.size(), step = std::max<std::size_t>(1, rows / kSampleRows);
    for (std::size_t r = std::min(step + 1, rows - 1); r < rows; r += step) sample_.push_back(r);
  }
  /// Chooses the lanes of least cost, and the key that they need.
  void choose(std::vector<Lane>& lanes, std::uint16_t& key) {
    lanes.clear();
    key = kNoKey;
    std::size_t least = divide(kNoKey, lanes);
    if (seat_ == nullptr || seat_->size() == 0) return;
    for (const std::uint16_t at : keys()) {
      std::vector<Lane> others;
      follow(at);
      const std::size_t cost = divide(at, others);
      if (cost >= least) continue;
      least = cost;
      lanes = std::move(others);
      key = at;
    }
  }
  /// Makes the numbers of the seat known that the key of each row finds.
  void follow(std::uint16_t key) {
    values_.clear();
    if (key == kNoKey || seat_ == nullptr) return;
    const SeatValues* before = nullptr;
    for (const std::byte* row : group_->rows) {
      before = seat_->of(static_cast<std::uint32_t>(load(row + key, 4)), before);
      values_.push_back(before);
    }
  }

  /// z of a lane in a row. @pre row > 0
  [[nodiscard]] std::uint64_t folded(const Lane& lane, std::size_t row) const noexcept {
    const auto value = [&](std::size_t r) { return load(group_->rows[r] + lane.at, lane.width); };
    const std::uint64_t back = value(row - 1), back2 = row > 1 ? value(row - 2) : back;
    const bool known = !values_.empty();
    const std::uint64_t expected =
        predict(lane, back, back2, known ? values_[row - 1] : nullptr, known ? values_[row] : nullptr);
    return fold((value(row) - expected) & mask(lane.width), lane.width);
  }

 private:
  /// Places whose number is the tick of a sample in most rows, the most frequent first.
  [[nodiscard]] std::vector<std::uint16_t> keys() const {
    std::vector<std::pair<std::size_t, std::uint16_t>> hits;
    for (std::size_t at = 0; at + 4 <= group_->length; ++at) {
      std::size_t count = 0;
      for (const std::size_t r : sample_)
        count += seat_->has(static_cast<std::uint32_t>(load(group_->rows[r] + at, 4))) ? 1 : 0;
      if (2 * count > sample_.size()) hits.emplace_back(sample_.size() - count, static_cast<std::uint16_t>(at));
    }
    std::ranges::sort(hits);
    std::vector<std::uint16_t> out;
    for (std::size_t i = 0; i < std::min(hits.size(), kKeysTried); ++i) out.push_back(hits[i].second);
    return out;
  }

  /// Bits of a lane in the sample rows; more than `limit` if it is no better.
  [[nodiscard]] std::size_t cost(const Lane& lane, std::size_t limit) const noexcept {
    std::size_t sum = kLaneBits * sample_.size();
    for (const std::size_t r : sample_) {
      sum += bits(folded(lane, r));
      if (sum > limit) break;
    }
    return sum;
  }

  /// Best lane of a width at a place. @param of_seat  numbers of the seat may predict it
  [[nodiscard]] std::pair<std::size_t, Lane> best(std::size_t at, std::size_t width, bool of_seat) const noexcept {
    Lane lane{.at = at, .width = width};
    std::pair<std::size_t, Lane> found{cost(lane, ~std::size_t{0} >> 1), lane};
    const auto attempt = [&] {
      if (const std::size_t c = cost(lane, found.first); c < found.first) found = {c, lane};
    };
    if (width == 1) return found;
    lane.prediction = Prediction::kLinear;
    attempt();
    if (values_.empty() || !of_seat) return found;
    lane.prediction = Prediction::kSeatValue;
    for (std::size_t k = 0; k < (width == 4 ? SeatValues::kWords : SeatValues::kLongs); ++k) {
      lane.value = static_cast<std::uint8_t>(k);
      attempt();
    }
    if (width != 4 || found.first < kNoisyBits * sample_.size()) return found;
    lane.prediction = Prediction::kFilter;
    for (std::size_t k = 0; k < kFiltered; ++k) {
      lane.value = static_cast<std::uint8_t>(k);
      if (fit(lane)) attempt();
    }
    return found;
  }

  /// Sets keep and gain of a lane so that most sample rows follow. @return false: they do not
  [[nodiscard]] bool fit(Lane& lane) const noexcept {
    struct Row {
      double back, change, value;
    };
    const auto row = [&](std::size_t r) -> Row {
      if (values_[r] == nullptr || values_[r - 1] == nullptr) return {};
      return {number_of(load(group_->rows[r - 1] + lane.at, 4)),
              number_of(values_[r]->words[lane.value]) - number_of(values_[r - 1]->words[lane.value]),
              number_of(load(group_->rows[r] + lane.at, 4))};
    };
    for (std::size_t k = 0; k + 1 < sample_.size(); k += 1 + kSampleRows / 4) {
      const Row a = row(sample_[k]), b = row(sample_[k + 1]);
      const double det = a.back * b.change - b.back * a.change;
      double keep = (a.value * b.change - b.value * a.change) / det, gain = (a.back * b.value - b.back * a.value) / det;
      if (!std::isfinite(keep) || !std::isfinite(gain)) continue;
      // Least squares over the rows that follow these two nearly.
      double bb = 0, bc = 0, cc = 0, bv = 0, cv = 0;
      std::size_t follow = 0;
      for (const std::size_t r : sample_) {
        const Row c = row(r);
        if (!(std::abs(keep * c.back + gain * c.change - c.value) <= kNearly * std::abs(c.value))) continue;
        ++follow;
        bb += c.back * c.back;
        bc += c.back * c.change;
        cc += c.change * c.change;
        bv += c.back * c.value;
        cv += c.change * c.value;
      }
      if (2 * follow < sample_.size()) continue;
      lane.keep = (bv * cc - cv * bc) / (bb * cc - bc * bc);
      lane.gain = (bb * cv - bc * bv) / (bb * cc - bc * bc);
      return std::isfinite(lane.keep) && std::isfinite(lane.gain);
    }
    return false;
  }

  /// Divides the row into the lanes of least cost. The key is a lane that needs no number of the seat.
  /// @return that cost [bits]
  std::size_t divide(std::size_t key, std::vector<Lane>& lanes) const {
    const std::size_t length = group_->length;
    std::vector<std::pair<std::size_t, Lane>> from(length + 1);
    for (std::size_t at = length; at-- > 0;) {
      from[at].first = ~std::size_t{0};
      for (const std::size_t width : {std::size_t{8}, std::size_t{4}, std::size_t{1}}) {
        if (at + width > length || (at < key && at + width > key) || (at == key && width != 4)) continue;
        const auto [bits, lane] = best(at, width, at != key);
        if (bits + from[at + width].first < from[at].first) from[at] = {bits + from[at + width].first, lane};
      }
    }
    for (std::size_t at = 0; at < length; at += lanes.back().width) lanes.push_back(from[at].second);
    return from[0].first;
  }

  const Rows* group_;
  const SeatRows* seat_;
  std::vector<std::size_t> sample_;        ///< rows from which the lanes are chosen
  std::vector<const SeatValues*> values_;  ///< of the seat for each row; empty without a key
};

}  // namespace

struct InputPacker::Group : Rows {
  std::uint8_t number = kPlain, seat = kNoSeat;
};

InputPacker::Kind InputPacker::kind_of(std::span<const std::byte> record) noexcept {
  Kind kind{record.size(), std::to_integer<std::size_t>(record[0]), 0, 0};
  if (record[0] == static_cast<std::byte>(InputRecord::kDatagram)) {
    kind[2] = std::to_integer<std::size_t>(record[1]);
    kind[3] = std::to_integer<std::size_t>(record[2]);
  }
  return kind;
}

void InputPacker::put_group(const Group& group, const std::vector<SeatRows>& seats, Division& division,
                            std::string& out) {
  const std::size_t rows = group.rows.size();
  Predictor predictor{group, group.seat < seats.size() ? &seats[group.seat] : nullptr};
  const bool worse =
      division.blocks >= kBlocksLeast && 10 * division.row_bytes > 10 * division.least_bytes + kWorseBytes;
  if (division.blocks == 0 || division.blocks >= kBlocksMost || worse) {
    predictor.choose(division.lanes, division.key);
    division.blocks = 0;
  }
  predictor.follow(division.key);
  std::string planes;
  std::vector<std::uint64_t> column(rows);
  put(out, group.seat);
  put(out, static_cast<std::uint16_t>(group.length));
  put(out, division.key);
  for (Lane& lane : division.lanes) {
    std::uint64_t all = 0;
    for (std::size_t r = 1; r < rows; ++r) all |= column[r] = predictor.folded(lane, r);
    lane.planes = (bits(all) + 7) / 8;
    put(out, static_cast<std::uint8_t>(static_cast<unsigned>(lane.prediction) |
                                       static_cast<unsigned>(std::countr_zero(lane.width)) << 2 | lane.planes << 4));
    const bool filter = lane.prediction == Prediction::kFilter;
    if (filter || lane.prediction == Prediction::kSeatValue) put(out, lane.value);
    if (filter)
      for (const double factor : {lane.keep, lane.gain}) put(out, std::bit_cast<std::uint64_t>(factor));
    for (std::size_t plane = 0; plane < lane.planes; ++plane)
      for (std::size_t r = 1; r < rows; ++r) planes += static_cast<char>(column[r] >> (8 * plane));
  }
  out.append(as_text(group.rows[0]), group.length);
  out += planes;
  division.row_bytes = planes.size() / rows;
  if (division.blocks++ == 0) division.least_bytes = division.row_bytes;
}

void InputPacker::add_row(const TickRecord& record) {
  ticks_.push_back(record.tick);
  for (std::size_t i = 0; i < seats_.size(); ++i)
    seats_[i].add(record.seats[i].sample_tick, seat_values(record.seats[i], scene_->seats[i].motion_scale));
}

bool InputPacker::add(std::span<const std::byte> piece) {
  if (piece.size() <= sizeof position_) return true;  // a piece without bytes
  const std::uint64_t position = load(piece.data(), sizeof position);
  if (bytes_.empty()) position_ = position;
  if (position != position_ + bytes_.size()) return false;
  bytes_.insert(bytes_.end(), piece.begin() + sizeof position, piece.end());
  return true;
}

void InputPacker::take(std::string& out, bool rest) {
  out.clear();
  std::vector<std::pair<std::span<const std::byte>, Group*>> records;
  std::map<Kind, Group> groups;
  std::size_t at = 0;
  while (at < bytes_.size()) {
    const std::span<const std::byte> left = std::span{bytes_}.subspan(at);
    const auto size = record_size(left);
    if (!size && !rest) break;
    const auto record = left.first(!size || *size == 0 ? left.size() : *size);
    at += record.size();
    records.emplace_back(record, nullptr);
    if (!size || *size == 0 || record.size() > kRowMax) continue;
    Group& group = groups[kind_of(record)];
    records.back().second = &group;
    group.length = record.size();
    group.rows.push_back(record.data());
    if (record[0] == static_cast<std::byte>(InputRecord::kDatagram))
      group.seat = std::to_integer<std::uint8_t>(record[1]) & input::kSeatMask;
  }
  if (!records.empty()) {
    put(out, position_);
    put(out, ticks_.empty() ? std::uint32_t{1} : ticks_.front());
    put(out, ticks_.empty() ? std::uint32_t{0} : ticks_.back());
    put(out, static_cast<std::uint32_t>(records.size()));
    std::uint8_t used = 0;
    for (auto& [kind, group] : groups)
      if (group.rows.size() >= kRowsAlike && used < kGroupsMax) group.number = used++;
    std::string plain;
    for (const auto& [record, group] : records) {
      const std::uint8_t number = group == nullptr ? kPlain : group->number;
      put(out, number);
      if (number != kPlain) continue;
      put(plain, static_cast<std::uint32_t>(record.size()));
      plain += text_of(record);
    }
    out += plain;
    put(out, used);
    for (const auto& [kind, group] : groups)
      if (group.number != kPlain) put_group(group, seats_, divisions_[kind], out);
    if (divisions_.size() > kGroupsMax) divisions_.clear();
    // A session that waits for a recording has no memory for the largest block so far.
    bytes_ = std::vector<std::byte>(bytes_.begin() + static_cast<std::ptrdiff_t>(at), bytes_.end());
    position_ += at;
  }
  if (ticks_.size() > kRowsBefore) ticks_.erase(ticks_.begin(), ticks_.end() - kRowsBefore);
  for (SeatRows& seat : seats_) seat.keep_last(kRowsBefore);
}

}  // namespace tandem::server
