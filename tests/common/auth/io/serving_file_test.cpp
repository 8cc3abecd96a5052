// Messages between a running server and the commands beside it.
#include "common/auth/io/serving_file.h"

#include <gtest/gtest.h>

#include "tests/common/auth/io/temporary_folder.h"

namespace tandem::auth {
namespace {

using test::Folder;

std::shared_ptr<const StateDirectory> directory(const Folder& folder) {
  return std::make_shared<const StateDirectory>(
      *StateDirectory::open(folder.path(), StateDirectory::Missing::kIsAnError));
}

TEST(ServingFile, DescribesTheServerWhileItRuns) {
  const Folder folder;
  const ServingSpec spec{"127.0.0.1:7000", {}};
  const ServingFile command(directory(folder), "lock");
  {
    ServingFile server(directory(folder), "lock"), second(directory(folder), "lock");
    ASSERT_EQ(server.begin(), "");
    ASSERT_EQ(server.write(spec), "");
    EXPECT_EQ(*command.read(), spec);
    EXPECT_NE(second.begin().find("another server runs from this folder"), std::string::npos);
  }
  EXPECT_EQ(*command.read(), std::nullopt);
}

TEST(ServingFile, PassesARequestToEndOnce) {
  const Folder folder;
  const ServingFile command(directory(folder), "lock");
  ASSERT_EQ(command.request_shutdown(5), "");
  ServingFile server(directory(folder), "lock");
  ASSERT_EQ(server.begin(), "");
  EXPECT_EQ(server.requested_shutdown(), std::nullopt) << "meant for the previous server";
  ASSERT_EQ(command.request_shutdown(30), "");
  EXPECT_EQ(server.requested_shutdown(), 30U);
  EXPECT_EQ(server.requested_shutdown(), std::nullopt);
  for (const char* wrong : {"3601\n", "30", "-1\n", "30 s\n", ""}) {
    folder.write(ServingFile::kEndFile, wrong);
    EXPECT_EQ(server.requested_shutdown(), std::nullopt) << wrong;
  }
}

TEST(ServingFile, DoesNothingWithoutADirectory) {
  const ServingFile server(nullptr, "lock");
  EXPECT_EQ(server.write({}), "");
  EXPECT_EQ(*server.read(), std::nullopt);
  EXPECT_EQ(server.requested_shutdown(), std::nullopt);
  EXPECT_NE(server.request_shutdown(0), "");
}

}  // namespace
}  // namespace tandem::auth
