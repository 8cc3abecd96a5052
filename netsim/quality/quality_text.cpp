#include "netsim/quality/quality_text.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kSecond = 1;  ///< index of the 1-s windows, which decide verdicts

std::string length_text(Duration length) {
  return length < std::chrono::seconds(1) ? format("%.0f ms", seconds(length) * 1e3)
                                          : format("%.0f s", seconds(length));
}

/// Returns the windows used in words: 1 s, or 100 ms if no 1-s window was full.
const WindowSummary& judged(const WindowSummaries& windows) noexcept {
  return windows[kSecond].windows > 0 ? windows[kSecond] : windows[0];
}

std::string unit_of(const WindowSummary& windows) {
  return windows.length == window_length(kSecond) ? "second" : length_text(windows.length);
}

/// Returns "62 % of its seconds are amber, 1.7 % red" or "all of its seconds are green".
std::string shares_text(const WindowSummary& windows) {
  const std::string of =
      windows.length == window_length(kSecond) ? "seconds" : length_text(windows.length) + " windows";
  const double amber = windows.share(Band::kAmber), red = windows.share(Band::kRed);
  if (amber + red == 0) return "all of its " + of + " are green";
  if (red == 0) return share_text(amber) + " of its " + of + " are amber, none red";
  if (amber == 0) return share_text(red) + " of its " + of + " are red";
  return share_text(red) + " of its " + of + " are red, " + share_text(amber) + " amber";
}

bool seen_beyond_green(const MeasureSummary& m) noexcept { return m.windows[1] + m.windows[2] > 0; }

/// Returns the words about one direction.
/// @param next  prefix of the second line
std::string way_words(const char* name, const DirectionSummary& way, const std::string& next) {
  if (way.sent == 0) return format("%s: nothing was sent", name);
  const auto called = verdict(way.windows);
  if (!called) return format("%s: too short to judge", name);
  const WindowSummary& windows = judged(way.windows);
  std::string text = format("%s: %s; ", name, verdict_name(called)) + shares_text(windows);
  std::string worst;
  const auto add = [&worst, &next](const std::string& what) {
    worst += (worst.empty() ? "\n" + next + "worst: " : "; ") + what;
  };
  const MeasureSummary& loss = windows.of(Measure::kLoss);
  if (seen_beyond_green(loss)) {
    std::string what =
        share_text(loss.worst) + " lost in the " + unit_of(windows) + format(" to %.2f s", seconds(loss.worst_at));
    const MeasureSummary& briefly = way.windows[0].of(Measure::kLoss);
    const bool hidden = windows.length != way.windows[0].length && briefly.worst > 2 * loss.worst;
    if (hidden) what += format(" (%s in 100 ms)", share_text(briefly.worst).c_str());
    add(what + format(", %s in all", share_text(way.lost_share()).c_str()));
  }
  if (way.longest_gap > kGapLimits.green) {
    add("nothing received for " + delay_text(seconds(way.longest_gap)) +
        format(" from %.2f s", seconds(way.longest_gap_at)));
  }
  const MeasureSummary& jitter = windows.of(Measure::kJitter);
  if (seen_beyond_green(jitter)) {
    add("jitter " + delay_text(jitter.worst) +
        format(" in the %s to %.2f s", unit_of(windows).c_str(), seconds(jitter.worst_at)));
  }
  if (way.arrived == 0) add("nothing was received");
  return text + worst;
}

std::string round_trip_words(const RoundTripSummary& trip, const std::string& next) {
  const auto called = verdict(trip.windows);
  if (!called) return "round trip: too short to judge";
  const WindowSummary& windows = judged(trip.windows);
  std::string text = format("round trip: %s; ", verdict_name(called)) + delay_text(seconds(trip.delay.p50)) + ", p99 " +
                     delay_text(seconds(trip.delay.p99)) + "; " + shares_text(windows);
  const MeasureSummary& p99 = windows.of(Measure::kRoundTrip);
  if (p99.windows[2] > 0) {
    text += "\n" + next + "worst: p99 " + delay_text(p99.worst) +
            format(" in the %s to %.2f s", unit_of(windows).c_str(), seconds(p99.worst_at));
  }
  return text;
}

std::string ms_cell(double s) { return format("%.*f", s < 0.01 ? 2 : s < 1 ? 1 : 0, s * 1e3); }
std::string ms_cell(Duration d) { return ms_cell(seconds(d)); }

std::string way_row(const char* name, const DirectionSummary& w) {
  return format("%-10s %9llu %9s %6llu %6llu | %7s %7s %7s %7s | %7s %7s %7s %7s | %s\n", name,
                static_cast<unsigned long long>(w.sent), share_text(w.lost_share()).c_str(),
                static_cast<unsigned long long>(w.duplicates), static_cast<unsigned long long>(w.reordered),
                ms_cell(w.delay.mean_s).c_str(), ms_cell(w.delay.p50).c_str(), ms_cell(w.delay.p99).c_str(),
                ms_cell(w.delay.max).c_str(), ms_cell(w.age.mean_s).c_str(), ms_cell(w.age.p50).c_str(),
                ms_cell(w.age.p99).c_str(), ms_cell(w.age.max).c_str(),
                (delay_text(seconds(w.longest_gap)) + format(" from %.2f s", seconds(w.longest_gap_at))).c_str());
}

std::string worst_cell(const WindowSummary& windows, Measure measure) {
  const MeasureSummary& m = windows.of(measure);
  if (m.windows[0] + m.windows[1] + m.windows[2] == 0) return "-";
  const std::string value = measure == Measure::kLoss ? share_text(m.worst) : delay_text(m.worst);
  return m.worst > 0 ? value + format(" to %.2f s", seconds(m.worst_at)) : value;
}

std::string window_rows(const char* name, const WindowSummaries& all, bool round_trip, const std::string& indent) {
  std::string text;
  for (const WindowSummary& w : all) {
    if (w.windows == 0) continue;
    text += indent + format("%-10s %7s %8s %8s %8s   ", name, length_text(w.length).c_str(),
                            share_text(w.share(Band::kGreen)).c_str(), share_text(w.share(Band::kAmber)).c_str(),
                            share_text(w.share(Band::kRed)).c_str());
    text += round_trip ? format("p99 %s\n", worst_cell(w, Measure::kRoundTrip).c_str())
                       : format("%-21s %-21s %s\n", worst_cell(w, Measure::kLoss).c_str(),
                                worst_cell(w, Measure::kGap).c_str(), worst_cell(w, Measure::kJitter).c_str());
  }
  return text;
}

double red_share(const LinkSummary& link) noexcept {
  const auto bad = [](const WindowSummaries& w) {
    return judged(w).share(Band::kRed) + 1e-3 * judged(w).share(Band::kAmber);
  };
  return std::max({bad(link.up.windows), bad(link.down.windows), bad(link.round_trip.windows)});
}

}  // namespace

std::optional<Band> verdict(const WindowSummaries& all) noexcept {
  const WindowSummary& windows = judged(all);
  if (windows.windows == 0) return std::nullopt;
  const double green = windows.share(Band::kGreen);
  if (green >= kShareNeeded) return Band::kGreen;
  return green + windows.share(Band::kAmber) >= kShareNeeded ? Band::kAmber : Band::kRed;
}

std::optional<Band> verdict(const LinkSummary& link) noexcept {
  std::optional<Band> worst;
  for (const WindowSummaries* windows : {&link.up.windows, &link.down.windows, &link.round_trip.windows}) {
    if (const auto one = verdict(*windows)) worst = worst ? worse(*worst, *one) : *one;
  }
  return worst;
}

double badness(const LinkSummary& link) noexcept {
  const auto called = verdict(link);
  return called ? 1 + static_cast<double>(*called) + std::min(red_share(link), 1.0) * (1 - 1e-9) : 0;
}

const char* verdict_name(const std::optional<Band>& verdict) noexcept { return verdict ? name(*verdict) : "too short"; }

const char* meaning(const std::optional<Band>& verdict) noexcept {
  if (!verdict) return "no verdict";
  switch (*verdict) {
    case Band::kGreen:
      return "usable for stiff contact and fast motion";
    case Band::kAmber:
      return "usable for slow motion and soft contact over a passive channel";
    case Band::kRed:
      break;
  }
  return "for more than 1 % of the time outside the limits for force feedback";
}

std::string quality_text(const LinkSummary& link, const std::string& indent) {
  const std::string next = indent + "  ";
  return indent + way_words("up", link.up, next) + "\n" + indent + way_words("down", link.down, next) + "\n" + indent +
         round_trip_words(link.round_trip, next) + "\n";
}

std::string quality_table(const LinkSummary& link, const std::string& indent) {
  std::string text;
  text += indent + format("%-10s %9s %9s %6s %6s | %31s | %31s | %s\n", "", "sent", "lost", "copies", "reord.",
                          "delay [ms] mean/p50/p99/max", "age [ms] mean/p50/p99/max", "longest gap");
  text += indent + way_row("up", link.up) + indent + way_row("down", link.down);
  const DelaySummary& trip = link.round_trip.delay;
  text += indent + format("%-10s %9llu %9s %6s %6s | %7s %7s %7s %7s |\n", "round trip",
                          static_cast<unsigned long long>(trip.count), "", "", "", ms_cell(trip.mean_s).c_str(),
                          ms_cell(trip.p50).c_str(), ms_cell(trip.p99).c_str(), ms_cell(trip.max).c_str());
  text += indent + format("%-10s %7s %8s %8s %8s   %-21s %-21s %s\n", "windows of", "", "green", "amber", "red",
                          "worst loss", "longest gap", "worst jitter");
  return text + window_rows("up", link.up.windows, false, indent) +
         window_rows("down", link.down.windows, false, indent) +
         window_rows("round trip", link.round_trip.windows, true, indent);
}

void sort_worst_first(std::vector<NamedLink>& links) {
  std::stable_sort(links.begin(), links.end(),
                   [](const NamedLink& a, const NamedLink& b) { return badness(a.link) > badness(b.link); });
}

std::string quality_report(std::vector<NamedLink> links, bool all) {
  if (links.empty()) return "";
  sort_worst_first(links);
  const auto worst = verdict(links.front().link);
  std::string text;
  const auto headline = [](const NamedLink& one) {
    const auto called = verdict(one.link);
    return format("  network of %s: %s, %s\n", one.name.c_str(), verdict_name(called), meaning(called));
  };
  if (all) {
    for (const NamedLink& one : links) {
      text += headline(one) + quality_text(one.link, "    ") + quality_table(one.link, "    ");
    }
    return text;
  }
  if (!worst) return "  network: too short to judge\n";
  if (worst == Band::kGreen) {
    return format("  network: green for %s, %s\n", links.size() == 1 ? links.front().name.c_str() : "all links",
                  meaning(worst));
  }
  text = headline(links.front()) + quality_text(links.front().link, "    ");
  std::string others;
  for (std::size_t i = 1; i < links.size(); ++i) {
    others += (i == 1 ? "" : ", ") + links[i].name + " " + verdict_name(verdict(links[i].link));
  }
  return others.empty() ? text : text + "    others: " + others + "\n";
}

std::string delay_text(double s) {
  const double ms = s * 1e3;
  if (ms >= 9999.5) return format("%.1f s", s);
  return format("%.*f ms", ms < 9.995 ? 2 : ms < 99.95 ? 1 : 0, ms);
}

std::string share_text(double share) {
  const double percent = share * 100;
  if (percent == 0) return "0 %";
  if (percent == 100) return "100 %";
  // Never rounded to 0 % or 100 %.
  if (percent > 99.9) return ">99.9 %";
  if (percent < 0.001) return "<0.001 %";
  return format("%.*f %%",
                percent < 0.0995                 ? 3
                : percent < 0.995                ? 2
                : percent < 9.95 || percent > 99 ? 1
                                                 : 0,
                percent);
}

}  // namespace tandem::netsim
