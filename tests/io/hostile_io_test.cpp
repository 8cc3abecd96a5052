// Unknown senders and insiders against real programs on loopback (tests/FAILURES.md). Outcomes are asserted, durations
// are printed.
#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <openssl/ssl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdio>
#include <limits>
#include <thread>

#include "client/app/join_client.h"
#include "client/seat/seat.h"
#include "common/auth/io/client_keystore.h"
#include "common/auth/io/state_directory.h"
#include "common/auth/ticket.h"
#include "common/io/process_hardening.h"
#include "hal/sim/sim_device.h"
#include "proto/rpc/rpc_codec.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "proto/wire/wire_codec.h"
#include "tests/common/base/counts.h"
#include "tests/io/junk.h"
#include "tests/io/machine_witness.h"
#include "tests/io/programs.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

io::SocketAddress udp_of(const Process& host) { return *io::parse_address(address_of(host), 1); }

// "Flood 50 kpps junk for 10 s on loopback: valid loss 0 %, 0 bytes sent back." flood_bench prints how late ticks get.
TEST(HostileLive, LosesNoValidDatagramAndSendsNoReplyInAFloodOfJunk) {
  const Folder folder;
  const std::size_t duration = draws(2, 10, 10);
  Process host = hosting("one_axis", {"--duration", std::to_string(duration + 2), "--json", folder.file("s.json")});
  Process trainer = client(address_of(host), "trainer", {"--json", folder.file("c.json")});
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  const JunkOutcome junk = send_junk(udp_of(host), std::chrono::seconds(duration), 50);
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(junk.sent, 50'000 * duration);
  EXPECT_EQ(junk.replies, 0U);
  const Json report = folder.json("s.json");
  ASSERT_FALSE(report.is_discarded());
  const Json& seat = report["seats"][0];
  std::printf("[ hostile  ] %zu s of 50 kpps: loss up %s %%, down %s %%, rtt p99 %s ms, late ticks %s\n", duration,
              seat["link"]["up"]["loss_percent"].dump().c_str(), seat["link"]["down"]["loss_percent"].dump().c_str(),
              seat["link"]["rtt_p99_ms"].dump().c_str(), report["machine"]["late_ticks"].dump().c_str());
  EXPECT_EQ(seat["link"]["up"]["loss_percent"].get<double>(), 0);
  EXPECT_EQ(seat["link"]["down"]["loss_percent"].get<double>(), 0);
  EXPECT_EQ(report["violations"], Json::array());
}

/// A workstation that joins from a chosen address of this machine, blocking, one connection at a time.
class Joiner {
 public:
  Joiner(const io::SocketAddress& to, const auth::LocalKeys& keys)
      : to_(to), keys_(keys), context_(SSL_CTX_new(TLS_client_method())) {
    SSL_CTX_set_min_proto_version(context_, TLS1_3_VERSION);
    SSL_CTX_use_certificate(context_, keys_.workstation.certificate.handle());
    SSL_CTX_use_PrivateKey(context_, keys_.workstation.key.handle());
  }
  ~Joiner() { SSL_CTX_free(context_); }
  Joiner(const Joiner&) = delete;
  Joiner& operator=(const Joiner&) = delete;

  /// @return whether it received a Welcome; otherwise `why` is the reason
  bool join(unsigned last_byte, std::uint32_t number) {
    io::Fd fd{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    const timeval timeout{30, 0};
    setsockopt(fd.get(), SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    const int at_once = 1;  // otherwise the Hello waits 40 ms for an acknowledgement of the handshake's last segment
    setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
    const auto from = *io::parse_address("127.0.0." + std::to_string(last_byte) + ":0", 0);
    if (::bind(fd.get(), from.get(), from.size) != 0 || ::connect(fd.get(), to_.get(), to_.size) != 0)
      return failed("no connection");
    const std::unique_ptr<SSL, void (*)(SSL*)> tls{SSL_new(context_), SSL_free};
    const unsigned char alpn[] = "\x08tandem/1";
    SSL_set_alpn_protos(tls.get(), alpn, sizeof alpn - 1);
    SSL_set_fd(tls.get(), fd.get());
    if (SSL_connect(tls.get()) != 1) return failed("no handshake");
    const auto listed = ask(tls.get(), rpc::SessionListRequest{});
    if (!listed || !std::holds_alternative<rpc::SessionList>(*listed)) return failed("no list");
    auth::Ticket ticket;
    auth::fill_random(ticket.ticket_id);
    ticket.session_id = std::get<rpc::SessionList>(*listed).sessions.at(0).id;
    ticket.role = AccessRole::kOperator;
    ticket.workstation = keys_.workstation.fingerprint();
    ticket.not_before = auth::wall_seconds();
    ticket.not_after = ticket.not_before + 60;
    const auto bytes = auth::sign_ticket(ticket, keys_.ticket_key);
    if (!bytes) return failed("no ticket");
    rpc::Hello hello;
    hello.client_cid = number | 1;
    hello.session = ticket.session_id;
    hello.credential = rpc::TicketCredential{{bytes->begin(), bytes->end()}};
    const auto answer = ask(tls.get(), std::move(hello));
    if (!answer) return failed("no answer");
    if (const auto* refused = std::get_if<rpc::ErrorReply>(&*answer)) return failed(refused->text);
    if (!std::holds_alternative<rpc::Welcome>(*answer)) return failed("not welcomed");
    SSL_shutdown(tls.get());
    return true;
  }
  std::string why;

 private:
  bool failed(std::string what) {
    why = std::move(what);
    return false;
  }
  static std::optional<rpc::Body> ask(SSL* tls, rpc::Body question) {
    const auto frame = rpc::encode({1, std::move(question)});
    if (!frame || SSL_write(tls, frame->bytes().data(), static_cast<int>(frame->bytes().size())) <= 0)
      return std::nullopt;
    std::array<std::byte, rpc::kLengthSize> head;
    if (!read(tls, head)) return std::nullopt;
    const auto length = rpc::frame_length(head);
    if (!length) return std::nullopt;
    std::vector<std::byte> body(*length);
    if (!read(tls, body)) return std::nullopt;
    auto answer = rpc::decode(body);
    if (!answer) return std::nullopt;
    return std::move(answer->body);
  }
  static bool read(SSL* tls, std::span<std::byte> into) {
    for (std::size_t got = 0; got < into.size();) {
      const int n = SSL_read(tls, into.data() + got, static_cast<int>(into.size() - got));
      if (n <= 0) return false;
      got += static_cast<std::size_t>(n);
    }
    return true;
  }
  io::SocketAddress to_;
  const auth::LocalKeys& keys_;
  SSL_CTX* context_;
};

/// Keys of this user's only server with published keys: the certificate in the handshake names the file.
std::optional<auth::LocalKeys> keys_of(const io::SocketAddress& server) {
  std::optional<auth::LocalKeys> keys;
  SSL_CTX* const context = SSL_CTX_new(TLS_client_method());
  io::Fd fd{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  if (::connect(fd.get(), server.get(), server.size) == 0) {
    SSL* const tls = SSL_new(context);
    const unsigned char alpn[] = "\x08tandem/1";
    SSL_set_alpn_protos(tls, alpn, sizeof alpn - 1);
    SSL_set_fd(tls, fd.get());
    SSL_connect(tls);
    X509* const certificate = SSL_get1_peer_certificate(tls);
    if (certificate != nullptr)
      if (const auto fingerprint = auth::fingerprint_of(certificate))
        if (auto found = auth::find_local_keys(auth::runtime_path(), *fingerprint); found && *found)
          keys.emplace(std::move(**found));
    X509_free(certificate);
    SSL_free(tls);
  }
  SSL_CTX_free(context);
  return keys;
}

// "1000 joins from 127.0.0.2-127.0.0.101: all in; running sessions' ledgers and gates undisturbed." Each join is a
// whole TLS handshake with both keys, a list, a single-use ticket and a Welcome. The clients join as operators,
// because no session has a thousand seats.
TEST(HostileLive, AcceptsEveryJoinOfABurstWithoutDisturbingAHand) {
  const Folder folder;
  const unsigned joins = static_cast<unsigned>(draws(100, 1000, 1000));
  Process host = hosting("one_axis", {"--duration", "600", "--json", folder.file("s.json")});
  Process trainer = client(address_of(host), "trainer", {"--json", folder.file("c.json")});
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  const auto keys = keys_of(udp_of(host));
  ASSERT_TRUE(keys);
  Joiner joiner{udp_of(host), *keys};
  const Time begin = io::monotonic_now();
  unsigned in = 0;
  for (unsigned i = 0; i < joins; ++i) {
    in += joiner.join(2 + i % 100, i * 2) ? 1U : 0U;
    ASSERT_EQ(in, i + 1) << joiner.why;
  }
  std::printf("[ hostile  ] %u joins from 100 addresses in %.2f s\n", in, seconds(io::monotonic_now() - begin));
  host.signal(SIGINT);
  EXPECT_EQ(host.wait(), 0) << host.err();
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  const Json report = folder.json("s.json");
  ASSERT_FALSE(report.is_discarded());
  EXPECT_EQ(report["violations"], Json::array());
  EXPECT_EQ(report["seats"][0]["gate_trips"], 0);
  std::printf("[ hostile  ] the running session meanwhile: rtt p99 %s ms, late ticks %s, loss up %s %%\n",
              report["seats"][0]["link"]["rtt_p99_ms"].dump().c_str(), report["machine"]["late_ticks"].dump().c_str(),
              report["seats"][0]["link"]["up"]["loss_percent"].dump().c_str());
}

/// A client that joined normally and then sends arbitrary messages under its own keys.
class Insider {
 public:
  Insider(const io::SocketAddress& server, const std::string& scene, const std::string& seat) {
    const SceneSpec spec = *parse_scene(find_shipped_scene(scene)->text, scene);
    const auto& own = *std::ranges::find(spec.seats, seat, &SeatSpec::name);
    device_ = std::move(*hal::sim::SimDevice::make({own.device, own.hand, {}, nullptr, io::monotonic_now()}));
    client::JoinOptions asking;
    asking.server = server;
    asking.seat = seat;
    asking.caps = device_->caps();
    asking.timeout = 20s;
    auto given = client::join_seat(asking);
    if (!given) {
      ADD_FAILURE() << given.error().reason;
      return;
    }
    core_.emplace(given->setup, device_->caps(), given->link);
    link_ = given->link;
    codec_.configure(body_layout(given->setup));
    socket_ = std::move(*io::connect_udp(given->udp));
  }
  /// Runs one millisecond as an honest client.
  void tick(bool speaks = true) {
    const Time now = io::monotonic_now();
    std::array<std::byte, 1500> buffer;
    for (ssize_t n; (n = ::recv(socket_.fd.get(), buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
      core_->on_datagram(now, std::span{buffer}.first(static_cast<std::size_t>(n)));
    static_cast<void>(core_->on_servo(now, device_->state()));
    while (const auto size = core_->poll_transmit(now, buffer))
      if (speaks) ::send(socket_.fd.get(), buffer.data(), *size, 0);
  }
  [[nodiscard]] bool runs() const { return core_->force().session == wire::SessionState::kRunning; }

  /// Sends a forged message, sealed correctly; `cut` bytes short.
  template <class Message>
  void say(wire::Type type, const Message& message, std::size_t cut = 0) {
    std::array<std::byte, transport::kDatagramMax> datagram;
    const std::size_t plain =
        codec_.encode({0, 0, 0}, message, std::span{datagram}.subspan(transport::kHeaderSize)) - cut;
    const auto all = std::span{datagram}.first(transport::kHeaderSize + plain + transport::kTagSize);
    transport::write_header({type, 0, link_.peer_cid, counter_}, all.first<transport::kHeaderSize>());
    transport::Aead seal{transport::key_of(link_.secrets.to_server, link_.secrets.cipher)};
    if (seal.seal(counter_++, all)) ::send(socket_.fd.get(), all.data(), all.size(), 0);
  }
  [[nodiscard]] wire::StateMessage honest() const { return core_->sample(); }

 private:
  std::unique_ptr<hal::sim::SimDevice> device_;
  std::optional<client::Seat> core_;
  transport::SecureChannel::Params link_;
  wire::Codec codec_;
  io::UdpSocket socket_;
  std::uint64_t counter_ = 1'000'000;  // newer than all counters of the honest core
};

/// One session with the misbehaving client. Returns whether the gate of the trainer's hand was judged.
bool session_with_insider() {
  const MachineWitness witness;
  const Folder folder;
  Process host = hosting("free_motion", {"--duration", "8", "--json", folder.file("s.json")});
  Process trainer = client(address_of(host), "trainer", {"--json", folder.file("c.json")});
  Insider insider{udp_of(host), "free_motion", "trainee"};
  if (testing::Test::HasFailure()) return true;
  const Time timeout = io::monotonic_now() + 20s;
  while (!insider.runs() && io::monotonic_now() < timeout) {
    insider.tick();
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_TRUE(insider.runs()) << host.err();
  const double wrong[] = {std::numeric_limits<double>::quiet_NaN(), 1e308, std::numeric_limits<double>::infinity(), 100,
                          -100};
  const int milliseconds = static_cast<int>(draws(1500, 4000, 4000));
  for (int ms = 0; ms < milliseconds; ++ms) {
    insider.tick(false);
    for (int k = 0; k < 10; ++k) {  // 10 kHz
      wire::StateMessage m = insider.honest();
      switch ((ms + k) % 4) {
        case 0:
          m.port.x[static_cast<std::size_t>(k) % 3] = wrong[static_cast<std::size_t>(ms) % 5];
          break;
        case 1:
          m.port.f[static_cast<std::size_t>(k) % 3] = wrong[static_cast<std::size_t>(ms) % 3];
          break;
        case 2:
          m.port.v[static_cast<std::size_t>(k) % 3] = wrong[static_cast<std::size_t>(ms) % 3];
          break;
        default:
          break;
      }
      insider.say(wire::Type::kState, m, (ms + k) % 4 == 3 ? 1 + static_cast<std::size_t>(k) : 0);
      wire::AuthorityMessage authority;
      authority.version = static_cast<std::uint32_t>(ms % 8);
      authority.masters = 2;
      authority.alpha = {0, 1};
      insider.say(wire::Type::kAuthority, authority);
      insider.say(wire::Type::kForce, wire::ForceMessage{});
    }
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(trainer.wait(), 0) << trainer.err();
  EXPECT_EQ(host.wait(), 0) << host.err();
  const Json report = folder.json("s.json");
  if (report.is_discarded()) {
    ADD_FAILURE() << host.err();
    return true;
  }
  EXPECT_EQ(report["violations"], Json::array());
  EXPECT_EQ(report["ended_by"], "scene");
  if (witness.machine_stood_still()) return false;
  EXPECT_EQ(report["seats"][0]["gate_trips"], 0) << "the trainer's hand";
  return true;
}

// "Hostile authenticated client: NaN, 1e308, 100 m jumps, 10 kHz, wrong lengths, instructor messages from a trainee":
// only that client is quarantined. The effect on the other hand is measured in virtual time (Insider.*).
TEST(HostileLive, QuarantinesOnlyTheMisbehavingClient) {
  repeat_disturbed("HostileLive, gate of the other hand", session_with_insider);
}

// "Keys in memory: core dumps off": a program that crashes leaves no dump to search. The twin shows that otherwise a
// dump would be written.
TEST(ProcessHardening, WritesNoCoreDumpOfACrash) {
  const Folder folder;
  const auto dumped = [&](bool hide) {
    const pid_t child = fork();
    if (child == 0) {
      const rlimit all{RLIM_INFINITY, RLIM_INFINITY};
      if (chdir(folder.file("").c_str()) != 0 || setrlimit(RLIMIT_CORE, &all) != 0) _exit(3);
      if (hide) io::disable_core_dumps();
      signal(SIGABRT, SIG_DFL);
      abort();
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) && WCOREDUMP(status);
  };
  EXPECT_FALSE(dumped(true));
  if (!dumped(false))
    std::puts("[ NOT RUN ] ProcessHardening, the twin that may be dumped: this system writes no core dumps");
}

// The programs themselves do it first.
TEST(ProcessHardening, IsActiveInServerAndClient) {
#ifdef TANDEM_DEBUG
  GTEST_SKIP() << "builds for debuggers and sanitizers may be dumped";
#else
  const Process host = hosting("one_axis");
  Process trainer = client(address_of(host), "trainer");
  ASSERT_TRUE(trainer.wait_for("the session runs")) << trainer.err();
  for (const pid_t id : {host.id(), trainer.id()}) {
    std::ostringstream limits;
    limits << std::ifstream("/proc/" + std::to_string(id) + "/limits").rdbuf();
    const std::string text = limits.str();
    const auto line = text.find("Max core file size");
    ASSERT_NE(line, std::string::npos);
    std::istringstream words(text.substr(line + 18));
    std::string soft, hard;
    words >> soft >> hard;
    EXPECT_EQ(soft, "0");
    EXPECT_EQ(hard, "0");
  }
#endif
}

}  // namespace
}  // namespace tandem::test
