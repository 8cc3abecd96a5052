// The end of the control server's thread.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <thread>
#include <utility>

#include "common/auth/io/server_keystore.h"
#include "common/io/fd.h"
#include "server/app/control/control_server.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

// Its timers expire while the thread is busy, so that their handlers already wait when `stop` cancels the timers.
TEST(ControlServerStop, EndsWhileTimersHaveExpired) {
  const std::string state = testing::TempDir() + "control_server_stop_" + std::to_string(::getpid());
  ASSERT_TRUE(auth::ServerKeystore::init(state, 1'700'000'000));
  for (int round = 0; round < 3; ++round) {
    ControlOptions options;
    options.listen = *io::parse_address("127.0.0.1:0", 0);
    options.state = state;
    std::promise<void> busy;
    bool first = true;
    ControlServer::Handlers handlers;
    handlers.on_event = [&](const ControlEventRecord&) {
      if (!std::exchange(first, false)) return;
      busy.set_value();
      std::this_thread::sleep_for(1300ms);  // longer than the interval of each timer
    };
    auto server = ControlServer::open(options, io::Steering{}, handlers);
    ASSERT_TRUE(server) << server.error();
    ASSERT_EQ((*server)->start(), "");
    {
      const io::Fd peer{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
      const io::SocketAddress to = (*server)->address();
      ASSERT_EQ(::connect(peer.get(), to.get(), to.size), 0);
    }  // a connection without a handshake is an event
    busy.get_future().wait();
    auto stopped = std::async(std::launch::async, [&] { (*server)->stop(); });
    if (stopped.wait_for(30s) != std::future_status::ready) {
      std::fputs("the control thread does not end\n", stderr);
      std::_Exit(1);  // neither the thread nor the future would ever end
    }
  }
  std::filesystem::remove_all(state);
}

}  // namespace
}  // namespace tandem::server
