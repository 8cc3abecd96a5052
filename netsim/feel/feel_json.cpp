#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "netsim/feel/feel_report.h"
#include "netsim/feel/noticeable.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }
double from_json(const Json& j) { return j.is_null() ? std::numeric_limits<double>::quiet_NaN() : j.get<double>(); }

}  // namespace

std::string feel_json(const FeelReport& r) {
  Json j{{"version", 1},
         {"scene", r.scene},
         {"network", r.network},
         {"law", r.channel},
         {"hands", r.plain_hands ? "plain" : "drawn"}};
  j["probes"] = Json::array();
  for (const ProbeName& one : kProbes)
    if (std::ranges::find(r.probes, one.probe) != r.probes.end()) j["probes"].push_back(one.name);
  j["recordings"] = r.recordings;
  j["one_way_s"] = number(r.one_way_s);
  Json feel = Json::object();
  for (const FeelSection& section : feel_sections())
    for (const FeelKey& key : section.keys) {
      const auto it = r.numbers.find(std::string(key.key));
      if (it == r.numbers.end()) continue;
      feel[std::string(key.key)] = {{"mean", number(it->second.mean)},
                                    {"worst", number(it->second.worst)},
                                    {"worst_seed", it->second.worst_seed},
                                    {"unit", std::string(si_unit(key.key))}};
    }
  j["feel"] = std::move(feel);
  j["noticed"] = noticeable_text(r.spec, r.numbers, r.one_way_s);
  j["noticeable"] = Json::object();
  for (const auto& [key, value] : noticeable_numbers(r.spec, r.numbers, r.one_way_s))
    j["noticeable"][key] = number(value);
  j["limits"] = Json::array();
  for (const FeelLimit& limit : r.limits) {
    const auto it = r.numbers.find(limit.key);
    j["limits"].push_back({{"key", limit.key},
                           {"at_least", limit.at_least},
                           {"end", limit.end},
                           {"holds", it != r.numbers.end() && limit.holds(it->second)}});
  }
  j["passed"] = r.passed();
  j["interrupted"] = r.interrupted;
  j["troubles"] = r.troubles;
  j["notes"] = r.notes;
  j["seeds"] = Json::array();
  for (const FeelSeed& seed : r.seeds) {
    Json one{{"seed", seed.seed}};
    for (const auto& [key, value] : seed.values) one[key] = number(value);
    j["seeds"].push_back(std::move(one));
  }
  j["lived_s"] = number(r.lived_s);
  j["wall_s"] = number(r.wall_s);
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_bytes(const ProbeResult& result) {
  const Exposure& e = result.exposure;
  Json j{{"exposure", {e.s, e.engaged_s, e.held_s, e.saturated_s, e.trips, e.error_square}},
         {"lived", result.lived_s},
         {"one_way", number(result.one_way_s)},
         {"trouble", result.trouble}};
  j["values"] = Json::object();
  for (const auto& [key, value] : result.values) j["values"][key] = number(value);
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

ProbeResult probe_result_from_bytes(const std::string& bytes) {
  const Json j = Json::parse(bytes);
  ProbeResult out;
  const Json& e = j.at("exposure");
  out.exposure = {.s = e.at(0),
                  .engaged_s = e.at(1),
                  .held_s = e.at(2),
                  .saturated_s = e.at(3),
                  .trips = e.at(4),
                  .error_square = e.at(5)};
  out.lived_s = j.at("lived").get<double>();
  out.one_way_s = from_json(j.at("one_way"));
  out.trouble = j.at("trouble").get<std::string>();
  for (const auto& [key, value] : j.at("values").items()) out.values[key] = from_json(value);
  return out;
}

}  // namespace tandem::netsim
