// Connects to a port of the loopback interface at which no server listens.
#include "client/app/server_connection.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "common/io/clock.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

struct ServerConnectionTest : ::testing::Test {
  ServerConnectionTest() {
    options.server = *io::parse_address("127.0.0.1:1", 1);
    options.timeout = 250ms;
    options.state =
        (std::filesystem::temp_directory_path() / ("tandem-connect-" + std::to_string(::getpid()))).string();
  }
  ~ServerConnectionTest() override { std::filesystem::remove_all(options.state); }
  JoinOptions options;
};

TEST_F(ServerConnectionTest, RetriesUntilTheTimeoutWhileNothingListens) {
  ServerConnection server{options};
  const Time begin = io::monotonic_now();
  const auto connected = server.connect();
  ASSERT_FALSE(connected);
  EXPECT_GT(io::monotonic_now() - begin, 150ms);
  EXPECT_FALSE(connected.error().interrupted);
  EXPECT_EQ(connected.error().reason,
            "no server at 127.0.0.1:1: nothing listens there (tried for 0.25 s). Start a server in another terminal "
            "first: `tandem-server run free_motion --listen 127.0.0.1:1`, and use the address it prints as `listening "
            "on`");
}

TEST_F(ServerConnectionTest, TriesOnceToReturnToTheServerOfASeat) {
  ServerConnection server{options};
  const Time begin = io::monotonic_now();
  ResumeState own;
  own.local = true;
  const auto connected = server.connect_to(own);
  ASSERT_FALSE(connected);
  EXPECT_EQ(connected.error().kind, ResumeError::Kind::kAgain);
  EXPECT_LT(io::monotonic_now() - begin, 2s);
}

}  // namespace
}  // namespace tandem::client
