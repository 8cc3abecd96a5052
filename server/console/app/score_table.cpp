#include "server/console/app/score_table.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "server/console/json_text.h"

namespace tandem::console {
namespace {

using netsim::score::Metric;
using netsim::score::MetricTrust;
using netsim::score::PartScore;
using netsim::score::Trust;
using nlohmann::json;

constexpr std::array kShown{Metric::kTime,      Metric::kPathLength,    Metric::kSparc,    Metric::kLogJerk,
                            Metric::kForcePeak, Metric::kForceMean,     Metric::kContacts, Metric::kContactTimeMean,
                            Metric::kTracking,  Metric::kAuthorityShare};

MetricTrust trust_of(const PartScore& part, Metric metric, double value, std::span<const RateDoubt> doubts) {
  MetricTrust out = netsim::score::trust_in(part.quality, metric, value);
  if (out.trust == Trust::kAbsent) return out;
  for (const RateDoubt& doubt : doubts) {
    if (doubt.metric != metric) continue;
    out.trust = std::max(out.trust, doubt.trust);
    out.reason += (out.reason.empty() ? "" : "; ") + std::string(doubt.reason);
  }
  return out;
}

json cell_of(const PartScore& part, Metric metric, std::span<const RateDoubt> doubts) {
  const double value = netsim::score::of(part.values, metric);
  const MetricTrust trust = trust_of(part, metric, value, doubts);
  const bool shown = trust.trust == Trust::kGood || trust.trust == Trust::kFlagged;
  return {{"text", shown ? json(netsim::score::value_text(netsim::score::row_of(metric), value)) : json()},
          {"trust", netsim::score::to_text(trust.trust)},
          {"reason", trust.reason}};
}

}  // namespace

std::string score_members(const netsim::score::LessonScores& scores, std::span<const RateDoubt> doubts) {
  json metrics = json::array(), seats = json::array();
  for (const Metric metric : kShown) {
    const auto& row = netsim::score::row_of(metric);
    metrics.push_back({{"key", row.key}, {"title", row.title}, {"unit", row.unit}});
  }
  for (const auto& seat : scores.seats) {
    json parts = json::array();
    for (const PartScore& part : seat.parts) {
      json cells = json::array();
      for (const Metric metric : kShown) cells.push_back(cell_of(part, metric, doubts));
      parts.push_back({{"part", part.key}, {"title", part.title}, {"cells", std::move(cells)}});
    }
    seats.push_back({{"seat", seat.name}, {"person", seat.person}, {"parts", std::move(parts)}});
  }
  const std::string text = json_text({{"rate_hz", scores.rate_hz},
                                      {"from_s", scores.begin_s},
                                      {"to_s", scores.end_s},
                                      {"metrics", std::move(metrics)},
                                      {"seats", std::move(seats)},
                                      {"notes", scores.notes}});
  return text.substr(1, text.size() - 2);
}

}  // namespace tandem::console
