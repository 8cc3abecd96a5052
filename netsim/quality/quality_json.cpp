#include "netsim/quality/quality_json.h"

#include <nlohmann/json.hpp>
#include <string>

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
    Json one;
    one["length_s"] = seconds(w.length);
    one["step_s"] = seconds(kWindowStep);
    one["judged"] = w.windows;
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
  Json json;
  json["verdict"] = verdict_name(verdict(way.windows));
  json["from_s"] = seconds(way.from);
  json["until_s"] = seconds(way.until);
  json["sent"] = way.sent;
  json["lost"] = way.lost;
  json["lost_percent"] = 100 * way.lost_share();
  json["arrived"] = way.arrived;
  json["duplicates"] = way.duplicates;
  json["reordered"] = way.reordered;
  json["reordered_percent"] = 100 * way.reordered_share();
  json["reordered_by_max"] = way.reordered_by_max;
  put_delay(json, way.delay, "delay_");
  json["jitter_ms"] = ms(way.delay.jitter());
  json["age_mean_ms"] = way.age.mean_s * 1e3;
  json["age_p50_ms"] = ms(way.age.p50);
  json["age_p99_ms"] = ms(way.age.p99);
  json["age_max_ms"] = ms(way.age.max);
  json["age_max_at_s"] = seconds(way.age.max_at);
  json["longest_gap_ms"] = ms(way.longest_gap);
  json["longest_gap_at_s"] = seconds(way.longest_gap_at);
  json["sender_pauses"] = way.pauses;
  json["sender_paused_s"] = seconds(way.paused);
  json["windows"] = windows_json(way.windows, {Measure::kLoss, Measure::kGap, Measure::kJitter});
  return json;
}

Json quality_json(const LinkSummary& link) {
  Json json;
  json["verdict"] = verdict_name(verdict(link));
  json["up"] = quality_json(link.up);
  json["down"] = quality_json(link.down);
  Json& trip = json["round_trip"];
  trip["verdict"] = verdict_name(verdict(link.round_trip.windows));
  trip["count"] = link.round_trip.delay.count;
  put_delay(trip, link.round_trip.delay, "");
  trip["windows"] = windows_json(link.round_trip.windows, {Measure::kRoundTrip});
  return json;
}

}  // namespace tandem::netsim
