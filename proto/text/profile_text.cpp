#include "proto/text/profile_text.h"

#include <algorithm>
#include <cmath>

#include "proto/schema/profile.pb.h"
#include "proto/text/profile_delay.h"
#include "proto/text/profile_loss.h"
#include "proto/text/profile_outage.h"
#include "proto/text/text_format_reader.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageValidator;

std::uint64_t whole(double value) { return static_cast<std::uint64_t>(std::llround(value)); }

ProfileStall stall_from(const pb::Stall& in, MessageValidator& validator, const std::string& key) {
  if (in.cap_ms() < in.length_min_ms()) validator.error(child_path(key, "cap_ms"), "is below length_min_ms");
  if (in.rate_per_s() * in.cap_ms() > 32e3) {
    validator.error(child_path(key, "rate_per_s"), "times cap_ms must be at most 32 stalls at the same time");
  }
  return {in.rate_per_s(), in.length_min_ms(), in.alpha(), in.cap_ms()};
}

ProfileRate rate_from(const pb::LinkRateProfile& in, MessageValidator& validator, const std::string& key) {
  ProfileRate rate;
  rate.rate_bit_s = whole(in.rate_bit_s());
  if (in.has_rate_bit_s() == in.has_capacity()) validator.error(key, "needs exactly one of rate_bit_s, capacity");
  if (in.has_capacity()) rate.capacity_file = in.capacity().file();
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
  if (in.has_queue_ms()) rate.queue_ms = in.queue_ms();
  rate.queue_datagrams = in.queue_datagrams();
  rate.codel = in.has_codel();
  if (in.codel().has_target_ms()) rate.codel_target_ms = in.codel().target_ms();
  if (in.codel().has_interval_ms()) rate.codel_interval_ms = in.codel().interval_ms();
  if (rate.codel_target_ms >= rate.codel_interval_ms) {
    validator.error(child_path(key, "codel"), "target_ms must be below interval_ms");
  }
  rate.drop_head = in.drop() == pb::LinkRateProfile::HEAD;
  if (rate.drop_head) {
    if (!in.has_queue_bytes() && !in.has_queue_ms() && !in.has_queue_datagrams()) {
      validator.error(child_path(key, "drop"), "needs a limit: queue_bytes, queue_ms or queue_datagrams");
    }
    if (in.has_codel()) validator.error(child_path(key, "codel"), "drops by a law of its own: not with drop: HEAD");
    if (in.has_competing_peak_ms()) validator.error(child_path(key, "competing_peak_ms"), "not with drop: HEAD");
  }
  rate.competing_peak_ms = in.competing_peak_ms();
  rate.competing_period_ms = in.competing_period_ms();
  if (in.has_competing_peak_ms() != in.has_competing_period_ms()) {
    validator.error(key, "competing_peak_ms and competing_period_ms belong together");
  } else if (in.has_competing_peak_ms() && rate.competing_period_ms <= rate.competing_peak_ms) {
    validator.error(child_path(key, "competing_period_ms"),
                    "must be above competing_peak_ms: a queue drains in real time");
  }
  return rate;
}

void damage_from(const pb::NetworkPath& in, ProfilePath& path, MessageValidator& validator, const std::string& key) {
  path.corrupted_percent = in.corrupted_percent();
  path.corruption = in.corruption() == pb::NetworkPath::BIT_FLIPS  ? ProfilePath::Corruption::kBitFlips
                    : in.corruption() == pb::NetworkPath::TRUNCATE ? ProfilePath::Corruption::kTruncate
                                                                   : ProfilePath::Corruption::kChecksum;
  if (in.has_corrupted_bits()) path.corrupted_bits = in.corrupted_bits();
  if (in.has_corruption() && !in.has_corrupted_percent()) {
    validator.error(child_path(key, "corruption"), "needs corrupted_percent");
  }
  if (in.has_corrupted_bits() && path.corruption != ProfilePath::Corruption::kBitFlips) {
    validator.error(child_path(key, "corrupted_bits"), "needs corruption: BIT_FLIPS");
  }
  path.mtu_bytes = in.mtu_bytes();
  path.fragments = in.above_mtu() == pb::NetworkPath::FRAGMENT;
  if (in.has_above_mtu() && !in.has_mtu_bytes()) validator.error(child_path(key, "above_mtu"), "needs mtu_bytes");
  const std::uint32_t overhead = path.rate ? path.rate->overhead_bytes : ProfileRate{}.overhead_bytes;
  const std::uint32_t least = overhead + (path.fragments ? 8 : 1);
  if (in.has_mtu_bytes() && path.mtu_bytes < least) {
    validator.error(child_path(key, "mtu_bytes"), "leaves no room beside the overhead of " + std::to_string(overhead) +
                                                      " bytes; at least " + std::to_string(least));
  }
}

ProfilePath path_from(const pb::NetworkPath& in, MessageValidator& validator, const std::string& key) {
  ProfilePath path;
  path.loss_percent = in.loss_percent();
  if (in.has_bad_periods()) {
    const auto& bad = in.bad_periods();
    path.bad_periods = {bad.good_mean_s(), bad.bad_mean_ms(), bad.loss_good_percent(), bad.loss_bad_percent()};
  }
  if (in.has_rate()) path.rate = rate_from(in.rate(), validator, child_path(key, "rate"));
  path.floor_ms = in.floor_ms();
  delay_from(in, path, validator, key);
  damage_from(in, path, validator, key);
  if (in.has_stall()) path.stall = stall_from(in.stall(), validator, child_path(key, "stall"));
  path.free_order = in.order() == pb::NetworkPath::FREE;
  if (in.has_reorder()) {
    ProfileReorder& reorder = path.reorder.emplace();
    reorder.probability_percent = in.reorder().probability_percent();
    if (in.reorder().has_displacement()) reorder.displacement = in.reorder().displacement();
    if (in.reorder().has_hold_limit_ms()) reorder.hold_limit_ms = in.reorder().hold_limit_ms();
  }
  if (in.has_duplicate()) {
    ProfileDuplicate& duplicate = path.duplicate.emplace();
    duplicate.probability_percent = in.duplicate().probability_percent();
    if (in.duplicate().has_delay_max_ms()) duplicate.delay_max_ms = in.duplicate().delay_max_ms();
  }
  loss_from(in, path, validator, key);
  return path;
}

}  // namespace

ProfileOutage outage_from(const pb::ProfileOutage& in, MessageValidator& validator, const std::string& key) {
  ProfileOutage outage{.start_s = in.start_s(),
                       .length_ms = in.length_ms(),
                       .period_s = in.period_s(),
                       .hold = in.mode() == pb::ProfileOutage::HOLD,
                       .up = in.direction() != pb::ProfileOutage::DOWN,
                       .down = in.direction() != pb::ProfileOutage::UP,
                       .hold_bytes = whole(in.hold_bytes())};
  outage.mean_gap_s = in.mean_gap_s();
  outage.length_max_ms = in.has_length_max_ms() ? in.length_max_ms() : outage.length_ms;
  if (in.has_mean_gap_s() == in.has_start_s()) validator.error(key, "needs exactly one of start_s, mean_gap_s");
  if (in.has_mean_gap_s() && in.has_period_s()) validator.error(child_path(key, "period_s"), "not with mean_gap_s");
  if (in.has_length_max_ms() && !in.has_mean_gap_s() && !in.has_period_s()) {
    validator.error(child_path(key, "length_max_ms"), "needs mean_gap_s or period_s");
  }
  if (outage.length_max_ms < outage.length_ms) validator.error(child_path(key, "length_max_ms"), "is below length_ms");
  if (outage.mean_gap_s > 0 && outage.length_max_ms > 32e3 * outage.mean_gap_s) {
    validator.error(child_path(key, "length_max_ms"), "is above 32 times mean_gap_s");
  }
  if (in.has_period_s() && outage.period_s * 1e3 <= std::max(outage.length_ms, outage.length_max_ms)) {
    validator.error(child_path(key, "period_s"), "must be longer than the outage, or the link is never up");
  }
  outage.hold_last = in.mode() == pb::ProfileOutage::HOLD_LAST;
  outage.all_links = in.scope() == pb::ProfileOutage::ALL_LINKS;
  if (in.has_scope() && !in.has_mean_gap_s() && !in.has_length_max_ms()) {
    validator.error(
        child_path(key, "scope"),
        "needs mean_gap_s or length_max_ms: an outage without a drawn time or length hits all clients in any case");
  }
  outage.loss_at_start_ms = in.loss_at_start_ms();
  if (outage.length_ms > 0 && outage.loss_at_start_ms > outage.length_ms) {  // otherwise the length is the error
    validator.error(child_path(key, "loss_at_start_ms"), "is longer than the outage");
  }
  if (in.has_hold_bytes() && !outage.hold) validator.error(child_path(key, "hold_bytes"), "needs mode: HOLD");
  return outage;
}

namespace {

void directions(const pb::Profile& in, ProfileSpec& profile, MessageValidator& validator) {
  if (in.has_both()) {
    for (const char* key : {"up", "down"}) {
      if (validator.is_set(key)) validator.error(key, "both directions are described by `both` already");
    }
    profile.up = path_from(in.both(), validator, "both");
    profile.down = profile.up;
    return;
  }
  if (!in.has_up() || !in.has_down()) {
    validator.error("", "needs `both { ... }`, or `up { ... }` and `down { ... }`; an empty one is a perfect network");
  }
  profile.up = path_from(in.up(), validator, "up");
  profile.down = path_from(in.down(), validator, "down");
  const auto file = [](const ProfilePath& path) { return path.rate ? path.rate->capacity_file : std::nullopt; };
  if (file(profile.up) && file(profile.down) && *file(profile.up) != *file(profile.down)) {
    validator.error("down.rate.capacity", "names another file than up.rate.capacity: one file holds both directions");
  }
}

std::string stem(std::string_view file) {
  if (const auto slash = file.rfind('/'); slash != std::string_view::npos) file.remove_prefix(slash + 1);
  return std::string(file.substr(0, file.find('.')));
}

}  // namespace

std::expected<ProfileSpec, InputErrors> parse_profile_text(std::string_view text, std::string_view file_name) {
  MessageValidator validator{file_name};
  pb::Profile in;
  text::read_document(text, file_name, in, validator);
  // Rules between numbers apply only to numbers that are in range.
  if (!validator.ok()) return std::unexpected(validator.take());

  ProfileSpec profile;
  profile.name = stem(file_name);
  profile.version = in.version();
  profile.summary = in.summary();
  profile.sources.assign(in.source().begin(), in.source().end());
  profile.shared = in.shared();
  directions(in, profile, validator);
  for (int i = 0; i < in.outage_size(); ++i) {
    profile.outages.push_back(outage_from(in.outage(i), validator, child_path("", "outage", i)));
  }
  for (const auto& check : in.check()) {
    profile.checks.push_back({.up = check.direction() != pb::ProfileOutage::DOWN,
                              .down = check.direction() != pb::ProfileOutage::UP,
                              .delay_ms = {check.p5_ms(), check.p50_ms(), check.p95_ms(), check.p99_ms()}});
  }
  if (!validator.ok()) return std::unexpected(validator.take());
  return profile;
}

}  // namespace tandem
