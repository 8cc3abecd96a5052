#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "netsim/system/hold_limit.h"
#include "server/report/violations.h"
#include "server/session/session.h"

namespace tandem::netsim {

/// Checks that authority moves only as announced: 50 ticks after the audited decision, and only to seats with a live
/// link. It judges a tool only while some seat has authority over it; otherwise a change moves no authority. The
/// checker has its own copy of the limits.
class AuthorityTransferChecker {
 public:
  explicit AuthorityTransferChecker(const SceneSpec& scene)
      : scene_(&scene), before_(scene.tools.size()), held_(scene.tools.size(), true) {}

  void on_audit_event(const server::AuditEvent& e) {
    if (e.what != server::AuditEvent::What::kAuthority) return;
    // The session clock may be paused while a change waits for its tick. The checker therefore counts ticks itself.
    const std::uint64_t since = e.tick > session_tick_ ? e.tick - session_tick_ : 0;
    decisions_[count_++ % kRemembered] = {e.tool, ticks_run_ + since, e.after};
  }

  /// @param lived  ticks that the session ran since the last call
  void check(std::uint32_t lived, const server::Session& session, server::Violations& violations) {
    ticks_run_ += lived;
    session_tick_ = session.clock().session_tick();
    for (std::size_t j = 0; j < before_.size(); ++j) {
      const control::ToolAuthority& row = session.tool(j).authority;
      const control::MasterArray& now = row.requested();
      const bool felt = !row.held() && !held_[j] && now != before_[j];
      if (felt && session.clock().session_tick() > kNotice && !announced(j, now))
        violations.add("handover_announced", scene_->tools[j].name, session.clock().time(), false);
      // A late server runs many ticks in one call. The link's state in the tick of the change is then unknown.
      for (std::size_t i = 0; felt && lived == 1 && i < scene_->masters(); ++i)
        if (now[i] > before_[j][i] + 1e-9 && link_is_stale(session, i))
          violations.add("handover_link", scene_->seats[i].name, session.clock().time(), false);
      before_[j] = now;
      held_[j] = row.held();
    }
  }

 private:
  static constexpr std::uint32_t kNotice = 50;       // ticks
  static constexpr std::uint64_t kRemembered = 256;  // decisions, of all tools

  /// Returns whether an audited decision announced these shares. The caller skips the scene's first kNotice ticks.
  [[nodiscard]] bool announced(std::size_t tool, const control::MasterArray& weights) const {
    for (const Decision& d : decisions_)
      if (d.tool == tool && ticks_run_ >= d.tick + kNotice && d.weights == weights) return true;
    return false;
  }
  [[nodiscard]] bool link_is_stale(const server::Session& session, std::size_t i) const {
    const server::SeatEndpoint& seat = session.seat(i);
    const double limit = scene_->gate.silence_limit + 2 * hold_limit(*scene_, session.clock().dt());
    return !seat.taken() || seconds(seat.silence(session.clock().last_tick())) > limit + 1e-9;
  }

  struct Decision {
    std::size_t tool = kToolsMax;
    std::uint64_t tick = 0;  ///< in ticks as `ticks_run_` counts them
    control::MasterArray weights{};
  };
  const SceneSpec* scene_;
  std::vector<control::MasterArray> before_;
  std::vector<bool> held_;
  std::vector<Decision> decisions_ = std::vector<Decision>(kRemembered);
  std::uint64_t count_ = 0, ticks_run_ = 0;
  std::uint32_t session_tick_ = 0;
};

}  // namespace tandem::netsim
