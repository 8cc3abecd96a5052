#include "client/app/motor_state.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

namespace tandem::client {
namespace {

struct MotorStateTest : testing::Test {
  MotorStateTest() {
    std::string name = (std::filesystem::temp_directory_path() / "tandem-motors-XXXXXX").string();
    folder = mkdtemp(name.data());
  }
  ~MotorStateTest() override { std::filesystem::remove_all(folder); }
  [[nodiscard]] bool confirmed() const {
    const auto record = MotorState{folder}.find(signs);
    EXPECT_TRUE(record) << record.error();
    return record && *record && (*record)->confirmed;
  }
  std::string folder;
  hal::SignFile signs{"serial:0001", "arm.textproto", std::string(64, 'a'), {"base", "shoulder", "elbow"}};
};

TEST_F(MotorStateTest, KeepsWhatWasFoundForThisDeviceAndThisFile) {
  const MotorState state{folder};
  EXPECT_FALSE(confirmed());
  EXPECT_EQ(state.unfit_to_keep(), "");
  EXPECT_EQ(state.keep(signs, true), "");
  EXPECT_TRUE(confirmed());
  hal::SignFile other = signs;
  other.sha256 = std::string(64, 'b');
  EXPECT_FALSE(*state.find(other));
  EXPECT_EQ(state.keep(signs, false), "");
  EXPECT_FALSE(confirmed()) << "found reversed later";
  EXPECT_FALSE(*MotorState{folder + "/none"}.find(signs)) << "a folder that is not there knows of nothing";
  EXPECT_FALSE(std::filesystem::exists(folder + "/none")) << "and is not made by asking";
}

TEST_F(MotorStateTest, OfAFullDiskTheOldBookIsLeftAndTheErrorIsTold) {
  const MotorState state{folder};
  ASSERT_EQ(state.keep(signs, true), "");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit none{0, before.rlim_max};  // no file may grow: every write fails
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &none), 0);
  const std::string wrong = state.keep(signs, false);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_NE(wrong, "");
  EXPECT_TRUE(confirmed()) << "whole, as it was";
}

TEST_F(MotorStateTest, ATornBookIsAnErrorAndIsNotWrittenOver) {
  const MotorState state{folder};
  ASSERT_EQ(state.keep(signs, true), "");
  const std::string name = folder + "/" + MotorState::kFile;
  std::filesystem::resize_file(name, std::filesystem::file_size(name) - 3);
  const auto found = state.find(signs);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().find("line 1 has no end"), std::string::npos) << found.error();
  EXPECT_NE(state.unfit_to_keep(), "");
  EXPECT_NE(state.keep(signs, true), "");
  EXPECT_FALSE(state.find(signs));
}

TEST_F(MotorStateTest, TheCommandIsPrintedAsItMustBeTyped) {
  EXPECT_EQ(MotorState{""}.command("woodenhaptics:preset=polhem-v1,energise=yes"),
            "tandem-client doctor --device woodenhaptics:preset=polhem-v1,energise=yes --confirm-motors");
  EXPECT_EQ(MotorState{"/my state"}.command("woodenhaptics:preset=it's mine.textproto"),
            "tandem-client doctor --device 'woodenhaptics:preset=it'\\''s mine.textproto' --confirm-motors --state '/my state'");
}

}  // namespace
}  // namespace tandem::client
