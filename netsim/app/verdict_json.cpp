#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "netsim/app/run_json.h"
#include "netsim/app/sweep.h"
#include "netsim/app/test_report.h"
#include "netsim/quality/quality_json.h"

/// JSON of a run, of the seeds of a test, and of a sweep: the only source of the verdicts that includes the JSON
/// library, which takes long to compile.
namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the number, or null if it does not exist.
Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }
Json number(const std::optional<double>& v) { return v ? number(*v) : Json(nullptr); }
double number_from(const Json& j) { return j.is_null() ? std::numeric_limits<double>::quiet_NaN() : j.get<double>(); }

/// Returns an array with one element per item.
Json array_of(const auto& items, auto make) {
  Json all = Json::array();
  for (const auto& item : items) all.push_back(make(item));
  return all;
}

/// @param indent  spaces per level; -1: one line
std::string text(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

/// Returns an array of objects with two texts each.
Json pairs(const std::vector<std::pair<std::string, std::string>>& all, const char* first, const char* second) {
  return array_of(all, [&](const auto& pair) { return Json{{first, pair.first}, {second, pair.second}}; });
}

Json numbers(const std::vector<double>& values) {
  return array_of(values, [](double value) { return number(value); });
}

Json violation_json(const server::Violation& v) {
  return {{"invariant", v.invariant}, {"seat", v.seat}, {"at_s", v.at_s}, {"expected", v.expected}, {"count", v.count}};
}

Json seed_json(const Scenario& scenario, const SeedOutcome& o) {
  Json seed{{"seed", o.seed},
            {"verdict", name(o.state)},
            {"causes", causes(scenario, o)},
            {"values", numbers(o.values)},
            {"violations", array_of(o.violations, violation_json)},
            {"network", pairs(o.bands, "seat", "band")},
            {"notes", o.notes},
            {"duration_s", number(o.duration_s)},
            {"trace_hash", o.trace_hash},
            {"cpu_s", number(o.cpu_s)},
            {"replay", replay_command(scenario, o.seed)}};
  if (!o.report.empty()) seed["report"] = Json::parse(o.report);
  if (!o.recording.empty()) seed["recording"] = o.recording;
  if (!o.recording_problem.empty()) seed["recording_problem"] = o.recording_problem;
  return seed;
}

Json limit_json(const Limit& limit, const std::optional<WorstValue>& worst) {
  return {{"subject", limit.subject},
          {"metric", limit.metric},
          {"unit", limit.unit},
          {"min", number(limit.min)},
          {"max", number(limit.max)},
          {"worst", worst ? number(worst->value) : Json(nullptr)},
          {"worst_seed", worst ? Json(worst->seed) : Json(nullptr)},
          {"margin_percent", worst ? number(margin_percent(limit, worst->value)) : Json(nullptr)}};
}

Json scenario_json(const ScenarioResult& r) {
  const Scenario& s = r.scenario;
  Json limits = Json::array();
  for (std::size_t i = 0; i < s.limits.size(); ++i) limits.push_back(limit_json(s.limits[i], r.worst_of(i)));
  return {{"name", s.name},
          {"file", s.file},
          {"summary", s.summary},
          {"scene", s.scene},
          {"network", s.network},
          {"seat_networks", pairs(s.seat_networks, "seat", "network")},
          {"duration_s", number(s.setup.scene.duration)},
          {"verdict", r.passed() ? "pass" : "fail"},
          {"cpu_s", number(r.cpu_s())},
          {"notes", s.notes},
          {"limits", std::move(limits)},
          {"seeds", array_of(r.seeds, [&](const SeedOutcome& o) { return seed_json(s, o); })}};
}

Json point_json(const Sweep& sweep, const SweepPoint& p, const ScenarioResult& runs) {
  const auto seed_of = [&](const SeedOutcome& s) {
    Json broken = Json::array();
    for (const server::Violation& v : s.violations)
      if (!v.expected) broken.push_back(v.invariant + (v.seat.empty() ? "" : " at " + v.seat));
    return Json{{"seed", s.seed},       {"value", number(sweep.value_of(s))}, {"broken", std::move(broken)},
                {"trouble", s.trouble}, {"trace_hash", s.trace_hash},         {"replay", sweep.replay(p, s.seed)}};
  };
  return {{"delay_ms", p.delay_ms},
          {"jitter_ms", p.jitter_ms},
          {"loss_percent", p.loss_percent},
          {"worst", number(p.worst)},
          {"median", number(p.median)},
          {"worst_seed", std::isfinite(p.worst) ? Json(p.worst_seed) : Json(nullptr)},
          {"broken", p.broken},
          {"trouble", p.trouble},
          {"seeds", array_of(runs.seeds, seed_of)}};
}

}  // namespace

std::string run_json(const server::RunReport& report, const std::vector<NamedLink>& links,
                     const std::vector<std::string>& notes, bool interrupted, const std::string& scores) {
  Json json = Json::parse(server::to_json(report));
  for (Json& seat : json["seats"])
    for (const NamedLink& one : links)
      if (seat["name"] == one.name) seat["quality"] = quality_json(one.link);
  json["interrupted"] = interrupted;
  json["notes"] = notes;
  if (!scores.empty()) json["scores"] = Json::parse(scores);
  return json.dump(2) + "\n";
}

std::string without_cpu_time(const std::string& report) {
  Json json = Json::parse(report);
  json.erase("cpu_s");
  return json.dump();
}

std::string test_json(const TestResult& result) {
  double cpu_s = 0;
  for (const ScenarioResult& r : result.scenarios) cpu_s += r.cpu_s();
  Json json{{"version", 1},
            {"verdict", result.passed() ? "pass" : "fail"},
            {"interrupted", result.interrupted},
            {"seeds_run", result.all() - result.not_run()},
            {"seeds_failed", result.failed()},
            {"seeds_not_run", result.not_run()},
            {"cpu_s", number(cpu_s)}};
  if (const auto& r = result.recordings)
    json["recordings"] = {{"folder", r->folder}, {"written", result.recorded()}, {"left_out", r->left_out}};
  json["scenarios"] = array_of(result.scenarios, scenario_json);
  return text(json, 2) + "\n";
}

std::string sweep_json(const Sweep& sweep) {
  Json points = Json::array();
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
    points.push_back(point_json(sweep, sweep.points[i], sweep.runs.scenarios[i]));
  return text({{"version", 1},
               {"scene", sweep.spec.scene_name},
               {"metric", sweep.spec.metric},
               {"unit", sweep.unit()},
               {"good", sweep.good()},
               {"points", std::move(points)}},
              2) +
         "\n";
}

std::string to_bytes(const SeedOutcome& o) {
  return text({{"seed", o.seed},
               {"state", static_cast<int>(o.state)},
               {"trouble", o.trouble},
               {"hash", o.trace_hash},
               {"duration", o.duration_s},
               {"cpu", o.cpu_s},
               {"report", o.report},
               {"values", numbers(o.values)},
               {"violations", array_of(o.violations, violation_json)},
               {"bands", pairs(o.bands, "seat", "band")},
               {"words", o.network_text},
               {"badness", o.badness},
               {"notes", o.notes},
               {"recording", o.recording},
               {"recording_problem", o.recording_problem}},
              -1);
}

SeedOutcome outcome_from_bytes(const std::string& bytes) {
  const Json j = Json::parse(bytes);
  SeedOutcome o{.seed = j.at("seed"),
                .state = static_cast<SeedOutcome::State>(j.at("state").get<int>()),
                .trouble = j.at("trouble"),
                .violations = {},
                .values = {},
                .bands = {},
                .notes = j.at("notes"),
                .network_text = j.at("words"),
                .badness = j.at("badness"),
                .trace_hash = j.at("hash"),
                .duration_s = j.at("duration"),
                .cpu_s = j.at("cpu"),
                .report = j.at("report"),
                .recording = j.at("recording"),
                .recording_problem = j.at("recording_problem")};
  for (const Json& value : j.at("values")) o.values.push_back(number_from(value));
  for (const Json& v : j.at("violations"))
    o.violations.push_back({v.at("invariant"), v.at("seat"), v.at("at_s"), v.at("expected"), v.at("count")});
  for (const Json& b : j.at("bands")) o.bands.emplace_back(b.at("seat"), b.at("band"));
  return o;
}

}  // namespace tandem::netsim
