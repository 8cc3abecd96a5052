#include "common/auth/io/control_stream.h"

#include <openssl/err.h>
#include <openssl/ssl.h>

#include <asio/read.hpp>
#include <asio/write.hpp>

#include "proto/rpc/rpc_codec.h"

namespace tandem::auth {

ControlStream::ControlStream(asio::ip::tcp::socket socket, asio::ssl::context& context, Side side)
    : stream_(ByteLimitedSocket(std::move(socket)), context),
      side_(side),
      deadline_(stream_.get_executor()),
      frame_deadline_(stream_.get_executor()) {}

std::shared_ptr<ControlStream> ControlStream::make(asio::ip::tcp::socket socket, asio::ssl::context& context,
                                                   Side side) {
  return std::shared_ptr<ControlStream>(new ControlStream(std::move(socket), context, side));
}

void ControlStream::set_deadline(Duration from_now, std::function<void()> late) {
  deadline_.expires_after(from_now);
  deadline_.async_wait([self = weak_from_this(), late = std::move(late)](const asio::error_code& error) {
    const auto stream = self.lock();
    if (error || !stream) return;
    stream->late_ = true;
    stream->drop();
    if (late) late();
  });
}

void ControlStream::clear_deadline() { deadline_.cancel(); }

void ControlStream::drop() {
  asio::error_code ignored;
  stream_.next_layer().socket().close(ignored);
}

StreamError ControlStream::fault(const asio::error_code& error, bool in_handshake) {
  if (stopped_) return {StreamErrorCode::kStopped, "the connection was closed here"};
  if (late_)
    return {StreamErrorCode::kDeadline,
            in_handshake ? "no answer in time; check that a Tandem server runs there" : "the other side took too long"};
  if (error == asio::error::no_buffer_space && stream_.next_layer().used_up())
    return {StreamErrorCode::kTooMuch, "the other side sent more than it may"};
  const bool tls = error.category() == asio::error::get_ssl_category();
  if (in_handshake && (tls || error == asio::error::eof || error == asio::ssl::error::stream_truncated))
    return {StreamErrorCode::kHandshake,
            tls ? "no TLS 1.3 connection with the parameters of Tandem: " + error.message()
                : "the other side ended the connection before the TLS handshake was complete"};
  if (error == asio::error::eof || error == asio::ssl::error::stream_truncated ||
      error == asio::error::connection_reset || error == asio::error::broken_pipe)
    return {StreamErrorCode::kClosed, "the other side ended the connection"};
  // An alert after the handshake: with TLS 1.3 the client learns only now that the server rejected its key.
  if (tls) return {StreamErrorCode::kHandshake, "the other side refused: " + error.message()};
  return {StreamErrorCode::kNetwork, error.message()};
}

void ControlStream::handshake(std::function<void(Peer)> done) {
  const auto type = side_ == Side::kServer ? asio::ssl::stream_base::server : asio::ssl::stream_base::client;
  stream_.async_handshake(type, [self = shared_from_this(), done = std::move(done)](const asio::error_code& error) {
    if (error) return done(std::unexpected(self->fault(error, true)));
    auto peer = authenticated_peer(self->stream_.native_handle());
    if (!peer) return done(std::unexpected(StreamError{StreamErrorCode::kHandshake, std::move(peer.error())}));
    done(*peer);
  });
}

void ControlStream::read(std::size_t frame_max, Duration frame_deadline, const std::function<void(Bytes)>& done) {
  // The first byte may arrive at any time; the frame deadline applies to the rest of the frame.
  auto body = [self = shared_from_this(), frame_max, done](const asio::error_code& error, std::size_t) {
    if (error) {
      self->frame_deadline_.cancel();
      return done(std::unexpected(self->fault(error)));
    }
    const auto length = rpc::frame_length(self->head_, frame_max);
    if (!length) {
      self->frame_deadline_.cancel();
      return done(std::unexpected(StreamError{StreamErrorCode::kLength, std::string(rpc::to_text(length.error()))}));
    }
    self->in_ = SecretBuffer(*length);
    asio::async_read(self->stream_, asio::buffer(self->in_.bytes().data(), self->in_.size()),
                     [self, done](const asio::error_code& e, std::size_t) {
                       self->frame_deadline_.cancel();
                       if (e) return done(std::unexpected(self->fault(e)));
                       done(std::exchange(self->in_, SecretBuffer()));
                     });
  };
  auto first = [self = shared_from_this(), frame_deadline, body = std::move(body), done](const asio::error_code& error,
                                                                                         std::size_t) {
    if (error) return done(std::unexpected(self->fault(error)));
    if (frame_deadline > Duration::zero()) {
      self->frame_deadline_.expires_after(frame_deadline);
      self->frame_deadline_.async_wait([weak = std::weak_ptr(self)](const asio::error_code& cancelled) {
        const auto stream = weak.lock();
        if (cancelled || !stream) return;
        stream->late_ = true;
        stream->drop();
      });
    }
    asio::async_read(self->stream_, asio::buffer(self->head_.data() + 1, self->head_.size() - 1), body);
  };
  asio::async_read(stream_, asio::buffer(head_.data(), 1), std::move(first));
}

void ControlStream::write(SecretBuffer frame, std::function<void(std::expected<void, StreamError>)> done) {
  out_ = std::move(frame);
  asio::async_write(stream_, asio::buffer(std::as_const(out_).bytes().data(), out_.size()),
                    [self = shared_from_this(), done = std::move(done)](const asio::error_code& error, std::size_t) {
                      self->out_ = SecretBuffer();
                      if (error) return done(std::unexpected(self->fault(error)));
                      done({});
                    });
}

void ControlStream::close() {
  if (stopped_) return;
  stopped_ = true;
  deadline_.cancel();
  frame_deadline_.cancel();
  drop();
}

}  // namespace tandem::auth
