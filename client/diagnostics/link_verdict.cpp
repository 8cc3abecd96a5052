#include "client/diagnostics/link_verdict.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"

namespace tandem::client {

namespace {

constexpr double kGone = 1.0;                            // [s] no Wi-Fi scan lasts that long
constexpr double kLostAtEnd = 0.5;                       // [s] a Wi-Fi scan this long just at the end is unlikely
constexpr double kLeastSeconds = 2.0;                    // [s]
constexpr double kCrisp = 0.010;                         // [s] round trip that users cannot perceive
constexpr double kRttGood = 0.020;                       // [s]
constexpr double kLossGood = 0.1, kLossUsable = 10;      // [%]
constexpr double kGapUsable = 0.050;                     // [s] after a longer gap every seat is released and re-engaged
constexpr double kPauseShare = 0.01;                     // usable pauses per second of test: one in 100 s is accidental
constexpr double kLateGood = 0.001, kLateUsable = 0.02;  // share of ticks
constexpr double kJitterGood = 0.002, kJitterUsable = 0.010;  // [s]
constexpr double kClockStep = 0.001, kTransitStep = 0.005;    // [s]

double ms(double s) { return 1e3 * s; }
unsigned long long n(std::uint64_t v) { return v; }

std::string or_unknown(const std::optional<double>& seconds_) {
  return seconds_ ? format("%.2f ms", ms(*seconds_)) : std::string("not known");
}

std::optional<double> size_of(const std::optional<double>& step) {
  return step ? std::optional{std::abs(*step)} : std::nullopt;
}

/// Collects advice and keeps the worst grade.
class Judge {
 public:
  explicit Judge(LinkVerdict& verdict) : verdict_(&verdict) {}
  void note(LinkGrade at_best, std::string advice) {
    verdict_->grade = std::max(verdict_->grade, at_best);
    verdict_->advice.push_back(std::move(advice));
  }

 private:
  LinkVerdict* verdict_;
};

void judge_delay(const LinkTestResult& f, Judge& judge) {
  const double tick = 1 / f.tick_hz;
  const double rtt = *f.rtt_p99;
  if (rtt + 2 * tick > f.loop_age_max) {
    judge.note(LinkGrade::kBad,
               format("round trips of %.0f ms are older than this scene trusts (loop_age_max %.0f ms): hands would be "
                      "released. Use a nearer server, or a scene made for delay",
                      ms(rtt), ms(f.loop_age_max)));
  } else if (rtt > kRttGood) {
    judge.note(
        LinkGrade::kUsable,
        format(
            "round trips of %.0f ms (99 %%): the tool follows late and feels softer; move slowly. A nearer server or "
            "a cable instead of radio helps",
            ms(rtt)));
  }
  if (f.jitter && *f.jitter > kJitterGood)
    judge.note(*f.jitter <= kJitterUsable ? LinkGrade::kUsable : LinkGrade::kBad,
               format("datagrams come up to %.0f ms later than the fastest (99 %%): use a cable instead of Wi-Fi, end "
                      "downloads and video on this line",
                      ms(*f.jitter)));
}

void judge_loss(const LinkTestResult::Direction& way, const char* direction, Judge& judge) {
  const double percent = way.loss_percent();
  if (percent <= kLossGood) return;
  judge.note(
      percent <= kLossUsable ? LinkGrade::kUsable : LinkGrade::kBad,
      format("%.2g %% lost %s: a bad cable, weak radio or a full line; try a cable, and end what else uses the line",
             percent, direction));
}

void judge_machine(const LinkTestResult& f, Judge& judge) {
  if (f.ticks == 0) return;
  const double share =
      static_cast<double>(f.late_ticks + f.missed_ticks) / static_cast<double>(f.ticks + f.missed_ticks);
  if (share > kLateGood)
    judge.note(share <= kLateUsable ? LinkGrade::kUsable : LinkGrade::kBad,
               format("this machine was late for %.1f %% of its ticks, not the network: end other programs, allow "
                      "real-time priority "
                      "(`rtprio 80` in /etc/security/limits.conf), switch off power saving",
                      100 * share));
  if (f.clock_step && std::abs(*f.clock_step) > kClockStep)
    judge.note(LinkGrade::kUsable, format("this machine's wall clock was set by %+.1f ms during the test: hands do not "
                                          "feel it, but times in recordings jump. "
                                          "Let a time service slew the clock instead of stepping it",
                                          ms(*f.clock_step)));
  if (f.transit_step && std::abs(*f.transit_step) > kTransitStep)
    judge.note(LinkGrade::kUsable, format("the way down became %.1f ms %s and stayed so for a second or more: another "
                                          "route, a full queue on the way, or a "
                                          "stalled server",
                                          ms(std::abs(*f.transit_step)), *f.transit_step > 0 ? "longer" : "shorter"));
}

std::string words(const LinkTestResult& f, LinkGrade grade) {
  if (server_lost(f)) return "the server was lost before the test was over: the results cover the time until then";
  switch (grade) {
    case LinkGrade::kGood:
      return *f.rtt_p50 <= kCrisp ? "hands can work together over this link as if it were one room"
                                  : "hands can work together over this link; the delay is felt a little";
    case LinkGrade::kUsable:
      return "hands can work together over this link, with the limits listed below";
    case LinkGrade::kBad:
      return "this link is not fit for hands: forces would be released again and again, or be far too soft";
  }
  return {};
}

}  // namespace

const char* to_text(LinkGrade grade) noexcept {
  switch (grade) {
    case LinkGrade::kGood:
      return "GOOD";
    case LinkGrade::kUsable:
      return "USABLE";
    case LinkGrade::kBad:
      return "BAD";
  }
  return "";
}

bool server_lost(const LinkTestResult& f) noexcept {
  return f.down && f.silent_at_end > std::max(kLostAtEnd, f.silence_limit);
}

LinkVerdict assess_link(const LinkTestResult& f) {
  LinkVerdict verdict;
  Judge judge{verdict};
  if (!f.down || !f.up || !f.rtt_p50 || !f.rtt_p99) {
    verdict.grade = LinkGrade::kBad;
    verdict.text = "nothing came back";
    verdict.advice.emplace_back(
        "the server accepted the join, but no datagram of the session arrived: a firewall or a provider may drop "
        "steady UDP. Ask for UDP to the server's port in both directions");
    return verdict;
  }
  judge_delay(f, judge);
  judge_loss(*f.up, "on the way up", judge);
  judge_loss(*f.down, "on the way down", judge);
  // A gap towards the server also matters to the user, because the forces returned then are old.
  const double gap = std::max(f.up->longest_gap, f.down->longest_gap);
  if (server_lost(f)) {
    judge.note(LinkGrade::kBad, format("no datagram came in the last %.1f s of the test: the server or the network "
                                       "failed. Check that the server runs, then test again",
                                       f.silent_at_end));
  } else if (gap > kGone) {
    judge.note(LinkGrade::kBad,
               format("no datagram came for %.1f s: the server or the network failed for that time", gap));
  } else if (gap > f.silence_limit) {
    judge.note(
        gap <= kGapUsable && f.pauses <= std::max(1.0, kPauseShare * f.seconds) ? LinkGrade::kUsable : LinkGrade::kBad,
        format("silent for up to %.0f ms up and %.0f ms down, %u time%s beyond the %.0f ms after which a hand is "
               "released%s",
               ms(f.up->longest_gap), ms(f.down->longest_gap), f.pauses, f.pauses == 1 ? "" : "s", ms(f.silence_limit),
               f.late_ticks + f.missed_ticks > 0 ? " (this machine itself was late, too)"
                                                 : ": Wi-Fi that scans or roams, a line that is full"));
  }
  judge_machine(f, judge);
  if (f.refused > 0)
    judge.note(
        LinkGrade::kUsable,
        format(
            "%llu datagrams from the server's address were not authentic: damaged on the way, or from another sender",
            n(f.refused)));
  verdict.text = words(f, verdict.grade);
  if (f.seconds < kLeastSeconds) {
    verdict.grade = std::max(verdict.grade, LinkGrade::kUsable);
    verdict.text = format("too short to judge: the test lasted %.1f s; test for at least 10 s", f.seconds);
  }
  return verdict;
}

std::string summary(const LinkTestResult& f) {
  std::string text = format("%.1f s, %.0f datagrams per second each way of %zu bytes up, %zu down\n", f.seconds,
                            f.tick_hz, f.datagram_up, f.datagram_down);
  text += "round trip    min " + or_unknown(f.rtt_min) + ", median " + or_unknown(f.rtt_p50) + ", 99 % " +
          or_unknown(f.rtt_p99) + ", max " + or_unknown(f.rtt_max) + "\n";
  text += "jitter        " + or_unknown(f.jitter) + " later than the fastest (99 %, way down)\n";
  const auto way = [&](const char* name, const std::optional<LinkTestResult::Direction>& w) {
    text += w ? format("%s  lost %.2f %% (%llu of %llu), reordered %llu, longest gap %.1f ms\n", name,
                       w->loss_percent(), n(w->lost), n(w->sent), n(w->reordered), ms(w->longest_gap))
              : format("%s  not known: nothing came back\n", name);
  };
  way("way up      ", f.up);
  way("way down    ", f.down);
  text += format("also          %llu duplicates, %llu not authentic, %u silences beyond %.0f ms\n", n(f.duplicates),
                 n(f.refused), f.pauses, ms(f.silence_limit));
  text += "clocks        wall clock stepped by " + or_unknown(size_of(f.clock_step)) + ", way down by " +
          or_unknown(size_of(f.transit_step)) + "\n";
  text += format(
      "this machine  %llu of %llu ticks late by more than 1 ms, %llu missed; wakes up 99 %% within %.2f ms, at worst "
      "%.2f ms\n",
      n(f.late_ticks), n(f.ticks), n(f.missed_ticks), ms(f.wake_p99), ms(f.wake_max));
  return text;
}

}  // namespace tandem::client
