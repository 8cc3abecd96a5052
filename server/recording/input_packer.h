#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "proto/spec/scene_spec.h"
#include "server/recording/input_block.h"
#include "server/recording/seat_values.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// Packs the inputs of a session into blocks (server/recording/input_block.h), one per chunk of a recording.
class InputPacker {
 public:
  /// Rows of the chunk before that predict values too: inputs may arrive a little later than the record of their tick.
  static constexpr std::size_t kRowsBefore = 64;

  /// @param scene  outlives the packer
  explicit InputPacker(const SceneSpec& scene) : scene_(&scene), seats_(scene.seats.size()) {}

  /// Adds a row of the recording.
  void add_row(const TickRecord& record);
  /// Adds bytes of the journal: a position (u64), then bytes (InputJournal::drain).
  /// @return false if they do not follow those before. Then they are not added: take a block first
  [[nodiscard]] bool add(std::span<const std::byte> piece);
  [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }
  /// Replaces `out` by a block of all bytes so far, but a record that is not whole, which the next block has.
  /// Empty: there are none. The next chunk begins.
  /// @param rest  the block has that record too; call it at the end of the file and before a gap
  void take(std::string& out, bool rest);

 private:
  /// Records that are alike: length and kind; for datagrams seat, flags and type too.
  using Kind = std::array<std::size_t, 4>;
  /// How the rows of a kind are divided into lanes. Choosing it takes as long as packing 20 chunks, so it is kept.
  struct Division {
    std::vector<input_block::Lane> lanes;
    std::uint16_t key = input_block::kNoKey;
    std::size_t blocks = 0;                      ///< that used it
    std::size_t row_bytes = 0, least_bytes = 0;  ///< per row in the last and in the first of them
  };
  struct Group;
  [[nodiscard]] static Kind kind_of(std::span<const std::byte> record) noexcept;
  static void put_group(const Group& group, const std::vector<SeatRows>& seats, Division& division, std::string& out);

  const SceneSpec* scene_;
  std::vector<std::uint32_t> ticks_;  ///< of the rows
  std::vector<SeatRows> seats_;       ///< by seat
  std::vector<std::byte> bytes_;      ///< of the journal
  std::uint64_t position_ = 0;        ///< of bytes_[0]
  std::map<Kind, Division> divisions_;
};

}  // namespace tandem::server
