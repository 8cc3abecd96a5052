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

/// Adds numbers by key.
void put_numbers(const auto& numbers, Json& into) {
  for (const auto& [key, value] : numbers) into[key] = number(value);
}

/// @param indent  spaces per level; -1: one line
std::string text(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string feel_json(const FeelReport& r) {
  Json probes = Json::array(), feel = Json::object(), limits = Json::array(), seeds = Json::array();
  for (const ProbeName& one : kProbes)
    if (std::ranges::find(r.probes, one.probe) != r.probes.end()) probes.push_back(one.name);
  for (const FeelSection& section : feel_sections())
    for (const auto& [key, of] : r.rows(section))
      feel[std::string(key->key)] = {{"mean", number(of.mean)},
                                     {"worst", number(of.worst)},
                                     {"worst_seed", of.worst_seed},
                                     {"unit", std::string(si_unit(key->key))}};
  for (const FeelLimit& limit : r.limits)
    limits.push_back({{"key", limit.key}, {"at_least", limit.at_least}, {"end", limit.end}, {"holds", r.holds(limit)}});
  for (const FeelSeed& seed : r.seeds) put_numbers(seed.values, seeds.emplace_back(Json{{"seed", seed.seed}}));
  Json noticeable = Json::object();
  put_numbers(noticeable_numbers(r.spec, r.numbers, r.one_way_s), noticeable);
  return text({{"version", 1},
               {"scene", r.scene},
               {"network", r.network},
               {"law", r.channel},
               {"hands", r.plain_hands ? "plain" : "drawn"},
               {"probes", std::move(probes)},
               {"recordings", r.recordings},
               {"one_way_s", number(r.one_way_s)},
               {"feel", std::move(feel)},
               {"noticed", noticeable_text(r.spec, r.numbers, r.one_way_s)},
               {"noticeable", std::move(noticeable)},
               {"limits", std::move(limits)},
               {"passed", r.passed()},
               {"interrupted", r.interrupted},
               {"troubles", r.troubles},
               {"notes", r.notes},
               {"seeds", std::move(seeds)},
               {"lived_s", number(r.lived_s)},
               {"wall_s", number(r.wall_s)}},
              2) +
         "\n";
}

std::string to_bytes(const ProbeResult& result) {
  const Exposure& e = result.exposure;
  Json values = Json::object();
  put_numbers(result.values, values);
  return text(
      {{"exposure",
        {e.s, e.engaged_s, e.held_s, e.saturated_s, e.trips, e.error_square, e.sent_up, e.sent_down, e.send_ticks}},
       {"lived", result.lived_s},
       {"one_way", number(result.one_way_s)},
       {"trouble", result.trouble},
       {"values", std::move(values)}},
      -1);
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
                  .error_square = e.at(5),
                  .sent_up = e.at(6),
                  .sent_down = e.at(7),
                  .send_ticks = e.at(8)};
  out.lived_s = j.at("lived").get<double>();
  out.one_way_s = from_json(j.at("one_way"));
  out.trouble = j.at("trouble").get<std::string>();
  for (const auto& [key, value] : j.at("values").items()) out.values[key] = from_json(value);
  return out;
}

}  // namespace tandem::netsim
