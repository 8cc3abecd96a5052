// Joins a second over three servers, each by a ticket of its own, from 40 addresses: TLS handshake, ticket, reply,
// close. Servers, clients and etcd share this machine. The reference of the same run are the same servers without a
// directory, which use the tickets up in their own files.
#include <asio.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "common/auth/io/control_stream.h"
#include "common/auth/ticket.h"
#include "common/base/format.h"
#include "common/io/clock.h"
#include "common/io/socket_address.h"
#include "proto/rpc/rpc_codec.h"
#include "tests/bench/service_hosts.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kServers = 3, kAddresses = 40, kAtATime = 24;
constexpr Duration kLength = 8s;
/// Clients that join as consoles and leave, a number of them at a time.
class Crowd {
 public:
  Crowd(const Hosts& hosts, const auth::Identity& workstation)
      : hosts_(hosts), workstation_(workstation), tls_([this](const auth::KeyFingerprint&) { return &workstation_; }) {}

  void run() {
    began_ = io::monotonic_now();
    for (std::size_t i = 0; i < kAtATime; ++i) begin(i);
    context_.run();
    took_ = seconds(io::monotonic_now() - began_);
  }
  [[nodiscard]] double joins_per_second() const { return static_cast<double>(joined_) / took_; }
  [[nodiscard]] std::size_t joined() const { return joined_; }
  [[nodiscard]] const std::string& refusal() const { return refusal_; }
  [[nodiscard]] std::size_t refused() const { return refused_; }

 private:
  void begin(std::size_t place) {
    if (io::monotonic_now() - began_ > kLength) return;
    const std::size_t number = number_++;
    const Host& host = hosts_[number % kServers];
    asio::ip::tcp::socket socket(context_);
    socket.open(asio::ip::tcp::v4());
    socket.set_option(asio::socket_base::linger(true, 0));  // no port stays in TIME_WAIT
    const auto from = asio::ip::make_address_v4(format("127.0.0.%zu", 2 + number % kAddresses));
    socket.bind({from, 0});
    asio::error_code failed;
    socket.connect({asio::ip::make_address_v4("127.0.0.1"), static_cast<std::uint16_t>(host.address.port())}, failed);
    if (failed) return refuse(place, failed.message());
    socket.set_option(asio::ip::tcp::no_delay(true));
    const auto stream =
        auth::ControlStream::make(std::move(socket), tls_.context(), auth::ControlStream::Side::kClient);
    stream->set_deadline(10s);
    stream->handshake([this, place, stream, &host](auth::ControlStream::Peer peer) {
      if (!peer) return refuse(place, peer.error().text);
      ask(place, stream, host);
    });
  }
  void ask(std::size_t place, const std::shared_ptr<auth::ControlStream>& stream, const Host& host) {
    const std::int64_t now = auth::wall_seconds();
    auth::Ticket ticket;
    ticket.ticket_id = auth::random_bytes<auth::Id16>();
    ticket.session_id = host.sessions.front();
    ticket.role = AccessRole::kOperator;
    ticket.workstation = workstation_.fingerprint();
    ticket.not_before = now;
    ticket.not_after = now + 600;
    const auto signed_ticket = auth::sign_ticket(ticket, host.keys->ticket_key());
    if (!signed_ticket) fail(signed_ticket.error());
    rpc::Hello hello;
    hello.session = host.sessions.front();
    hello.credential = rpc::TicketCredential{*signed_ticket};
    hello.client_cid = static_cast<std::uint32_t>(number_);
    stream->write(*rpc::encode({1, hello}), [this, place, stream](std::expected<void, auth::StreamError>) {
      stream->read(rpc::kFrameMax, 10s, [this, place, stream](auth::ControlStream::Bytes bytes) {
        if (!bytes) return refuse(place, bytes.error().text);
        const auto frame = rpc::decode(std::as_const(*bytes).bytes());
        if (!frame || !std::holds_alternative<rpc::Welcome>(frame->body)) {
          const auto* const error = frame ? std::get_if<rpc::ErrorReply>(&frame->body) : nullptr;
          return refuse(place, error == nullptr ? "another reply" : error->text);
        }
        ++joined_;
        stream->close();
        asio::post(context_, [this, place] { begin(place); });
      });
    });
  }
  void refuse(std::size_t place, const std::string& why) {
    ++refused_;
    refusal_ = why;
    asio::post(context_, [this, place] { begin(place); });
  }

  const Hosts& hosts_;
  const auth::Identity& workstation_;
  asio::io_context context_;
  auth::ClientTls tls_;
  Time began_{};
  double took_ = 0;
  std::size_t number_ = 0, joined_ = 0, refused_ = 0;
  std::string refusal_;
};

double measure(const char* what, const std::string& folder, const auth::Identity& workstation,
               const test::EtcdCluster* etcd) {
  const Hosts hosts({folder, kServers, 1}, workstation, etcd);
  Crowd crowd(hosts, workstation);
  crowd.run();
  std::printf("%-34s %7.0f joins/s, %zu refused%s%s\n", what, crowd.joins_per_second(), crowd.refused(),
              crowd.refused() > 0 ? ": " : "", crowd.refusal().c_str());
  std::fflush(stdout);
  return crowd.joins_per_second();
}

int run() {
  if (test::etcd_program("etcd").empty()) {
    std::printf("[ NOT RUN ] etcd is not installed (Debian: etcd-server)\n");
    return 0;
  }
  std::string folder = (std::filesystem::temp_directory_path() / "tandem-joins-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) fail("no temporary folder");
  const auth::Identity workstation = make_workstation();
  const double alone = measure("three servers, each alone", folder + "/alone", workstation, nullptr);
  double service = 0;
  {
    const test::EtcdCluster etcd(3);
    service = measure("three servers, three etcd", folder + "/service", workstation, &etcd);
  }
  std::printf("service / alone = %.2f (asked: at least 200 joins/s over three servers, etcd's transactions included)\n",
              service / alone);
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace tandem::bench

int main() { return tandem::bench::run(); }
