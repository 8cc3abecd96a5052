#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/spec/input_error.h"
#include "proto/spec/scene_spec.h"

/// A file of cells after validation of its own text: every number is finite and in range. Only proto/text/cells_text.h
/// creates it. netsim/cells/cell.h makes cells of it and checks them against the scene.
namespace tandem {

/// Task of the hands of a cell; proto/schema/cells.proto describes them.
enum class CellTask : std::uint8_t {
  kFree,
  kWall,
  kTissue,
  kFollowerRelaxed,
  kFollowerTight,
  kStep,
  kGesture,
  kRecorded
};
/// Authority of the leader in a cell; proto/schema/cells.proto describes it.
enum class CellAlpha : std::uint8_t { kOne, kHalf, kZero, kStepped };

/// Names in reports, by enumerator.
inline constexpr std::array<std::string_view, 8> kCellTaskNames{"free",           "wall", "tissue",  "follower_relaxed",
                                                                "follower_tight", "step", "gesture", "recorded"};
inline constexpr std::array<std::string_view, 4> kCellAlphaNames{"1", "1/2", "0", "stepped"};
[[nodiscard]] constexpr std::string_view to_text(CellTask task) noexcept {
  return kCellTaskNames[static_cast<std::size_t>(task)];
}
[[nodiscard]] constexpr std::string_view to_text(CellAlpha alpha) noexcept {
  return kCellAlphaNames[static_cast<std::size_t>(alpha)];
}

/// A value of an axis, and its place in the file for errors that a later check finds.
template <class Value>
struct CellAxisValue {
  Value value{};
  InputError place;  ///< file, line, column, key and value; the message is empty
};
template <class Value>
using CellAxis = std::vector<CellAxisValue<Value>>;

/// A grid: every combination of its values is a cell. No axis is empty.
struct CellGridSpec {
  std::string name;
  CellAxis<LawKind> laws;
  CellAxis<HandCouplingKind> couplings;
  CellAxis<std::uint32_t> hands;                                       ///< [2, 8]
  CellAxis<double> delays_ms, jitters_ms, losses_percent, outages_ms;  ///< each direction
  CellAxis<CellTask> tasks;
  CellAxis<CellAlpha> alphas;

  /// Returns the number of its cells.
  [[nodiscard]] std::size_t cells() const noexcept {
    return laws.size() * couplings.size() * hands.size() * delays_ms.size() * jitters_ms.size() *
           losses_percent.size() * outages_ms.size() * tasks.size() * alphas.size();
  }
};

struct CellsSpec {
  std::string name;  ///< of the file, without folder and extension
  std::string summary;
  CellAxisValue<std::string> scene;      ///< name or file
  CellAxisValue<std::string> recording;  ///< of task RECORDED; empty: none
  std::uint64_t seed = 1;                ///< first seed
  std::uint32_t seeds = 1;               ///< of each cell [1, 1000]
  std::vector<CellGridSpec> grids;

  [[nodiscard]] std::size_t cells() const noexcept {
    std::size_t sum = 0;
    for (const CellGridSpec& grid : grids) sum += grid.cells();
    return sum;
  }
};

/// Largest number of cells of a file.
inline constexpr std::size_t kCellsMax = 20'000;

}  // namespace tandem
