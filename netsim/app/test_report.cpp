#include "netsim/app/test_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/format.h"
#include "netsim/app/failure_recordings.h"
#include "netsim/app/test_notes.h"

namespace tandem::netsim {
namespace {

using State = SeedOutcome::State;

constexpr std::size_t kSeedsShown = 40;     // marks per line of the table
constexpr std::size_t kFailuresShown = 20;  // with causes; the others by seed only

char mark(State state) {
  constexpr std::array<char, 5> kMarks{'-', '.', 'F', 'T', 'C'};
  return kMarks[static_cast<std::size_t>(state)];
}

/// Returns whether two limits come from one line of the scenario (the same limit for several seats).
bool together(const Limit& a, const Limit& b) {
  return a.of == b.of && a.metric == b.metric && a.phase == b.phase && a.min == b.min && a.max == b.max;
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

std::string percent(double value) { return std::isnan(value) ? "-" : short_number(std::round(value)) + " %"; }

void put_limits(const ScenarioResult& r, std::string& out) {
  const auto& limits = r.scenario.limits;
  struct Row {
    std::string metric, worst, range, margin, where;
  };
  std::vector<Row> rows{{"limit", "worst", "must be", "margin", "at"}};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (std::any_of(limits.begin(), limits.begin() + static_cast<std::ptrdiff_t>(i),
                    [&](const Limit& l) { return together(l, limits[i]); }))
      continue;
    std::optional<WorstValue> worst;
    for (std::size_t k = i; k < limits.size(); ++k) {
      if (!together(limits[i], limits[k])) continue;
      if (const auto one = r.worst_of(k); one && (!worst || one->room() < worst->room())) worst = one;
    }
    if (!worst) continue;
    const Limit& limit = *worst->limit;
    rows.push_back(
        {limit.metric,
         short_number(worst->value) + (limit.unit.empty() || std::isnan(worst->value) ? "" : " " + limit.unit),
         range_text(limit), holds(limit, worst->value) ? percent(margin_percent(limit, worst->value)) : "BROKEN",
         limit.subject + ", seed " + std::to_string(worst->seed)});
  }
  if (rows.size() == 1) return;
  std::array<std::size_t, 4> width{};
  for (const Row& row : rows)
    for (std::size_t c = 0; c < 4; ++c)
      width[c] = std::max(width[c], std::array{&row.metric, &row.worst, &row.range, &row.margin}[c]->size());
  for (const Row& row : rows)
    out += "  " + padded(row.metric, width[0]) + "  " + padded(row.worst, width[1]) + "  " +
           padded(row.range, width[2]) + "  " + padded(row.margin, width[3]) + "  " + row.where + "\n";
}

/// Returns the link quality for force feedback, each seat at its worst seed: `red: trainee; green: trainer`.
std::string bands_text(const ScenarioResult& r) {
  constexpr std::array<std::string_view, 4> kWorstFirst{"red", "amber", "green", "too short"};
  const auto rank = [&](std::string_view band) { return std::ranges::find(kWorstFirst, band) - kWorstFirst.begin(); };
  std::vector<std::pair<std::string, std::string>> worst;
  for (const SeedOutcome& s : r.seeds)
    for (const auto& [seat, band] : s.bands) {
      const auto known = std::ranges::find(worst, seat, &std::pair<std::string, std::string>::first);
      if (known == worst.end()) {
        worst.emplace_back(seat, band);
      } else if (rank(band) < rank(known->second)) {
        known->second = band;
      }
    }
  std::string text;
  for (const std::string_view band : kWorstFirst) {
    std::string seats;
    for (const auto& [seat, its] : worst)
      if (its == band) seats += (seats.empty() ? "" : ", ") + seat;
    if (!seats.empty()) text += (text.empty() ? "" : "; ") + std::string(band) + ": " + seats;
  }
  return text;
}

/// Returns the network of the worst seed per direction, as `run` prints it.
std::string network_words(const ScenarioResult& r) {
  const auto worst = std::ranges::max_element(
      r.seeds, {}, [](const SeedOutcome& s) { return s.network_text.empty() ? -1 : s.badness; });
  if (worst == r.seeds.end() || worst->network_text.empty()) return {};
  return "  seed " + std::to_string(worst->seed) + "," +
         worst->network_text.substr(worst->network_text.find_first_not_of(' ') - 1);
}

std::string verdict(const ScenarioResult& r) {
  if (r.failed() > 0) return "FAIL " + std::to_string(r.failed()) + " of " + std::to_string(r.seeds.size());
  return r.passed() ? "pass" : "not finished";
}

void put_scenario(const ScenarioResult& r, std::size_t name_width, std::string& out) {
  const std::string range =
      std::to_string(r.seeds.front().seed) + (r.seeds.size() > 1 ? "-" + std::to_string(r.seeds.back().seed) : "");
  std::string marks;
  for (const SeedOutcome& s : r.seeds) marks += mark(s.state);
  for (std::size_t at = 0; at < marks.size(); at += kSeedsShown) {
    out += padded(at == 0 ? r.scenario.name : "", name_width + 2) + padded(at == 0 ? range : "", 12) +
           padded(marks.substr(at, kSeedsShown), std::min(kSeedsShown, std::max<std::size_t>(marks.size(), 8)) + 2);
    if (at == 0)
      out += padded(verdict(r), 14) + (r.real_time() > 0 ? format("%.0f x real time per core", r.real_time()) : "");
    while (out.back() == ' ') out.pop_back();
    out += '\n';
  }
}

void put_failures(const TestResult& result, std::string& out) {
  std::size_t failed = 0;
  for (const ScenarioResult& r : result.scenarios)
    for (const SeedOutcome& s : r.seeds) {
      if (!s.failed()) continue;
      if (++failed > kFailuresShown) continue;
      out += "\nFAIL " + r.scenario.name + ", seed " + std::to_string(s.seed) + "\n";
      for (const std::string& cause : causes(r.scenario, s)) out += "  " + cause + "\n";
      out += "  replay: " + replay_command(r.scenario, s.seed) + "\n";
      for (const std::string& line : recording_lines(s)) out += "  " + line + "\n";
    }
  if (failed > kFailuresShown)
    out += "\nand " + std::to_string(failed - kFailuresShown) + " more failures; --json and --junit name all of them\n";
}

/// States how many failures were recorded, and that the largest number of files was reached.
void put_recordings(const TestResult& result, std::string& out) {
  if (!result.recordings || result.failed() == 0) return;
  const FailureRecordings& r = *result.recordings;
  out += format("\nrecordings: %zu of %zu failures in ", result.recorded(), result.failed()) + r.folder;
  if (r.left_out > 0)
    out += format("; %zu were left out, as a call writes at most %zu files", r.left_out, kFailureRecordingsMax);
  out += "\n";
}

}  // namespace

std::string test_summary(const TestResult& result) {
  std::string out;
  std::size_t width = 8;
  for (const ScenarioResult& r : result.scenarios) width = std::max(width, r.scenario.name.size());
  out += padded("scenario", width + 2) + padded("seeds", 12) + ". pass, F broken, T trouble, C crash, - not run\n";
  for (const ScenarioResult& r : result.scenarios) put_scenario(r, width, out);
  for (const ScenarioResult& r : result.scenarios) {
    out += "\n" + r.scenario.name + ": " + r.scenario.scene + " over " + r.scenario.network;
    for (const auto& [seat, network] : r.scenario.seat_networks) out += ", " + seat + " over " + network;
    out += "\n";
    if (const std::string bands = bands_text(r); !bands.empty())
      out += "  network for force feedback, at the worst seed: " + bands + "\n";
    out += network_words(r);
    put_limits(r, out);
    for (const std::string& note : r.scenario.notes) out += "  note: " + note + "\n";
    out += notes_text(r);
  }
  put_failures(result, out);
  put_recordings(result, out);
  if (result.not_run() > 0) {
    out += "\nnot run:";
    for (const ScenarioResult& r : result.scenarios) {
      if (r.count(State::kNotRun) == 0) continue;
      out += " " + r.scenario.name + " (";
      std::string list;
      for (const SeedOutcome& s : r.seeds)
        if (s.state == State::kNotRun && list.size() < 60) list += (list.empty() ? "" : " ") + std::to_string(s.seed);
      out += list + (r.count(State::kNotRun) > 1 && list.size() >= 60 ? " ..." : "") + ")";
    }
    out += "\n";
  }
  const std::size_t all = result.all(), failed = result.failed(), not_run = result.not_run();
  return out + format("\n%s: %zu of %zu seeds passed, %zu failed, %zu not run, in %.1f s\n",
                      result.passed() ? "pass" : "FAIL", all - failed - not_run, all, failed, not_run, result.wall_s);
}

}  // namespace tandem::netsim
