// gRPC: one stream per client in both directions, by its callback interface; sealed by TLS.
#include <grpcpp/grpcpp.h>
#include <peer_messages.grpc.pb.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <future>
#include <mutex>
#include <string>

#include "common/auth/tls_key.h"
#include "common/io/clock.h"
#include "tests/bench/peers/peer.h"
#include "tests/bench/udp_load.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;
using peers::Sample;

std::string text_of(const SecretBuffer& secret) {
  const auto bytes = secret.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Certificate that the clients trust.
struct Identity {
  auth::TlsKey key = auth::TlsKey::generate();
  std::string certificate =
      auth::Certificate::self_signed(key, "peers", std::array<std::byte, 16>{std::byte{1}}, std::time(nullptr))
          .to_pem();
};

class EchoStream final : public grpc::ServerBidiReactor<Sample, Sample> {
 public:
  explicit EchoStream(std::size_t down) { answer_.mutable_body()->resize(down), StartRead(&asked_); }
  void OnReadDone(bool good) override {
    if (!good) return Finish(grpc::Status::OK);
    std::memcpy(answer_.mutable_body()->data(), asked_.body().data(), std::min(asked_.body().size(), sizeof(Mark)));
    StartWrite(&answer_);
  }
  void OnWriteDone(bool good) override {
    if (good) StartRead(&asked_);
  }
  void OnDone() override { delete this; }

 private:
  Sample asked_, answer_;
};

class EchoService final : public peers::Loop::CallbackService {
 public:
  explicit EchoService(std::size_t down) : down_(down) {}
  grpc::ServerBidiReactor<Sample, Sample>* Exchange(grpc::CallbackServerContext*) override {
    return new EchoStream(down_);
  }

 private:
  std::size_t down_;
};

/// Collects answers of gRPC's threads, with the time of their arrival.
class Answers {
 public:
  void add(Duration loop) {
    const std::lock_guard lock(mutex_);
    loops_.push_back(loop);
  }
  void take(std::vector<Duration>& into) {
    into.clear();
    const std::lock_guard lock(mutex_);
    std::swap(into, loops_);
  }

 private:
  std::mutex mutex_;
  std::vector<Duration> loops_;
};

/// One client. gRPC takes one write at a time: a message during a write waits, and a newer one replaces it.
class ClientStream final : public grpc::ClientBidiReactor<Sample, Sample> {
 public:
  ClientStream(peers::Loop::Stub& stub, const SendTimes& times, Answers& answers) : times_(times), answers_(answers) {
    stub.async()->Exchange(&context_, this);
    StartRead(&answer_);
    StartCall();
  }
  ~ClientStream() override {
    context_.TryCancel();
    over_.get_future().wait();
  }
  ClientStream(const ClientStream&) = delete;
  ClientStream& operator=(const ClientStream&) = delete;
  void OnDone(const grpc::Status&) override { over_.set_value(); }

  void send(const std::vector<std::byte>& message) {
    const std::lock_guard lock(mutex_);
    next_.assign(reinterpret_cast<const char*>(message.data()), message.size());
    if (writing_) return void(waits_ = true);
    write();
  }
  void OnWriteDone(bool good) override {
    const std::lock_guard lock(mutex_);
    writing_ = false;
    if (good && std::exchange(waits_, false)) write();
  }
  void OnReadDone(bool good) override {
    if (!good) return;
    const auto& body = answer_.body();
    times_.hear({reinterpret_cast<const std::byte*>(body.data()), body.size()},
                [this](Duration loop, Duration) { answers_.add(loop); });
    StartRead(&answer_);
  }

 private:
  void write() {
    message_.set_body(next_);
    writing_ = true;
    StartWrite(&message_);
  }

  const SendTimes& times_;
  Answers& answers_;
  grpc::ClientContext context_;
  std::mutex mutex_;
  std::string next_;
  bool writing_ = false, waits_ = false;
  Sample message_, answer_;
  std::promise<void> over_;
};

class GrpcClients final : public PeerClients {
 public:
  GrpcClients(const Exchange& exchange, std::uint16_t port, const Identity& identity)
      : times_(exchange), message_(exchange.up) {
    grpc::ChannelArguments own;
    own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // a connection per client, as different computers have
    own.SetSslTargetNameOverride("peers");
    grpc::SslCredentialsOptions trusted;
    trusted.pem_root_certs = identity.certificate;
    const auto credentials = exchange.sealed ? grpc::SslCredentials(trusted) : grpc::InsecureChannelCredentials();
    for (std::size_t c = 0; c < exchange.clients; ++c) {
      const auto channel = grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(port), credentials, own);
      if (!channel->WaitForConnected(std::chrono::system_clock::now() + 20s))
        throw std::runtime_error("not all clients got through");
      stubs_.push_back(peers::Loop::NewStub(channel));
      streams_.push_back(std::make_unique<ClientStream>(*stubs_.back(), times_, answers_));
    }
  }
  void send(std::size_t client) override {
    times_.stamp(client, message_);
    streams_[client]->send(message_);
  }
  void receive(Time until, const Heard& heard) override {
    UdpLoad::pause_until(until.time_since_epoch());
    answers_.take(taken_);
    for (const Duration loop : taken_) heard(loop, {});
  }

 private:
  SendTimes times_;
  std::vector<std::byte> message_;
  Answers answers_;
  std::vector<Duration> taken_;
  std::vector<std::unique_ptr<peers::Loop::Stub>> stubs_;
  std::vector<std::unique_ptr<ClientStream>> streams_;
};

class GrpcPeer final : public Peer {
 public:
  explicit GrpcPeer(const Exchange& exchange) : exchange_(exchange) {}
  void serve(const std::function<void(std::uint16_t)>& ready) override {
    EchoService service(exchange_.down);
    grpc::SslServerCredentialsOptions options;
    options.pem_key_cert_pairs.push_back({text_of(identity_.key.to_pem()), identity_.certificate});
    int port = 0;
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0",
                             exchange_.sealed ? grpc::SslServerCredentials(options) : grpc::InsecureServerCredentials(),
                             &port);
    builder.RegisterService(&service);
    const auto server = builder.BuildAndStart();
    if (!server || port == 0) throw std::runtime_error("gRPC cannot listen");
    ready(static_cast<std::uint16_t>(port));
    server->Wait();
  }
  std::unique_ptr<PeerClients> connect(std::uint16_t port) override {
    return std::make_unique<GrpcClients>(exchange_, port, identity_);
  }

 private:
  Exchange exchange_;
  Identity identity_;
};

}  // namespace

std::unique_ptr<Peer> make_peer(const Exchange& exchange) { return std::make_unique<GrpcPeer>(exchange); }

}  // namespace tandem::bench
