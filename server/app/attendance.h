#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "server/app/status.h"

namespace tandem::server {

/// Notices who comes, goes and stays away while a session runs.
class Attendance {
 public:
  static constexpr Duration kLost = std::chrono::seconds(10);  ///< then a warning names the seat

  struct Note {
    const char* event;        ///< joined, left, back, gone, running, held
    std::string seat;         ///< empty: the whole session
    std::string text;         ///< for people
    bool warning = false;     ///< somebody stays away
  };
  struct News {
    std::vector<Note> notes;
    bool all_lost = false;    ///< everybody who was there has been away for kSessionSilence
    bool all_left = false;    ///< every one of them left as people leave, `kLost` ago at least
  };
  [[nodiscard]] News look(Time now, const SessionStatus& status, const SceneSpec& scene);

 private:
  struct Seat {
    bool taken = false, warned = false;
    std::optional<Time> away_since;
  };
  std::array<Seat, kSeatsMax> seats_{};
  std::optional<wire::SessionState> state_;
  bool deserted_ = false;  ///< everybody had left when it was looked last
};

}  // namespace tandem::server
