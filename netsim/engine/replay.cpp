#include "netsim/engine/replay.h"

#include <algorithm>

namespace tandem::netsim {
namespace {

std::string place(const Decision& d) {
  return "flow " + std::to_string(d.flow) + " " + name(d.direction) + ", datagram " + std::to_string(d.index);
}

/// Returns the length of a recording, which ends one mean gap after the last datagram. n datagrams have n gaps; a
/// single one lasts 1 s.
Duration period_of(const std::vector<Replay::Fate>& fates) {
  if (fates.empty()) return Duration{1};
  const Duration length = fates.back().clock - fates.front().clock;
  const auto gaps = static_cast<std::int64_t>(fates.size()) - 1;
  if (gaps == 0) return std::chrono::seconds(1);
  return length + std::max(length / gaps, Duration{1});
}

}  // namespace

std::expected<Replay, std::string> Replay::make(std::span<const Decision> rows) {
  if (rows.empty()) return std::unexpected("the log holds no decision");
  std::vector<Decision> ordered(rows.begin(), rows.end());
  // Sorted by datagram; a copy follows its original.
  std::ranges::sort(ordered, {}, [](const Decision& d) { return std::tuple(d.flow, d.direction, d.index, d.copy); });
  Replay replay;
  const Decision* original = nullptr;
  for (const Decision& d : ordered) {
    Flow& flow = replay.flows_[d.flow];
    flow.link = d.link;
    Track& track = flow.tracks[static_cast<std::size_t>(d.direction)];
    const bool same = original != nullptr && original->flow == d.flow && original->direction == d.direction &&
                      original->index == d.index;
    if (d.copy) {
      if (!same) return std::unexpected(place(d) + ": a copy without its original");
      PathDecision& decision = track.fates.back().decision;
      if (decision.copied) return std::unexpected(place(d) + ": two copies; one can be played");
      if (netsim::dropped(decision.outcome) && !netsim::dropped(d.outcome)) {
        return std::unexpected(place(d) + ": its copy arrived, it did not");
      }
      decision.copied = true;
      decision.copy_delay = d.out - original->out;
      if (netsim::dropped(d.outcome)) decision.copy_outcome = d.outcome;
      continue;
    }
    if (same) return std::unexpected(place(d) + ": is there twice");
    original = &d;
    const Time clock = track.fates.empty() ? d.in : std::max(track.fates.back().clock, d.in);
    track.fates.push_back(
        {.in = d.in,
         .clock = clock,
         .decision = {.outcome = d.outcome, .index = d.index, .at = d.out, .corruption = d.corruption}});
  }
  for (auto& [number, flow] : replay.flows_) {
    for (Track& track : flow.tracks) {
      track.period = period_of(track.fates);
      for (std::uint32_t i = 0; i < track.fates.size(); ++i) {
        if (track.fates[i].decision.outcome != Outcome::kWaiting) track.decided.push_back(i);
      }
    }
  }
  return replay;
}

std::vector<std::uint32_t> Replay::flows() const {
  std::vector<std::uint32_t> all;
  for (const auto& [number, flow] : flows_) all.push_back(number);
  return all;
}

const Replay::Track& Replay::track(std::uint32_t flow, Direction direction) const noexcept {
  static const Track kNothing;
  const auto found = flows_.find(flow);
  return found == flows_.end() ? kNothing : found->second.tracks[static_cast<std::size_t>(direction)];
}

std::uint32_t Replay::link(std::uint32_t flow) const noexcept {
  const auto found = flows_.find(flow);
  return found == flows_.end() ? flow : found->second.link;
}

Duration Replay::delay_max(std::uint32_t flow, Direction direction) const noexcept {
  Duration longest{};
  for (const Fate& fate : track(flow, direction).fates) {
    longest = std::max(longest, fate.delay() + std::max(fate.decision.copy_delay, Duration::zero()));
  }
  return longest;
}

const Replay::Fate* ReplayPath::own(Time now, std::uint64_t index) const noexcept {
  const auto& fates = track_->fates;
  const auto found = std::ranges::lower_bound(fates, index, {}, [](const Replay::Fate& f) { return f.decision.index; });
  return found != fates.end() && found->decision.index == index && found->in == now ? &*found : nullptr;
}

const Replay::Fate* ReplayPath::at(Time now) const noexcept {
  const auto& [fates, decided, period] = *track_;
  if (decided.empty()) return nullptr;
  const Time first = fates.front().clock;
  if (now > first) now = first + (now - first) % period;
  const auto after =
      std::ranges::upper_bound(decided, now, {}, [&fates = fates](std::uint32_t i) { return fates[i].clock; });
  return &fates[after == decided.begin() ? *after : *std::prev(after)];
}

PathDecision ReplayPath::send(Time now) noexcept {
  PathDecision decision{.index = count_++, .at = now};
  if (track_->fates.empty()) return decision;
  const std::uint64_t index = decision.index;
  const Replay::Fate* fate = own(now, index);
  const bool matched = fate != nullptr;
  if (matched) ++matched_;
  if (!matched) {
    now = std::max(now, last_in_);
    fate = at(now);
    if (fate == nullptr) return decision;  // nothing to imitate: the datagram passes
  }
  last_in_ = std::max(last_in_, now);
  decision = fate->decision;  // kWaiting only for the recorded datagram itself: `at` returns decided fates
  decision.index = index;
  decision.at = now + fate->delay();
  if (decision.outcome == Outcome::kDeliver) {
    if (!matched) decision.at = std::max(decision.at, last_out_);
    last_out_ = std::max(last_out_, decision.at);
  }
  return decision;
}

}  // namespace tandem::netsim
