#pragma once

#include <optional>
#include <string>
#include <vector>

#include "netsim/quality_summary.h"

/// What a network was like for force feedback, for people: words first, numbers after. ASCII.
namespace tandem::netsim {

/// How often a band must be kept to give its name to the whole: a network that is red for more than 1 % of the time is red.
inline constexpr double kShareNeeded = 0.99;

/// The best band that so many of the 1-s windows keep; of the 100-ms windows when no second was full; empty: no window at
/// all was.
[[nodiscard]] std::optional<Band> verdict(const WindowSummaries& windows) noexcept;
/// The worst of both directions and the round trip.
[[nodiscard]] std::optional<Band> verdict(const LinkSummary& link) noexcept;
/// `green`, `amber`, `red` or `too short`.
[[nodiscard]] const char* verdict_name(const std::optional<Band>& verdict) noexcept;

/// Orders links and whole networks, the worst highest: by verdict, then by the share of red and amber windows [0, 4).
/// 0: nothing was judged.
[[nodiscard]] double badness(const LinkSummary& link) noexcept;

/// What people can do over a network of this verdict.
[[nodiscard]] const char* meaning(const std::optional<Band>& verdict) noexcept;

/// For each of up, down and round trip a line, and one more for its worst moments; lines begin with `indent`.
[[nodiscard]] std::string quality_words(const LinkSummary& link, const std::string& indent);

/// All numbers: totals of each direction, then every length of window.
[[nodiscard]] std::string quality_table(const LinkSummary& link, const std::string& indent);

struct NamedLink {
  std::string name;
  LinkSummary link;
};

/// A session's links, the worst first: that one in words, the others by name. When all are green, one line.
/// @param all  every link in words and numbers
[[nodiscard]] std::string quality_report(std::vector<NamedLink> links, bool all);

/// The worst first, by `badness`.
void sort_worst_first(std::vector<NamedLink>& links);

/// `0.07 ms`, `8.25 ms`, `61.5 ms`, `410 ms`, `12.3 s`.
[[nodiscard]] std::string delay_text(double seconds);
/// `0.083 %`, `1.7 %`, `41 %`.
[[nodiscard]] std::string share_text(double share);

}  // namespace tandem::netsim
