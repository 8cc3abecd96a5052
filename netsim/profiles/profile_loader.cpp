#include "netsim/profiles/profile_loader.h"

#include <algorithm>
#include <cmath>

#include "common/base/suggestions.h"
#include "proto/text/profile_text.h"

namespace tandem::netsim {
namespace {

Duration milliseconds(double ms) { return Duration{std::llround(ms * 1e6)}; }
double probability(double percent) { return percent / 100; }

BodySpec body_from(const ProfileBody& in) {
  BodySpec body;
  if (in.kind == ProfileBody::Kind::kNone) return body;
  body = {.kind = static_cast<BodySpec::Kind>(in.kind),
          .low = milliseconds(in.low_ms),
          .high = milliseconds(in.high_ms),
          .scale = milliseconds(in.scale_ms),
          .shape = in.shape,
          .cap = milliseconds(in.cap_ms),
          .tau = milliseconds(in.tau_ms),
          .sd = milliseconds(in.sd_ms)};
  for (const auto& phase : in.phases) body.phases.push_back({phase.weight, milliseconds(phase.mean_ms)});
  for (const auto& point : in.points) {
    body.quantiles.push_back({probability(point.percent), milliseconds(point.delay_ms)});
  }
  return body;
}

LossSpec loss_from(const ProfilePath& in) {
  LossSpec loss;
  loss.probability = probability(in.loss_percent);
  if (const auto& bad = in.bad_periods) {
    loss.periods = BadPeriodsSpec{.good_mean = milliseconds(bad->good_mean_s * 1e3),
                                  .bad_mean = milliseconds(bad->bad_mean_ms),
                                  .loss_good = probability(bad->loss_good_percent),
                                  .loss_bad = probability(bad->loss_bad_percent)};
  }
  if (const auto& ge = in.gilbert_elliott) {
    loss.gilbert_elliott = GilbertElliottSpec{.p = probability(ge->p_percent),
                                              .r = probability(ge->r_percent),
                                              .h = probability(ge->h_percent),
                                              .k = probability(ge->k_percent)};
  }
  if (const auto& four = in.four_state) {
    loss.four_state = FourStateSpec{.p13 = probability(four->p13_percent),
                                    .p31 = probability(four->p31_percent),
                                    .p32 = probability(four->p32_percent),
                                    .p23 = probability(four->p23_percent),
                                    .p14 = probability(four->p14_percent)};
  }
  if (const auto& bursts = in.loss_bursts) {
    loss.bursts = LossBurstsSpec{
        .rate_per_s = bursts->rate_per_s,
        .law = static_cast<LossBurstsSpec::Law>(bursts->law),
        .unit = bursts->datagrams ? LossBurstsSpec::Unit::kDatagrams : LossBurstsSpec::Unit::kMilliseconds,
        .length = bursts->length,
        .alpha = bursts->alpha,
        .cap = bursts->cap};
  }
  if (const auto& pattern = in.loss_pattern) {
    LossPatternSpec& out = loss.pattern.emplace();
    out = {.lost = pattern->lost, .of = pattern->of, .every = pattern->every, .indices = pattern->indices};
    for (const double s : pattern->times_s) out.times.push_back(milliseconds(s * 1e3));
  }
  if (const auto& congestion = in.congestion_loss) {
    loss.congestion = CongestionLossSpec{.wait_low = milliseconds(congestion->wait_low_ms),
                                         .wait_high = milliseconds(congestion->wait_high_ms),
                                         .probability = probability(congestion->queue_percent),
                                         .in_stall = probability(congestion->stall_percent)};
  }
  if (const auto& trace = in.loss_trace) {
    loss.trace = std::make_shared<LossTrace>(LossTrace{trace->lost, milliseconds(trace->interval_ms)});
  }
  return loss;
}

PathSpec path_from(const ProfilePath& in) {
  PathSpec path;
  path.loss = loss_from(in);
  if (const auto& rate = in.rate) {
    path.rate.bits_per_s = rate->rate_bit_s;
    path.rate.overhead_bytes = rate->overhead_bytes;
    path.rate.queue_bytes = rate->queue_bytes;
    if (rate->queue_ms) path.rate.queue_wait = milliseconds(*rate->queue_ms);
    path.rate.queue_datagrams = rate->queue_datagrams;
    if (rate->codel) {
      path.rate.codel = CoDelSpec{milliseconds(rate->codel_target_ms), milliseconds(rate->codel_interval_ms)};
    }
    path.rate.drop = rate->drop_head ? RateSpec::Drop::kHead : RateSpec::Drop::kTail;
    path.rate.recorded = rate->capacity_file.has_value();
    path.rate.competing_peak = milliseconds(rate->competing_peak_ms);
    path.rate.competing_period = milliseconds(rate->competing_period_ms);
  }
  path.floor = milliseconds(in.floor_ms);
  path.body = body_from(in.body);
  for (const ProfileRegime& regime : in.regimes) {
    path.regimes.push_back({milliseconds(regime.mean_ms), milliseconds(regime.floor_ms), body_from(regime.body)});
  }
  if (const auto& boundary = in.boundary) {
    path.boundary = {.period = milliseconds(boundary->period_s * 1e3),
                     .phase = milliseconds(boundary->phase_s * 1e3),
                     .stall_low = milliseconds(boundary->stall_low_ms),
                     .stall_high = milliseconds(boundary->stall_high_ms),
                     .floor_high = milliseconds(boundary->floor_high_ms),
                     .loss_window = milliseconds(boundary->loss_window_ms),
                     .loss = probability(boundary->loss_percent)};
  }
  if (const auto& slots = in.slots) path.slots = {milliseconds(slots->period_ms), slots->datagrams, slots->bytes};
  if (const auto& stall = in.stall) {
    path.stall = {.rate_per_s = stall->rate_per_s,
                  .length_min = milliseconds(stall->length_min_ms),
                  .alpha = stall->alpha,
                  .cap = milliseconds(stall->cap_ms)};
  }
  path.corruption.probability = probability(in.corrupted_percent);
  path.corruption.mode = static_cast<CorruptionSpec::Mode>(in.corruption);
  path.corruption.bits = in.corrupted_bits;
  path.mtu = {in.mtu_bytes, in.fragments ? MtuSpec::Above::kFragment : MtuSpec::Above::kDrop};
  path.order = in.free_order ? Order::kFree : Order::kFifo;
  if (const auto& reorder = in.reorder) {
    path.reorder = {.probability = probability(reorder->probability_percent),
                    .displacement = reorder->displacement,
                    .hold_limit = milliseconds(reorder->hold_limit_ms)};
  }
  if (const auto& duplicate = in.duplicate) {
    path.duplicate = {.probability = probability(duplicate->probability_percent),
                      .delay_max = milliseconds(duplicate->delay_max_ms)};
  }
  return path;
}

}  // namespace

OutageSpec outage_from(const ProfileOutage& in) {
  return {.start = milliseconds(in.start_s * 1e3),
          .length = milliseconds(in.length_ms),
          .period = milliseconds(in.period_s * 1e3),
          .mode = in.hold        ? OutageSpec::Mode::kHold
                  : in.hold_last ? OutageSpec::Mode::kHoldLast
                                 : OutageSpec::Mode::kDrop,
          .hold_bytes = in.hold_bytes,
          .mean_gap = milliseconds(in.mean_gap_s * 1e3),
          .length_max =
              in.mean_gap_s > 0 || in.length_max_ms > in.length_ms ? milliseconds(in.length_max_ms) : Duration::zero(),
          .scope = in.all_links ? OutageSpec::Scope::kAll : OutageSpec::Scope::kLink,
          .loss_at_start = milliseconds(in.loss_at_start_ms)};
}

/// Returns a minimal recording, used to validate the other parameters while the real one is missing.
std::shared_ptr<const CapacityTrace> stand_in() {
  return std::make_shared<CapacityTrace>(CapacityTrace{{{0, 1}}, std::chrono::milliseconds(1)});
}

namespace {

struct Embedded {
  std::string_view name, unused, text;
};
constexpr Embedded kEmbedded[] = {
#include "profiles_embedded_data.inc"
};

std::vector<ShippedProfile> sorted() {
  std::vector<ShippedProfile> all;
  for (const Embedded& profile : kEmbedded) all.push_back({profile.name, profile.text});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return all;
}

}  // namespace

bool supply_capacity(LinkSpec& link, const LinkSpec& recorded) {
  bool used = false;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    RateSpec& rate = link[direction].rate;
    if (!rate.recorded) continue;
    rate.trace = recorded[direction].rate.trace;
    used = true;
  }
  return used;
}

std::expected<Profile, InputErrors> parse_profile(std::string_view text, std::string_view file_name) {
  auto in = parse_profile_text(text, file_name);
  if (!in) return std::unexpected(std::move(in.error()));
  Profile profile;
  profile.name = std::move(in->name);
  profile.version = in->version;
  profile.summary = std::move(in->summary);
  profile.sources = std::move(in->sources);
  profile.link = {path_from(in->up), path_from(in->down), in->shared};
  for (const ProfilePath* path : {&in->up, &in->down}) {
    if (path->rate && path->rate->capacity_file) profile.capacity_file = *path->rate->capacity_file;
  }
  for (const ProfileOutage& outage : in->outages) {
    if (outage.up) profile.link.up.outages.push_back(outage_from(outage));
    if (outage.down) profile.link.down.outages.push_back(outage_from(outage));
  }
  for (const ProfileQuantiles& check : in->checks) {
    if (check.up) profile.checks.push_back({Direction::kUp, check.delay_ms});
    if (check.down) profile.checks.push_back({Direction::kDown, check.delay_ms});
  }
  // Final validation by the engine. Errors missed by the schema's rules (a value rounded to 0 ns) have no line.
  InputErrors errors;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    PathSpec spec = profile.link[direction];
    if (spec.rate.recorded) spec.rate.trace = stand_in();
    for (const SpecError& problem : problems(spec)) {
      errors.push_back(
          {std::string(file_name), 0, 0, std::string(name(direction)) + "." + problem.key, "", problem.message});
    }
  }
  if (!errors.empty()) return std::unexpected(std::move(errors));
  return profile;
}

std::span<const ShippedProfile> shipped_profiles() noexcept {
  static const std::vector<ShippedProfile> all = sorted();
  return all;
}

std::span<const ShippedProfile> complete_profiles() {
  static const std::vector<ShippedProfile> all = [] {
    std::vector<ShippedProfile> some;
    for (const ShippedProfile& profile : shipped_profiles()) {
      const auto read = shipped_profile(profile.name);
      if (read && !read->capacity_file) some.push_back(profile);
    }
    return some;
  }();
  return all;
}

std::expected<Profile, InputErrors> shipped_profile(std::string_view name) {
  std::vector<std::string> names;
  for (const ShippedProfile& profile : shipped_profiles()) {
    if (profile.name == name) return parse_profile(profile.text, std::string(name) + ".textproto");
    names.emplace_back(profile.name);
  }
  InputError error;
  error.message = "no profile is called \"" + std::string(name) + "\"; " + suggest(name, names) +
                  "; a file needs its path or its ending, such as my.textproto";
  return std::unexpected(InputErrors{error});
}

}  // namespace tandem::netsim
