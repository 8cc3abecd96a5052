#pragma once

#include <expected>
#include <string>
#include <vector>

#include "proto/spec/lesson.h"

namespace tandem::server {

/// A recorded hand that moves a seat again.
struct ReplayedHand {
  std::string seat;  ///< name
  /// `t_s[s],px[m],py[m],pz[m]`: session time, rest position of the hand's spring in the frame of the scene. The spring
  /// (HandModel::kRecorded) then holds the tip where it was recorded, against the recorded force.
  std::string csv;
};
/// A recorded lesson as a live session: its scene, and the hands that play it. Couplings, authority and forces come
/// from the session as always; the recording moves hands only.
struct ReplayedLesson {
  /// As long as the recording. The seats of `hands` are required. Of the other master seats, `awaited` are required
  /// too, and the rest is optional.
  SceneSpec scene;
  std::vector<ReplayedHand> hands;
  std::vector<std::string> awaited;  ///< seats that clients must take before the replay begins
};

/// @param seats  names of the seats to play; empty: all master seats that were engaged
/// @param await  with `seats`, the other seats that the scene requires are awaited; a replay of all hands awaits none
/// @return error: no such seat, a seat without motion, or a scene whose tool needs a SLAVE seat, which nothing plays
[[nodiscard]] std::expected<ReplayedLesson, std::string> replayed_lesson(const Lesson& lesson,
                                                                         const std::vector<std::string>& seats,
                                                                         bool await);

/// Returns for users that the recording begins later than its session, and what its replay does until then; empty: it
/// begins with it.
[[nodiscard]] std::string late_begin_text(const Lesson& lesson);

}  // namespace tandem::server
