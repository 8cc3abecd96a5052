#include "server/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tandem::server {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kSettle = 1.0;     // [s] not judged after engage or an outage
constexpr double kLagMax = 2.0;     // [s] longest lag that is looked for
constexpr double kSlipReach = 0.15;  // [s] catching up and the age of samples: how far from its tick a slip shows
constexpr std::size_t kSlipsMax = 1000;
constexpr double kSpeedSpan = 0.005;  // [s] over which speed is taken: encoder steps vanish, motion does not

std::array<float, 3> single(const Triple& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

double distance2(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = static_cast<double>(a[k]) - static_cast<double>(b[k]);
    sum += d * d;
  }
  return sum;
}

double norm(const std::array<float, 3>& v) { return std::sqrt(distance2(v, {})); }

/// Root of the mean of what is added; NaN of nothing.
class Rms {
 public:
  void add(double square) {
    sum_ += square;
    ++n_;
  }
  [[nodiscard]] double value() const { return n_ == 0 ? kNaN : std::sqrt(sum_ / static_cast<double>(n_)); }

 private:
  double sum_ = 0;
  std::uint64_t n_ = 0;
};

}  // namespace

ReportBuilder::ReportBuilder(const SceneSpec& scene)
    : scene_(&scene),
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
  const auto ticks = static_cast<std::size_t>(std::min(scene.duration * scene.tick_hz + 1000, static_cast<double>(kTicksMax)));
  for (auto& t : seats_) t.reserve(ticks);
  for (auto& t : tools_) t.reserve(ticks);
}

void ReportBuilder::place(Track& track, std::uint32_t tick, const Sample& sample) {
  if (tick >= kTicksMax) return;
  if (tick >= track.size()) track.resize(tick + 1);
  track[tick] = sample;
}

void ReportBuilder::add(const TickRecord& record) {
  if (!record.running) return;
  // A server that has too much to do leaves records out: each stands for the ticks since the one before.
  const std::uint32_t stands_for = ticks_ > 0 && record.tick > newest_ ? record.tick - newest_ : 1;
  newest_ = record.tick;
  ticks_ += stands_for;
  if (record.tick >= kTicksMax) return;
  judged_ += stands_for;
  if (record.slipped != slipped_ && slips_.size() < kSlipsMax) slips_.push_back(record.tick);
  slipped_ = record.slipped;
  const auto settled = [&](std::uint32_t& since, bool on) {
    if (!on) since = ~0u;
    if (on && since == ~0u) since = record.tick;
    return on && record.tick - since >= static_cast<std::uint32_t>(kSettle * scene_->tick_hz);
  };
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const SeatRecord& s = record.seats[i];
    alpha_sum_[i] += stands_for * s.alpha;
    last_[i] = s;
    const bool usable = settled(engaged_since_[i], s.engaged);
    place(seats_[i], s.sample_tick, {single(s.x), single(s.f_out), single(s.f_cmd), single({s.q[0], s.q[1], s.q[2]}), true, usable});
  }
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const ToolRecord& t = record.tools[j];
    mfs_[j] = t.mfs_j;
    held_ticks_[j] += t.held ? stands_for : 0;
    const bool usable = settled(held_since_[j], !t.held);
    place(tools_[j], t.sample_tick, {single(t.x), single(t.f_env), single(t.f_cmd), single({t.q[0], t.q[1], t.q[2]}), true, usable});
    const double square = t.f_env[0] * t.f_env[0] + t.f_env[1] * t.f_env[1] + t.f_env[2] * t.f_env[2];
    if (square > 1e-12) {
      contact_square_[j] += square;
      ++contact_count_[j];
    }
    penetration_[j] = std::max(penetration_[j], t.penetration);
  }
}

/// Samples that never came are interpolated: between two known ones motion is smooth at this time scale.
ReportBuilder::Track ReportBuilder::without_gaps(const Track& track) {
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
    }
    before = k;
  }
  return out;
}

std::vector<char> ReportBuilder::counted(const Pair& pair, const std::vector<Window>& windows) const {
  const std::size_t n = std::min(pair.seat->size(), pair.slave->size());
  std::vector<char> use(n, 0);
  const auto mark = [&](double from, double to, char value) {
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(from * scene_->tick_hz - 1e-6)));
    const auto last = static_cast<std::size_t>(std::max(0.0, std::ceil(to * scene_->tick_hz - 1e-6)));
    for (std::size_t k = first; k < std::min(last, n); ++k) use[k] = value;
  };
  for (const Window& w : windows) mark(w.from, w.to, 1);
  for (const SeatSpec& s : scene_->seats)
    for (const Deviation& d : s.hand.deviations) mark(d.at, d.at + d.length, 0);
  for (std::size_t k = 0; k < n; ++k) use[k] = static_cast<char>(use[k] && (*pair.seat)[k].usable && (*pair.slave)[k].usable);
  return use;
}

SeatMetrics ReportBuilder::judge(const Pair& pair, const std::vector<Window>& windows, const std::vector<Window>& contact,
                                 const Window& peaks) const {
  const Track& s = *pair.seat;
  const Track& t = *pair.slave;
  const std::vector<char> use = counted(pair, windows);
  const std::size_t n = use.size();
  SeatMetrics m;

  const auto rms_at_lag = [&](std::size_t lag, std::size_t stride) {
    Rms rms;
    for (std::size_t k = 0; k + lag < n; k += stride)
      if (use[k]) rms.add(distance2(s[k].x, t[k + lag].x));
    return rms.value();
  };
  m.tracking_rms_m = rms_at_lag(0, 1);
  const auto coarse = std::max<std::size_t>(1, static_cast<std::size_t>(0.010 * scene_->tick_hz));
  std::size_t best = 0;
  double least = m.tracking_rms_m;
  const auto try_lag = [&](std::size_t lag, std::size_t stride) {
    if (const double r = rms_at_lag(lag, stride); r < least) {
      least = r;
      best = lag;
    }
  };
  for (std::size_t lag = coarse; lag <= static_cast<std::size_t>(kLagMax * scene_->tick_hz) && lag < n; lag += coarse) try_lag(lag, 4);
  const std::size_t around = best;
  least = rms_at_lag(around, 1);
  for (std::size_t lag = around > coarse ? around - coarse : 0; lag <= around + coarse && lag < n; ++lag) try_lag(lag, 1);
  m.tracking_rms_lag_removed_m = least;

  const auto delay = static_cast<std::size_t>(std::llround(pair.one_way_s * scene_->tick_hz));
  Rms transport, error, commanded;
  std::array<Rms, 3> joints;
  double effort = 0, speed = 0, environment = 0;
  const auto span = std::max<std::size_t>(1, static_cast<std::size_t>(kSpeedSpan * scene_->tick_hz));
  const auto slip_reach = static_cast<std::size_t>(kSlipReach * scene_->tick_hz);
  const auto slipped_near = [&](std::size_t k) {
    return std::ranges::any_of(slips_, [&](std::size_t slip) { return k + slip_reach >= slip && k <= slip + slip_reach; });
  };
  for (std::size_t k = 0; k < n; ++k) {
    if (!use[k]) continue;
    if (k >= delay) transport.add(distance2(s[k].x, s[k - delay].x));
    for (std::size_t c = 0; c < 3; ++c) {
      const double e = static_cast<double>(s[k].q[c]) - static_cast<double>(t[k].q[c]);
      joints[c].add(e * e);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    environment = std::max(environment, norm(t[k].f));  // percent is always of the run's peak
    const double time = static_cast<double>(k) / scene_->tick_hz;
    if (time < peaks.from || time >= peaks.to || !s[k].known) continue;
    effort = std::max(effort, norm(s[k].f));
    // Beside a gap in the samples, or where session time stood still, a difference is no speed.
    if (k >= span && s[k - span].known && !slipped_near(k)) speed = std::max(speed, std::sqrt(distance2(s[k].x, s[k - span].x)) * scene_->tick_hz / static_cast<double>(span));
  }
  if (!contact.empty()) {
    const std::vector<char> touching = counted(pair, contact);
    for (std::size_t k = 0; k < n; ++k) {
      if (!touching[k]) continue;
      const std::array<float, 3> felt{pair.answer * s[k].f[0], pair.answer * s[k].f[1], pair.answer * s[k].f[2]};
      const std::array<float, 3> asked{pair.answer * s[k].f_cmd[0], pair.answer * s[k].f_cmd[1], pair.answer * s[k].f_cmd[2]};
      error.add(distance2(felt, t[k].f));
      // What was commanded to the slave is what it would have pressed with; the environment answers with the opposite.
      const std::array<float, 3> wanted{-t[k].f_cmd[0], -t[k].f_cmd[1], -t[k].f_cmd[2]};
      commanded.add(distance2(asked, wanted));
    }
  }
  m.transport_lag_rms_m = transport.value();
  const std::size_t count = scene_->seats.front().device.model == DeviceModel::kLinear ? 1 : 3;
  for (std::size_t c = 0; c < count; ++c) m.joint_rms_rad.push_back(joints[c].value());
  m.force_error_rms_n = error.value();
  m.force_error_commanded_rms_n = commanded.value();
  const double judged = scene_->commanded_force ? m.force_error_commanded_rms_n : m.force_error_rms_n;
  double peak = environment;
  if (scene_->commanded_force) {
    peak = 0;
    for (std::size_t k = 0; k < n; ++k) peak = std::max(peak, norm(t[k].f_cmd));
  }
  m.force_error_percent = peak > 0 ? 100 * judged / peak : kNaN;
  m.effort_peak_n = effort;
  m.speed_peak_m_s = speed;
  return m;
}

RunReport ReportBuilder::build(const std::vector<LinkReport>& links) const {
  RunReport r;
  r.scenario = scene_->name;
  r.duration_s = static_cast<double>(ticks_) / scene_->tick_hz;
  r.judged_s = static_cast<double>(judged_) / scene_->tick_hz;
  std::vector<Track> seats, tools;
  for (const auto& t : seats_) seats.push_back(without_gaps(t));
  for (const auto& t : tools_) tools.push_back(without_gaps(t));

  std::vector<Window> all, contact;
  for (const PhaseSpec& p : scene_->phases) {
    all.push_back({p.from, p.to});
    if (p.contact) contact.push_back({p.from, p.to});
  }
  const auto pair_of = [&](std::size_t i) {
    std::size_t j = scene_->seats[i].kind == SeatKind::kSlave ? scene_->seats[i].tool : 0;
    if (scene_->seats[i].kind == SeatKind::kMaster)
      while (j + 1 < tools.size() && scene_->follow[i][j] <= 0) ++j;
    // Delay of the leader's path: up to the server; a remote slave adds its own, which the tracking error then contains.
    return Pair{&seats[i], &tools[j], i < links.size() ? std::max(0.0, 0.5 * (links[i].rtt_p50_ms * 1e-3 - 1 / scene_->tick_hz)) : 0,
                scene_->seats[i].kind == SeatKind::kSlave ? -1.0f : 1.0f};
  };
  for (std::size_t i = 0; i < seats.size(); ++i) {
    SeatReport s;
    s.name = scene_->seats[i].name;
    s.kind = scene_->seats[i].kind;
    s.role = scene_->seats[i].role;
    s.alpha_mean = judged_ > 0 ? alpha_sum_[i] / static_cast<double>(judged_) : 0;
    s.metrics = judge(pair_of(i), all, contact, {0, std::numeric_limits<double>::infinity()});
    s.gate = wire::to_text(last_[i].gate);
    s.last = last_[i];
    for (std::size_t j = 0; j < tools.size(); ++j) s.mfs_j += scene_->follow[i][j] > 0 ? mfs_[j] : 0;
    if (i < links.size()) s.link = links[i];
    r.seats.push_back(std::move(s));
  }
  for (std::size_t j = 0; j < tools.size(); ++j)
    r.tools.push_back({scene_->tools[j].name,
                       contact_count_[j] > 0 ? std::sqrt(contact_square_[j] / static_cast<double>(contact_count_[j])) : 0.0,
                       penetration_[j], static_cast<double>(held_ticks_[j]) / scene_->tick_hz});
  for (const PhaseSpec& p : scene_->phases) {
    PhaseReport phase{p.name, p.from, p.to, {}};
    const std::vector<Window> only{{p.from, p.to}};
    for (std::size_t i = 0; i < seats.size(); ++i)
      phase.seats.push_back(judge(pair_of(i), only, p.contact ? only : std::vector<Window>{}, only.front()));
    r.phases.push_back(std::move(phase));
  }
  return r;
}

}  // namespace tandem::server
