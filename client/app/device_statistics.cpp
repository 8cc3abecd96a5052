#include "client/app/device_statistics.h"

#include <nlohmann/json.hpp>

#include "common/base/format.h"

namespace tandem::client {
namespace {

using Json = nlohmann::ordered_json;

double ms(std::int64_t ns) { return 1e-6 * static_cast<double>(ns); }
unsigned long long n(std::uint64_t v) { return v; }

Json durations(const Histogram& of) {
  if (of.count() == 0) return nullptr;
  Json buckets = Json::array();
  of.each_bucket([&](std::int64_t first, std::int64_t last, std::uint64_t count) {
    // `to` is the beginning of the next bucket, except for the last bucket.
    buckets.push_back({{"from", ms(first)}, {"to", 1e-6 * (static_cast<double>(last) + 1)}, {"count", count}});
  });
  return {{"count", of.count()},
          {"p50", ms(of.quantile(0.50))},
          {"p99", ms(of.quantile(0.99))},
          {"max", ms(of.max())},
          {"buckets", std::move(buckets)}};
}

/// Returns the quantiles as one line; the JSON contains all buckets.
std::string line_of(const char* name, const Histogram& of) {
  if (of.count() == 0) return {};
  return format("%s p50 %.3f, p99 %.3f, max %.3f ms", name, ms(of.quantile(0.50)), ms(of.quantile(0.99)), ms(of.max()));
}

}  // namespace

Json to_json(const hal::DeviceStats& stats, const hal::DeviceHistograms& histograms) {
  return {{"exchanges", stats.ticks},
          {"late", stats.late},
          {"missed_periods", stats.missed},
          {"unanswered", stats.unanswered},
          {"resyncs", stats.resyncs},
          {"expired_commands", stats.expired},
          {"rejected_commands", stats.rejected},
          {"clamped_commands", stats.clamped},
          {"period_ms", durations(histograms.period)},
          {"round_trip_ms", durations(histograms.round_trip)}};
}

std::vector<std::string> summary(const hal::DeviceStats& stats, const hal::DeviceHistograms& histograms) {
  std::vector<std::string> lines;
  lines.push_back(
      format("device: %llu exchanges, %llu late by more than 1 ms, %llu periods missed, %llu unanswered, %llu resyncs",
             n(stats.ticks), n(stats.late), n(stats.missed), n(stats.unanswered), n(stats.resyncs)));
  for (std::string line : {line_of("period:", histograms.period), line_of("round trip:", histograms.round_trip)})
    if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace tandem::client
