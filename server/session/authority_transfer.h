#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/control/authority.h"
#include "proto/wire/wire_messages.h"

namespace tandem::server {

/// Scheduled changes of the authority over one tool. Between the decision and the tick that executes it pass `kNotice`
/// ticks, in which the parties are notified (ARCHITECTURE.md, invariant 53). The decision settles the outcome:
/// `scheduled` is what the session's authority version stands for. Several decisions within the notice period are
/// executed in order, each after its own notice, so that a ramp stays a ramp. A later decision removes those that would
/// be executed at the same tick as it or after it. So the last decision is executed last.
class AuthorityTransfer {
 public:
  static constexpr std::uint32_t kNotice = wire::kTransferNoticeTicks;

  struct Change {
    control::MasterArray wanted{};
    std::uint8_t by = 0;    ///< as in AuditEvent::seat
    bool reported = false;  ///< it was deferred before, with an audit event
    bool due = false;       ///< the slot holds a change
  };

  /// Sets the initial authority, without notice.
  void set_initial(const control::MasterArray& weights) noexcept { scheduled_ = weights; }
  /// @param weights  `change.wanted`, normalised
  /// @param ahead    ticks until execution, at most kNotice; 0: this tick, if `due` was not called in it yet
  void schedule(const control::MasterArray& weights, const Change& change, std::uint32_t ahead = kNotice) noexcept {
    for (std::uint32_t n = ahead + 1; n <= ticks_left_; ++n) at(n).due = false;
    at(ahead) = change;
    at(ahead).due = true;
    scheduled_ = weights;
    ticks_left_ = ahead;
  }
  /// Begins the next tick.
  void tick() noexcept {
    now_ = now_ + 1 == changes_.size() ? 0 : now_ + 1;
    if (ticks_left_ > 0) --ticks_left_;
  }
  /// Change to execute in this tick; null if there is none. Returned once, valid until the next `tick`.
  [[nodiscard]] const Change* due() noexcept { return at(0).due ? (at(0).due = false, &at(0)) : nullptr; }
  /// Cancels the change that was due: the authority stays as it is. No effect if a later change is pending.
  void cancel(const control::MasterArray& in_force) noexcept {
    if (!pending()) scheduled_ = in_force;
  }

  [[nodiscard]] const control::MasterArray& scheduled() const noexcept { return scheduled_; }
  [[nodiscard]] bool pending() const noexcept { return ticks_left_ > 0; }
  /// Seat that made the last pending decision, as in AuditEvent::seat; 0 if none is pending.
  [[nodiscard]] std::uint8_t latest_by() const noexcept {
    return pending() ? changes_[(now_ + ticks_left_) % changes_.size()].by : 0;
  }
  /// Ticks until the last decision is executed; 0 if none is pending.
  [[nodiscard]] std::uint32_t ticks_left() const noexcept { return ticks_left_; }

 private:
  [[nodiscard]] Change& at(std::uint32_t ahead) noexcept { return changes_[(now_ + ahead) % changes_.size()]; }

  std::array<Change, kNotice + 1> changes_{};
  std::size_t now_ = 0;
  std::uint32_t ticks_left_ = 0;  ///< until the last pending change
  control::MasterArray scheduled_{};
};

}  // namespace tandem::server
