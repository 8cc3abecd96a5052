#include "server/console/app/web_server.h"

#include <openssl/ssl.h>
#include <unistd.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

#include "common/io/clock.h"
#include "server/console/app/http_connection.h"

namespace tandem::console {
namespace {

namespace net = boost::asio;
using Error = boost::system::error_code;
using Tcp = net::ip::tcp;

constexpr std::chrono::milliseconds kPeriod{50};
constexpr int kSendBuffer = 65536;  // of a connection [bytes]: a slow browser gets few old states

auth::Origin origin_of(const net::ip::address& address) {
  return address.is_v4() ? auth::Origin::v4(address.to_v4().to_uint())
                         : auth::Origin::of_v6(address.to_v6().to_bytes());
}

/// TLS 1.2 and 1.3 with OpenSSL's own choice of ciphers, without compression and renegotiation.
net::ssl::context tls_context(const TlsFiles& files) {
  net::ssl::context context{net::ssl::context::tls_server};
  SSL_CTX_set_min_proto_version(context.native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_options(context.native_handle(), SSL_OP_NO_COMPRESSION | SSL_OP_NO_RENEGOTIATION);
  context.use_certificate_chain_file(files.certificate());
  context.use_private_key_file(files.key(), net::ssl::context::pem);
  return context;
}

/// Accepts connections and wakes the WebSockets.
class WebServer {
 public:
  WebServer(net::io_context& context, Tcp::acceptor acceptor, WebState& state, net::ssl::context* tls, int signals)
      : context_(context),
        acceptor_(std::move(acceptor)),
        state_(state),
        tls_(tls),
        timer_(context),
        signals_(context, signals) {
    accept();
    wait();
    signals_.async_wait(net::posix::stream_descriptor::wait_read, [this](Error) { context_.stop(); });
  }

  void on_news() {
    state_.gateway.on_news();
    each([](LiveSocket& socket) { socket.on_news(); });
  }

 private:
  void accept() {
    acceptor_.async_accept([this](Error error, Tcp::socket socket) {
      if (error) {  // out of descriptors: accept again at the next period
        retry_ = true;
        return;
      }
      if (const Tcp::endpoint from = socket.remote_endpoint(error); !error) serve(std::move(socket), from.address());
      accept();
    });
  }

  void serve(Tcp::socket socket, const net::ip::address& from) {
    Error ignored;
    static_cast<void>(socket.set_option(Tcp::no_delay{true}, ignored));
    static_cast<void>(socket.set_option(net::socket_base::send_buffer_size{kSendBuffer}, ignored));
    boost::beast::tcp_stream plain(std::move(socket));
    serve_http(tls_ != nullptr ? WebStream(std::move(plain), *tls_) : WebStream(std::move(plain)), state_,
               origin_of(from));
  }

  void wait() {
    timer_.expires_after(kPeriod);
    timer_.async_wait([this](Error error) {
      if (error) return;
      if (std::exchange(retry_, false)) accept();
      const auto now = std::chrono::steady_clock::now();
      each([now](LiveSocket& socket) { socket.on_period(now); });
      if (++periods_ % 20 == 0) state_.gateway.on_second(io::monotonic_now());
      wait();
    });
  }

  /// A call may end a socket.
  template <class Call>
  void each(Call call) {
    std::vector<std::shared_ptr<LiveSocket>> sockets;
    for (LiveSocket* socket : state_.sockets)
      if (auto held = socket->weak_from_this().lock()) sockets.push_back(std::move(held));
    for (const auto& socket : sockets) call(*socket);
  }

  net::io_context& context_;
  Tcp::acceptor acceptor_;
  WebState& state_;
  net::ssl::context* tls_;
  net::steady_timer timer_;
  net::posix::stream_descriptor signals_;
  std::uint64_t periods_ = 0;
  bool retry_ = false;
};

std::expected<Tcp::acceptor, std::string> open_port(net::io_context& context, const io::SocketAddress& listen) {
  Tcp::endpoint endpoint;
  std::memcpy(endpoint.data(), listen.get(), listen.size);
  endpoint.resize(listen.size);
  Error error;
  Tcp::acceptor acceptor{context};
  static_cast<void>(acceptor.open(endpoint.protocol(), error));
  if (!error) static_cast<void>(acceptor.set_option(net::socket_base::reuse_address{true}, error));
  if (!error) static_cast<void>(acceptor.bind(endpoint, error));
  if (!error) static_cast<void>(acceptor.listen(net::socket_base::max_listen_connections, error));
  if (error)
    return std::unexpected("--listen: " + io::to_text(listen) + " cannot be opened: " + error.message() +
                           "; choose another port, or 0 for a free one");
  return acceptor;
}

std::string url_of(const WebOptions& options, std::uint16_t port) {
  std::string host = options.listen.family() == AF_INET6 ? "[::1]" : "127.0.0.1";
  if (options.tls && !options.listen.loopback()) host = options.tls->name();
  return (options.tls ? "https://" : "http://") + host + ":" + std::to_string(port) + "/";
}

}  // namespace

std::expected<void, std::string> run_web_server(
    const WebOptions& options, GatewayLinks links,
    const std::function<void(const std::string& url, const std::string& token)>& started) {
  const auto mailbox = std::make_shared<Mailbox>();
  const auto waiting = std::make_shared<std::atomic<bool>>(false);  // many pictures, one call
  const auto server = std::make_shared<WebServer*>(nullptr);        // of the web thread
  const auto news = [mailbox, waiting, server] {
    if (waiting->exchange(true)) return;
    mailbox->post([waiting, server] {
      waiting->store(false);
      if (*server != nullptr) (*server)->on_news();
    });
  };
  Gateway gateway(options.gateway, std::move(links), mailbox, news);
  WebState state{gateway, options.tls ? &*options.tls : nullptr, HttpSlots(kHttpMax + gateway.audience_max())};
  std::optional<net::ssl::context> tls;
  if (options.tls) tls.emplace(tls_context(*options.tls));
  net::io_context context{1};  // ends before what its connections refer to
  auto acceptor = open_port(context, options.listen);
  if (!acceptor) return std::unexpected(acceptor.error());
  state.port = acceptor->local_endpoint().port();
  mailbox->connect([&context](Mailbox::Work work) { net::post(context, std::move(work)); });
  waiting->store(false);  // pictures before this had no receiver
  {
    WebServer web(context, std::move(*acceptor), state, tls ? &*tls : nullptr, ::dup(options.signals));
    *server = &web;
    started(url_of(options, state.port), gateway.has_token() ? gateway.make_token(io::monotonic_now()) : std::string{});
    context.run();
    *server = nullptr;
  }
  mailbox->connect({});
  gateway.abandon_requests();
  return {};
}

}  // namespace tandem::console
