#pragma once

#include <expected>
#include <string>
#include <vector>

#include "proto/spec/lesson.h"

namespace tandem::server {

/// A recorded hand that moves a seat again.
struct ReplayedHand {
  std::string seat;  ///< name
  std::string csv;   ///< `t_s[s],px[m],py[m],pz[m]`: session time, tip of the hand in the frame of the scene
};
/// A recorded lesson as a live session: its scene, and the hands that play it. Couplings, authority and forces come
/// from the session as always; the recording moves hands only.
struct ReplayedLesson {
  SceneSpec scene;  ///< the seats of `hands` are required, all other master seats are open; as long as the recording
  std::vector<ReplayedHand> hands;
};

/// @param seats  names of the seats to play; empty: all master seats that were engaged
/// @return error: no such seat, a seat without motion, or a scene whose tool needs a SLAVE seat, which nothing plays
[[nodiscard]] std::expected<ReplayedLesson, std::string> replayed_lesson(const Lesson& lesson,
                                                                         const std::vector<std::string>& seats);

}  // namespace tandem::server
