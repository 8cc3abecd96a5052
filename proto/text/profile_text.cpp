#include "proto/text/profile_text.h"

#include <algorithm>
#include <cmath>

#include "common/base/milliseconds.h"
#include "proto/schema/profile.pb.h"
#include "proto/text/profile_delay.h"
#include "proto/text/profile_loss.h"
#include "proto/text/profile_outage.h"
#include "proto/text/text_format_reader.h"

namespace tandem::netsim {
namespace {

using text::child_path;
using text::MessageValidator;

std::uint64_t whole(double value) { return static_cast<std::uint64_t>(std::llround(value)); }

StallSpec stall_from(const pb::Stall& in, MessageValidator& validator, const std::string& key) {
  if (in.cap_ms() < in.length_min_ms()) validator.error(child_path(key, "cap_ms"), "is below length_min_ms");
  if (in.rate_per_s() * in.cap_ms() > 32e3) {
    validator.error(child_path(key, "rate_per_s"), "times cap_ms must be at most 32 stalls at the same time");
  }
  return {.rate_per_s = in.rate_per_s(),
          .length_min = from_milliseconds(in.length_min_ms()),
          .alpha = in.alpha(),
          .cap = from_milliseconds(in.cap_ms())};
}

void check_codel(const pb::LinkRateProfile& in, MessageValidator& validator, const std::string& key) {
  const double target = in.codel().has_target_ms() ? in.codel().target_ms() : seconds(CoDelSpec{}.target) * 1e3;
  const double interval = in.codel().has_interval_ms() ? in.codel().interval_ms() : seconds(CoDelSpec{}.interval) * 1e3;
  if (target >= interval) validator.error(child_path(key, "codel"), "target_ms must be below interval_ms");
}

void check_head_drop(const pb::LinkRateProfile& in, MessageValidator& validator, const std::string& key) {
  if (!in.has_queue_bytes() && !in.has_queue_ms() && !in.has_queue_datagrams()) {
    validator.error(child_path(key, "drop"), "needs a limit: queue_bytes, queue_ms or queue_datagrams");
  }
  if (in.has_codel()) validator.error(child_path(key, "codel"), "drops by a law of its own: not with drop: HEAD");
  if (in.has_competing_peak_ms()) validator.error(child_path(key, "competing_peak_ms"), "not with drop: HEAD");
}

RateSpec rate_from(const pb::LinkRateProfile& in, MessageValidator& validator, const std::string& key) {
  RateSpec rate{.bits_per_s = whole(in.rate_bit_s()), .recorded = in.has_capacity()};
  if (in.has_rate_bit_s() == in.has_capacity()) validator.error(key, "needs exactly one of rate_bit_s, capacity");
  if (in.capacity().has_file() && in.capacity().file().empty()) {
    validator.error(child_path(key, "capacity.file"), "is empty: leave it out and give the file when you start");
  }
  if (in.has_capacity() && in.has_competing_peak_ms()) {
    validator.error(child_path(key, "competing_peak_ms"), "not with a recorded capacity");
  }
  if (in.rate_bit_s() != std::floor(in.rate_bit_s())) {
    validator.error(child_path(key, "rate_bit_s"), "must be a whole number");
  }
  if (in.has_overhead_bytes()) rate.overhead_bytes = in.overhead_bytes();
  if (in.has_queue_bytes()) rate.queue_bytes = whole(in.queue_bytes());
  if (in.has_queue_ms()) rate.queue_wait = from_milliseconds(in.queue_ms());
  rate.queue_datagrams = in.queue_datagrams();
  check_codel(in, validator, key);
  if (in.has_codel()) {
    CoDelSpec& codel = rate.codel.emplace();
    if (in.codel().has_target_ms()) codel.target = from_milliseconds(in.codel().target_ms());
    if (in.codel().has_interval_ms()) codel.interval = from_milliseconds(in.codel().interval_ms());
  }
  if (in.drop() == pb::LinkRateProfile::HEAD) {
    rate.drop = RateSpec::Drop::kHead;
    check_head_drop(in, validator, key);
  }
  rate.competing_peak = from_milliseconds(in.competing_peak_ms());
  rate.competing_period = from_milliseconds(in.competing_period_ms());
  if (in.has_competing_peak_ms() != in.has_competing_period_ms()) {
    validator.error(key, "competing_peak_ms and competing_period_ms belong together");
  } else if (in.has_competing_peak_ms() && in.competing_period_ms() <= in.competing_peak_ms()) {
    validator.error(child_path(key, "competing_period_ms"),
                    "must be above competing_peak_ms: a queue drains in real time");
  }
  return rate;
}

CorruptionSpec corruption_from(const pb::NetworkPath& in, MessageValidator& validator, const std::string& key) {
  using Mode = CorruptionSpec::Mode;
  CorruptionSpec corruption{.probability = probability(in.corrupted_percent()),
                            .mode = in.corruption() == pb::NetworkPath::BIT_FLIPS  ? Mode::kBitFlips
                                    : in.corruption() == pb::NetworkPath::TRUNCATE ? Mode::kTruncate
                                                                                   : Mode::kChecksum};
  if (in.has_corrupted_bits()) corruption.bits = in.corrupted_bits();
  if (in.has_corruption() && !in.has_corrupted_percent()) {
    validator.error(child_path(key, "corruption"), "needs corrupted_percent");
  }
  if (in.has_corrupted_bits() && corruption.mode != Mode::kBitFlips) {
    validator.error(child_path(key, "corrupted_bits"), "needs corruption: BIT_FLIPS");
  }
  return corruption;
}

MtuSpec mtu_from(const pb::NetworkPath& in, std::uint32_t overhead, MessageValidator& validator,
                 const std::string& key) {
  const bool fragments = in.above_mtu() == pb::NetworkPath::FRAGMENT;
  if (in.has_above_mtu() && !in.has_mtu_bytes()) validator.error(child_path(key, "above_mtu"), "needs mtu_bytes");
  const std::uint32_t least = overhead + (fragments ? 8 : 1);
  if (in.has_mtu_bytes() && in.mtu_bytes() < least) {
    validator.error(child_path(key, "mtu_bytes"), "leaves no room beside the overhead of " + std::to_string(overhead) +
                                                      " bytes; at least " + std::to_string(least));
  }
  return {in.mtu_bytes(), fragments ? MtuSpec::Above::kFragment : MtuSpec::Above::kDrop};
}

PathSpec path_from(const pb::NetworkPath& in, MessageValidator& validator, const std::string& key) {
  PathSpec path;
  if (in.has_rate()) path.rate = rate_from(in.rate(), validator, child_path(key, "rate"));
  path.floor = from_milliseconds(in.floor_ms());
  delay_from(in, path, validator, key);
  path.corruption = corruption_from(in, validator, key);
  path.mtu = mtu_from(in, path.rate.overhead_bytes, validator, key);
  if (in.has_stall()) path.stall = stall_from(in.stall(), validator, child_path(key, "stall"));
  path.order = in.order() == pb::NetworkPath::FREE ? ArrivalOrder::kFree : ArrivalOrder::kFifo;
  path.reorder.probability = probability(in.reorder().probability_percent());
  if (in.reorder().has_displacement()) path.reorder.displacement = in.reorder().displacement();
  if (in.reorder().has_hold_limit_ms()) path.reorder.hold_limit = from_milliseconds(in.reorder().hold_limit_ms());
  path.duplicate.probability = probability(in.duplicate().probability_percent());
  if (in.duplicate().has_delay_max_ms()) path.duplicate.delay_max = from_milliseconds(in.duplicate().delay_max_ms());
  path.loss = loss_from(in, validator, key);
  return path;
}

}  // namespace

OutageSpec outage_from(const pb::ProfileOutage& in, MessageValidator& validator, const std::string& key) {
  using Mode = OutageSpec::Mode;
  const bool random_length = in.has_length_max_ms() && in.length_max_ms() > in.length_ms();
  const double length_max_ms = in.has_length_max_ms() ? in.length_max_ms() : in.length_ms();
  if (in.has_mean_gap_s() == in.has_start_s()) validator.error(key, "needs exactly one of start_s, mean_gap_s");
  if (in.has_mean_gap_s() && in.has_period_s()) validator.error(child_path(key, "period_s"), "not with mean_gap_s");
  if (in.has_length_max_ms() && !in.has_mean_gap_s() && !in.has_period_s()) {
    validator.error(child_path(key, "length_max_ms"), "needs mean_gap_s or period_s");
  }
  if (length_max_ms < in.length_ms()) validator.error(child_path(key, "length_max_ms"), "is below length_ms");
  if (in.mean_gap_s() > 0 && length_max_ms > 32e3 * in.mean_gap_s()) {
    validator.error(child_path(key, "length_max_ms"), "is above 32 times mean_gap_s");
  }
  if (in.has_period_s() && in.period_s() * 1e3 <= std::max(in.length_ms(), length_max_ms)) {
    validator.error(child_path(key, "period_s"), "must be longer than the outage, or the link is never up");
  }
  if (in.has_scope() && !in.has_mean_gap_s() && !in.has_length_max_ms()) {
    validator.error(
        child_path(key, "scope"),
        "needs mean_gap_s or length_max_ms: an outage without a drawn time or length hits all clients in any case");
  }
  if (in.length_ms() > 0 && in.loss_at_start_ms() > in.length_ms()) {  // otherwise the length is the error
    validator.error(child_path(key, "loss_at_start_ms"), "is longer than the outage");
  }
  if (in.has_hold_bytes() && in.mode() != pb::ProfileOutage::HOLD)
    validator.error(child_path(key, "hold_bytes"), "needs mode: HOLD");
  return {.start = from_milliseconds(in.start_s() * 1e3),
          .length = from_milliseconds(in.length_ms()),
          .period = from_milliseconds(in.period_s() * 1e3),
          .mode = in.mode() == pb::ProfileOutage::HOLD        ? Mode::kHold
                  : in.mode() == pb::ProfileOutage::HOLD_LAST ? Mode::kHoldLast
                                                              : Mode::kDrop,
          .hold_bytes = whole(in.hold_bytes()),
          .mean_gap = from_milliseconds(in.mean_gap_s() * 1e3),
          .length_max = in.mean_gap_s() > 0 || random_length ? from_milliseconds(length_max_ms) : Duration::zero(),
          .scope = in.scope() == pb::ProfileOutage::ALL_LINKS ? OutageSpec::Scope::kAll : OutageSpec::Scope::kLink,
          .loss_at_start = from_milliseconds(in.loss_at_start_ms())};
}

namespace {

/// Calls `each(direction)` for the directions that a message of the schema names.
template <typename Each>
void for_directions(pb::ProfileOutage::Where named, const Each& each) {
  if (named != pb::ProfileOutage::DOWN) each(Direction::kUp);
  if (named != pb::ProfileOutage::UP) each(Direction::kDown);
}

std::optional<std::string> capacity_file(const pb::NetworkPath& in) {
  return in.rate().has_capacity() ? std::optional{in.rate().capacity().file()} : std::nullopt;
}

void read_directions(const pb::Profile& in, Profile& profile, MessageValidator& validator) {
  if (in.has_both()) {
    for (const char* key : {"up", "down"}) {
      if (validator.is_set(key)) validator.error(key, "both directions are described by `both` already");
    }
    profile.link.up = profile.link.down = path_from(in.both(), validator, "both");
    if (const auto& trace = profile.link.up.loss.trace)
      profile.link.down.loss.trace = std::make_shared<LossTrace>(*trace);
    profile.capacity_file = capacity_file(in.both());
    return;
  }
  if (!in.has_up() || !in.has_down()) {
    validator.error("", "needs `both { ... }`, or `up { ... }` and `down { ... }`; an empty one is a perfect network");
  }
  profile.link.up = path_from(in.up(), validator, "up");
  profile.link.down = path_from(in.down(), validator, "down");
  const auto up = capacity_file(in.up()), down = capacity_file(in.down());
  if (up && down && *up != *down) {
    validator.error("down.rate.capacity", "names another file than up.rate.capacity: one file holds both directions");
  }
  profile.capacity_file = down ? down : up;
}

std::string stem(std::string_view file) {
  if (const auto slash = file.rfind('/'); slash != std::string_view::npos) file.remove_prefix(slash + 1);
  return std::string(file.substr(0, file.find('.')));
}

}  // namespace

std::expected<Profile, InputErrors> parse_profile_text(std::string_view text, std::string_view file_name) {
  MessageValidator validator{file_name};
  pb::Profile in;
  text::read_document(text, file_name, in, validator);
  // Rules between numbers apply only to numbers that are in range.
  if (!validator.ok()) return std::unexpected(validator.take());

  Profile profile;
  profile.name = stem(file_name);
  profile.version = in.version();
  profile.summary = in.summary();
  profile.sources.assign(in.source().begin(), in.source().end());
  profile.link.shared = in.shared();
  read_directions(in, profile, validator);
  for (int i = 0; i < in.outage_size(); ++i) {
    const OutageSpec outage = outage_from(in.outage(i), validator, child_path("", "outage", i));
    for_directions(in.outage(i).direction(), [&](Direction d) { profile.link[d].outages.push_back(outage); });
  }
  for (const auto& check : in.check()) {
    for_directions(check.direction(), [&](Direction d) {
      profile.checks.push_back({d, {check.p5_ms(), check.p50_ms(), check.p95_ms(), check.p99_ms()}});
    });
  }
  if (!validator.ok()) return std::unexpected(validator.take());
  return profile;
}

}  // namespace tandem::netsim
