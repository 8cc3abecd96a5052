#include "common/base/enumerator_count.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace tandem {
namespace {

enum class Colour : std::uint8_t { kRed, kGreen, kBlue };
enum class None : std::uint8_t {};
enum class Gap : std::uint8_t { kFirst, kThird = 2 };

TEST(EnumeratorCount, CountsEnumeratorsFromZero) {
  EXPECT_EQ(enumerator_count<Colour>(), 3U);
  EXPECT_EQ(enumerator_count<None>(), 0U);
  EXPECT_EQ(enumerator_count<Gap>(), 1U) << "up to the first value without an enumerator";
}

TEST(EnumeratorCount, TellsEnumeratorsFromOtherValues) {
  EXPECT_TRUE(is_enumerator<Colour::kBlue>());
  EXPECT_FALSE(is_enumerator<static_cast<Colour>(3)>());
  EXPECT_TRUE(is_enumerator<Gap::kThird>());
}

}  // namespace
}  // namespace tandem
