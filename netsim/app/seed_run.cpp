#include "netsim/app/seed_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>

#include "netsim/system/run_simulation.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;
using State = SeedOutcome::State;

double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

std::string_view name(State state) noexcept {
  constexpr std::array<std::string_view, 5> kNames{"not run", "pass", "fail", "trouble", "crash"};
  return kNames[static_cast<std::size_t>(state)];
}

SeedOutcome run_seed(const Scenario& scenario, std::uint64_t seed, const SeedRunObserver& observer) {
  SeedOutcome out;
  out.seed = seed;
  SimulationConfig setup = scenario.setup;
  setup.seed = seed;
  setup.monitor_quality = true;
  const double begun = cpu_now();
  const auto go_on = [&](double session_s) {
    if (observer.progress) observer.progress(session_s / setup.scene.duration);
    return true;
  };
  SimulationResult run = run_simulation(setup, {.keep_running = go_on, .trace = observer.trace});
  out.cpu_s = cpu_now() - begun;
  out.violations = run.report.violations;
  out.trace_hash = run.report.trace_hash;
  out.duration_s = run.report.duration_s;
  out.trouble = run.trouble;
  out.notes = run.notes;
  for (const NamedLink& one : run.links) out.bands.emplace_back(one.name, verdict_name(verdict(one.link)));
  for (const NamedLink& one : run.links) out.badness = std::max(out.badness, badness(one.link));
  out.network_text = quality_report(run.links, false);
  bool good = run.report.passed;
  for (const Limit& limit : scenario.limits) {
    out.values.push_back(value_of(limit, run.report));
    good = good && holds(limit, out.values.back());
  }
  out.state = !out.trouble.empty() ? State::kTrouble : good ? State::kPass : State::kFail;
  if (observer.report) {
    Json report = Json::parse(server::to_json(run.report));
    report.erase("cpu_s");
    out.report = report.dump();
  }
  return out;
}

std::string to_bytes(const SeedOutcome& o) {
  Json j{{"seed", o.seed},
         {"state", static_cast<int>(o.state)},
         {"trouble", o.trouble},
         {"hash", o.trace_hash},
         {"duration", o.duration_s},
         {"cpu", o.cpu_s},
         {"report", o.report},
         {"values", Json::array()},
         {"violations", Json::array()},
         {"bands", Json::array()},
         {"words", o.network_text},
         {"badness", o.badness},
         {"notes", o.notes}};
  for (const double value : o.values) j["values"].push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  for (const server::Violation& v : o.violations)
    j["violations"].push_back({v.invariant, v.seat, v.at_s, v.expected, v.count});
  for (const auto& [seat, band] : o.bands) j["bands"].push_back(Json{{"seat", seat}, {"band", band}});
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SeedOutcome outcome_from_bytes(const std::string& bytes) {
  const Json j = Json::parse(bytes);
  SeedOutcome o;
  o.seed = j.at("seed").get<std::uint64_t>();
  o.state = static_cast<State>(j.at("state").get<int>());
  o.trouble = j.at("trouble").get<std::string>();
  o.trace_hash = j.at("hash").get<std::string>();
  o.duration_s = j.at("duration").get<double>();
  o.cpu_s = j.at("cpu").get<double>();
  o.report = j.at("report").get<std::string>();
  for (const Json& value : j.at("values"))
    o.values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
  for (const Json& v : j.at("violations"))
    o.violations.push_back({v.at(0).get<std::string>(), v.at(1).get<std::string>(), v.at(2).get<double>(),
                            v.at(3).get<bool>(), v.at(4).get<std::uint64_t>()});
  o.notes = j.at("notes").get<std::vector<std::string>>();
  for (const Json& b : j.at("bands"))
    o.bands.emplace_back(b.at("seat").get<std::string>(), b.at("band").get<std::string>());
  o.network_text = j.at("words").get<std::string>();
  o.badness = j.at("badness").get<double>();
  return o;
}

}  // namespace tandem::netsim
