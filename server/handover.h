#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/control/authority.h"
#include "proto/wire.h"

namespace tandem::server {

/// The time between a decision about a tool's weights and the tick that carries it out (design notes, security 2.5), in which those whom
/// it concerns are told. Who wins is settled by the decision: from then on `decided` is what the session's version stands for. Several
/// within that time are all carried out, each after its own, so that a ramp stays a ramp; but none that a later one comes before, or
/// comes together with: the last decision is also the last to act.
class Handover {
 public:
  static constexpr std::uint32_t kNotice = wire::kHandoverNotice;

  struct Change {
    control::Weights wanted{};
    std::uint8_t who = 0;  ///< as audit lines name people
    bool told = false;     ///< it was put off before, and that was written down
    bool due = false;      ///< there is one
  };

  /// Without notice: what a session begins with.
  void begin_with(const control::Weights& weights) noexcept { decided_ = weights; }
  /// @param weights  the same as `change.wanted`, normalised  @param ahead  ticks from now on, at most kNotice; 0: this one, if `due`
  ///                 was not asked yet
  void decide(const control::Weights& weights, const Change& change, std::uint32_t ahead = kNotice) noexcept {
    for (std::uint32_t n = ahead + 1; n <= left_; ++n) at(n).due = false;
    at(ahead) = change;
    at(ahead).due = true;
    decided_ = weights;
    left_ = ahead;
  }
  /// A tick begins.
  void tick() noexcept {
    now_ = now_ + 1 == changes_.size() ? 0 : now_ + 1;
    if (left_ > 0) --left_;
  }
  /// What this tick carries out, once; null: nothing. Good until the next `tick`.
  [[nodiscard]] const Change* due() noexcept { return at(0).due ? (at(0).due = false, &at(0)) : nullptr; }
  /// The one that was to be carried out was the last, and is not: the weights stay.
  void call_off(const control::Weights& in_force) noexcept {
    if (!pending()) decided_ = in_force;
  }

  [[nodiscard]] const control::Weights& decided() const noexcept { return decided_; }
  [[nodiscard]] bool pending() const noexcept { return left_ > 0; }
  /// Who made the last decision, as audit lines name people, as long as it is to come; 0 when nothing is.
  [[nodiscard]] std::uint8_t newest_by() const noexcept { return pending() ? changes_[(now_ + left_) % changes_.size()].who : 0; }
  [[nodiscard]] std::uint32_t left() const noexcept { return left_; }  ///< ticks until the last decision is carried out

 private:
  [[nodiscard]] Change& at(std::uint32_t ahead) noexcept { return changes_[(now_ + ahead) % changes_.size()]; }

  std::array<Change, kNotice + 1> changes_{};
  std::size_t now_ = 0;
  std::uint32_t left_ = 0;  ///< there is none after this
  control::Weights decided_{};
};

}  // namespace tandem::server
