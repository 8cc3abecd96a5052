#include "common/trust/io/control_client.h"

#include <unistd.h>

#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <cstring>

#include "proto/control_codec.h"

namespace tandem::trust {

struct ControlClient::State {
  State(ClientTls::Judge judge, int interruption) : tls(std::move(judge)), signals(context) {
    if (interruption < 0) return;
    signals.assign(::dup(interruption));  // asio closes what it is given
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
    context.poll();  // lets what was cancelled go
  }

  /// Runs until `done`. @return false: a signal came first
  bool run(const bool& done) {
    context.restart();
    while (!done && !interrupted && context.run_one() > 0) {
    }
    return !interrupted;
  }
  [[nodiscard]] ClientFault fault_of(const StreamFault& fault) const {
    if (interrupted) return {ClientFault::Kind::kInterrupted, StreamEnd::kStopped, "interrupted"};
    if (!tls.refusal().empty()) return {ClientFault::Kind::kRefusedKey, fault.end, tls.refusal()};
    return {ClientFault::Kind::kStream, fault.end, fault.text};
  }

  ClientTls tls;
  asio::io_context context{1};
  asio::posix::stream_descriptor signals;
  std::shared_ptr<ControlStream> stream;
  bool interrupted = false;
  Pin server;
  std::uint32_t request = 0;
};

ControlClient::ControlClient(std::unique_ptr<State> state) : state_(std::move(state)) {}
ControlClient::~ControlClient() = default;
ControlClient::ControlClient(ControlClient&&) noexcept = default;
ControlClient& ControlClient::operator=(ControlClient&&) noexcept = default;

int ControlClient::fd() const noexcept { return state_->stream->socket().native_handle(); }

const Pin& ControlClient::server() const noexcept { return state_->server; }

std::expected<Secret<kExportSize>, std::string> ControlClient::export_secrets(const LinkContext& context) { return state_->stream->export_secrets(context); }

std::expected<ControlClient, ClientFault> ControlClient::connect(const io::SocketAddress& server, ClientTls::Judge judge, Duration patience, int signals) {
  auto state = std::make_unique<State>(std::move(judge), signals);
  asio::ip::tcp::endpoint to;
  to.resize(server.size);
  std::memcpy(to.data(), server.get(), server.size);
  asio::ip::tcp::socket socket(state->context);
  asio::steady_timer patient(state->context, patience);
  bool done = false, late = false;
  asio::error_code failed;
  patient.async_wait([&](const asio::error_code& error) {
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
  patient.cancel();
  if (!undisturbed) {
    asio::error_code ignored;
    socket.close(ignored);
    state->context.restart();
    state->context.poll();  // the handlers above look at this frame's variables
    return std::unexpected(state->fault_of({}));
  }
  state->context.restart();
  state->context.poll();
  const std::string where = io::to_text(server);
  if (failed)
    return std::unexpected(ClientFault{ClientFault::Kind::kUnreachable, StreamEnd::kTrouble,
                                       where + (late ? " does not answer; is the address right, does a firewall stand between?"
                                                     : " cannot be reached: " + failed.message() + "; does tandem-server run there?")});
  asio::error_code ignored;
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  state->stream = ControlStream::make(std::move(socket), state->tls.context(), ControlStream::Side::kClient);
  state->stream->set_deadline(patience);
  done = false;
  ControlStream::Peer peer = std::unexpected(StreamFault{});
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

std::expected<control::Body, ClientFault> ControlClient::ask(const control::Body& body, Duration patience) {
  State& s = *state_;
  auto frame = control::encode({++s.request, body});
  if (!frame) return std::unexpected(ClientFault{ClientFault::Kind::kBadFrame, {}, std::string(control::to_text(frame.error()))});
  struct Exchange {
    bool done = false;
    std::expected<control::Frame, ClientFault> answer = std::unexpected(ClientFault{});
  };
  // Shared: after an interruption the callbacks come late.
  const auto exchange = std::make_shared<Exchange>();
  const auto finish = [exchange](std::expected<control::Frame, ClientFault> answer) {
    exchange->answer = std::move(answer);
    exchange->done = true;
  };
  s.stream->set_deadline(patience);
  s.stream->write(std::move(*frame), [&s, finish](std::expected<void, StreamFault> written) {
    // A server that refuses writes its reason and closes: it is read even when our bytes found no taker any more.
    (void)written;
    s.stream->read(control::kFrameMax, ControlStream::Duration::zero(), [&s, finish](ControlStream::Bytes bytes) {
      if (!bytes) return finish(std::unexpected(s.fault_of(bytes.error())));
      auto got = control::decode(std::as_const(*bytes).bytes());
      if (!got)
        return finish(std::unexpected(ClientFault{ClientFault::Kind::kBadFrame, {}, "the server's answer cannot be read: " + std::string(control::to_text(got.error()))}));
      finish(std::move(*got));
    });
  });
  if (!s.run(exchange->done)) return std::unexpected(s.fault_of({}));
  s.stream->clear_deadline();
  if (!exchange->answer) return std::unexpected(exchange->answer.error());
  // Refused under number 0: the server did not get as far as reading ours.
  const bool ours = exchange->answer->request == s.request || (exchange->answer->request == 0 && std::holds_alternative<control::Refused>(exchange->answer->body));
  if (!ours)
    return std::unexpected(ClientFault{ClientFault::Kind::kBadFrame, {}, "the server answered another question than was asked"});
  return std::move(exchange->answer->body);
}

}  // namespace tandem::trust
