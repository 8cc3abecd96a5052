#include "client/app/motor_registry_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

namespace tandem::client {
namespace {

struct MotorRegistryFileTest : testing::Test {
  MotorRegistryFileTest() {
    std::string name = (std::filesystem::temp_directory_path() / "tandem-motors-XXXXXX").string();
    folder = mkdtemp(name.data());
  }
  ~MotorRegistryFileTest() override { std::filesystem::remove_all(folder); }
  [[nodiscard]] bool confirmed() const {
    const auto record = MotorRegistryFile{folder}.find(signs);
    EXPECT_TRUE(record) << record.error();
    return record && *record && (*record)->confirmed;
  }
  std::string folder;
  hal::SignFile signs{"serial:0001", "arm.textproto", std::string(64, 'a'), {"base", "shoulder", "elbow"}};
};

TEST_F(MotorRegistryFileTest, KeepsResultsPerDeviceAndPerFile) {
  const MotorRegistryFile state{folder};
  EXPECT_FALSE(confirmed());
  EXPECT_EQ(state.storage_error(), "");
  EXPECT_EQ(state.store(signs, true), "");
  EXPECT_TRUE(confirmed());
  hal::SignFile other = signs;
  other.sha256 = std::string(64, 'b');
  EXPECT_FALSE(*state.find(other));
  EXPECT_EQ(state.store(signs, false), "");
  EXPECT_FALSE(confirmed()) << "found reversed later";
  EXPECT_FALSE(*MotorRegistryFile{folder + "/none"}.find(signs)) << "a folder that is not there knows of nothing";
  EXPECT_FALSE(std::filesystem::exists(folder + "/none")) << "and is not made by asking";
}

TEST_F(MotorRegistryFileTest, KeepsTheOldFileAndReportsAFullDisk) {
  const MotorRegistryFile state{folder};
  ASSERT_EQ(state.store(signs, true), "");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit none{0, before.rlim_max};  // file size limit 0: every write fails
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &none), 0);
  const std::string wrong = state.store(signs, false);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_NE(wrong, "");
  EXPECT_TRUE(confirmed()) << "whole, as it was";
}

TEST_F(MotorRegistryFileTest, RejectsATornFileAndDoesNotOverwriteIt) {
  const MotorRegistryFile state{folder};
  ASSERT_EQ(state.store(signs, true), "");
  const std::string name = folder + "/" + MotorRegistryFile::kFile;
  std::filesystem::resize_file(name, std::filesystem::file_size(name) - 3);
  const auto found = state.find(signs);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().find("line 1 has no end"), std::string::npos) << found.error();
  EXPECT_NE(state.storage_error(), "");
  EXPECT_NE(state.store(signs, true), "");
  EXPECT_FALSE(state.find(signs));
}

TEST_F(MotorRegistryFileTest, PrintsTheCommandQuotedForAShell) {
  EXPECT_EQ(MotorRegistryFile{""}.command("woodenhaptics:preset=polhem-v1,enable_motors=yes"),
            "tandem-client doctor --device woodenhaptics:preset=polhem-v1,enable_motors=yes --confirm-motors");
  EXPECT_EQ(MotorRegistryFile{"/my state"}.command("woodenhaptics:preset=it's mine.textproto"),
            "tandem-client doctor --device 'woodenhaptics:preset=it'\\''s mine.textproto' --confirm-motors --state "
            "'/my state'");
}

}  // namespace
}  // namespace tandem::client
