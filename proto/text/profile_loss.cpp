#include "proto/text/profile_loss.h"

#include <cmath>

#include "common/base/milliseconds.h"
#include "proto/schema/profile.pb.h"

namespace tandem::netsim {
namespace {

using text::child_path;
using text::MessageValidator;

BadPeriodsSpec from(const pb::BadPeriods& in) {
  return {.good_mean = from_milliseconds(in.good_mean_s() * 1e3),
          .bad_mean = from_milliseconds(in.bad_mean_ms()),
          .loss_good = probability(in.loss_good_percent()),
          .loss_bad = probability(in.loss_bad_percent())};
}

GilbertElliottSpec from(const pb::GilbertElliottLoss& in, MessageValidator& validator, const std::string& key) {
  const double k_percent = in.has_k_percent() ? in.k_percent() : 100.0;
  if (in.h_percent() > k_percent) {
    validator.error(child_path(key, "h_percent"),
                    "is above k_percent: the bad state would pass more than the good one");
  }
  return {.p = probability(in.p_percent()),
          .r = probability(in.r_percent()),
          .h = probability(in.h_percent()),
          .k = probability(k_percent)};
}

FourStateSpec from(const pb::FourStateLoss& in, MessageValidator& validator, const std::string& key) {
  const double p13 = in.p13_percent(), p14 = in.p14_percent(), p32 = in.p32_percent();
  const double p31 = in.has_p31_percent() ? in.p31_percent() : 100 - p13;
  const double p23 = in.has_p23_percent() ? in.p23_percent() : 100.0;
  if (p13 + p14 > 100) validator.error(child_path(key, "p13_percent"), "with p14_percent is above 100");
  if (p31 + p32 > 100) validator.error(child_path(key, "p31_percent"), "with p32_percent is above 100");
  if (p13 > 0 && p31 == 0) validator.error(child_path(key, "p31_percent"), "is 0: a burst would never end");
  if (p32 > 0 && p23 == 0) validator.error(child_path(key, "p23_percent"), "is 0: state 2 would never be left");
  return {.p13 = probability(p13),
          .p31 = probability(p31),
          .p32 = probability(p32),
          .p23 = probability(p23),
          .p14 = probability(p14)};
}

LossBurstsSpec from(const pb::LossBurstsProfile& in, MessageValidator& validator, const std::string& key) {
  using Law = LossBurstsSpec::Law;
  const bool datagrams = in.has_length_datagrams();
  LossBurstsSpec bursts{
      .rate_per_s = in.rate_per_s(),
      .law = in.law() == pb::LossBurstsProfile::GEOMETRIC   ? Law::kGeometric
             : in.law() == pb::LossBurstsProfile::PARETO_II ? Law::kParetoII
                                                            : Law::kFixed,
      .unit = datagrams ? LossBurstsSpec::Unit::kDatagrams : LossBurstsSpec::Unit::kMilliseconds,
      .length = datagrams ? in.length_datagrams() : in.length_ms(),
  };
  if (in.has_length_datagrams() == in.has_length_ms()) {
    validator.error(key, "needs exactly one of length_datagrams, length_ms");
  }
  const std::string length = child_path(key, datagrams ? "length_datagrams" : "length_ms");
  if (in.has_alpha() != (bursts.law == Law::kParetoII))
    validator.error(key, "alpha belongs to PARETO_II, which needs it");
  if (in.has_alpha()) bursts.alpha = in.alpha();
  if (!in.has_cap() && bursts.law != Law::kFixed)
    validator.error(key, "needs a cap: a drawn length has no end of its own");
  bursts.cap = in.has_cap() ? in.cap() : bursts.length;
  if (bursts.cap < bursts.length) validator.error(child_path(key, "cap"), "is below the length");
  if (datagrams && bursts.law != Law::kParetoII && bursts.length < 1) {
    validator.error(length, "is less than one datagram");
  }
  if (datagrams && bursts.law == Law::kFixed && bursts.length != std::floor(bursts.length)) {
    validator.error(length, "must be a whole number");
  }
  if (!datagrams && bursts.rate_per_s * bursts.cap > 32e3) {
    validator.error(child_path(key, "rate_per_s"),
                    "times the longest length must be at most 32 bursts at the same time");
  }
  return bursts;
}

LossPatternSpec from(const pb::LossPatternProfile& in, MessageValidator& validator, const std::string& key) {
  LossPatternSpec pattern{.lost = in.lost(), .of = in.of(), .every = in.every()};
  if (in.has_lost() != in.has_of()) validator.error(key, "lost and of belong together");
  if (pattern.lost > pattern.of) validator.error(child_path(key, "lost"), "is above `of`");
  for (int i = 0; i < in.index_size(); ++i) {
    const std::string place = child_path(key, "index", i);
    if (in.index(i) != std::floor(in.index(i))) validator.error(place, "must be a whole number");
    if (i > 0 && in.index(i) <= in.index(i - 1)) validator.error(place, "does not ascend");
    pattern.indices.push_back(static_cast<std::uint64_t>(in.index(i)));
  }
  for (int i = 0; i < in.at_s_size(); ++i) {
    if (i > 0 && in.at_s(i) <= in.at_s(i - 1)) validator.error(child_path(key, "at_s", i), "does not ascend");
    pattern.times.push_back(from_milliseconds(in.at_s(i) * 1e3));
  }
  return pattern;
}

CongestionLossSpec from(const pb::NetworkPath& path, MessageValidator& validator, const std::string& key) {
  const auto& in = path.congestion_loss();
  if (in.queue_percent() > 0 && in.wait_high_ms() <= in.wait_low_ms()) {
    validator.error(child_path(key, "wait_high_ms"), "must be above wait_low_ms");
  }
  if (in.queue_percent() > 0 && !path.has_rate()) {
    validator.error(child_path(key, "queue_percent"), "needs a queue: rate { ... }");
  }
  if (in.stall_percent() > 0 && !path.has_stall())
    validator.error(child_path(key, "stall_percent"), "needs stall { ... }");
  return {.wait_low = from_milliseconds(in.wait_low_ms()),
          .wait_high = from_milliseconds(in.wait_high_ms()),
          .probability = probability(in.queue_percent()),
          .in_stall = probability(in.stall_percent())};
}

LossTrace from(const pb::LossTraceProfile& in, MessageValidator& validator, const std::string& key) {
  LossTrace trace{.interval = from_milliseconds(in.interval_ms())};
  if (in.bits().empty() || in.bits().find_first_not_of("01") != std::string::npos) {
    validator.error(child_path(key, "bits"), "must be one or more of 0 (passes) and 1 (lost)");
  }
  for (const char bit : in.bits()) trace.lost.push_back(bit == '1');
  return trace;
}

}  // namespace

LossSpec loss_from(const pb::NetworkPath& in, MessageValidator& validator, const std::string& key) {
  LossSpec loss{.probability = probability(in.loss_percent())};
  if (in.has_bad_periods()) loss.periods = from(in.bad_periods());
  if (in.has_gilbert_elliott())
    loss.gilbert_elliott = from(in.gilbert_elliott(), validator, child_path(key, "gilbert_elliott"));
  if (in.has_four_state()) loss.four_state = from(in.four_state(), validator, child_path(key, "four_state"));
  if (in.has_loss_bursts()) loss.bursts = from(in.loss_bursts(), validator, child_path(key, "loss_bursts"));
  if (in.has_loss_pattern()) loss.pattern = from(in.loss_pattern(), validator, child_path(key, "loss_pattern"));
  if (in.has_congestion_loss()) loss.congestion = from(in, validator, child_path(key, "congestion_loss"));
  if (in.has_loss_trace())
    loss.trace = std::make_shared<LossTrace>(from(in.loss_trace(), validator, child_path(key, "loss_trace")));
  return loss;
}

}  // namespace tandem::netsim
