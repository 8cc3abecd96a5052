#include "hal/core/report_descriptor.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace tandem::hal {
namespace {

std::vector<std::byte> items(std::initializer_list<int> values) {
  std::vector<std::byte> out;
  for (const int v : values) out.push_back(static_cast<std::byte>(v));
  return out;
}

TEST(ReportDescriptor, FindsReportIdsOnlyAtItems) {
  EXPECT_TRUE(has_report_ids(items({0x05, 0x01, 0x09, 0x08, 0xA1, 0x01, 0x85, 0x01, 0xC0})));
  EXPECT_FALSE(has_report_ids(items({0x05, 0x01, 0x09, 0x08, 0xA1, 0x01, 0x75, 0x08, 0xC0})));
  EXPECT_FALSE(has_report_ids(items({0x06, 0x85, 0x01, 0x27, 0x85, 0x85, 0x85, 0x85, 0xC0})))
      << "0x85 as data of other items";
  EXPECT_FALSE(has_report_ids(items({0xFE, 0x02, 0x10, 0x85, 0x85, 0xC0}))) << "inside a long item";
  EXPECT_TRUE(has_report_ids(items({0xFE, 0x02, 0x10, 0x00, 0x00, 0x85, 0x07})));
}

TEST(ReportDescriptor, ParsesAnyBytesToTheirEnd) {
  EXPECT_FALSE(has_report_ids({}));
  EXPECT_FALSE(has_report_ids(items({0xFE})));
  EXPECT_FALSE(has_report_ids(items({0x27})));
  for (int value = 0; value < 256; ++value) {
    for (std::size_t size = 1; size < 9; ++size) {
      const std::vector<std::byte> same(size, static_cast<std::byte>(value));
      EXPECT_EQ(has_report_ids(same), (value & 0xFC) == 0x84);
    }
  }
}

}  // namespace
}  // namespace tandem::hal
