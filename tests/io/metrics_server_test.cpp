// Monitoring endpoints cannot be used to read the metrics by a user's browser, and stalled readers block no others.
// Real sockets on loopback.
#include "server/app/monitor/metrics_server.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <thread>
#include <vector>

#include "common/io/fd.h"

namespace tandem::server {
namespace {

constexpr int kPatienceMs = 30'000;  // limit against hanging; durations are never judged
constexpr std::string_view kAsk = "GET /metrics HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";

/// A server whose responses are too long for the kernel's buffers.
class Looked {
 public:
  explicit Looked(std::chrono::milliseconds deadline, std::size_t size = 64U << 20)
      : server_(
            context_, [size](std::string_view) { return HttpResponse{200, "text/plain", std::string(size, 'x')}; }, {},
            deadline) {
    EXPECT_EQ(server_.listen(*io::parse_address("127.0.0.1:0", 0)), "");
    thread_ = std::thread([this] { context_.run(); });
  }
  ~Looked() {
    asio::post(context_, [this] { server_.stop(); });
    thread_.join();
  }
  [[nodiscard]] io::Fd visitor(std::string_view says) const {
    io::Fd socket{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    EXPECT_EQ(::connect(socket.get(), server_.address().get(), server_.address().size), 0);
    EXPECT_EQ(::send(socket.get(), says.data(), says.size(), MSG_NOSIGNAL), static_cast<ssize_t>(says.size()));
    return socket;
  }

 private:
  asio::io_context context_;
  MetricsServer server_;
  std::thread thread_;
};

/// @return bytes until the peer closed; nullopt if it did not
std::optional<std::size_t> read_to_end(const io::Fd& socket) {
  std::size_t all = 0;
  std::vector<char> part(1U << 16);
  while (true) {
    pollfd ready{socket.get(), POLLIN, 0};
    if (::poll(&ready, 1, kPatienceMs) <= 0) return std::nullopt;
    const ssize_t n = ::recv(socket.get(), part.data(), part.size(), 0);
    if (n <= 0) return all;  // closed or reset
    all += static_cast<std::size_t>(n);
  }
}

/// Whether the peer ends the connection, although nothing is read.
bool ends(const io::Fd& socket) {
  pollfd ended{socket.get(), POLLRDHUP, 0};
  return ::poll(&ended, 1, kPatienceMs) == 1 && (ended.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
}

TEST(MetricsServer, AcceptsOnlyAddressesAndItsOwnNamesAsHost) {
  const std::vector<std::string> names{"monitor.lab"};
  for (const char* good : {"127.0.0.1", "127.0.0.1:9464", "192.0.2.7:1", "[::1]", "[2001:db8::1]:9464", "localhost",
                           "LocalHost:9464", "monitor.lab", "Monitor.Lab:80"})
    EXPECT_TRUE(host_is_ours(good, names)) << good;
  for (const char* bad :
       {"", ":80", "attacker.example", "attacker.example:9464", "127.0.0.1.attacker.example",
        "localhost.attacker.example", "monitor.lab.attacker.example", "[::1", "[attacker]", "[127.0.0.1]",
        "127.0.0.1:80:90", "127.0.0.1:x", "::1", "[::1]x", "0x7f.1", "monitor.lab@attacker.example"})
    EXPECT_FALSE(host_is_ours(bad, names)) << bad;
}

TEST(MetricsServer, DisconnectsSlowReadersAtTheDeadline) {
  const Looked server(std::chrono::milliseconds(100));
  const io::Fd slow = server.visitor(kAsk), silent = server.visitor("GET /met");
  EXPECT_TRUE(ends(silent)) << "also a client that does not finish its request";
  EXPECT_TRUE(ends(slow));
  const auto got = read_to_end(slow);
  ASSERT_TRUE(got);
  EXPECT_LT(*got, 64U << 20) << "the rest is not waited for";
}

TEST(MetricsServer, AnswersWhileSlowReadersFillAllConnections) {
  const Looked server(std::chrono::hours(1));
  std::vector<io::Fd> slow;
  for (std::size_t i = 0; i < MetricsServer::kConnectionsMax; ++i) slow.push_back(server.visitor("GET /met"));
  const auto got = read_to_end(server.visitor(kAsk));
  ASSERT_TRUE(got);
  EXPECT_GT(*got, 64U << 20);
  EXPECT_TRUE(ends(slow.front())) << "the oldest connection was closed";
}

}  // namespace
}  // namespace tandem::server
