#include "client/app/device_list.h"

#include <gtest/gtest.h>

#include "client/app/hardware_device.h"

namespace tandem::client {
namespace {

hal::Backend& backend(std::string_view name) { return **hal::find_backend(name); }

TEST(DeviceList, NamesEveryFactOfADevice) {
  for (const char* kind : {"falcon", "woodenhaptics", "spacemouse", "openhaptics", "mouse"}) {
    SCOPED_TRACE(kind);
    const std::string text =
        describe(backend(kind),
                 {.spec = std::string(kind) + ":port=1-2", .description = "it", .problem = "", .node = "/dev/it"});
    for (const char* about :
         {"library", "permission    you may open /dev/it", "firmware", "rate", "calibration", "homing", "gravity"})
      EXPECT_NE(text.find(about), std::string::npos) << about << "\n" << text;
    EXPECT_TRUE(text.starts_with(std::string("it\n            --device ") + kind + ":port=1-2\n")) << text;
  }
  EXPECT_NE(describe(backend("spacemouse"), {}).find("battery"), std::string::npos);
}

TEST(DeviceList, ReportsTheProblemOfADevice) {
  const std::string text =
      describe(backend("falcon"),
               {.spec = "falcon", .description = "it", .problem = "permission denied: do this", .node = "/dev/it"});
  EXPECT_NE(text.find("permission denied: do this\n"), std::string::npos) << text;
  EXPECT_NE(text.find("none for /dev/it"), std::string::npos) << text;
}

TEST(HardwareDevice, ReportsEachMistakeOnItsOwnLine) {
  const auto wrong = HardwareDevice::spec_errors("mouse:plane=up,grab=1,loose");
  ASSERT_EQ(wrong.size(), 3u);
  EXPECT_EQ(wrong[1], "--device: mouse: plane = 'up': must be 'vertical' or 'table'");
  EXPECT_EQ(HardwareDevice::spec_errors("falcom").size(), 1u);
  EXPECT_TRUE(HardwareDevice::spec_errors("mouse").empty());
}

TEST(DeviceList, MarksEachFindingByItsKind) {
  using Kind = DeviceDiagnostics::Finding::Kind;
  EXPECT_EQ(finding_line({Kind::kGood, "homed"}), "  ok      homed\n");
  EXPECT_EQ(finding_line({Kind::kNotice, "battery 5 %"}), "  notice  battery 5 %\n");
  EXPECT_EQ(finding_line({Kind::kTrouble, "silent"}), "  TROUBLE silent\n");
}

}  // namespace
}  // namespace tandem::client
