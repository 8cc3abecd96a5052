#include "hal/io/openhaptics_library.h"

#include <gtest/gtest.h>

#include "hal/backends/openhaptics_backend.h"

namespace tandem::hal {
namespace {

TEST(OpenHapticsLibrary, ReportsMissingParts) {
  const auto absent = OpenHapticsLibrary::load("libHD-that-is-not-there.so");
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, Errc::kLibraryMissing);
  EXPECT_NE(absent.error().message.find("Install the vendor's OpenHaptics"), std::string::npos)
      << absent.error().message;
  const auto old = OpenHapticsLibrary::load(STUB_LIBHD_OLD);
  ASSERT_FALSE(old);
  EXPECT_EQ(old.error().code, Errc::kUnsupported);
  EXPECT_NE(old.error().message.find("hdCheckCalibration, hdUpdateCalibration"), std::string::npos)
      << old.error().message;
}

TEST(OpenHapticsBackend, OpensTheNamedDevice) {
  OpenHapticsBackend backend;
  const std::string library = std::string("library=") + STUB_LIBHD;
  const auto open = [&](const std::string& spec) { return backend.open(*parse_device_spec(spec)); };
  const auto unnamed = open("openhaptics:" + library);
  ASSERT_TRUE(unnamed) << unnamed.error().message;
  EXPECT_EQ(unnamed->driver->id().key, "default");
  EXPECT_EQ(open("openhaptics:left," + library)->driver->id().key, "left");
  EXPECT_EQ(open("openhaptics:left,library=other.so").error().code, Errc::kUnsupported);
  EXPECT_TRUE(open("openhaptics:home=here," + library));
  EXPECT_NE(open("openhaptics:home=there," + library).error().message.find("must be 'here'"), std::string::npos);
  EXPECT_NE(open("openhaptics:left,libary=x").error().message.find("library"), std::string::npos);
}

}  // namespace
}  // namespace tandem::hal
