#include "netsim/engine/path.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

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
  kDamage,
  kPlaces
};

/// Latest time, 146 years: far enough from the 64-bit limits that no sum of delays overflows.
constexpr Time kTimeMax{Duration{std::int64_t{1} << 62}};

/// Validates the spec. Path initializes this member first, so that no model sees an invalid number.
PathSpec checked(const PathSpec& spec) {
  throw_if_any("network path", problems(spec));
  return spec;
}

/// Returns the salt of a name. Indices stay below 2^40; above them, a name below 2^23 is used as it is and a larger one
/// as a hash.
std::uint64_t salt_of(std::uint64_t name) noexcept {
  constexpr std::uint64_t kPlain = std::uint64_t{1} << 23;
  return (name < kPlain ? name : kPlain | (mix64(name) >> 41)) << 40;
}

}  // namespace

Path::Path(const PathSpec& spec, const Keys& keys)
    : spec_(checked(spec)),
      loss_key_(keys.path.derive(kLoss)),
      outages_(spec.outages, keys.link.derive(kOutages), keys.network.derive(kOutages)),
      rate_(spec.rate),
      trace_(spec.trace),
      body_(spec.body, keys.path.derive(kBody)),
      regimes_(spec.regimes, keys.path.derive(kRegimes)),
      boundary_(spec.boundary, keys.path.derive(kBoundary)),
      stalls_(spec.stall, keys.path.derive(kStall)),
      slots_(spec.slots),
      payload_max_(spec.mtu.bytes == 0 ? ~std::uint64_t{0} : spec.mtu.bytes - spec.rate.overhead_bytes),
      corruption_key_(keys.path.derive(kDamage)),
      place_key_(keys.path.derive(kPlaces)),
      reorder_key_(keys.path.derive(kReorder)),
      duplicate_key_(keys.path.derive(kDuplicate)),
      copy_key_(keys.path.derive(kCopy)) {
  if (spec.rate.drop == RateSpec::Drop::kHead) head_.emplace(spec.rate);
  for (const OutageSpec& outage : spec.outages) {
    if (outage.mode == OutageSpec::Mode::kHoldLast) keeps_newest_ = true;
  }
  set_flow(0, 0);
  plain_queue_ = !head_ && !flows_.front().loss.depends_on_queue();
  plain_end_ = spec.corruption.probability <= 0 && spec.duplicate.probability <= 0 && spec.reorder.probability <= 0;
}

void Path::set_flow(std::uint32_t flow, std::uint64_t name) {
  const std::uint64_t salt = salt_of(name);
  Flow made{salt, Loss{spec_.loss, loss_key_, salt}};
  if (flow == flows_.size()) {
    flows_.push_back(std::move(made));
    newest_.reserve(flows_.size());
    return;
  }
  flows_[flow] = std::move(made);
  remove_flow(flow);
}

void Path::remove_flow(std::uint32_t flow) noexcept {
  if (head_) head_->remove_flow(flow, kNoFlow);
  for (Newest& newest : newest_) {
    if (newest.datagram.flow == flow) newest.datagram.flow = kNoFlow;
  }
}

void Path::replace(Path& before, Time at) noexcept {
  last_in_ = before.last_in_;
  last_out_ = before.last_out_;
  // Models that are functions of time need no transfer. An unchanged model with state is transferred whole.
  const bool same_loss = spec_.loss == before.spec_.loss;
  for (std::size_t i = 0; i < std::min(flows_.size(), before.flows_.size()); ++i) {
    std::swap(flows_[i], before.flows_[i]);
    if (same_loss) continue;
    std::swap(flows_[i].loss, before.flows_[i].loss);
    flows_[i].loss.set_salt(flows_[i].salt);
  }
  outages_.replace(before.outages_);
  std::swap(newest_, before.newest_);
  if (spec_.slots == before.spec_.slots) std::swap(slots_, before.slots_);
  if (spec_.rate == before.spec_.rate) {
    std::swap(rate_, before.rate_);
    std::swap(head_, before.head_);
  } else {
    rate_.replace(before.rate_, at);
  }
}

PathDecision Path::send(Time now, std::uint32_t flow, std::size_t size) noexcept {
  Flow& from = flows_[flow];
  now = std::clamp(now, last_in_, kTimeMax);
  last_in_ = now;
  InTransit datagram{.flow = flow, .index = from.count++, .packet = from.packets, .size = size, .sent = now};
  if (size > payload_max_ && spec_.mtu.above == MtuSpec::Above::kFragment)
    datagram.pieces = static_cast<std::uint32_t>((size + payload_max_ - 1) / payload_max_);
  from.packets += datagram.pieces;
  PathDecision decision{.index = datagram.index, .at = now};
  decision.outcome = enter(from, datagram, decision);
  return decision;
}

/// Decides what happens to the datagram up to the queue, and behind it where that is known at once.
inline Outcome Path::enter(Flow& from, InTransit& datagram, PathDecision& decision) noexcept {
  const Time now = datagram.sent;
  const std::uint64_t packet = datagram.packet;
  // Loss models run also during an outage: they count every datagram, and outages must not affect their draws.
  bool lost = from.loss.lost(now, packet);
  if (boundary_.lost(now, packet | from.salt)) lost = true;
  for (std::uint64_t each = packet + 1; each < packet + datagram.pieces; ++each) {
    if (from.loss.lost(now, each)) lost = true;
    if (boundary_.lost(now, each | from.salt)) lost = true;
  }
  const OutageGate::Passage passage = outages_.enter(now, datagram.size);
  if (passage.state == OutageGate::State::kDropped) return Outcome::kOutage;
  if (passage.state == OutageGate::State::kHoldFull) return Outcome::kHoldFull;
  // Loss is decided at the time of sending, also for held datagrams. Otherwise a released burst would meet a single
  // state.
  DelayTrace::Step recorded;
  if (trace_.present()) recorded = trace_.at(now);
  if (recorded.lost || lost) return Outcome::kLost;
  datagram.recorded = recorded.delay;
  if (passage.state == OutageGate::State::kNewest) {
    keep_newest(datagram, passage.at);
    return Outcome::kWaiting;
  }
  if (plain_queue_ && datagram.pieces == 1 && datagram.size <= payload_max_)  // the usual case
    return send_whole(from, datagram, passage.at, decision);
  return reach_queue(datagram, passage.at, decision);
}

Duration Path::queue_wait(Time now) noexcept {
  now = std::max(now, last_in_);
  return std::max(head_ ? head_->waiting(rate_, now) : rate_.waiting(now), Duration::zero());
}

void Path::keep_newest(const InTransit& datagram, Time until) noexcept {
  const auto before = std::find_if(newest_.begin(), newest_.end(),
                                   [&](const Newest& newest) { return newest.datagram.flow == datagram.flow; });
  if (before != newest_.end()) {
    const InTransit& old = before->datagram;
    replaced_ =
        Resolved{old.flow, old.ticket, {.outcome = Outcome::kReplaced, .index = old.index, .at = datagram.sent}};
    newest_.erase(before);
  }
  newest_.push_back({datagram, until});
}

Outcome Path::reach_queue(const InTransit& datagram, Time at, PathDecision& decision) noexcept {
  Flow& from = flows_[datagram.flow];
  if (from.loss.depends_on_queue()) {
    const Duration wait = head_ ? head_->waiting(rate_, at) : rate_.waiting(at);
    if (from.loss.lost_in_queue(wait, datagram.packet)) return Outcome::kLost;
  }
  if (datagram.size > payload_max_ && datagram.pieces == 1) return Outcome::kAboveMtu;
  if (head_) return head_->enter(rate_, at, datagram) ? Outcome::kWaiting : Outcome::kQueueFull;
  return datagram.pieces > 1 ? send_in_pieces(from, datagram, at, decision) : send_whole(from, datagram, at, decision);
}

inline Outcome Path::send_whole(Flow& from, const InTransit& datagram, Time at, PathDecision& decision) noexcept {
  const auto sent = rate_.serve(at, datagram.size);
  return sent ? leave_queue(from, datagram, *sent, decision) : Outcome::kQueueFull;
}

Outcome Path::send_in_pieces(Flow& from, const InTransit& datagram, Time at, PathDecision& decision) noexcept {
  // Remaining fragments of an incomplete datagram still use the link, because the sender does not know of the drop.
  Outcome outcome = Outcome::kDeliver;
  std::size_t left = datagram.size;
  Time last{};
  for (std::uint64_t packet = datagram.packet; packet < datagram.packet + datagram.pieces; ++packet) {
    const std::size_t size = std::min<std::size_t>(left, payload_max_);
    left -= size;
    const auto sent = rate_.serve(at, size);
    if (!sent) {
      outcome = Outcome::kQueueFull;
      continue;
    }
    const auto arrived = travel(from, packet, size, datagram.recorded, *sent);
    if (!arrived && outcome == Outcome::kDeliver) outcome = Outcome::kLost;
    last = std::max(last, arrived.value_or(Time{}));
  }
  if (dropped(outcome)) return outcome;
  const bool hit = is_corrupted(from, datagram.packet, datagram.pieces);
  if (hit && spec_.corruption.mode == CorruptionSpec::Mode::kChecksum) return Outcome::kCorrupted;
  decision.at = last;
  return arrive(from, datagram.size, hit, decision);
}

inline Outcome Path::leave_queue(Flow& from, const InTransit& datagram, Time sent, PathDecision& decision) noexcept {
  const bool hit = is_corrupted(from, datagram.packet, datagram.pieces);
  if (hit && spec_.corruption.mode == CorruptionSpec::Mode::kChecksum) return Outcome::kCorrupted;
  const auto at = travel(from, datagram.packet, datagram.size, datagram.recorded, sent);
  if (!at) return Outcome::kLost;
  decision.at = *at;
  return arrive(from, datagram.size, hit, decision);
}

inline bool Path::is_corrupted(const Flow& from, std::uint64_t packet, std::uint32_t pieces) const noexcept {
  if (spec_.corruption.probability <= 0) return false;
  bool hit = false;
  for (std::uint64_t each = packet; each < packet + pieces; ++each) {
    if (corruption_key_.uniform(each | from.salt) < spec_.corruption.probability) hit = true;
  }
  return hit;
}

/// Applies floor, body, stalls, order and slots to one packet. Returns empty if the packet is lost in a stall.
inline std::optional<Time> Path::travel(Flow& from, std::uint64_t packet, std::size_t size, Duration recorded,
                                        Time sent) noexcept {
  const std::uint64_t draw = packet | from.salt;
  const Time due =
      sent + spec_.floor + recorded + body_.at(sent, draw) + regimes_.at(sent, draw) + boundary_.floor(sent);
  Time at = stalls_.release(boundary_.release(due));
  if (at > due && from.loss.lost_in_stall(packet)) return std::nullopt;
  if (spec_.order == ArrivalOrder::kFifo) at = slots_.release(std::max(at, last_out_), size);
  last_out_ = std::max(last_out_, at);
  return at;
}

/// Applies corruption, duplication and reordering to a datagram that arrives.
Outcome Path::arrive(Flow& from, std::size_t size, bool hit, PathDecision& decision) noexcept {
  if (plain_end_ && from.held_count == 0) return Outcome::kDeliver;
  const Time at = decision.at;
  const std::uint64_t draw = decision.index | from.salt;
  if (hit && size > 0) {
    if (spec_.corruption.mode == CorruptionSpec::Mode::kBitFlips) {
      decision.corruption = {
          .kind = Corruption::Kind::kBitFlips, .bits = spec_.corruption.bits, .seed = place_key_.bits(draw)};
    } else {
      const double length = place_key_.uniform(draw) * static_cast<double>(size);
      decision.corruption = {.kind = Corruption::Kind::kTruncated, .length = static_cast<std::uint32_t>(length)};
    }
  }
  const DuplicateSpec& duplicate = spec_.duplicate;
  if (duplicate.probability > 0 && duplicate_key_.uniform(draw) < duplicate.probability) {
    decision.copied = true;
    const double longest = static_cast<double>(duplicate.delay_max.count()) + 1;
    decision.copy_delay = Duration{static_cast<std::int64_t>(copy_key_.uniform(draw) * longest)};
  }
  const ReorderSpec& reorder = spec_.reorder;
  if (reorder.probability > 0 || from.held_count > 0) {  // held datagrams may predate the present spec
    if (from.held_count > 0) remove_expired(from, last_in_);
    if (from.held_count < kHeldMax && reorder_key_.uniform(draw) < reorder.probability) {
      decision.at = at + reorder.hold_limit;
      from.held[from.held_count++] = {decision.index, at, decision.at, reorder.displacement};
      return Outcome::kHeldBack;
    }
    if (from.held_count > 0) decision.released = pass(from, at);
  }
  return Outcome::kDeliver;
}

void Path::set_ticket(std::uint32_t flow, std::uint32_t ticket) noexcept {
  // The datagram just sent is the newest entry in one of two stores; the check finds the right one.
  if (!newest_.empty() && newest_.back().datagram.flow == flow &&
      newest_.back().datagram.index + 1 == flows_[flow].count) {
    newest_.back().datagram.ticket = ticket;
  } else if (head_) {
    head_->set_ticket(ticket);
  }
}

Path::Resolved Path::decided(const HeadDropQueue::Decided& left) noexcept {
  const InTransit& datagram = left.datagram;
  Resolved settled{datagram.flow, datagram.ticket, {.index = datagram.index, .at = datagram.sent}};
  if (left.dropped) {
    settled.decision.outcome = Outcome::kPushedOut;
    settled.decision.at = left.at;
  } else if (datagram.flow != kNoFlow) {
    settled.decision.outcome = leave_queue(flows_[datagram.flow], datagram, left.at, settled.decision);
  }
  return settled;
}

std::optional<Path::Resolved> Path::resolve(Time now) noexcept {
  if (replaced_) return std::exchange(replaced_, std::nullopt);
  while (true) {
    // A datagram released at the end of an outage reaches the queue at that time and may push others out.
    const bool lets_go = !newest_.empty() && newest_.front().until <= now;
    if (head_) {
      if (const auto left = head_->next(rate_, lets_go ? newest_.front().until : now)) return decided(*left);
    }
    if (!lets_go) return std::nullopt;
    const Newest first = newest_.front();
    newest_.erase(newest_.begin());
    Resolved settled{
        first.datagram.flow, first.datagram.ticket, {.index = first.datagram.index, .at = first.datagram.sent}};
    if (settled.flow == kNoFlow) return settled;
    settled.decision.outcome = reach_queue(first.datagram, first.until, settled.decision);
    if (settled.decision.outcome != Outcome::kWaiting) return settled;
    head_->set_ticket(first.datagram.ticket);
  }
}

std::optional<Path::Resolved> Path::flush(const Path& next) noexcept {
  if (!head_ || next.spec_.rate == spec_.rate) return std::nullopt;
  const auto left = head_->next(rate_, kTimeMax);
  return left ? std::optional{decided(*left)} : std::nullopt;
}

std::optional<Time> Path::next_resolve() noexcept {
  if (replaced_) return last_in_;
  std::optional<Time> next;
  if (head_) next = head_->next_time(rate_);
  if (!newest_.empty()) next = std::min(next.value_or(newest_.front().until), newest_.front().until);
  return next;
}

void Path::remove_expired(Flow& flow, Time now) noexcept {
  const auto last = flow.held.begin() + static_cast<std::ptrdiff_t>(flow.held_count);
  const auto kept = std::remove_if(flow.held.begin(), last, [now](const Held& held) { return held.limit <= now; });
  flow.held_count = static_cast<std::size_t>(kept - flow.held.begin());
}

std::span<const Release> Path::pass(Flow& flow, Time at) noexcept {
  std::size_t released = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < flow.held_count; ++i) {
    Held held = flow.held[i];
    if (--held.after > 0) {
      flow.held[kept++] = held;
      continue;
    }
    const Time when = std::max(held.nominal, at);
    if (when < held.limit) released_[released++] = {held.index, when};  // otherwise the limit releases it
  }
  flow.held_count = kept;
  return {released_.data(), released};
}

}  // namespace tandem::netsim
