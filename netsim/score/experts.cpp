#include "netsim/score/experts.h"

#include <algorithm>
#include <cmath>

namespace tandem::netsim::score {
namespace {

constexpr double kNormal = 1.4826;  // standard deviation of a normal distribution over its median absolute deviation
constexpr double kDeviationMin = 0.01;  // of the median: experts who differ by less set no finer mark

/// A value that may be used, or NaN.
double usable_value(const PartScore& part, Metric metric) {
  const double value = of(part.values, metric);
  return trust_in(part.quality, metric, value).trust == Trust::kWithheld ? kUnknown : value;
}

Threshold threshold_from(std::vector<double> values, const MetricRow& row) {
  Threshold out;
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  out.experts = values.size();
  if (values.size() < kExpertsMin || !judges_person(row)) return out;
  out.median = median_of(values);
  for (double& v : values) v = std::abs(v - out.median);
  out.deviation = std::max(median_of(values), kDeviationMin * std::abs(out.median));
  out.pass_mark = out.median + (row.better == Better::kLow ? 1 : -1) * kNormal * out.deviation;
  return out;
}

double theil_sen(const std::vector<CurvePoint>& points) {
  std::vector<double> slopes;
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + 1; b < points.size(); ++b)
      if (points[a].counts && points[b].counts)
        slopes.push_back((points[b].value - points[a].value) / static_cast<double>(b - a));
  return median_of(std::move(slopes));
}

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) return kUnknown;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

std::vector<PartThresholds> thresholds_of(std::span<const LessonScores> experts, const std::string& seat) {
  std::vector<PartThresholds> out;
  for (const LessonScores& lesson : experts)
    if (const SeatScore* score = lesson.seat(seat))
      for (const PartScore& part : score->parts)
        if (std::ranges::find(out, part.key, &PartThresholds::key) == out.end()) out.push_back({part.key, {}});
  for (PartThresholds& thresholds : out)
    for (const MetricRow& row : metric_rows()) {
      std::vector<double> values;
      for (const LessonScores& lesson : experts)
        if (const SeatScore* score = lesson.seat(seat))
          if (const PartScore* part = score->part(thresholds.key)) values.push_back(usable_value(*part, row.metric));
      thresholds.metrics[static_cast<std::size_t>(row.metric)] = threshold_from(std::move(values), row);
    }
  return out;
}

const Threshold* threshold_of(const std::vector<PartThresholds>& all, std::string_view part, Metric metric) noexcept {
  const auto found = std::ranges::find(all, part, &PartThresholds::key);
  if (found == all.end()) return nullptr;
  const Threshold& threshold = found->metrics[static_cast<std::size_t>(metric)];
  return threshold.exists() ? &threshold : nullptr;
}

bool passes(const Threshold& threshold, Metric metric, double value) noexcept {
  return row_of(metric).better == Better::kLow ? value <= threshold.pass_mark : value >= threshold.pass_mark;
}

Cusum cusum(const std::vector<bool>& passed, const CusumOptions& o) {
  const double p = std::log(o.unacceptable / o.acceptable), q = std::log((1 - o.acceptable) / (1 - o.unacceptable));
  Cusum out;
  out.step = q / (p + q);
  out.low = std::log((1 - o.alpha) / o.beta) / (p + q);
  out.high = std::log((1 - o.beta) / o.alpha) / (p + q);
  double sum = 0;
  for (const bool good : passed) {
    sum += good ? -out.step : 1 - out.step;
    out.sums.push_back(sum);
    if (sum <= -out.low) out.verdict = Cusum::Verdict::kCompetent;
    if (sum >= out.high) out.verdict = Cusum::Verdict::kDeficient;
  }
  return out;
}

std::vector<LearningCurve> learning_curves(std::span<const LessonScores> sessions, const std::string& seat,
                                           const std::vector<PartThresholds>& thresholds, const CusumOptions& options) {
  std::vector<LearningCurve> out;
  for (const PartThresholds& part : thresholds)
    for (const MetricRow& row : metric_rows()) {
      const Threshold& threshold = part.metrics[static_cast<std::size_t>(row.metric)];
      if (!threshold.exists()) continue;
      LearningCurve curve{part.key, row.metric, threshold, {}, kUnknown, {}};
      std::vector<bool> passed;
      for (const LessonScores& session : sessions) {
        CurvePoint point;
        point.file = session.file;
        const SeatScore* const score = session.seat(seat);
        if (const PartScore* const found = score == nullptr ? nullptr : score->part(part.key)) {
          point.value = of(found->values, row.metric);
          point.trust = trust_in(found->quality, row.metric, point.value).trust;
          point.counts = point.trust == Trust::kGood || point.trust == Trust::kFlagged;
          point.passed = point.counts && passes(threshold, row.metric, point.value);
        }
        if (point.counts) passed.push_back(point.passed);
        curve.points.push_back(std::move(point));
      }
      curve.slope = theil_sen(curve.points);
      curve.sum = cusum(passed, options);
      out.push_back(std::move(curve));
    }
  return out;
}

}  // namespace tandem::netsim::score
