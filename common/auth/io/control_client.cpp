#include "common/auth/io/control_client.h"

#include <unistd.h>

#include <algorithm>
#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <chrono>
#include <cstring>

#include "proto/rpc/rpc_codec.h"

namespace tandem::auth {

struct ControlClient::State {
  State(ClientTls::IdentityCallback judge, int interruption) : tls(std::move(judge)), signals(context) {
    if (interruption < 0) return;
    signals.assign(::dup(interruption));  // asio closes the descriptor it is given
    signals.async_wait(asio::posix::stream_descriptor::wait_read, [this](const asio::error_code& error) {
      if (error) return;
      interrupted = true;
      if (stream) stream->close();
    });
  }
  ~State() {
    if (stream) stream->close();
    asio::error_code ignored;
    signals.close(ignored);
    context.restart();
    context.poll();  // runs the cancelled handlers
  }

  /// Runs until `done`. @return false: a signal arrived first
  bool run(const bool& done) {
    context.restart();
    while (!done && !interrupted && context.run_one() > 0) {
    }
    return !interrupted;
  }
  [[nodiscard]] ClientError fault_of(const StreamError& fault) const {
    if (interrupted) return {ClientError::Kind::kInterrupted, StreamErrorCode::kStopped, "interrupted"};
    if (!tls.rejection().empty()) return {ClientError::Kind::kRefusedKey, fault.end, tls.rejection()};
    return {ClientError::Kind::kStream, fault.end, fault.text};
  }

  ClientTls tls;
  asio::io_context context{1};
  asio::posix::stream_descriptor signals;
  std::shared_ptr<ControlStream> stream;
  bool interrupted = false;
  KeyFingerprint server;
  std::uint32_t request = 0;
};

ControlClient::ControlClient(std::unique_ptr<State> state) : state_(std::move(state)) {}
ControlClient::~ControlClient() = default;
ControlClient::ControlClient(ControlClient&&) noexcept = default;
ControlClient& ControlClient::operator=(ControlClient&&) noexcept = default;

int ControlClient::fd() const noexcept { return state_->stream->socket().native_handle(); }

const KeyFingerprint& ControlClient::server() const noexcept { return state_->server; }

std::expected<Secret<kExportSize>, std::string> ControlClient::export_secrets(const ExporterContext& context) {
  return state_->stream->export_secrets(context);
}

std::expected<ControlClient, ClientError> ControlClient::connect(const io::SocketAddress& server,
                                                                 ClientTls::IdentityCallback judge, Duration timeout,
                                                                 int signals) {
  const auto begin = std::chrono::steady_clock::now();
  auto state = std::make_unique<State>(std::move(judge), signals);
  asio::ip::tcp::endpoint to;
  to.resize(server.size);
  std::memcpy(to.data(), server.get(), server.size);
  asio::ip::tcp::socket socket(state->context);
  asio::steady_timer deadline(state->context, timeout);
  bool done = false, late = false;
  asio::error_code failed;
  deadline.async_wait([&](const asio::error_code& error) {
    if (error) return;
    late = true;
    asio::error_code ignored;
    socket.close(ignored);
  });
  socket.async_connect(to, [&](const asio::error_code& error) {
    failed = error;
    done = true;
  });
  const bool undisturbed = state->run(done);
  deadline.cancel();
  if (!undisturbed) {
    asio::error_code ignored;
    socket.close(ignored);
    state->context.restart();
    state->context.poll();  // the handlers above use variables of this frame
    return std::unexpected(state->fault_of({}));
  }
  state->context.restart();
  state->context.poll();
  const std::string where = io::to_text(server);
  if (failed)
    return std::unexpected(ClientError{
        ClientError::Kind::kUnreachable, StreamErrorCode::kNetwork,
        where + (late ? " does not answer; check the address and the firewalls"
                      : " cannot be reached: " + failed.message() + "; check that tandem-server runs there"),
        failed == asio::error::connection_refused});
  asio::error_code ignored;
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  state->stream = ControlStream::make(std::move(socket), state->tls.context(), ControlStream::Side::kClient);
  const auto left = timeout - (std::chrono::steady_clock::now() - begin);
  state->stream->set_deadline(
      std::max(std::chrono::duration_cast<Duration>(left), Duration{std::chrono::milliseconds(1)}));
  done = false;
  ControlStream::Peer peer = std::unexpected(StreamError{});
  state->stream->handshake([&](ControlStream::Peer got) {
    peer = std::move(got);
    done = true;
  });
  if (!state->run(done)) {
    state->stream->close();
    state->context.restart();
    state->context.poll();
    return std::unexpected(state->fault_of({}));
  }
  if (!peer) return std::unexpected(state->fault_of(peer.error()));
  state->stream->clear_deadline();
  state->server = *peer;
  return ControlClient(std::move(state));
}

std::expected<rpc::Body, ClientError> ControlClient::ask(const rpc::Body& body, Duration timeout) {
  State& s = *state_;
  auto frame = rpc::encode({++s.request, body});
  if (!frame)
    return std::unexpected(ClientError{ClientError::Kind::kBadFrame, {}, std::string(rpc::to_text(frame.error()))});
  struct Exchange {
    bool done = false;
    std::expected<rpc::Frame, ClientError> answer = std::unexpected(ClientError{});
  };
  // Shared, because after an interruption the callbacks run late.
  const auto exchange = std::make_shared<Exchange>();
  const auto finish = [exchange](std::expected<rpc::Frame, ClientError> answer) {
    exchange->answer = std::move(answer);
    exchange->done = true;
  };
  s.stream->set_deadline(timeout);
  s.stream->write(std::move(*frame), [&s, finish](std::expected<void, StreamError> written) {
    // A server that rejects writes its reason and closes. The reply is read even if the write failed.
    (void)written;
    s.stream->read(rpc::kFrameMax, ControlStream::Duration::zero(), [&s, finish](ControlStream::Bytes bytes) {
      if (!bytes) return finish(std::unexpected(s.fault_of(bytes.error())));
      auto got = rpc::decode(std::as_const(*bytes).bytes());
      if (!got)
        return finish(std::unexpected(
            ClientError{ClientError::Kind::kBadFrame,
                        {},
                        "the server's answer cannot be read: " + std::string(rpc::to_text(got.error()))}));
      finish(std::move(*got));
    });
  });
  if (!s.run(exchange->done)) return std::unexpected(s.fault_of({}));
  s.stream->clear_deadline();
  if (!exchange->answer) return std::unexpected(exchange->answer.error());
  // An ErrorReply under number 0: the server rejected the connection before it read the request.
  const bool ours = exchange->answer->request == s.request ||
                    (exchange->answer->request == 0 && std::holds_alternative<rpc::ErrorReply>(exchange->answer->body));
  if (!ours)
    return std::unexpected(
        ClientError{ClientError::Kind::kBadFrame, {}, "the server's reply does not match the request"});
  return std::move(exchange->answer->body);
}

}  // namespace tandem::auth
