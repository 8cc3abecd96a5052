// Validation of --device specifications and the files they name, without any device.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "hal/backends/backend.h"
#include "hal/drivers/spacemouse/products.h"
#include "hal/io/evdev_mouse.h"
#include "hal/io/udev_rule.h"

namespace tandem::hal {
namespace {

struct BackendsTest : testing::Test {
  BackendsTest() {
    folder = std::filesystem::temp_directory_path() /
             ("tandem_backends_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
              std::to_string(getpid()));
    std::filesystem::create_directories(folder);
  }
  ~BackendsTest() override { std::filesystem::remove_all(folder); }
  std::string write(const std::string& name, std::string_view content) const {
    std::ofstream(folder / name, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
    return (folder / name).string();
  }
  /// Returns all errors of a specification, independent of attached devices; empty: none.
  static std::string mistakes(const std::string& words) {
    const auto choice = parse_device_spec(words);
    if (!choice) return choice.error().message;
    const auto backend = find_backend(choice->backend);
    if (!backend) return backend.error().message;
    const auto checked = (*backend)->check(*choice);
    return checked ? std::string() : checked.error().message;
  }
  static long lines(const std::string& text) { return text.empty() ? 0 : 1 + std::ranges::count(text, '\n'); }
  std::filesystem::path folder;
};

TEST_F(BackendsTest, ReportsMistakesOfOptionsAndFilesTogether) {
  const std::string bad = write("bad.textproto", "falcon {\n  peak_n: 99\n  peek_n: 3\n}\n");
  const std::string told = mistakes("falcon:prot=1-2,calibration=" + bad + ",firmware=" + write("f.bin", "abc"));
  for (const char* part : {"has no option 'prot'", ":2:", "peak_n = 99", ":3:", "peek_n", "7000 to 9000"})
    EXPECT_NE(told.find(part), std::string::npos) << part << "\n" << told;
  EXPECT_EQ(lines(told), 4) << told;
}

TEST_F(BackendsTest, ReportsAllMistakesForEveryKind) {
  for (const auto& [words, count] : {std::pair{"woodenhaptics:preset=no-such,enable_motors=perhaps,home=there", 3},
                                     {"woodenhaptics:enable_motors=1", 2},
                                     {"spacemouse:calibration=/no/such,speed=3", 2},
                                     {"mouse:mm_per_count=9,plane=up,grab=1", 3},
                                     {"replay:/no/such.csv,end=stop,loop=yes,scale=0", 4},
                                     {"openhaptics:left,libary=x,lib", 2},
                                     {"falcon:thing", 1}}) {
    SCOPED_TRACE(words);
    const std::string told = mistakes(words);
    EXPECT_EQ(lines(told), count) << told;
  }
  for (const char* fine :
       {"falcon", "falcon:port=1-2", "woodenhaptics:preset=aluhaptics-v2,enable_motors=yes,home=here",
        "spacemouse:serial=7", "mouse", "openhaptics:left"})
    EXPECT_EQ(mistakes(fine), "") << fine;
}

TEST_F(BackendsTest, RejectsBinaryInputInOneLine) {
  for (const std::string& file :
       {write("program", std::string("\x7f"
                                     "ELF\0\0\1",
                                     7) +
                             std::string(50'000, '\x03')),
        std::string("/dev/zero"), write("huge", std::string(10'000'000, 'x')), folder.string()}) {
    SCOPED_TRACE(file);
    for (const std::string& words :
         {"falcon:calibration=" + file, "spacemouse:calibration=" + file, "woodenhaptics:preset=" + file}) {
      const std::string told = mistakes(words);
      EXPECT_EQ(lines(told), 1) << told.substr(0, 500);
      EXPECT_NE(told.find(file), std::string::npos) << told.substr(0, 500);
    }
  }
  const std::string firmware = mistakes("falcon:firmware=/dev/zero");
  EXPECT_NE(firmware.find("/dev/zero: has more than 9000 bytes"), std::string::npos) << firmware;
  const std::string endless = mistakes("replay:/dev/zero");
  EXPECT_EQ(lines(endless), 1) << endless.substr(0, 500);
  EXPECT_NE(endless.find("is not text"), std::string::npos) << endless;
}

TEST_F(BackendsTest, NamesTheLineOfContradictoryReadings) {
  const std::string reading =
      "mass_reading { mass_kg: 0.1 up_z: 1 encoder { leg_1: 4000 leg_2: 0 leg_3: 0 } motor_without { leg_1: 0 leg_2: 0 "
      "leg_3: 0 } "
      "motor_with { leg_1: 0 leg_2: 0 leg_3: 0 } }\n";
  const std::string nowhere = write("a.textproto", "falcon {\n measured: \"me\"\n" + reading + reading + "}");
  EXPECT_NE(mistakes("falcon:calibration=" + nowhere).find(nowhere + ":3: falcon: mass_reading 1"), std::string::npos)
      << mistakes("falcon:calibration=" + nowhere);
  const std::string other = write("b.textproto", "# a SpaceMouse\nspacemouse { speed_m_s: 0.1 }");
  EXPECT_NE(mistakes("falcon:calibration=" + other).find(other + ":1: does not describe a falcon"), std::string::npos);
}

TEST_F(BackendsTest, RejectsAReplayOutsideTheWorkspaceWithItsPlace) {
  const std::string wide = write("wide.csv", "t_s[s],px[m],py[m],pz[m]\n0,0,0,0\n1,0,0.05,0\n2,0,0.3,0\n3,0,0,0\n");
  // The middle of y is 0.15. The rows are at -0.15, -0.1 and +0.15; the first of them is already outside.
  const std::string told = mistakes("replay:" + wide + ",scale=1");
  EXPECT_NE(told.find(wide + ":2: y of the device = -0.15 m at scale 1: must be in [-0.1, 0.1] m"), std::string::npos)
      << told;
  EXPECT_EQ(mistakes("replay:" + wide), "") << "auto shrinks it to 60 mm";
  EXPECT_NE(mistakes("replay:" + wide + ",scale=1,axes=+y+x+z").find("x of the device = -0.15"), std::string::npos);
  const std::string fast = write("fast.csv", "t_s[s],px[m],py[m],pz[m]\n0,0,0,0\n1,0.01,0,0\n1.01,0.05,0,0\n");
  EXPECT_NE(mistakes("replay:" + fast + ",scale=1").find(fast + ":4: speed from the row before = 4 m/s"),
            std::string::npos)
      << mistakes("replay:" + fast + ",scale=1");
}

TEST_F(BackendsTest, NamesTheRemedyForAMouseWithoutPermission) {
  const std::string known = EvdevMouse::permission_advice("/dev/input/event5", EvdevMouse::Ids{0x046d, 0xc077});
  for (const char* part : {"/dev/input/event5", "ATTRS{id/vendor}==\"046d\", ATTRS{id/product}==\"c077\"",
                           "group 'input'", "sim:keyboard"})
    EXPECT_NE(known.find(part), std::string::npos) << part << "\n" << known;
  const std::string unknown = EvdevMouse::permission_advice("/dev/input/event5", std::nullopt);
  EXPECT_EQ(unknown.find("ATTRS"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("Join the group 'input'"), std::string::npos) << unknown;
}

TEST(UdevRules, MatchEverySpaceMouseAndNoKeyboardOfTheVendor) {
  const auto rules = (*find_backend("spacemouse"))->udev_rules();
  const auto has = [&](const std::string& words) {
    return std::ranges::any_of(rules, [&](const std::string& r) { return r.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(has("KERNELS==\"*:046D:C626.*\"")) << "SpaceNavigator";
  EXPECT_TRUE(has("KERNELS==\"*:256F:*\", MODE=\"0660\", TAG+=\"uaccess\"")) << "newer than the list";
  for (const std::uint16_t product : spacemouse::kExcluded) {
    const std::string no = udev_no_rule({spacemouse::k3Dconnexion, product});
    const auto at = std::ranges::find(rules, no);
    ASSERT_NE(at, rules.end()) << no;
    EXPECT_GT(at, std::ranges::find(rules, udev_vendor_rule(spacemouse::k3Dconnexion))) << "the later rule wins";
    EXPECT_NE(no.find("TAG-=\"uaccess\""), std::string::npos);
  }
  for (Backend* backend : backends())
    for (const std::string& rule : backend->udev_rules())
      EXPECT_EQ(rule.find("KERNELS==\"*:046D:*\""), std::string::npos) << "all mice of Logitech";
}

TEST(UdevRules, MatchTheTouchAsSerialPortAndAsHidDevice) {
  const auto rules = (*find_backend("openhaptics"))->udev_rules();
  ASSERT_EQ(rules.size(), 2u);
  EXPECT_TRUE(rules[0].starts_with("SUBSYSTEM==\"tty\", ATTRS{idVendor}==\"0301\", ATTRS{idProduct}==\"2988\""))
      << rules[0];
  EXPECT_EQ(rules[1], "SUBSYSTEM==\"hidraw\", KERNELS==\"*:2988:*\", MODE=\"0660\", TAG+=\"uaccess\"");
  for (const std::string& rule : rules)
    EXPECT_TRUE(rule.ends_with("MODE=\"0660\", TAG+=\"uaccess\"")) << "only the logged-in user";
}

TEST(Backends, NameTheirLibraryAndTheFactsOfEveryDevice) {
  for (Backend* backend : backends()) {
    SCOPED_TRACE(backend->name());
    EXPECT_FALSE(backend->library().empty());
    if (backend->name() == "replay") continue;
    for (const char* about : {"firmware", "rate", "calibration", "homing", "gravity"})
      EXPECT_TRUE(std::ranges::any_of(backend->facts(), [&](const DeviceFact& f) {
        return f.topic == about && !f.text.empty();
      })) << about;
  }
  EXPECT_TRUE((*find_backend("falcon"))->library().starts_with("libusb 1.")) << (*find_backend("falcon"))->library();
  EXPECT_TRUE((*find_backend("woodenhaptics"))->library().starts_with("hidapi 0."))
      << (*find_backend("woodenhaptics"))->library();
}

}  // namespace
}  // namespace tandem::hal
