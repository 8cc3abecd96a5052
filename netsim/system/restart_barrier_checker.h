#pragma once

#include <cstdint>
#include <vector>

#include "server/report/violations.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Checks the restart barrier: after a restart of the server no seat engages before all seats with authority are back.
/// An instructor may resume the session earlier.
class RestartBarrierChecker {
 public:
  explicit RestartBarrierChecker(const SceneSpec& scene) : scene_(&scene), seats_(scene.seats.size()) {}

  void check(const server::Session& session, server::Violations& violations);
  /// @param t  session time for violations [s]
  void on_audit_event(const server::AuditEvent& event, double t, server::Violations& violations);

 private:
  struct Seat {
    bool led = false, required = false;  ///< had authority; must be back before any seat engages
  };
  const SceneSpec* scene_;
  std::vector<Seat> seats_;
  std::uint64_t epoch_ = 1;           ///< of the session
  bool recovering_ = false;           ///< since a restart of the server
  bool participant_missing_ = false;  ///< a required seat is not back
};

}  // namespace tandem::netsim
