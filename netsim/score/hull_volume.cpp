#include "netsim/score/hull_volume.h"

#include <libqhull_r/qhull_ra.h>

#include <array>
#include <cstdio>
#include <memory>
#include <vector>

#include "netsim/score/triple.h"

namespace tandem::netsim::score {
namespace {

constexpr std::size_t kHullPointsMin = 4;

struct SinkClosing {
  void operator()(std::FILE* sink) const noexcept { std::fclose(sink); }
};

}  // namespace

double hull_volume(std::span<const LessonTriple> points) {
  std::vector<double> numbers;
  numbers.reserve(3 * points.size());
  for (const LessonTriple& p : points)
    if (known(p)) numbers.insert(numbers.end(), p.begin(), p.end());
  if (numbers.size() < 3 * kHullPointsMin) return 0;
  // The library explains flat input at length; no reader needs that text.
  std::array<char, 256> text{};
  const std::unique_ptr<std::FILE, SinkClosing> sink{::fmemopen(text.data(), text.size(), "w")};
  if (sink == nullptr) return kUnknown;
  qhT hull;
  qh_zero(&hull, sink.get());
  char options[] = "qhull Qt Pp";
  const int failed = qh_new_qhull(&hull, 3, static_cast<int>(numbers.size() / 3), numbers.data(), False, options,
                                  sink.get(), sink.get());
  double volume = 0;  // of flat input
  if (failed == 0) {
    qh_getarea(&hull, hull.facet_list);
    volume = hull.totvol;
  }
  int blocks = 0, bytes = 0;
  qh_freeqhull(&hull, !qh_ALL);
  qh_memfreeshort(&hull, &blocks, &bytes);
  return volume;
}

}  // namespace tandem::netsim::score
