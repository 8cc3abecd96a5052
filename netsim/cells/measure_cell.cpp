#include "netsim/cells/measure_cell.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "netsim/feel/feel_keys.h"
#include "netsim/feel/meters.h"
#include "netsim/feel/probes.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kExposedFrom = 1, kDriftSpan = 1;              // [s]
constexpr double kContactDepth = 0.0005, kContactForce = 0.05;  // [m, N]; less is no contact

/// Returns the positions of the hands' mean, weighted with authority, row by row.
std::vector<hal::Vec3> weighted_hands(const FeelTrace& trace) {
  std::vector<hal::Vec3> out(trace.rows(), hal::Vec3::Zero());
  for (std::size_t i = 0; i < out.size(); ++i) {
    double sum = 0;
    for (const FeelTrace::Hand& hand : trace.hands) {
      out[i] += hand.alpha[i] * hand.x[i];
      sum += hand.alpha[i];
    }
    out[i] = sum > 0 ? hal::Vec3(out[i] / sum) : trace.tool[i];  // HELD: the tool is braked
  }
  return out;
}

/// Returns the largest energy that the motors of the first `hands` hands together had given at any time [J], at least
/// 0.
double motor_energy(const FeelTrace& trace, std::size_t hands) {
  double sum = 0, largest = 0;
  for (std::size_t i = 0; i < trace.rows(); ++i) {
    for (std::size_t k = 0; k < hands; ++k) sum += trace.hands[k].work[i];
    largest = std::max(largest, sum);
  }
  return largest;
}

/// Returns whether a hand moved too fast, oscillates in the rest, or the tool left the hands.
bool unstable(const FeelTrace& trace, const TaskTimes& times, const std::vector<hal::Vec3>& hands) {
  for (std::size_t i = 0; i < hands.size(); ++i)
    if (!((trace.tool[i] - hands[i]).norm() <= kUnstableDistance)) return true;
  return std::ranges::any_of(trace.hands, [&](const FeelTrace::Hand& hand) {
    const double fastest = 1e3 * largest_step_per_ms(hand.x, trace.tick_hz);
    return !(fastest <= kUnstableSpeed) || !(limit_cycle(trace, hand, times.cycle, times.end) <= kUnstableForce);
  });
}

void put_motion(const FeelTrace& trace, const TaskTimes& times, const std::vector<hal::Vec3>& hands, CellValues& v) {
  const auto put = [&](CellNumber number, double value) { v[static_cast<std::size_t>(number)] = value; };
  const Series tool = trace.part(trace.tool, times.from, times.to);
  put(CellNumber::kTracking, rms_difference(trace.part(hands, times.from, times.to), tool));
  double farthest = kNaN;
  for (std::size_t i = 1; i < trace.hands.size(); ++i) {
    const double distance = rms_difference(trace.part(trace.hands[i].x, times.from, times.to), tool);
    farthest = std::isnan(farthest) ? distance : larger(farthest, distance);
  }
  put(CellNumber::kFollower, farthest);
  put(CellNumber::kDrag, rms(trace.part(trace.hands[0].f, times.from, times.to)));
  const double last = times.end - kDriftSpan;
  put(CellNumber::kDrift,
      (mean(trace.part(trace.tool, last, times.end)) - mean(trace.part(hands, last, times.end))).norm());
}

void put_contact(const FeelTrace& trace, const TaskTimes& times, CellValues& v) {
  const HeldPress held = held_press(trace, times.from, times.to);
  const bool deep = held.felt >= kContactForce && held.felt / held.stiffness >= kContactDepth;
  v[static_cast<std::size_t>(CellNumber::kStiffness)] = deep ? held.stiffness : kNaN;
  v[static_cast<std::size_t>(CellNumber::kForceError)] = deep ? held.difference : kNaN;
}

Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

}  // namespace

CellResult::Summary CellResult::of(CellNumber number) const {
  const CellNumberRow& row = row_of(number);
  Summary out{.median = kNaN, .worst = kNaN};
  std::vector<double> values;
  for (const CellRun& run : runs) {
    const double value = run.values[static_cast<std::size_t>(number)];
    if (std::isnan(value)) continue;
    if (values.empty() || worse(row, value, out.worst)) {
      out.worst = value;
      out.worst_seed = run.seed;
    }
    values.push_back(value);
  }
  if (values.empty()) return out;
  if (number == CellNumber::kUnstable) {
    out.median = out.worst = mean(values);
    return out;
  }
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  out.median = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  return out;
}

bool CellResult::sound() const noexcept {
  return !runs.empty() &&
         std::ranges::all_of(runs, [](const CellRun& run) { return run.trouble.empty() && run.broken.empty(); });
}

CellValues values_of(const FeelTrace& trace, const TaskTimes& times) {
  CellValues v;
  v.fill(kNaN);
  if (trace.rows() == 0 || trace.hands.empty()) return v;
  const std::vector<hal::Vec3> hands = weighted_hands(trace);
  if (times.contact) {
    put_contact(trace, times, v);
  } else {
    put_motion(trace, times, hands, v);
  }
  FeelValues exposure;
  put_exposure(exposure_of(trace, kExposedFrom), exposure);
  v[static_cast<std::size_t>(CellNumber::kEngagedShare)] = exposure.at("engaged_share");
  v[static_cast<std::size_t>(CellNumber::kMotorEnergy)] = motor_energy(trace, trace.hands.size());
  v[static_cast<std::size_t>(CellNumber::kLeaderEnergy)] = motor_energy(trace, 1);
  v[static_cast<std::size_t>(CellNumber::kUnstable)] = unstable(trace, times, hands) ? 1 : 0;
  return v;
}

CellRun measure_cell(const Cell& cell, const CellInput& input, std::uint64_t seed) {
  const FeelSetup setup = setup_of(cell, input);
  const FeelTrace trace = run_probe(setup, run_of(cell, input, setup, seed), seed);
  return {.seed = seed,
          .values = values_of(trace, task_times(cell.task, input.recording.get())),
          .trouble = trace.trouble,
          .broken = trace.broken};
}

std::string to_bytes(const CellResult& result) {
  Json runs = Json::array();
  for (const CellRun& run : result.runs) {
    Json values = Json::array();
    for (const double value : run.values) values.push_back(number(value));
    runs.push_back({run.seed, std::move(values), run.trouble, run.broken});
  }
  return runs.dump(-1, ' ', false, Json::error_handler_t::replace);
}

CellResult cell_result_from_bytes(const std::string& bytes) {
  CellResult result;
  for (const Json& run : Json::parse(bytes)) {
    CellRun& out = result.runs.emplace_back();
    out.seed = run.at(0).get<std::uint64_t>();
    const Json& values = run.at(1);
    if (values.size() != out.values.size()) throw std::invalid_argument("another number of values");
    for (std::size_t i = 0; i < out.values.size(); ++i)
      out.values[i] = values[i].is_null() ? kNaN : values[i].get<double>();
    out.trouble = run.at(2).get<std::string>();
    out.broken = run.at(3).get<std::vector<std::string>>();
  }
  return result;
}

}  // namespace tandem::netsim
