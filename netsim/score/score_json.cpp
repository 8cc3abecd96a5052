#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "netsim/score/score_output.h"
#include "proto/spec/access_role.h"

namespace tandem::netsim::score {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json metric_json(const PartScore& part, const MetricRow& row) {
  const double value = of(part.values, row.metric);
  const MetricTrust trust = trust_in(part.quality, row.metric, value);
  Json out{{"value", trust.trust == Trust::kWithheld ? Json(nullptr) : number(value)},
           {"unit", row.si_unit},
           {"trust", to_text(trust.trust)}};
  if (!trust.reason.empty()) out["reason"] = trust.reason;
  return out;
}

Json quality_json(const Quality& q) {
  Json doubts = Json::array();
  for (const Doubt& doubt : q.doubts) doubts.push_back({{"trust", to_text(doubt.trust)}, {"reason", doubt.reason}});
  return {{"expected_s", q.expected_s},
          {"missing_share", q.missing_share},
          {"longest_gap_s", q.longest_gap_s},
          {"freshness_known", q.freshness_known},
          {"gate_trips", q.gate_known ? Json(q.gate_trips) : Json(nullptr)},
          {"clipped_share", q.clipped_share},
          {"margin_min_j", number(q.margin_min_j)},
          {"doubts", doubts}};
}

/// @param main_only  the main metrics of the whole lesson and of the time in which the seat holds the tool
Json seat_json(const SeatScore& seat, bool main_only = false) {
  Json parts = Json::array();
  for (const PartScore& part : seat.parts) {
    if (main_only && part.kind != Part::Kind::kWhole && part.key != "held:" + seat.name) continue;
    Json metrics = Json::object();
    for (const MetricRow& row : metric_rows())
      if (!main_only || std::ranges::find(main_metrics(), row.metric) != main_metrics().end())
        metrics[std::string(row.key)] = metric_json(part, row);
    parts.push_back({{"part", part.key},
                     {"title", part.title},
                     {"quality", quality_json(part.quality)},
                     {"metrics", std::move(metrics)}});
  }
  return {{"seat", seat.name},
          {"person", seat.person},
          {"role", to_text(access_role(seat.role))},
          {"tool", seat.tool.empty() ? Json(nullptr) : Json(seat.tool)},
          {"parts", std::move(parts)}};
}

Json options_json(const ScoreOptions& o) {
  return {{"authority", o.authority},
          {"position_cutoff_hz", o.position_cutoff_hz},
          {"force_cutoff_hz", o.force_cutoff_hz},
          {"spectrum_rate_hz", o.spectrum_rate_hz},
          {"speed_min_m_s", o.speed_min},
          {"force_contact_n", o.force_contact},
          {"force_limit_n", o.force_limit},
          {"segment_min_s", o.segment_min_s},
          {"gap_flagged_s", o.gap_flagged_s},
          {"missing_flagged", o.missing_flagged},
          {"gap_withheld_s", o.gap_withheld_s},
          {"missing_withheld", o.missing_withheld}};
}

Json lesson_json(const LessonScores& lesson) {
  Json seats = Json::array(), interventions = Json::array(), pairs = Json::array();
  for (const SeatScore& seat : lesson.seats) seats.push_back(seat_json(seat));
  for (const NamedIntervention& i : lesson.interventions)
    interventions.push_back({{"seat", i.seat},
                             {"from_seat", i.from_seat},
                             {"tool", i.tool},
                             {"from_s", i.from_s},
                             {"to_s", i.to_s},
                             {"cause", i.cause},
                             {"opposition", number(i.opposition)}});
  for (const NamedPair& p : lesson.pairs)
    pairs.push_back({{"seats", {p.first, p.second}},
                     {"conflict", number(p.score.conflict)},
                     {"both_feel_s", p.score.both_feel_s},
                     {"one_person", p.score.one_person},
                     {"both_move_share", number(p.score.both_move_share)},
                     {"speed_correlation", number(p.score.speed_correlation)}});
  return {{"file", lesson.file},
          {"session", lesson.session},
          {"begin_s", lesson.begin_s},
          {"end_s", lesson.end_s},
          {"rate_hz", lesson.rate_hz},
          {"start_unix_ns", lesson.start_unix_ns == 0 ? Json(nullptr) : Json(lesson.start_unix_ns)},
          {"complete", lesson.complete},
          {"options", options_json(lesson.options)},
          {"seats", std::move(seats)},
          {"interventions", std::move(interventions)},
          {"pairs", std::move(pairs)},
          {"notes", lesson.notes}};
}

Json curves_json(const ScoreResult& result) {
  Json curves = Json::array();
  for (const LearningCurve& curve : result.curves) {
    Json points = Json::array();
    for (const CurvePoint& point : curve.points)
      points.push_back({{"file", point.file},
                        {"value", point.counts ? number(point.value) : Json(nullptr)},
                        {"trust", to_text(point.trust)},
                        {"passed", point.counts ? Json(point.passed) : Json(nullptr)}});
    curves.push_back({{"part", curve.part},
                      {"metric", row_of(curve.metric).key},
                      {"unit", row_of(curve.metric).si_unit},
                      {"experts", curve.threshold.experts},
                      {"median", number(curve.threshold.median)},
                      {"deviation", number(curve.threshold.deviation)},
                      {"pass_mark", number(curve.threshold.pass_mark)},
                      {"sessions", std::move(points)},
                      {"slope", number(curve.slope)},
                      {"cusum",
                       {{"step", curve.sum.step},
                        {"low", -curve.sum.low},
                        {"high", curve.sum.high},
                        {"sums", curve.sum.sums},
                        {"verdict", to_text(curve.sum.verdict)}}}});
  }
  return {{"seat", result.seat},
          {"recordings", result.experts},
          {"cusum",
           {{"acceptable", result.cusum.acceptable},
            {"unacceptable", result.cusum.unacceptable},
            {"alpha", result.cusum.alpha},
            {"beta", result.cusum.beta}}},
          {"curves", std::move(curves)}};
}

Json correlation_json(const Correlation& c) {
  return {{"value", number(c.value)}, {"low", number(c.low)}, {"high", number(c.high)}};
}

Json sheets_json(const ScoreResult& result) {
  Json totals = Json::array(), agreements = Json::array();
  for (const SheetTotal& s : result.sheets)
    totals.push_back({{"file", s.lesson},
                      {"scale", s.scale},
                      {"of", s.of},
                      {"by", s.by},
                      {"total", s.total},
                      {"rated", s.rated},
                      {"items", s.items},
                      {"least", s.least},
                      {"most", s.most},
                      {"closed", s.closed}});
  for (const ScaleAgreement& a : result.agreements) {
    Json one{{"scale", a.scale}, {"evaluators", a.evaluators}, {"targets", a.targets}};
    if (a.totals) {
      one["confidence"] = a.totals->confidence;
      one["icc_2_1"] = correlation_json(a.totals->single);
      one["icc_2_k"] = correlation_json(a.totals->mean);
    }
    if (a.kappa)
      one[a.evaluators.size() == 2 ? "kappa_cohen" : "kappa_fleiss"] = {{"value", a.kappa->kappa},
                                                                        {"agreement", a.kappa->agreement}};
    if (!a.missing.empty()) one["reason"] = a.missing;
    agreements.push_back(std::move(one));
  }
  return {{"totals", std::move(totals)}, {"agreement", std::move(agreements)}};
}

std::string without_commas(std::string text) {
  for (char& c : text)
    if (c == ',' || c == '\n' || c == '\r' || c == '"') c = ';';
  return text;
}

std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace

std::string main_scores_json(const LessonScores& lesson) {
  Json seats = Json::array();
  for (const SeatScore& seat : lesson.seats) seats.push_back(seat_json(seat, true));
  const Json json{{"conditions", conditions_of(lesson.options)}, {"notes", lesson.notes}, {"seats", std::move(seats)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string scores_json(const ScoreResult& result) {
  Json lessons = Json::array();
  for (const LessonScores& lesson : result.lessons) lessons.push_back(lesson_json(lesson));
  Json out{{"lessons", std::move(lessons)}};
  if (result.experts > 0) out["experts"] = curves_json(result);
  out["sheets"] = sheets_json(result);
  out["notes"] = result.notes;
  // Names in recordings may be any bytes.
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string scores_csv(const ScoreResult& result) {
  std::string out = "file,seat,role,part,metric,unit,value,trust,reason\n";
  for (const LessonScores& lesson : result.lessons)
    for (const SeatScore& seat : lesson.seats)
      for (const PartScore& part : seat.parts)
        for (const MetricRow& row : metric_rows()) {
          const double value = of(part.values, row.metric);
          const MetricTrust trust = trust_in(part.quality, row.metric, value);
          const bool shown = trust.trust == Trust::kGood || trust.trust == Trust::kFlagged;
          out += without_commas(lesson.file) + "," + without_commas(seat.name) + "," +
                 std::string(to_text(access_role(seat.role))) + "," + without_commas(part.key) + "," +
                 std::string(row.key) + "," + std::string(row.si_unit) + "," + (shown ? shortest(value) : "") + "," +
                 std::string(to_text(trust.trust)) + "," + without_commas(trust.reason) + "\n";
        }
  return out;
}

}  // namespace tandem::netsim::score
