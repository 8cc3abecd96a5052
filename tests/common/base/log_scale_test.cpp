#include "common/base/log_scale.h"

#include <gtest/gtest.h>

#include "common/base/single_writer_counter.h"

namespace tandem {
namespace {

TEST(LogScale, IsExactBelow64ThenHas32BinsPerOctave) {
  for (std::uint64_t value = 0; value < 64; ++value) {
    EXPECT_EQ(LogScale::bin_of(value), value);
    EXPECT_EQ(LogScale::last_of(value), static_cast<std::int64_t>(value));
  }
  EXPECT_EQ(LogScale::bin_of(64), 64U);
  EXPECT_EQ(LogScale::bin_of(65), 64U) << "two values per bin from 64 to 127";
  EXPECT_EQ(LogScale::last_of(64), 65);
  EXPECT_EQ(LogScale::bin_of(127), 95U);
  EXPECT_EQ(LogScale::bin_of(128), 96U);
  EXPECT_EQ(LogScale::last_of(96), 131) << "four values per bin from 128 to 255";
}

TEST(LogScale, AscendsWithoutGapsAndCoversAllTimes) {
  for (std::size_t bin = 1; bin < LogScale::kBins; ++bin) {
    const auto first = static_cast<std::uint64_t>(LogScale::last_of(bin - 1)) + 1;
    EXPECT_EQ(LogScale::bin_of(first), bin);
    EXPECT_EQ(LogScale::bin_of(static_cast<std::uint64_t>(LogScale::last_of(bin))), bin);
    if (LogScale::last_of(bin) == std::numeric_limits<std::int64_t>::max()) return;
  }
  FAIL() << "no bin ends at the largest time";
}

TEST(SingleWriterCounter, AddsAndResets) {
  SingleWriterCounter<std::uint64_t> counter;
  counter.add(3);
  counter.add(4);
  EXPECT_EQ(counter.get(), 7U);
  counter.reset();
  EXPECT_EQ(counter.get(), 0U);
}

}  // namespace
}  // namespace tandem
