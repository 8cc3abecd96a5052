#pragma once

#include <optional>
#include <string>
#include <vector>

#include "netsim/quality/link_summary.h"

/// Text about the quality of a network for force feedback: first words, then numbers. ASCII.
namespace tandem::netsim {

/// Share of windows that must be in a band or better for the verdict to be that band. A network that is red for more
/// than 1 % of the time is red.
inline constexpr double kShareNeeded = 0.99;

/// Returns the best band that kShareNeeded of the 1-s windows reach. Uses the 100-ms windows if no 1-s window was full.
/// Empty if there were no windows.
[[nodiscard]] std::optional<Band> verdict(const WindowSummaries& windows) noexcept;
/// Returns the worst verdict of both directions and of the round trip.
[[nodiscard]] std::optional<Band> verdict(const LinkSummary& link) noexcept;
/// Returns `green`, `amber`, `red` or `too short`.
[[nodiscard]] const char* verdict_name(const std::optional<Band>& verdict) noexcept;

/// Returns a sort key for links and networks, larger for worse ones. They compare by verdict, then by the share of red
/// and amber windows, in [0, 4). 0: no verdict.
[[nodiscard]] double badness(const LinkSummary& link) noexcept;

/// Returns text about the operations that a network with this verdict permits.
[[nodiscard]] const char* meaning(const std::optional<Band>& verdict) noexcept;

/// Returns one line for each of up, down and round trip, each followed by a line about its worst windows. Lines begin
/// with `indent`.
[[nodiscard]] std::string quality_text(const LinkSummary& link, const std::string& indent);

/// Returns all numbers: totals of each direction, then every window length.
[[nodiscard]] std::string quality_table(const LinkSummary& link, const std::string& indent);

/// Results of one link with its display name.
struct NamedLink {
  std::string name;
  LinkSummary link;
};

/// Returns a report of a session's links, worst first: the worst link in words, the others by name. One line if all
/// links are green.
/// @param all  true: every link in words and numbers
[[nodiscard]] std::string quality_report(std::vector<NamedLink> links, bool all);

/// Sorts links by `badness`, worst first.
void sort_worst_first(std::vector<NamedLink>& links);

/// Returns a delay as text: `0.07 ms`, `8.25 ms`, `61.5 ms`, `410 ms`, `12.3 s`.
[[nodiscard]] std::string delay_text(double seconds);
/// Returns a share as text: `0.083 %`, `1.7 %`, `41 %`.
[[nodiscard]] std::string share_text(double share);

}  // namespace tandem::netsim
