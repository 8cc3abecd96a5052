#include "proto/text/profile_loss.h"

#include <cmath>

#include "proto/schema/profile.pb.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageValidator;

ProfileGilbertElliott from(const pb::GilbertElliottLoss& in, MessageValidator& validator, const std::string& key) {
  ProfileGilbertElliott ge{in.p_percent(), in.r_percent(), in.h_percent(), in.has_k_percent() ? in.k_percent() : 100.0};
  if (ge.h_percent > ge.k_percent) {
    validator.error(child_path(key, "h_percent"),
                    "is above k_percent: the bad state would pass more than the good one");
  }
  return ge;
}

ProfileFourState from(const pb::FourStateLoss& in, MessageValidator& validator, const std::string& key) {
  ProfileFourState s{.p13_percent = in.p13_percent(),
                     .p31_percent = in.has_p31_percent() ? in.p31_percent() : 100 - in.p13_percent(),
                     .p32_percent = in.p32_percent(),
                     .p23_percent = in.has_p23_percent() ? in.p23_percent() : 100.0,
                     .p14_percent = in.p14_percent()};
  if (s.p13_percent + s.p14_percent > 100)
    validator.error(child_path(key, "p13_percent"), "with p14_percent is above 100");
  if (s.p31_percent + s.p32_percent > 100)
    validator.error(child_path(key, "p31_percent"), "with p32_percent is above 100");
  if (s.p13_percent > 0 && s.p31_percent == 0) {
    validator.error(child_path(key, "p31_percent"), "is 0: a burst would never end");
  }
  if (s.p32_percent > 0 && s.p23_percent == 0) {
    validator.error(child_path(key, "p23_percent"), "is 0: state 2 would never be left");
  }
  return s;
}

ProfileLossBursts from(const pb::LossBurstsProfile& in, MessageValidator& validator, const std::string& key) {
  using Law = ProfileLossBursts::Law;
  ProfileLossBursts bursts{.rate_per_s = in.rate_per_s(), .datagrams = in.has_length_datagrams()};
  bursts.law = in.law() == pb::LossBurstsProfile::GEOMETRIC   ? Law::kGeometric
               : in.law() == pb::LossBurstsProfile::PARETO_II ? Law::kParetoII
                                                              : Law::kFixed;
  if (in.has_length_datagrams() == in.has_length_ms()) {
    validator.error(key, "needs exactly one of length_datagrams, length_ms");
  }
  const std::string length = child_path(key, bursts.datagrams ? "length_datagrams" : "length_ms");
  bursts.length = bursts.datagrams ? in.length_datagrams() : in.length_ms();
  if (in.has_alpha() != (bursts.law == Law::kParetoII))
    validator.error(key, "alpha belongs to PARETO_II, which needs it");
  if (in.has_alpha()) bursts.alpha = in.alpha();
  if (!in.has_cap() && bursts.law != Law::kFixed)
    validator.error(key, "needs a cap: a drawn length has no end of its own");
  bursts.cap = in.has_cap() ? in.cap() : bursts.length;
  if (bursts.cap < bursts.length) validator.error(child_path(key, "cap"), "is below the length");
  if (bursts.datagrams && bursts.law != Law::kParetoII && bursts.length < 1) {
    validator.error(length, "is less than one datagram");
  }
  if (bursts.datagrams && bursts.law == Law::kFixed && bursts.length != std::floor(bursts.length)) {
    validator.error(length, "must be a whole number");
  }
  if (!bursts.datagrams && bursts.rate_per_s * bursts.cap > 32e3) {
    validator.error(child_path(key, "rate_per_s"),
                    "times the longest length must be at most 32 bursts at the same time");
  }
  return bursts;
}

ProfileLossPattern from(const pb::LossPatternProfile& in, MessageValidator& validator, const std::string& key) {
  ProfileLossPattern pattern{.lost = in.lost(), .of = in.of(), .every = in.every(), .indices = {}, .times_s = {}};
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
    pattern.times_s.push_back(in.at_s(i));
  }
  return pattern;
}

ProfileCongestionLoss from(const pb::NetworkPath& path, MessageValidator& validator, const std::string& key) {
  const auto& in = path.congestion_loss();
  ProfileCongestionLoss loss{in.wait_low_ms(), in.wait_high_ms(), in.queue_percent(), in.stall_percent()};
  if (loss.queue_percent > 0 && loss.wait_high_ms <= loss.wait_low_ms) {
    validator.error(child_path(key, "wait_high_ms"), "must be above wait_low_ms");
  }
  if (loss.queue_percent > 0 && !path.has_rate()) {
    validator.error(child_path(key, "queue_percent"), "needs a queue: rate { ... }");
  }
  if (loss.stall_percent > 0 && !path.has_stall())
    validator.error(child_path(key, "stall_percent"), "needs stall { ... }");
  return loss;
}

ProfileLossTrace from(const pb::LossTraceProfile& in, MessageValidator& validator, const std::string& key) {
  ProfileLossTrace trace{.lost = {}, .interval_ms = in.interval_ms()};
  if (in.bits().empty() || in.bits().find_first_not_of("01") != std::string::npos) {
    validator.error(child_path(key, "bits"), "must be one or more of 0 (passes) and 1 (lost)");
  }
  for (const char bit : in.bits()) trace.lost.push_back(bit == '1');
  return trace;
}

}  // namespace

void loss_from(const pb::NetworkPath& in, ProfilePath& path, MessageValidator& validator, const std::string& key) {
  if (in.has_gilbert_elliott()) {
    path.gilbert_elliott = from(in.gilbert_elliott(), validator, child_path(key, "gilbert_elliott"));
  }
  if (in.has_four_state()) path.four_state = from(in.four_state(), validator, child_path(key, "four_state"));
  if (in.has_loss_bursts()) path.loss_bursts = from(in.loss_bursts(), validator, child_path(key, "loss_bursts"));
  if (in.has_loss_pattern()) path.loss_pattern = from(in.loss_pattern(), validator, child_path(key, "loss_pattern"));
  if (in.has_congestion_loss()) path.congestion_loss = from(in, validator, child_path(key, "congestion_loss"));
  if (in.has_loss_trace()) path.loss_trace = from(in.loss_trace(), validator, child_path(key, "loss_trace"));
}

}  // namespace tandem
