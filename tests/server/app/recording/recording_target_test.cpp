// Where recordings go, and their names.
#include "server/app/recording/recording_target.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace tandem::server {
namespace {

class RecordingTarget : public testing::Test {
 protected:
  RecordingTarget() {
    std::string name = testing::TempDir() + "target-XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  ~RecordingTarget() override { std::filesystem::remove_all(folder_); }
  void touch(const std::string& name) const { std::ofstream(folder_ + "/" + name) << "x"; }
  std::string folder_;
};

TEST_F(RecordingTarget, NamesAFileOfAFolderByTimeAndSession) {
  EXPECT_EQ(recording_path(folder_, "lab", "0f3a9c11", 1'795'697'985), folder_ + "/lab-20261126T125945Z-0f3a9c11.mcap");
  touch("lab-20261126T125945Z-0f3a9c11.mcap.part");
  EXPECT_EQ(recording_path(folder_, "lab", "0f3a9c11", 1'795'697'985),
            folder_ + "/lab-20261126T125945Z-0f3a9c11-2.mcap");
}

TEST_F(RecordingTarget, NeverNamesAFileThatExists) {
  const std::string file = folder_ + "/a.mcap";
  EXPECT_EQ(recording_path(file, "lab", "id", 0), file);
  touch("a.mcap");
  EXPECT_EQ(recording_path(file, "lab", "id", 0), folder_ + "/a-2.mcap");
  touch("a-2.mcap.part");
  EXPECT_EQ(recording_path(file, "lab", "id", 0), folder_ + "/a-3.mcap");
}

TEST_F(RecordingTarget, RejectsWhatCannotBeWritten) {
  EXPECT_EQ(recording_target_problem(folder_), "");
  EXPECT_EQ(recording_target_problem(folder_ + "/a.mcap"), "");
  EXPECT_EQ(recording_folder(folder_ + "/a.mcap"), folder_);
  EXPECT_EQ(recording_folder(folder_), folder_);
  EXPECT_EQ(recording_folder("a.mcap"), ".");
  for (const std::string& wrong :
       {folder_ + "/absent", folder_ + "/a.csv", folder_ + "/absent/a.mcap", std::string(".mcap"), folder_ + "/.mcap"})
    EXPECT_NE(recording_target_problem(wrong), "") << wrong;
}

}  // namespace
}  // namespace tandem::server
