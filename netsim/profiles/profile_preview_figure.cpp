#include "netsim/profiles/profile_preview_figure.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"
#include "netsim/quality/quality_text.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kOutageFrom = 5;  ///< consecutive lost datagrams: 5 ms
constexpr std::size_t kCurvePoints = 400;

/// Returns the time spans [s] of at least `least` consecutive lost datagrams.
std::vector<plot::Band> lost_spans(const ProfilePreviewDirection& way, std::size_t least) {
  std::vector<plot::Band> spans;
  for (std::size_t i = 0; i < way.shown.size(); ++i) {
    if (way.shown[i] != ProfilePreviewDirection::kLost) continue;
    std::size_t end = i;
    while (end < way.shown.size() && way.shown[end] == ProfilePreviewDirection::kLost) ++end;
    if (end - i >= least) spans.push_back({static_cast<double>(i) * 1e-3, static_cast<double>(end) * 1e-3, ""});
    i = end;
  }
  return spans;
}

plot::Panel over_time(const ProfilePreview& portrait, Direction direction, const std::string& title) {
  const auto d = static_cast<std::size_t>(direction);
  const ProfilePreviewDirection& way = portrait.ways[d];
  plot::Panel panel{.title = title + ", " + name(direction) + ": delay, and what was lost",
                    .x_label = "time [s]",
                    .y_label = "delay [ms]",
                    .bands = lost_spans(way, kOutageFrom),
                    .rug = lost_spans(way, 1),
                    .x = plot::Range{0, seconds(portrait.shown)},
                    .y_span_min = 1,
                    .height = 190};
  plot::Curve curve{"", d == 0 ? "up" : "down", {}, false};
  for (std::size_t i = 0; i < way.shown.size(); ++i) {
    if (way.shown[i] == ProfilePreviewDirection::kLost) continue;
    curve.points.push_back({static_cast<double>(i) * 1e-3, way.shown[i] * 1e-3});
  }
  panel.curves.push_back(std::move(curve));
  return panel;
}

/// Returns the number of nines of a share: 0 is the minimum, 1 is 90 %, 2 is 99 %, ...
double nines(double share) { return -std::log10(std::max(1 - share, 1e-12)); }

plot::Panel distribution(const ProfilePreview& portrait, const std::vector<ExpectedQuantile>& promised) {
  plot::Panel panel{.title = format("distribution over %.0f minutes", seconds(portrait.length) / 60),
                    .x_label = "share that is faster: 0 none, 1 is 90 %, 2 is 99 %, 3 is 99.9 %, ...",
                    .y_label = "delay [ms]",
                    .y_span_min = 1,
                    .height = 220};
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    const auto d = static_cast<std::size_t>(direction);
    const ProfilePreviewDirection& way = portrait.ways[d];
    plot::Curve curve{name(direction), d == 0 ? "up" : "down", {}, false};
    const double last = nines(1 - 1.0 / std::max<double>(1, static_cast<double>(way.delays.size())));
    for (std::size_t i = 0; i <= kCurvePoints && !way.delays.empty(); ++i) {
      const double x = last * static_cast<double>(i) / kCurvePoints;
      curve.points.push_back({x, seconds(way.quantile(1 - std::pow(10, -x))) * 1e3});
    }
    panel.curves.push_back(std::move(curve));
  }
  for (const ExpectedQuantile& p : promised) {
    if (p.share < 0.5) continue;  // at the left edge
    const auto twin = [&p](const ExpectedQuantile& other) {
      return other.direction != p.direction && other.share == p.share && other.delay_ms == p.delay_ms;
    };
    const bool both = std::ranges::any_of(promised, twin);
    if (both && p.direction == Direction::kDown) continue;
    const std::string label = format("promised p%.0f", p.share * 100);
    panel.notes.push_back({{nines(p.share), p.delay_ms}, both ? label : label + ", " + name(p.direction)});
  }
  return panel;
}

}  // namespace

plot::Figure profile_preview_figure(const ProfilePreview& portrait, const std::string& title,
                                    const std::vector<ExpectedQuantile>& promised) {
  return {title,
          1,
          {over_time(portrait, Direction::kUp, title), over_time(portrait, Direction::kDown, title),
           distribution(portrait, promised)}};
}

}  // namespace tandem::netsim
