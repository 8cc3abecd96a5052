#include "netsim/quality/quality_json.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "netsim/quality/quality_text.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

double ms(Duration d) { return static_cast<double>(d.count()) / 1e6; }

void put_delay(Json& json, const DelaySummary& d, const std::string& prefix) {
  json[prefix + "mean_ms"] = d.mean_s * 1e3;
  json[prefix + "p5_ms"] = ms(d.p5);
  json[prefix + "p50_ms"] = ms(d.p50);
  json[prefix + "p95_ms"] = ms(d.p95);
  json[prefix + "p99_ms"] = ms(d.p99);
  json[prefix + "max_ms"] = ms(d.max);
}

Json windows_json(const WindowSummaries& all, std::initializer_list<Measure> measures) {
  Json list = Json::array();
  for (const WindowSummary& w : all) {
    Json one{{"length_s", seconds(w.length)}, {"step_s", seconds(kWindowStep)}, {"judged", w.windows}};
    for (const Band band : {Band::kGreen, Band::kAmber, Band::kRed}) {
      one[std::string(name(band)) + "_percent"] = 100 * w.share(band);
    }
    for (const Measure measure : measures) {
      const MeasureSummary& m = w.of(measure);
      Json of;
      for (const Band band : {Band::kGreen, Band::kAmber, Band::kRed}) {
        of[name(band)] = m.windows[static_cast<std::size_t>(band)];
      }
      of[measure == Measure::kLoss ? "worst_percent" : "worst_ms"] = m.worst * (measure == Measure::kLoss ? 100 : 1e3);
      of["worst_to_s"] = seconds(m.worst_at);
      one[measure == Measure::kRoundTrip ? "round_trip_p99" : name(measure)] = of;
    }
    list.push_back(one);
  }
  return list;
}

}  // namespace

Json quality_json(const DirectionSummary& way) {
  Json json{{"verdict", verdict_name(verdict(way.windows))},
            {"from_s", seconds(way.from)},
            {"until_s", seconds(way.until)},
            {"sent", way.sent},
            {"lost", way.lost},
            {"lost_percent", 100 * way.lost_share()},
            {"arrived", way.arrived},
            {"duplicates", way.duplicates},
            {"reordered", way.reordered},
            {"reordered_percent", 100 * way.reordered_share()},
            {"reordered_by_max", way.reordered_by_max}};
  put_delay(json, way.delay, "delay_");
  json.update(Json{{"jitter_ms", ms(way.delay.jitter())},
                   {"age_mean_ms", way.age.mean_s * 1e3},
                   {"age_p50_ms", ms(way.age.p50)},
                   {"age_p99_ms", ms(way.age.p99)},
                   {"age_max_ms", ms(way.age.max)},
                   {"age_max_at_s", seconds(way.age.max_at)},
                   {"longest_gap_ms", ms(way.longest_gap)},
                   {"longest_gap_at_s", seconds(way.longest_gap_at)},
                   {"sender_pauses", way.pauses},
                   {"sender_paused_s", seconds(way.paused)},
                   {"windows", windows_json(way.windows, {Measure::kLoss, Measure::kGap, Measure::kJitter})}});
  return json;
}

Json quality_json(const LinkSummary& link) {
  const RoundTripSummary& round_trip = link.round_trip;
  Json trip{{"verdict", verdict_name(verdict(round_trip.windows))}, {"count", round_trip.delay.count}};
  put_delay(trip, round_trip.delay, "");
  trip["windows"] = windows_json(round_trip.windows, {Measure::kRoundTrip});
  return {{"verdict", verdict_name(verdict(link))},
          {"up", quality_json(link.up)},
          {"down", quality_json(link.down)},
          {"round_trip", std::move(trip)}};
}

}  // namespace tandem::netsim
