#include "hal/backends/device_spec_parser.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hal/io/open_sim_device.h"

namespace tandem::hal {
namespace {

auto lines_of(const Result<>& verdict) {
  const std::string text = verdict ? std::string() : verdict.error().message;
  return text.empty() ? 0 : 1 + std::ranges::count(text, '\n');
}

TEST(DeviceSpec, ReadsNameAndOptions) {
  const auto choice = parse_device_spec("mouse:event5,plane=table,grab=yes");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->backend, "mouse");
  EXPECT_EQ(choice->name, "event5");
  EXPECT_EQ(choice->find("plane"), "table");
  EXPECT_TRUE(choice->errors.empty());
  EXPECT_FALSE(parse_device_spec(":event5"));
}

TEST(DeviceSpec, ReportsAllMistakesWithKeyValueAndAllowedRange) {
  const auto choice =
      parse_device_spec("mouse:event5,plain=table,plane=up,,grab=maybe,mm_per_count=nan,loose,grab=yes,port=");
  ASSERT_TRUE(choice) << "the words are judged together with what the backend knows";
  OptionParser judge{*choice, {"mm_per_count", "plane", "grab", "port"}};
  EXPECT_EQ(judge.one_of("plane", {"vertical", "table"}), "vertical");
  EXPECT_FALSE(judge.yes_or_no("grab", false));
  EXPECT_FALSE(judge.number("mm_per_count", 0.001, 5, "mm"));
  const auto verdict = judge.result();
  ASSERT_FALSE(verdict);
  EXPECT_EQ(verdict.error().code, Errc::kUnsupported);
  for (const char* part :
       {"has no option 'plain' (= 'table'); did you mean plane?", "plane = 'up': must be 'vertical' or 'table'",
        "grab = 'maybe': must be 'yes' or 'no'", "mm_per_count = 'nan': must be a number in [0.001, 5] mm",
        "'loose' has no value", "grab = 'yes': grab is given twice", "option port needs a value",
        "a name or KEY=VALUE is missing"})
    EXPECT_NE(verdict.error().message.find(part), std::string::npos) << part << "\n" << verdict.error().message;
  EXPECT_EQ(lines_of(verdict), 8);
}

TEST(DeviceSpec, RejectsATrailingComma) {
  const auto choice = parse_device_spec("mouse:event5,");
  ASSERT_TRUE(choice);
  EXPECT_EQ(lines_of(OptionParser(*choice, {}).result()), 1);
}

TEST(DeviceSpec, ReportsNothingForAValidSpec) {
  const auto choice = parse_device_spec("mouse:event5,mm_per_count=5,grab=no");
  OptionParser judge{*choice, {"mm_per_count", "grab"}};
  EXPECT_EQ(judge.number("mm_per_count", 0.001, 5, "mm"), 5.0);
  EXPECT_FALSE(judge.yes_or_no("grab", true));
  EXPECT_TRUE(judge.valid() && judge.result());
}

TEST(DeviceSpec, ReportsAllMistakesOfSimulatedDevices) {
  const auto opened = open_sim_device("sim:hnad=leader,model=tuch,rec=1", SimDeviceSpec{}, HandSpec{});
  ASSERT_FALSE(opened);
  for (const char* part : {"did you mean hand?", "did you mean touch?", "motion=FILE.mcap must come before"})
    EXPECT_NE(opened.error().message.find(part), std::string::npos) << part << "\n" << opened.error().message;
}

}  // namespace
}  // namespace tandem::hal
