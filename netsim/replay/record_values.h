#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "netsim/replay/session_replay.h"
#include "proto/spec/scene_spec.h"
#include "server/report/tick_record.h"

namespace tandem::netsim {

/// One number of a tick's record.
struct RecordValue {
  std::string channel;  ///< `/SEAT/measured_cp`, `/TOOL/measured_cp`, ..., as recordings name their channels
  std::string field;    ///< name within the channel, such as `x` or `q1`
};

/// The numbers of a TickRecord of one scene, in a fixed order, with their names.
class RecordValues {
 public:
  explicit RecordValues(const SceneSpec& scene);

  [[nodiscard]] const std::vector<RecordValue>& names() const noexcept { return names_; }
  /// Writes all numbers of a record of this scene. @param out  in the order of `names`
  static void read(const SceneSpec& scene, const server::TickRecord& record, std::vector<double>& out);
  /// First number whose bits differ; NaN in `recorded` is unknown and equals everything.
  /// @param recorded  as `names`  @param replayed  as `names`
  [[nodiscard]] std::optional<ReplayDifference> difference(const std::vector<double>& recorded,
                                                           const std::vector<double>& replayed) const;

 private:
  std::vector<RecordValue> names_;
};

}  // namespace tandem::netsim
