// Connects to a port of the loopback interface at which no server listens.
#include "client/app/server_connection.h"

#include <gtest/gtest.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "common/auth/io/client_keystore.h"
#include "common/io/clock.h"
#include "common/io/event_fd.h"
#include "common/io/signals.h"
#include "tests/io/blocked_lookup.h"

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
  /// The workstation has learnt another server of the service, by name.
  void learn_name() {
    const auto keys = auth::ClientKeystore::open_or_make(options.state, auth::wall_seconds());
    ASSERT_TRUE(keys) << keys.error();
    ASSERT_EQ(keys->store_server({"127.0.0.1:1", {}, "a", ServicePin{}, {"lab:7000"}}), "");
    options.names = dns.resolver();
  }
  tandem::test::BlockedLookup dns;
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

TEST_F(ServerConnectionTest, EndsAtTheTimeoutWhileNoDnsServerAnswers) {
  learn_name();
  const auto connected = ServerConnection{options}.connect();
  ASSERT_FALSE(connected);
  EXPECT_TRUE(dns.blocks());
  EXPECT_EQ(dns.names(), std::vector<std::string>{"lab:7000"});
  EXPECT_FALSE(connected.error().interrupted);
  for (const char* words : {"no server at 127.0.0.1:1", "\"lab:7000\": no answer of the DNS server yet"})
    EXPECT_NE(connected.error().reason.find(words), std::string::npos) << connected.error().reason;
}

TEST_F(ServerConnectionTest, EndsAtASignalWhileNoDnsServerAnswers) {
  learn_name();
  const io::EventFd signal;
  options.signals = signal.get();
  options.timeout = 1h;
  std::jthread user([&] {
    dns.wait_for(1);
    signal.signal();
  });
  const auto connected = ServerConnection{options}.connect();
  ASSERT_FALSE(connected);
  EXPECT_TRUE(dns.blocks());
  EXPECT_TRUE(connected.error().interrupted);
}

TEST_F(ServerConnectionTest, WaitsForConnectAndReplyTogether) {
  const Time until = Time{} + 5s;
  EXPECT_EQ(ServerConnection::answer_time(Time{} + 100ms, until, 5s), 4900ms);
  EXPECT_EQ(ServerConnection::answer_time(Time{} + 4900ms, until, 5s), 1s) << "the server has accepted late";
  EXPECT_EQ(ServerConnection::answer_time(Time{} + 8s, until, 5s), 1s);
  EXPECT_EQ(ServerConnection::answer_time(Time{} + 250ms, Time{} + 250ms, 250ms), 250ms);
}

TEST_F(ServerConnectionTest, NamesTheSignalAndWhatWasMissingWhenItEnded) {
  const io::Fd signals = io::make_signalfd();
  options.signals = signals.get();
  ::kill(::getpid(), SIGTERM);
  const auto console = ServerConnection{options}.connect();
  options.seat = "trainee";
  const auto seat = ServerConnection{options}.connect();
  signalfd_siginfo taken{};
  ASSERT_EQ(::read(signals.get(), &taken, sizeof taken), static_cast<ssize_t>(sizeof taken));
  ASSERT_FALSE(console);
  EXPECT_TRUE(console.error().interrupted);
  EXPECT_EQ(console.error().reason, "ended by SIGTERM before the server answered") << "a console has no seat";
  ASSERT_FALSE(seat);
  EXPECT_EQ(seat.error().reason, "ended by SIGTERM before it had a seat");
}

TEST_F(ServerConnectionTest, SaysThatOnlyTheSessionEnds) {
  options.session = "exam";
  const auto refused = ServerConnection{options}.expect<rpc::Welcome>(
      rpc::ErrorReply{rpc::ErrorCode::kSessionOver, "the session is ending", 0});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().reason,
            "refused: the session is ending, and takes no participants any more. Ask its operator whether another one "
            "begins; `tandem-client sessions --server 127.0.0.1:1 --state " +
                options.state + "` lists the open ones");
}

TEST_F(ServerConnectionTest, TriesOnceToReturnToTheServerOfASeat) {
  ServerConnection server{options};
  const Time begin = io::monotonic_now();
  ResumeState own;
  own.local = true;
  const auto connected = server.connect_to(own, options.server);
  ASSERT_FALSE(connected);
  EXPECT_EQ(connected.error().kind, ResumeError::Kind::kAgain);
  EXPECT_LT(io::monotonic_now() - begin, 2s);
}

}  // namespace
}  // namespace tandem::client
