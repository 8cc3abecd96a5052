#include "common/auth/io/append_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/common/auth/io/temporary_folder.h"

namespace tandem::auth {
namespace {

using test::Folder;
using enum AppendFile::TornLine;

StateDirectory opened(const Folder& folder) {
  auto state = StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError);
  EXPECT_TRUE(state) << state.error();
  return std::move(*state);
}

TEST(AppendFile, NeverAppendsToALineThatACrashLeftIncomplete) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  for (const std::string& torn : {std::string("to"), std::string(5000, 't')}) {
    folder.write("x", "one\n" + torn);
    EXPECT_EQ(AppendFile(state, "x").append("two\n"), "");
    EXPECT_EQ(folder.read("x"), "one\ntwo\n");
    folder.write("x", "one\n" + torn);
    EXPECT_EQ(AppendFile(state, "x", AppendFile::TornLine::kEnded).append("two\n"), "");
    EXPECT_EQ(folder.read("x"), "one\n" + torn + "\ntwo\n");
  }
  folder.write("x", "nothing but a piece");
  EXPECT_EQ(AppendFile(state, "x").append("two\n"), "");
  EXPECT_EQ(folder.read("x"), "two\n");
  folder.write("x", std::string(StateDirectory::kFileMax - 1, 'x') + "\n");
  EXPECT_NE(AppendFile(state, "x").append("two\n"), "") << "no longer than what can be read again";
}

TEST(AppendFile, RotatesLongFilesAndKeepsACountOfOlderOnes) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  const AppendFile file(state, "x", kEnded);
  EXPECT_EQ(file.append("first\n"), "");
  EXPECT_EQ(file.rotate(6, 2), 0u) << "6 bytes are not more than 6";
  EXPECT_EQ(file.rotate(5, 2), 6u);
  EXPECT_EQ(folder.read("x.1"), "first\n");
  EXPECT_FALSE(state.has("x"));
  for (const char* line : {"second\n", "third\n"}) {
    EXPECT_EQ(file.append(line), "");
    EXPECT_EQ(file.rotate(0, 2), std::string_view(line).size());
  }
  EXPECT_EQ(folder.read("x.1"), "third\n");
  EXPECT_EQ(folder.read("x.2"), "second\n");
  EXPECT_FALSE(state.has("x.3")) << "the oldest file is removed";
}

TEST(AppendFile, ReportsWhyItCannotBeAppendedToWithoutWriting) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  const AppendFile file(state, "x");
  EXPECT_NE(file.problem().find("cannot be written to"), std::string::npos) << "a file that does not exist";
  EXPECT_FALSE(state.has("x"));
  folder.write("x", "one\n");
  EXPECT_EQ(file.problem(), "");
  ASSERT_EQ(chmod(folder.path("x").c_str(), 0640), 0);
  EXPECT_NE(file.problem().find("chmod 0600"), std::string::npos);
}

}  // namespace
}  // namespace tandem::auth
