#include "server/report/report.h"

#include <algorithm>
#include <cmath>

namespace tandem::server {

namespace {

constexpr double kSettlingTime = 1.0;  // [s] excluded after engagement or an outage
constexpr std::size_t kDroppedTicksMax = 1000;
constexpr double kReservedMax = 60;  // [s] for a session without a scheduled end

std::array<float, 3> single(const Triple& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

ReportBuilder::ReportBuilder(const SceneSpec& scene, std::size_t slots_max)
    : scene_(&scene),
      slots_max_(std::max<std::size_t>(slots_max, 2)),
      seats_(scene.seats.size()),
      tools_(scene.tools.size()),
      alpha_sum_(scene.seats.size()),
      contact_square_(scene.tools.size()),
      penetration_(scene.tools.size()),
      contact_count_(scene.tools.size()),
      held_ticks_(scene.tools.size()),
      engaged_since_(scene.seats.size(), ~0u),
      held_since_(scene.tools.size(), ~0u),
      last_(scene.seats.size()),
      mfs_(scene.tools.size()) {
  const double length = scene.endless() ? kReservedMax : scene.duration;
  const auto slots = static_cast<std::size_t>(std::min(length * scene.tick_hz + 1000, static_cast<double>(slots_max_)));
  for (auto& t : seats_) t.reserve(slots);
  for (auto& t : tools_) t.reserve(slots);
}

void ReportBuilder::store_sample(Track& track, std::uint32_t tick, const Sample& sample) {
  if (tick % stride_ != 0) return;
  const std::size_t slot = tick / stride_;
  if (slot >= slots_max_) return;
  if (slot >= track.size()) track.resize(slot + 1);
  track[slot] = sample;
}

/// Keeps every second sample, so that a long session is evaluated to its end in bounded memory.
void ReportBuilder::decimate() {
  stride_ *= 2;
  for (auto* tracks : {&seats_, &tools_})
    for (Track& track : *tracks) {
      for (std::size_t k = 0; 2 * k < track.size(); ++k) track[k] = track[2 * k];
      track.resize((track.size() + 1) / 2);
    }
}

/// Records intervals in which session time did not advance while hands moved. Differences across them give no valid
/// speed. After a stop every seat engages again.
void ReportBuilder::track_stops(const TickRecord& record) {
  const bool stopped = record.stopped_ticks != stopped_ticks_;
  if ((record.dropped_ticks != dropped_ticks_ || stopped) && slips_.size() < kDroppedTicksMax)
    slips_.push_back(record.tick);
  stopped_total_ += record.stopped_ticks >= stopped_ticks_ ? record.stopped_ticks - stopped_ticks_
                                                           : record.stopped_ticks;  // a restarted server counts from 0
  dropped_ticks_ = record.dropped_ticks;
  stopped_ticks_ = record.stopped_ticks;
  if (!stopped) return;
  std::ranges::fill(engaged_since_, ~0u);
  std::ranges::fill(held_since_, ~0u);
}

void ReportBuilder::add(const TickRecord& record) {
  if (!record.running) return;
  // An overloaded server sheds records: each record represents all ticks since the one before.
  const std::uint32_t stands_for = ticks_ > 0 && record.tick > newest_ ? record.tick - newest_ : 1;
  newest_ = record.tick;
  ticks_ += stands_for;
  if (stands_for > std::max(1.0, kSpeedSpan * scene_->tick_hz)) {
    sparse_ticks_ += stands_for;
    ++sparse_records_;
  }
  unleased_ticks_ += record.unleased ? stands_for : 0;
  track_stops(record);
  while (record.tick / stride_ >= slots_max_) decimate();
  const auto settled = [&](std::uint32_t& since, bool on) {
    if (!on) since = ~0u;
    if (on && since == ~0u) since = record.tick;
    return on && record.tick - since >= static_cast<std::uint32_t>(kSettlingTime * scene_->tick_hz);
  };
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const SeatRecord& s = record.seats[i];
    alpha_sum_[i] += stands_for * s.alpha;
    last_[i] = s;
    const bool usable = settled(engaged_since_[i], s.engaged);
    store_sample(seats_[i], s.sample_tick,
                 {single(s.x), single(s.f_out), single(s.f_cmd), single({s.q[0], s.q[1], s.q[2]}), true, usable,
                  static_cast<std::uint8_t>(s.leader)});
  }
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const ToolRecord& t = record.tools[j];
    mfs_[j] = t.mfs_j;
    held_ticks_[j] += t.held && !record.unleased ? stands_for : 0;
    const bool usable = settled(held_since_[j], !t.held);
    store_sample(tools_[j], t.sample_tick,
                 {single(t.x), single(t.f_env), single(t.f_cmd), single({t.q[0], t.q[1], t.q[2]}), true, usable, 0});
    const double square = t.f_env[0] * t.f_env[0] + t.f_env[1] * t.f_env[1] + t.f_env[2] * t.f_env[2];
    if (square > 1e-12) {
      contact_square_[j] += square;
      ++contact_count_[j];
    }
    penetration_[j] = std::max(penetration_[j], t.penetration);
  }
}

/// Interpolates missing samples: between two known samples the motion is smooth at this time scale.
ReportBuilder::Track ReportBuilder::fill_gaps(const Track& track) {
  Track out = track;
  std::size_t before = out.size();
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!out[k].known) continue;
    for (std::size_t g = before == out.size() ? 0 : before + 1; g < k; ++g) {
      const float w = before == out.size() ? 1.0f : static_cast<float>(g - before) / static_cast<float>(k - before);
      const Sample& a = out[before == out.size() ? k : before];
      const Sample& b = out[k];
      for (std::size_t c = 0; c < 3; ++c) {
        out[g].x[c] = a.x[c] + w * (b.x[c] - a.x[c]);
        out[g].f[c] = a.f[c] + w * (b.f[c] - a.f[c]);
        out[g].f_cmd[c] = a.f_cmd[c] + w * (b.f_cmd[c] - a.f_cmd[c]);
        out[g].q[c] = a.q[c] + w * (b.q[c] - a.q[c]);
      }
      out[g].usable = a.usable && b.usable;
      out[g].leader = a.leader == b.leader ? a.leader : std::uint8_t{0};
    }
    before = k;
  }
  return out;
}

/// Whether the path of a hand, while its seat was engaged, extends over more than kMoved along an axis.
bool ReportBuilder::has_moved(const Track& track) {
  std::optional<std::pair<Point3, Point3>> box;
  for (const Sample& s : track) {
    if (!s.known || !s.usable) continue;
    if (!box) box.emplace(s.x, s.x);
    for (std::size_t c = 0; c < 3; ++c) {
      box->first[c] = std::min(box->first[c], s.x[c]);
      box->second[c] = std::max(box->second[c], s.x[c]);
      if (box->second[c] - box->first[c] > kMoved) return true;
    }
  }
  return false;
}

RunReport ReportBuilder::build(const std::vector<LinkReport>& links) const {
  RunReport r;
  r.scenario = scene_->name;
  r.duration_s = static_cast<double>(ticks_) / scene_->tick_hz;
  if (sparse()) {
    r.sparse_s = static_cast<double>(sparse_ticks_) / scene_->tick_hz;
    r.sparse_gap_s = r.sparse_s / static_cast<double>(sparse_records_);
  }
  r.stopped_s = static_cast<double>(stopped_total_) / scene_->tick_hz;
  r.unleased_s = static_cast<double>(unleased_ticks_) / scene_->tick_hz;
  std::vector<Track> seats, tools;
  for (const auto& t : seats_) seats.push_back(fill_gaps(t));
  for (const auto& t : tools_) tools.push_back(fill_gaps(t));

  ReportInterval all{.windows = {},
                     .outside = scene_->phases.empty(),
                     .contact = {},
                     .all_peaks = true};  // outside of no window: everything
  for (const PhaseSpec& p : scene_->phases) {
    all.windows.push_back({p.from, p.to});
    if (p.contact) all.contact.push_back({p.from, p.to});
  }
  const ReportInterval rest{.windows = all.windows, .outside = true, .contact = {}, .all_peaks = false};
  const auto pair_of = [&](std::size_t i) {
    std::size_t j = scene_->seats[i].kind == SeatKind::kSlave ? scene_->seats[i].tool : 0;
    if (scene_->seats[i].kind == SeatKind::kMaster)
      while (j + 1 < tools.size() && scene_->follow[i][j] <= 0) ++j;
    // Delay of the leader's path up to the server. A remote slave adds its own delay, which the tracking error then
    // contains.
    return SeatAndSlave{&seats[i],
                        &tools[j],
                        i < links.size() ? std::max(0.0, 0.5 * (links[i].rtt_p50_ms * 1e-3 - 1 / scene_->tick_hz)) : 0,
                        !scene_->tools[j].is_virtual || scene_->tools[j].remote,
                        seats,
                        scene_->seats[i].kind == SeatKind::kSlave ? -1.0f : 1.0f};
  };
  for (std::size_t i = 0; i < seats.size(); ++i) {
    SeatReport s;
    s.name = scene_->seats[i].name;
    s.kind = scene_->seats[i].kind;
    s.role = scene_->seats[i].role;
    s.alpha_mean = ticks_ > 0 ? alpha_sum_[i] / static_cast<double>(ticks_) : 0;
    s.metrics = compute_metrics(pair_of(i), all);
    if (s.kind == SeatKind::kMaster) r.moved = r.moved || has_moved(seats_[i]);
    s.gate = wire::to_text(last_[i].gate);
    s.last = last_[i];
    for (std::size_t j = 0; j < tools.size(); ++j) s.mfs_j += scene_->follow[i][j] > 0 ? mfs_[j] : 0;
    if (i < links.size()) s.link = links[i];
    r.seats.push_back(std::move(s));
  }
  for (std::size_t j = 0; j < tools.size(); ++j)
    r.tools.push_back(
        {scene_->tools[j].name,
         contact_count_[j] > 0 ? std::sqrt(contact_square_[j] / static_cast<double>(contact_count_[j])) : 0.0,
         penetration_[j], static_cast<double>(held_ticks_[j]) / scene_->tick_hz});
  for (const PhaseSpec& p : scene_->phases) {
    PhaseReport phase{p.name, p.from, p.to, {}};
    const std::vector<Window> only{{p.from, p.to}};
    const ReportInterval part{
        .windows = only, .outside = false, .contact = p.contact ? only : std::vector<Window>{}, .all_peaks = false};
    for (std::size_t i = 0; i < seats.size(); ++i) phase.seats.push_back(compute_metrics(pair_of(i), part));
    r.phases.push_back(std::move(phase));
  }
  if (!scene_->phases.empty()) {
    r.outside.emplace(PhaseReport{"outside phases", 0, r.duration_s, {}});
    for (std::size_t i = 0; i < seats.size(); ++i) r.outside->seats.push_back(compute_metrics(pair_of(i), rest));
  }
  // Time counts as evaluated if it is for any MASTER seat. Phases and the rest do not overlap for one seat.
  std::vector<char> any;
  for (std::size_t i = 0; i < scene_->masters(); ++i)
    for (const ReportInterval* part : {&static_cast<const ReportInterval&>(all), &rest}) {
      const std::vector<char> use = usable_slots(pair_of(i), part->windows, part->outside);
      any.resize(std::max(any.size(), use.size()));
      for (std::size_t k = 0; k < use.size(); ++k) any[k] = static_cast<char>(any[k] | use[k]);
    }
  r.judged_s = static_cast<double>(std::ranges::count(any, 1)) / rate();
  return r;
}

}  // namespace tandem::server
