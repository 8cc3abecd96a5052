// Connection floods by unknown senders, and clients that do not read (tests/FAILURES.md), against a running session.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/ssl.h>
#include <signal.h>
#include <sys/socket.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <deque>
#include <thread>

#include "common/auth/io/client_keystore.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "proto/rpc/rpc_codec.h"
#include "tests/common/base/counts.h"
#include "tests/io/constant_force_scene.h"
#include "tests/io/metrics_page.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

/// Resident memory of a process [KiB], from /proc.
long resident_kib(pid_t id) {
  std::ifstream status("/proc/" + std::to_string(id) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::strtol(line.c_str() + 6, nullptr, 10);
  return -1;
}

/// A running session with two hands, and its outcome.
struct Running {
  Running()
      : host(hosting(folder.write("press.textproto", constant_force_scene()),
                     {"--metrics", "127.0.0.1:0", "--json", folder.file("s.json")})),
        trainer(client(address_of(host), "trainer", {"--json", folder.file("trainer.json")})),
        trainee(client(address_of(host), "trainee", {"--json", folder.file("trainee.json")})),
        to(*io::parse_address(address_of(host), 1)) {
    EXPECT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
    metrics = host.after("metrics on http://");
    metrics = metrics.substr(0, metrics.find('/'));
  }
  void expect_undisturbed() {
    Process still({TANDEM_CLIENT, "sessions", "--server", address_of(host)});
    EXPECT_EQ(still.wait(), 0) << "the server still accepts other clients: " << still.err();
    host.signal(SIGINT);
    EXPECT_EQ(host.wait(), 0) << host.err();
    EXPECT_EQ(trainer.wait(), 0) << trainer.err();
    EXPECT_EQ(trainee.wait(), 0) << trainee.err();
    EXPECT_EQ(folder.json("s.json")["violations"], Json::array());
    for (const char* seat : {"trainer.json", "trainee.json"}) EXPECT_EQ(folder.json(seat)["gate"]["trips"], 0) << seat;
  }
  /// The highest histogram bucket of lateness that holds less than `share` of all ticks, as text.
  [[nodiscard]] std::string lateness(double share) const {
    const std::string all = page(metrics);
    const auto number = [&](const std::string& name) {
      const std::size_t at = all.find("\n" + name);
      return at == std::string::npos ? 0.0 : std::strtod(all.c_str() + all.find("} ", at) + 2, nullptr);
    };
    const double count = number("tandem_tick_lateness_seconds_count");
    std::string least = "?";
    for (std::size_t at = all.find("\ntandem_tick_lateness_seconds_bucket"); at != std::string::npos;
         at = all.find("\ntandem_tick_lateness_seconds_bucket", at + 1)) {
      const std::size_t le = all.find("le=\"", at) + 4, value = all.find("} ", at) + 2;
      least = all.substr(le, all.find('"', le) - le);
      if (std::strtod(all.c_str() + value, nullptr) >= share * count) break;
    }
    return format("p%g of %.0f ticks late by at most %s s", 100 * share, count, least.c_str());
  }
  Folder folder;
  Process host, trainer, trainee;
  io::SocketAddress to;
  std::string metrics;
};

/// The first bytes of a TLS client.
std::string client_hello() {
  SSL_CTX* const context = SSL_CTX_new(TLS_client_method());
  SSL* const tls = SSL_new(context);
  BIO* const out = BIO_new(BIO_s_mem());
  SSL_set_bio(tls, BIO_new(BIO_s_mem()), out);
  const unsigned char alpn[] = "\x08tandem/1";
  SSL_set_alpn_protos(tls, alpn, sizeof alpn - 1);
  SSL_set_connect_state(tls);
  SSL_do_handshake(tls);
  std::string bytes(static_cast<std::size_t>(BIO_pending(out)), '\0');
  BIO_read(out, bytes.data(), static_cast<int>(bytes.size()));
  SSL_free(tls);
  SSL_CTX_free(context);
  return bytes;
}

// "TLS connect flood 2000/s for 10 s: running sessions undisturbed; memory + <= 32 MiB." From 1000 addresses, each says
// a ClientHello and never goes on; at most 600 are open at a time.
TEST(FloodLive, TwoThousandConnectionsASecondDisturbNoHandAndTakeLittleMemory) {
  Running session;
  const std::size_t length = draws(2, 10, 10);
  const std::string hello = client_hello();
  const std::string quiet = session.lateness(0.999);
  const long before = resident_kib(session.host.id());
  ASSERT_GT(before, 0);
  long most = before;
  std::deque<io::Fd> open;
  std::size_t tried = 0, reached = 0;
  const Time begin = io::monotonic_now();
  for (std::size_t ms = 0; ms < 1000 * length; ++ms) {
    std::this_thread::sleep_until(
        std::chrono::steady_clock::time_point{(begin + std::chrono::milliseconds(ms)).time_since_epoch()});
    for (int k = 0; k < 2; ++k, ++tried) {
      io::Fd fd{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)};
      const linger at_once{1, 0};  // no port waits for late segments
      setsockopt(fd.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
      const auto from = *io::parse_address(format("127.0.%zu.%zu:0", 1 + tried / 250 % 4, 1 + tried % 250), 0);
      if (::bind(fd.get(), from.get(), from.size) != 0) continue;
      static_cast<void>(::connect(fd.get(), session.to.get(), session.to.size));
      reached += ::send(fd.get(), hello.data(), hello.size(), MSG_NOSIGNAL) > 0 ? 1 : 0;
      open.push_back(std::move(fd));
      if (open.size() > 600) open.pop_front();
    }
    if (ms % 100 == 0) most = std::max(most, resident_kib(session.host.id()));
  }
  open.clear();
  most = std::max(most, resident_kib(session.host.id()));
  std::printf(
      "[ hostile  ] %zu connections in %zu s, %zu sent HELLO; memory of the server %ld KiB, at most %ld KiB more\n",
      tried, length, reached, before, most - before);
  std::printf("[ hostile  ] ticks: quiet %s; with the flood %s\n", quiet.c_str(), session.lateness(0.999).c_str());
  EXPECT_EQ(tried, 2000 * length);
  EXPECT_GT(reached, tried / 10);
#ifndef TANDEM_SANITIZED  // a sanitizer keeps 256 MiB of freed memory
  EXPECT_LE(most - before, 32 * 1024);
#endif
  session.expect_undisturbed();
}

/// Blocking TLS connection of a workstation that is enrolled by the server's own files.
class Reader {
 public:
  explicit Reader(const io::SocketAddress& to)
      : context_(SSL_CTX_new(TLS_client_method())),
        tls_(SSL_new(context_)),
        fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int small = 4096;
    setsockopt(fd_.get(), SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    const timeval timeout{30, 0};
    setsockopt(fd_.get(), SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
    if (::connect(fd_.get(), to.get(), to.size) != 0) return;
    const unsigned char alpn[] = "\x08tandem/1";
    SSL_set_alpn_protos(tls_, alpn, sizeof alpn - 1);
    SSL_set_fd(tls_, fd_.get());
  }
  ~Reader() {
    SSL_free(tls_);
    SSL_CTX_free(context_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  /// @return whether the handshake completed
  bool greet(const auth::LocalKeys& keys) {
    SSL_use_certificate(tls_, keys.workstation.certificate.handle());
    SSL_use_PrivateKey(tls_, keys.workstation.key.handle());
    return SSL_connect(tls_) == 1;
  }
  /// Sends requests and reads nothing. @return number of requests before the server closed the connection
  std::size_t ask_until_dropped(std::size_t most) {
    const auto frame = rpc::encode({1, rpc::SessionListRequest{}});
    const auto bytes = frame->bytes();
    for (std::size_t n = 0; n < most; ++n)
      if (SSL_write(tls_, bytes.data(), static_cast<int>(bytes.size())) <= 0) return n;
    return most;
  }
  [[nodiscard]] SSL* tls() const { return tls_; }

 private:
  SSL_CTX* context_;
  SSL* tls_;
  io::Fd fd_;
};

/// The keys that a server of this user published, found by the certificate it shows.
std::optional<auth::LocalKeys> keys_of(const io::SocketAddress& server) {
  Reader first{server};
  SSL_connect(first.tls());
  X509* const certificate = SSL_get1_peer_certificate(first.tls());
  if (certificate == nullptr) return std::nullopt;
  const auto fingerprint = auth::fingerprint_of(certificate);
  X509_free(certificate);
  if (!fingerprint) return std::nullopt;
  auto found = auth::find_local_keys(auth::runtime_path(), *fingerprint);
  if (!found || !*found) return std::nullopt;
  return std::move(**found);
}

// Slow consumer: the data for a client that does not read is bounded, its connection is closed, and no hand is
// affected.
TEST(FloodLive, DisconnectsSlowConsumersWithoutDisturbingAHand) {
  std::signal(SIGPIPE, SIG_IGN);
  Running session;
  const auto keys = keys_of(session.to);
  ASSERT_TRUE(keys);
  const long before = resident_kib(session.host.id());
  constexpr std::size_t kReaders = 4, kMost = 4'000'000;
  std::vector<std::thread> threads;
  std::array<std::size_t, kReaders> asked{};
  for (std::size_t i = 0; i < kReaders; ++i)
    threads.emplace_back([&, i] {
      Reader reader{session.to};
      if (reader.greet(*keys)) asked[i] = reader.ask_until_dropped(kMost);
    });
  for (std::thread& t : threads) t.join();
  const long after = resident_kib(session.host.id());
  for (const std::size_t n : asked) {
    EXPECT_GT(n, 0U) << "never accepted";
    EXPECT_LT(n, kMost) << "the server did not close the connection";
  }
  std::printf(
      "[ hostile  ] clients that do not read sent %zu, %zu, %zu, %zu requests before they were disconnected; memory of "
      "the "
      "server %ld KiB more; %s\n",
      asked[0], asked[1], asked[2], asked[3], after - before, session.lateness(0.999).c_str());
  EXPECT_LE(after - before, 4 * 1024);
  session.expect_undisturbed();
}

}  // namespace
}  // namespace tandem::test
