#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "netsim/replay/record_values.h"
#include "proto/spec/lesson.h"
#include "server/recording/tool_digest.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Compares the records of a replay with the rows of the lessons that a recording's files have, bit for bit. Where rows
/// have rounded values of tools, those of the replay are rounded too, and the digests of the recording prove the rest.
/// Inputs may lie in another file than the row of their tick: records beyond the newest lesson wait for the next one.
class RowComparison {
 public:
  static constexpr std::size_t kWaitingMax = 4096;  ///< records that wait; further ones are an error

  /// @param scene    of all lessons; must outlive this
  /// @param seats    rows have the values of seats as the server knew them
  /// @param rounded  rows have rounded values of tools
  RowComparison(const SceneSpec& scene, bool seats, bool rounded)
      : scene_(&scene), values_(scene), seats_(seats), rounded_(rounded) {}

  /// Adds the rows of the next file and compares the records that waited for them.
  /// @param lesson  its ticks are later than those of the lesson before
  [[nodiscard]] std::optional<ReplayDifference> add(std::shared_ptr<const Lesson> lesson);
  /// Compares the record of the last tick. @param tick  its number in the journal
  [[nodiscard]] std::optional<ReplayDifference> compare(const server::Session& session, std::uint64_t tick);

  /// Too many records wait: rows and inputs of the recording do not belong together.
  [[nodiscard]] bool overflowed() const noexcept { return waiting_.size() >= kWaitingMax; }
  /// Rows that were compared.
  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }
  /// Session ticks before the first row, of a recording that began later than its session.
  [[nodiscard]] std::uint64_t unseen() const noexcept { return unseen_; }
  /// Session tick of the newest record; nullopt: none ran.
  [[nodiscard]] std::optional<std::uint32_t> last_tick() const noexcept { return last_; }

 private:
  struct Waiting {
    std::uint64_t tick = 0;
    std::unique_ptr<server::TickRecord> record;
  };
  void count_unseen(const server::Session& session);
  std::optional<ReplayDifference> compare(const server::TickRecord& record, std::uint64_t tick);
  void round_tools(server::TickRecord& record) const noexcept;
  std::optional<ReplayDifference> compare_digest(const Lesson& lesson, const server::TickRecord& record);

  const SceneSpec* scene_;
  RecordValues values_;
  bool seats_, rounded_;
  std::deque<std::shared_ptr<const Lesson>> lessons_;
  std::size_t row_ = 0, digest_ = 0;   ///< next ones of the first lesson
  server::ToolDigest own_digest_;      ///< of the rows since its last digest
  std::optional<std::uint32_t> last_;  ///< tick of the newest record, as RecordingWriter decides
  std::uint64_t rows_ = 0, unseen_ = 0;
  std::optional<std::uint32_t> first_;      ///< tick of the first row
  std::optional<std::uint32_t> uncounted_;  ///< first session tick that `count_unseen` has not counted
  std::deque<Waiting> waiting_;
  server::TickRecord recorded_{}, replayed_{};
  std::vector<double> before_, now_;
};

}  // namespace tandem::netsim
