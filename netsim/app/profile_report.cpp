#include "netsim/app/profile_report.h"

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/base/format.h"
#include "netsim/profiles/profile_preview_figure.h"
#include "netsim/quality/quality_json.h"
#include "netsim/quality/quality_text.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kReportShares{0.05, 0.50, 0.95, 0.99};
constexpr std::array kShareNames{"p5", "p50", "p95", "p99"};

const ProfilePreviewDirection& way_of(const ProfilePreview& portrait, Direction direction) {
  return portrait.ways[static_cast<std::size_t>(direction)];
}

const DirectionSummary& quality_of(const ProfilePreview& portrait, Direction direction) {
  return direction == Direction::kUp ? portrait.quality.up : portrait.quality.down;
}

/// Returns the lines of the file with parameters, without those that the heading contains.
std::string parameters_of(const std::string& text) {
  std::string kept, line;
  std::istringstream lines(text);
  while (std::getline(lines, line)) {
    const auto says = [&line](const char* key) { return line.starts_with(key); };
    if (line.empty() || says("version:") || says("summary:") || says("source:") || says("check ")) continue;
    kept += "    " + line + "\n";
  }
  return kept;
}

std::string ms_cell(double ms) { return format("%.*f", ms < 9.995 ? 2 : ms < 99.95 ? 1 : 0, ms); }

std::string measured_row(const char* what, const std::array<double, 4>& q, const std::string& rest) {
  return format("  %-16s %8s %8s %8s %8s", what, ms_cell(q[0]).c_str(), ms_cell(q[1]).c_str(), ms_cell(q[2]).c_str(),
                ms_cell(q[3]).c_str()) +
         rest + "\n";
}

/// Returns the causes by which datagrams were lost, and their numbers.
std::vector<std::pair<const char*, std::uint64_t>> drops(const ProfilePreviewDirection& way) {
  std::vector<std::pair<const char*, std::uint64_t>> out;
  for (std::size_t i = 0; i < kOutcomes; ++i)
    if (const auto outcome = static_cast<Outcome>(i); dropped(outcome) && way.fates[i] > 0)
      out.emplace_back(name(outcome), way.fates[i]);
  return out;
}

std::string causes_of(const ProfilePreviewDirection& way) {
  std::string text;
  for (const auto& [cause, count] : drops(way))
    text += format("%s%llu %s", text.empty() ? "" : ", ", static_cast<unsigned long long>(count), cause);
  return text;
}

std::array<double, 4> quantiles_ms(const ProfilePreviewDirection& way) {
  std::array<double, 4> q{};
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = seconds(way.quantile(kReportShares[i])) * 1e3;
  return q;
}

std::string measured_text(const ProfileSource& subject, const ProfilePreview& portrait) {
  std::string text =
      format("\n  one-way delay over %.1f virtual minutes, 128 bytes at 1 kHz [ms]\n", seconds(portrait.length) / 60);
  text += format("  %-16s %8s %8s %8s %8s %8s %9s  %s\n", "", "p5", "p50", "p95", "p99", "max", "lost", "longest gap");
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    const ProfilePreviewDirection& way = way_of(portrait, direction);
    const DirectionSummary& quality = quality_of(portrait, direction);
    text += measured_row(name(direction), quantiles_ms(way),
                         format(" %8s %9s  %s at %.1f s", ms_cell(seconds(way.quantile(1)) * 1e3).c_str(),
                                share_text(quality.lost_share()).c_str(),
                                delay_text(seconds(quality.longest_gap)).c_str(), seconds(quality.longest_gap_at)));
    for (const ProfileCheck& check : subject.profile.checks) {
      if (check.direction == direction) text += measured_row("  promised", check.delay_ms, "");
    }
    if (const std::string causes = causes_of(way); !causes.empty()) text += "    dropped: " + causes + "\n";
  }
  if (subject.profile.checks.empty() && !subject.recording)
    text += "  no quantiles promised: nothing to compare these with\n";
  return text;
}

void put_quantiles(const std::array<double, 4>& ms, Json& into) {
  for (std::size_t i = 0; i < ms.size(); ++i) into[std::string(kShareNames[i]) + "_ms"] = ms[i];
}

Json description_json(const Profile& profile) {
  Json checks = Json::array();
  for (const ProfileCheck& check : profile.checks)
    put_quantiles(check.delay_ms, checks.emplace_back(Json{{"direction", name(check.direction)}}));
  return {{"name", profile.name},
          {"version", profile.version},
          {"summary", profile.summary},
          {"sources", profile.sources},
          {"checks", std::move(checks)}};
}

}  // namespace

std::string profile_heading(const ProfileSource& subject) {
  const Profile& profile = subject.profile;
  std::string text = profile.name;
  if (!subject.recording) text += format(", version %u", profile.version);
  if (!profile.summary.empty()) text += ": " + profile.summary;
  text += "\n";
  for (const std::string& note : subject.notes) text += "  note: " + note + "\n";
  for (const std::string& source : profile.sources) text += "  source: " + source + "\n";
  const std::string parameters = parameters_of(subject.text);
  return parameters.empty() ? text : text + "  parameters\n" + parameters;
}

std::string profile_report(const ProfileSource& subject, const ProfilePreview& portrait, const PictureStyle& style) {
  std::string text = measured_text(subject, portrait);
  const auto called = verdict(portrait.quality);
  text += format("\n  for force feedback: %s, %s\n", verdict_name(called), meaning(called));
  text += quality_text(portrait.quality, "    ") + quality_table(portrait.quality, "    ");
  const bool alike = subject.profile.link.up == subject.profile.link.down;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    if (alike && direction == Direction::kDown) break;
    const char* const which = alike ? "up (down is alike)" : name(direction);
    text += format("\n  %s: delay of the first %.0f s\n", which, seconds(portrait.shown));
    text += delay_picture(way_of(portrait, direction), portrait.shown, style);
    text +=
        format("\n  %s: delay of all %.1f minutes; share, share up to here\n", which, seconds(portrait.length) / 60);
    text += delay_histogram(way_of(portrait, direction), style);
  }
  return text;
}

std::string profiles_json(const std::vector<Profile>& profiles) {
  Json all = Json::array();
  for (const Profile& profile : profiles) all.push_back(description_json(profile));
  return all.dump(2) + "\n";
}

std::string profile_json(const ProfileSource& subject, const ProfilePreview& portrait, bool interrupted) {
  Json json = description_json(subject.profile);
  json["notes"] = subject.notes;
  Json& measured = json["measured"];
  measured["minutes"] = seconds(portrait.length) / 60;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    const ProfilePreviewDirection& way = way_of(portrait, direction);
    Json& of = measured[name(direction)];
    put_quantiles(quantiles_ms(way), of);
    of["max_ms"] = seconds(way.quantile(1)) * 1e3;
    of["lost_percent"] = 100 * quality_of(portrait, direction).lost_share();
    of["dropped"] = Json::object();
    for (const auto& [cause, count] : drops(way)) of["dropped"][cause] = count;
  }
  json["quality"] = quality_json(portrait.quality);
  json["interrupted"] = interrupted;
  return json.dump(2) + "\n";
}

plot::Figure profile_figure(const ProfileSource& subject, const ProfilePreview& portrait) {
  std::vector<ExpectedQuantile> promised;
  for (const ProfileCheck& check : subject.profile.checks) {
    for (std::size_t i = 0; i < kReportShares.size(); ++i)
      promised.push_back({check.direction, kReportShares[i], check.delay_ms[i]});
  }
  return profile_preview_figure(portrait, subject.profile.name, promised);
}

}  // namespace tandem::netsim
