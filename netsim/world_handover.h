#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/session.h"
#include "server/violations.h"

namespace tandem::netsim {

/// Whether weights move only as it was announced: 50 ticks after the decision that stands in the audit, and only to hands that are
/// heard from. Judged while somebody has weight: else a change of weights moves none. The numbers are said here once more.
class HandoverWatch {
 public:
  explicit HandoverWatch(const SceneSpec& scene) : scene_(&scene), before_(scene.tools.size()), held_(scene.tools.size(), true) {}

  void noted(const server::AuditEvent& e) {
    if (e.what != server::AuditEvent::What::kAuthority) return;
    // The session clock may stand still while a change waits for its tick: ticks are counted here.
    const std::uint64_t since = e.tick > session_tick_ ? e.tick - session_tick_ : 0;
    decisions_[count_++ % kRemembered] = {e.tool, lived_ + since, e.after};
  }

  /// @param lived  ticks the session lived through since the last call
  void check(std::uint32_t lived, const server::Session& session, server::Violations& violations) {
    lived_ += lived;
    session_tick_ = session.session_tick();
    for (std::size_t j = 0; j < before_.size(); ++j) {
      const control::AuthorityRow& row = session.tool(j).authority;
      const control::Weights& now = row.requested();
      const bool felt = !row.held() && !held_[j] && now != before_[j];
      if (felt && session.session_tick() > kNotice && !announced(j, now)) violations.note("handover_announced", scene_->tools[j].name, session.time(), false);
      // A late server lives through many ticks at once: how long a hand was silent in the one in which its weight grew is not seen.
      for (std::size_t i = 0; felt && lived == 1 && i < scene_->masters(); ++i)
        if (now[i] > before_[j][i] + 1e-9 && out_of_touch(session, i)) violations.note("handover_link", scene_->seats[i].name, session.time(), false);
      before_[j] = now;
      held_[j] = row.held();
    }
  }

 private:
  static constexpr std::uint32_t kNotice = 50;        // ticks
  static constexpr std::uint64_t kRemembered = 256;  // decisions, of all tools

  /// A scene's change in its first moments is not judged.
  [[nodiscard]] bool announced(std::size_t tool, const control::Weights& weights) const {
    for (const Decision& d : decisions_)
      if (d.tool == tool && lived_ >= d.tick + kNotice && d.weights == weights) return true;
    return false;
  }
  [[nodiscard]] bool out_of_touch(const server::Session& session, std::size_t i) const {
    const server::SeatPort& seat = session.seat(i);
    return !seat.taken() || seconds(seat.silence(session.last_tick())) > scene_->gate.silence_limit + 1e-9;
  }

  struct Decision {
    std::size_t tool = kToolsMax;
    std::uint64_t tick = 0;  ///< as `lived_` counts
    control::Weights weights{};
  };
  const SceneSpec* scene_;
  std::vector<control::Weights> before_;
  std::vector<bool> held_;
  std::vector<Decision> decisions_ = std::vector<Decision>(kRemembered);
  std::uint64_t count_ = 0, lived_ = 0;
  std::uint32_t session_tick_ = 0;
};

}  // namespace tandem::netsim
