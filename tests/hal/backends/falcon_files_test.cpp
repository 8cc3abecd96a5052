#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hal/backends/device_files.h"
#include "hal/backends/falcon_backend.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"

namespace tandem::hal {
namespace {

struct FalconFilesTest : testing::Test {
  FalconFilesTest() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::path(testing::TempDir()) / ("tandem_falcon_" + std::string(info->name()));
    std::filesystem::create_directories(folder);
  }
  ~FalconFilesTest() override { std::filesystem::remove_all(folder); }
  std::string write(const std::string& name, std::string_view content) const {
    const auto path = folder / name;
    std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
    return path.string();
  }
  static std::string open_error(const std::string& words) {
    FalconBackend backend;
    const auto opened = backend.open(*parse_device_spec(words));
    return opened ? std::string() : opened.error().message;
  }
  static std::string image() {
    std::string bytes;
    for (const std::byte b : falcon::some_firmware().image) bytes += static_cast<char>(b);
    return bytes;
  }
  std::filesystem::path folder;
};

TEST_F(FalconFilesTest, LoadsFirmwareWithItsHash) {
  // SHA-256 of "abc" is a published test vector (FIPS 180-2).
  const auto abc = load_firmware(write("abc.bin", "abc"));
  ASSERT_TRUE(abc);
  EXPECT_EQ(abc->sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const auto whole = load_firmware(write("falcon.bin", image()));
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->image, falcon::some_firmware().image);
  EXPECT_TRUE(check_firmware(*whole, whole->sha256));
  const auto huge = load_firmware(write("huge.bin", std::string(1 << 20, 'x')));
  ASSERT_TRUE(huge);
  EXPECT_EQ(huge->image.size(), kFirmwareMax + 1) << "no more is read than needed to refuse it";
  EXPECT_NE(load_firmware((folder / "none.bin").string()).error().message.find("No such file"), std::string::npos);
  EXPECT_NE(load_firmware(folder.string()).error().message.find("irectory"), std::string::npos);
}

TEST_F(FalconFilesTest, ReportsMistakesInFilesWithoutADevice) {
  EXPECT_NE(open_error("falcon:firmwear=x").find("firmware"), std::string::npos);
  const std::string bad = write("bad.textproto", "falcon {\n  peak_n: 99\n}\n");
  const std::string told = open_error("falcon:calibration=" + bad);
  EXPECT_NE(told.find(bad + ":2:"), std::string::npos) << told;
  EXPECT_NE(told.find("20"), std::string::npos) << told;
  const std::string reading =
      "mass_reading { mass_kg: 0.1 up_z: 1 encoder { leg_1: 0 leg_2: 0 leg_3: 0 } motor_without { leg_1: 0 leg_2: 0 "
      "leg_3: 0 } "
      "motor_with { leg_1: 0 leg_2: 0 leg_3: 0 } }\n";
  const std::string empty = write("zero.textproto", "falcon { measured: \"me\"\n" + reading + reading + "}");
  EXPECT_NE(open_error("falcon:calibration=" + empty).find("counts per N m"), std::string::npos);
  const std::string small = write("small.bin", "abc");
  EXPECT_NE(open_error("falcon:firmware=" + small).find("7000 to 9000"), std::string::npos);
  const std::string wrong_hash =
      write("hash.textproto", "falcon { firmware { sha256: \"" + std::string(64, '0') + "\" } }");
  const std::string told_hash =
      open_error("falcon:firmware=" + write("falcon.bin", image()) + ",calibration=" + wrong_hash);
  EXPECT_NE(told_hash.find("SHA-256"), std::string::npos) << told_hash;
}

TEST_F(FalconFilesTest, ReadsTheShippedExample) {
  const auto spec = load_device_file(std::string(TANDEM_SOURCE_DIR) + "/hal/drivers/falcon/example.textproto");
  ASSERT_TRUE(spec) << spec.error().message;
  ASSERT_TRUE(spec->falcon);
  const auto force = FalconForce::from(*spec->falcon);
  ASSERT_TRUE(force) << force.error().text;
  EXPECT_TRUE(force->calibrated());
}

}  // namespace
}  // namespace tandem::hal
