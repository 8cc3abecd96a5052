#include "netsim/path.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tandem::netsim {
namespace {

enum Purpose : std::uint64_t {
  kLoss = 1,
  kBody,
  kStall,
  kReorder,
  kDuplicate,
  kCopy,
  kRegimes,
  kBoundary,
  kOutages,
  kDamage
};

/// Far enough from the ends of 64 bits that no sum of delays overflows; 146 years.
constexpr Time kTimeMax{Duration{std::int64_t{1} << 62}};

/// First member of Path to be made, so that no model ever sees a bad number.
const PathSpec& checked(const PathSpec& spec) {
  const auto found = problems(spec);
  if (found.empty()) return spec;
  std::string message = "network path:";
  for (const SpecProblem& problem : found) message += "\n  " + problem.key + ": " + problem.message;
  throw std::invalid_argument(message);
}

}  // namespace

const char* name(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::kDeliver:
      return "delivered";
    case Outcome::kHeldBack:
      return "reordered";
    case Outcome::kOutage:
      return "outage";
    case Outcome::kHoldFull:
      return "hold full";
    case Outcome::kLost:
      return "lost";
    case Outcome::kQueueFull:
      return "queue full";
    case Outcome::kOverflow:
      return "overflow";
    case Outcome::kTooLong:
      return "too long";
    case Outcome::kCorrupted:
      return "corrupted";
    case Outcome::kAboveMtu:
      return "above MTU";
    case Outcome::kOldAddress:
      return "old address";
    case Outcome::kClientGone:
      return "client gone";
  }
  return "?";
}

Path::Path(const PathSpec& spec, RandomKey key, RandomKey link_key)
    : spec_(checked(spec)),
      outages_(spec.outages, link_key.derive(kOutages)),
      loss_(spec.loss, key.derive(kLoss)),
      rate_(spec.rate),
      floor_(spec.floor),
      trace_(spec.trace),
      body_(spec.body, key.derive(kBody)),
      regimes_(spec.regimes, key.derive(kRegimes)),
      boundary_(spec.boundary, key.derive(kBoundary)),
      stalls_(spec.stall, key.derive(kStall)),
      slots_(spec.slots),
      order_(spec.order),
      reorder_(spec.reorder),
      duplicate_(spec.duplicate),
      mtu_(spec.mtu == 0 ? ~std::uint64_t{0} : spec.mtu - std::min(spec.mtu, spec.rate.overhead_bytes)),
      corrupted_(spec.corrupted),
      corrupted_key_(key.derive(kDamage)),
      reorder_key_(key.derive(kReorder)),
      duplicate_key_(key.derive(kDuplicate)),
      copy_key_(key.derive(kCopy)) {}

Verdict Path::send(Time now, std::size_t size) noexcept {
  now = std::clamp(now, last_in_, kTimeMax);
  last_in_ = now;
  Verdict verdict;
  verdict.index = count_++;
  verdict.at = now;

  // Loss is asked even while the link is down: its models count every datagram, and outages must not move them.
  const bool lost = loss_.lost(now, verdict.index);
  const OutageGate::Passage passage = outages_.enter(now, size);
  if (passage.state != OutageGate::State::kUp) {
    verdict.outcome = passage.state == OutageGate::State::kDropped ? Outcome::kOutage : Outcome::kHoldFull;
    return verdict;
  }
  // Loss belongs to the moment of sending, also for what an outage holds: else a whole burst would meet one state.
  DelayTrace::Step recorded;
  if (trace_.present()) recorded = trace_.at(now);
  if (recorded.lost || lost || boundary_.lost(now, verdict.index)) {
    verdict.outcome = Outcome::kLost;
    return verdict;
  }
  if (loss_.minds_queue() && loss_.lost_in_queue(rate_.waiting(passage.at), verdict.index)) {
    verdict.outcome = Outcome::kLost;
    return verdict;
  }
  if (size > mtu_) {
    verdict.outcome = Outcome::kAboveMtu;
    return verdict;
  }
  const auto sent = rate_.serve(passage.at, size);
  if (!sent) {
    verdict.outcome = Outcome::kQueueFull;
    return verdict;
  }
  if (corrupted_ > 0 && corrupted_key_.uniform(verdict.index) < corrupted_) {
    verdict.outcome = Outcome::kCorrupted;
    return verdict;
  }
  const Time due = *sent + floor_ + recorded.delay + body_.at(*sent, verdict.index) +
                   regimes_.at(*sent, verdict.index) + boundary_.floor(*sent);
  Time at = stalls_.release(boundary_.release(due));
  if (at > due && loss_.lost_in_stall(verdict.index)) {
    verdict.outcome = Outcome::kLost;
    return verdict;
  }
  if (order_ == Order::kFifo) at = slots_.release(std::max(at, last_out_), size);
  last_out_ = std::max(last_out_, at);
  verdict.at = at;

  if (duplicate_.probability > 0 && duplicate_key_.uniform(verdict.index) < duplicate_.probability) {
    verdict.copied = true;
    const double longest = static_cast<double>(duplicate_.delay_max.count()) + 1;
    verdict.copy_delay = Duration{static_cast<std::int64_t>(copy_key_.uniform(verdict.index) * longest)};
  }
  if (reorder_.probability > 0 || held_count_ > 0) {  // what is held may be older than the present spec
    if (held_count_ > 0) forget_late(now);
    if (held_count_ < kHeldMax && reorder_key_.uniform(verdict.index) < reorder_.probability) {
      verdict.outcome = Outcome::kHeldBack;
      verdict.at = at + reorder_.hold_limit;
      held_[held_count_++] = {verdict.index, at, verdict.at, reorder_.displacement};
    } else if (held_count_ > 0) {
      verdict.released = pass(at);
    }
  }
  return verdict;
}

void Path::take_over(Path& before, Time at) noexcept {
  count_ = before.count_;
  last_in_ = before.last_in_;
  last_out_ = before.last_out_;
  held_count_ = before.held_count_;
  held_ = before.held_;
  outages_.take_over(before.outages_);
  // Models that are functions of time need nothing. Of those with a memory, an unchanged one is moved over whole.
  if (spec_.loss == before.spec_.loss) std::swap(loss_, before.loss_);
  if (spec_.slots == before.spec_.slots) std::swap(slots_, before.slots_);
  if (spec_.rate == before.spec_.rate) {
    std::swap(rate_, before.rate_);
  } else {
    rate_.take_over(before.rate_, at);
  }
}

void Path::forget_late(Time now) noexcept {
  const auto last = held_.begin() + static_cast<std::ptrdiff_t>(held_count_);
  const auto kept = std::remove_if(held_.begin(), last, [now](const Held& held) { return held.limit <= now; });
  held_count_ = static_cast<std::size_t>(kept - held_.begin());
}

std::span<const Release> Path::pass(Time at) noexcept {
  std::size_t released = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < held_count_; ++i) {
    Held held = held_[i];
    if (--held.after > 0) {
      held_[kept++] = held;
      continue;
    }
    const Time when = std::max(held.nominal, at);
    if (when < held.limit) released_[released++] = {held.index, when};  // else its limit lets it go
  }
  held_count_ = kept;
  return {released_.data(), released};
}

}  // namespace tandem::netsim
