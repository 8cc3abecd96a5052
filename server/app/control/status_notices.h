#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "proto/spec/scene_spec.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

/// Recent events of a session for the status of all participants, and the names behind its stops. The session knows
/// seats and roles; the names of workstations and consoles and their reasons are known here only.
class StatusNotices {
 public:
  /// Adds an event, numbered from 1. Only the newest rpc::kStatusEventsMax are kept, each cut to rpc::kTextMax bytes.
  void add(std::string_view text);
  /// A control connection stopped or paused the session. @param person  name in its ticket; empty: not named
  void set_stop(std::uint32_t number, std::string workstation, std::string person, std::string why);
  /// A control connection ended this stop. @param who its workstation, role and seat
  void set_resume(std::uint32_t number, std::string who);
  /// Adds an event for a stop that ended since the last call. A key at a seat may have ended it, which only the
  /// session's stop latch records.
  /// @param person  name of the person at the seat that ended it; empty: not named
  void update(const StopLatch& latch, const SceneSpec& scene, const std::string& person = {});
  /// Adds an event when snapshots of the session begin to fail, and when they are stored again.
  /// @param why  cause and remedy; empty: they are stored
  void set_storage_problem(const std::string& why);
  /// Adds events, workstation, person and reason to a status.
  void complete(rpc::Status& status) const;

 private:
  std::vector<rpc::StatusEvent> events_;
  std::uint32_t count_ = 0;            ///< number of events so far
  bool storage_fails_ = false;         ///< reported
  std::uint32_t resume_reported_ = 0;  ///< number of the newest stop whose end is in `events_`
  std::uint32_t resumed_ = 0;          ///< number of the stop that `resumer_` ended
  std::string resumer_;
  std::uint32_t stop_ = 0;  ///< number of the newest stop by a control connection
  std::string stop_workstation_, stop_person_, stop_why_;
};

}  // namespace tandem::server
