#include "common/auth/io/directory_lock.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/common/auth/io/temporary_folder.h"

namespace tandem::auth {
namespace {

using test::Folder;

StateDirectory opened(const Folder& folder) {
  auto state = StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError);
  EXPECT_TRUE(state) << state.error();
  return std::move(*state);
}

TEST(DirectoryLock, LocksForOneHolder) {
  const Folder folder;
  const StateDirectory a = opened(folder), b = opened(folder);
  auto held = DirectoryLock::attempt(a, "l");
  ASSERT_TRUE(held && *held);
  const auto second = DirectoryLock::attempt(b, "l");
  ASSERT_TRUE(second);
  EXPECT_FALSE(*second);
  (*held)->release();
  const auto third = DirectoryLock::attempt(b, "l");
  ASSERT_TRUE(third);
  EXPECT_TRUE(*third);
}

TEST(DirectoryLock, ReportsTheHolderOfALockThatStaysTaken) {
  const Folder folder;
  const StateDirectory a = opened(folder), b = opened(folder);
  auto held = DirectoryLock::wait(a, "l");
  ASSERT_TRUE(held);
  const auto second = DirectoryLock::wait(b, "l", std::chrono::milliseconds(30));
  ASSERT_FALSE(second) << "it waits no longer than its limit";
  for (const std::string& word :
       {folder.path("l"), std::string("0.03 s"), "process " + std::to_string(getpid()), std::string("then try again")})
    EXPECT_NE(second.error().find(word), std::string::npos) << word << "\n" << second.error();
  held->release();
  EXPECT_TRUE(DirectoryLock::wait(b, "l", std::chrono::milliseconds(30)));
}

TEST(DirectoryLock, EndsWithItsObjectAndHoldsNothingByDefault) {
  const Folder folder;
  const StateDirectory state = opened(folder);
  EXPECT_FALSE(DirectoryLock().held());
  {
    const auto held = DirectoryLock::attempt(state, "l");
    ASSERT_TRUE(held && *held);
    EXPECT_TRUE((*held)->held());
    EXPECT_EQ(DirectoryLock::holder_of(state, "l").find("process " + std::to_string(getpid())), 0u);
  }
  const auto again = DirectoryLock::attempt(state, "l");
  ASSERT_TRUE(again);
  EXPECT_TRUE(*again);
  EXPECT_EQ(DirectoryLock::holder_of(state, "no such file"), "another process");
}

}  // namespace
}  // namespace tandem::auth
