#include "common/base/axes.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace tandem {
namespace {

TEST(Axes, AreVisitedOnceEachInAscendingOrder) {
  for (std::size_t axes = 0; axes <= kAxesMax; ++axes) {
    std::vector<std::size_t> visited, all(axes);
    each_axis(axes, [&](std::size_t a) { visited.push_back(a); });
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(visited, all) << axes << " axes";
  }
}

}  // namespace
}  // namespace tandem
