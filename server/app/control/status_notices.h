#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "proto/spec/scene_spec.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

/// Recent events of a session for the status of all participants.
class StatusNotices {
 public:
  /// Adds an event, numbered from 1. Only the newest rpc::kStatusEventsMax are kept, each cut to rpc::kTextMax bytes.
  void add(std::string_view text);
  /// A control connection ended this stop. @param who its workstation, role and seat
  void set_resume(std::uint32_t number, std::string who);
  /// Adds an event for a stop that ended since the last call. A key at a seat may have ended it, which only the
  /// session's stop latch records.
  /// @param person  name of the person at the seat that ended it; empty: not named
  void update(const StopLatch& latch, const SceneSpec& scene, const std::string& person = {});
  /// Adds an event when snapshots of the session begin to fail, and when they are stored again.
  /// @param why  cause and remedy; empty: they are stored
  void set_storage_problem(const std::string& why);
  [[nodiscard]] const std::vector<rpc::StatusEvent>& events() const noexcept { return events_; }

 private:
  std::vector<rpc::StatusEvent> events_;
  std::uint32_t count_ = 0;            ///< number of events so far
  bool storage_fails_ = false;         ///< reported
  std::uint32_t resume_reported_ = 0;  ///< number of the newest stop whose end is in `events_`
  std::uint32_t resumed_ = 0;          ///< number of the stop that `resumer_` ended
  std::string resumer_;
};

}  // namespace tandem::server
