// The only source that compiles Boost.Beast.
#include "server/console/app/web_server.h"

#include <unistd.h>

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstring>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "common/io/clock.h"
#include "server/console/acknowledgement_window.h"
#include "server/console/app/connection_slot.h"
#include "server/console/app/page_files.h"
#include "server/console/app/random_secret.h"
#include "server/console/browser_frame.h"
#include "server/console/live_json.h"
#include "server/console/one_time_token.h"
#include "server/console/request_rules.h"

namespace tandem::console {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;
namespace websocket = beast::websocket;
using Tcp = net::ip::tcp;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

constexpr std::size_t kConnectionsMax = 64, kQueueMax = 64, kBodyMax = 4096;
constexpr std::uint32_t kHeaderMax = 8192;
constexpr std::chrono::milliseconds kStatePeriod{16};
constexpr std::chrono::seconds kHttpTimeout{10}, kWriteTimeout{5}, kTokenLife{600};
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }
beast::string_view boosted(std::string_view text) { return {text.data(), text.size()}; }

class LiveSocket;

/// State that all connections share.
struct Shared {
  LiveSource& source;
  std::string release;
  std::uint16_t port = 0;
  OneTimeToken token;
  BrowserCookies cookies{};
  std::size_t connections = 0;
  std::set<LiveSocket*> sockets{};
};

/// The WebSocket of one page.
class LiveSocket : public std::enable_shared_from_this<LiveSocket> {
 public:
  LiveSocket(Tcp::socket socket, Shared& shared, ConnectionSlot slot)
      : stream_(std::move(socket)), shared_(shared), slot_(std::move(slot)) {
    shared_.sockets.insert(this);
  }
  ~LiveSocket() { shared_.sockets.erase(this); }
  LiveSocket(const LiveSocket&) = delete;
  LiveSocket& operator=(const LiveSocket&) = delete;

  void start(const Request& request) {
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.read_message_max(kFrameMax);
    stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->opened();
    });
  }

  /// Called 60 times per second.
  void on_period(std::chrono::steady_clock::time_point now, const LivePicture* picture) {
    if (!open_) return;
    if (now - second_ >= std::chrono::seconds{1}) {
      second_ = now;
      frames_ = 0;
    }
    if (writing_ && now - write_begin_ > kWriteTimeout) return drop();  // the browser stalled
    if (picture == nullptr) return;
    if (picture->connected != connected_) {
      connected_ = picture->connected;
      send(notice_json(connected_ ? "info" : "error", connected_
                                                          ? "the connection to the server is back"
                                                          : "the connection to the server was lost; trying again"));
    }
    send_events(picture->status);
    send_state(picture->status);
  }

  void drop() {
    open_ = false;
    beast::get_lowest_layer(stream_).cancel();
    beast::get_lowest_layer(stream_).close();
  }

 private:
  void opened() {
    open_ = true;
    const LivePicture picture = shared_.source.newest();
    connected_ = picture.connected;
    send(hello_json(picture.status, picture.role, shared_.release));
    send(scene_json(picture.status));
    if (!connected_) send(notice_json("error", "the connection to the server was lost; trying again"));
    send_events(picture.status);
    send_state(picture.status);
    read();
  }

  void send_events(const rpc::Status& status) {
    if (!status.events.empty() && status.events.back().number < event_) event_ = 0;  // another run of the session
    for (const rpc::StatusEvent& event : status.events) {
      if (event.number <= event_) continue;
      event_ = event.number;
      send(event_json(status.session_id, event));
    }
  }

  void send_state(const rpc::Status& status) {
    if (!queue_.empty()) return window_.drop();
    const std::uint64_t n = window_.next();
    if (n == 0) return;
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    send(
        state_json(status, n, window_.dropped(), std::chrono::duration_cast<std::chrono::microseconds>(since).count()));
  }

  void send(std::string text) {
    if (!open_) return;
    if (queue_.size() >= kQueueMax) return drop();
    queue_.push_back(std::move(text));
    if (!writing_) write();
  }

  void write() {
    writing_ = true;
    write_begin_ = std::chrono::steady_clock::now();
    stream_.text(true);
    stream_.async_write(net::buffer(queue_.front()), [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->writing_ = false;
      self->queue_.pop_front();
      if (error) return self->drop();
      if (self->open_ && !self->queue_.empty()) self->write();
    });
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || !self->open_) {
        self->open_ = false;
        return;
      }
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      if (!self->stream_.got_text()) return self->close("send text frames");
      if (++self->frames_ > kFramesPerSecond) return self->close("more than 120 frames within one second");
      self->on_frame(text);
      if (self->open_) self->read();
    });
  }

  void close(const char* why) {
    open_ = false;
    if (writing_) return drop();  // a close frame must not overtake a message
    stream_.async_close({websocket::close_code::policy_error, why}, [self = shared_from_this()](beast::error_code) {});
  }

  void on_frame(const std::string& text) {
    const LivePicture picture = shared_.source.newest();
    auto frame = parse_browser_frame(text, picture.role, picture.status.session_id);
    if (!frame) {
      if (frame.error().close) return close("the frame is no JSON object");
      return send(reply_json(frame.error().id, false, frame.error().text));
    }
    if (const auto* ack = std::get_if<Ack>(&*frame)) {
      if (!window_.acknowledge(ack->n)) send(reply_json({}, false, "\"n\" names a state that was never sent"));
    } else if (const auto* watch = std::get_if<Watch>(&*frame)) {
      const bool known = watch->session == session_hex(picture.status.session_id);
      send(reply_json(watch->id, known, known ? "" : "unknown session; choose one of the message hello"));
      if (known) send(scene_json(picture.status));
    } else if (auto* order = std::get_if<Order>(&*frame)) {
      const auto id = order->id;
      const auto reply = [weak = weak_from_this(), executor = stream_.get_executor(), id](bool ok, std::string said) {
        net::post(executor, [weak, id, ok, said = std::move(said)] {
          if (const auto self = weak.lock()) self->send(reply_json(id, ok, said));
        });
      };
      if (!shared_.source.order(std::move(order->body), reply))
        send(reply_json(id, false, "16 orders already wait for the server; repeat this one in a second"));
    }
  }

  websocket::stream<beast::tcp_stream> stream_;
  Shared& shared_;
  ConnectionSlot slot_;
  beast::flat_buffer buffer_;
  std::deque<std::string> queue_;  ///< at most kQueueMax; the first one is being written
  AcknowledgementWindow window_;
  std::chrono::steady_clock::time_point second_{}, write_begin_{};
  unsigned frames_ = 0;
  std::uint32_t event_ = 0;
  bool open_ = false, writing_ = false, connected_ = true;
};

/// One HTTP connection.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Tcp::socket socket, Shared& shared)
      : stream_(std::move(socket)), shared_(shared), slot_(shared.connections) {}

  void read() {
    parser_.emplace();
    parser_->body_limit(kBodyMax);
    parser_->header_limit(kHeaderMax);
    stream_.expires_after(kHttpTimeout);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) self->on_request(self->parser_->release());
    });
  }

 private:
  void on_request(const Request& request) {
    const std::string_view host = view(request[http::field::host]);
    const std::string_view target = view(request.target());
    if (!host_allowed(host, shared_.port))
      return answer(request, http::status::misdirected_request, "open the address that tandem-console printed\n");
    const bool known = shared_.cookies.contains(cookie_value(view(request[http::field::cookie]), "tandem"));
    if (websocket::is_upgrade(request)) {
      if (target != "/live") return answer(request, http::status::not_found, "the WebSocket is /live\n");
      if (!known || !origin_allowed(view(request[http::field::origin]), host))
        return answer(request, http::status::forbidden, "open the URL that tandem-console printed\n");
      stream_.expires_never();
      std::make_shared<LiveSocket>(stream_.release_socket(), shared_, std::move(slot_))->start(request);
      return;
    }
    if (request.method() != http::verb::get)
      return answer(request, http::status::method_not_allowed, "only GET is supported\n");
    if (target == "/healthz") return answer(request, http::status::ok, "ok\n");
    if (const std::string_view token = token_of(target); !token.empty()) return redeem(request, token);
    if (!known)
      return answer(request, http::status::forbidden,
                    "this browser has no access; start tandem-console again and open the URL that it prints\n");
    for (const PageFile& file : page_files())
      if (file.path == target) return page(request, file);
    answer(request, http::status::not_found, "no such file\n");
  }

  void redeem(const Request& request, std::string_view token) {
    if (!shared_.token.redeem(token, io::monotonic_now()))
      return answer(
          request, http::status::forbidden,
          "the token is wrong, used or expired; start tandem-console again and open the URL that it prints\n");
    const std::string secret = random_secret();
    shared_.cookies.add(secret);
    Response response{http::status::see_other, request.version()};
    response.set(http::field::location, "/");
    response.set(http::field::set_cookie, "tandem=" + secret + "; Path=/; HttpOnly; SameSite=Strict");
    send(request, std::move(response));
  }

  void page(const Request& request, const PageFile& file) {
    const bool same = view(request[http::field::if_none_match]) == file.etag;
    Response response{same ? http::status::not_modified : http::status::ok, request.version()};
    response.set(http::field::etag, boosted(file.etag));
    response.set(http::field::content_type, boosted(file.type));
    response.set(http::field::content_encoding, "gzip");
    if (!same) response.body() = std::string(file.gzip);
    send(request, std::move(response));
  }

  void answer(const Request& request, http::status status, const char* text) {
    Response response{status, request.version()};
    response.set(http::field::content_type, "text/plain; charset=utf-8");
    response.body() = text;
    send(request, std::move(response));
  }

  void send(const Request& request, Response response) {
    response.set("Content-Security-Policy", kPolicy);
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    const bool asset = request.target().starts_with("/assets/") && response.result() == http::status::ok;
    response.set(http::field::cache_control, asset ? "private, no-cache" : "no-store");
    response.keep_alive(request.keep_alive());
    response.prepare_payload();
    response_ = std::move(response);
    http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error && self->response_.keep_alive()) return self->read();
      beast::error_code ignored;
      self->stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
    });
  }

  beast::tcp_stream stream_;
  Shared& shared_;
  ConnectionSlot slot_;
  beast::flat_buffer buffer_{kHeaderMax + kBodyMax};
  std::optional<http::request_parser<http::string_body>> parser_;
  Response response_;
};

/// Accepts connections and wakes the WebSockets.
class WebServer {
 public:
  WebServer(net::io_context& context, Tcp::acceptor acceptor, Shared& shared, int signals)
      : context_(context),
        acceptor_(std::move(acceptor)),
        shared_(shared),
        timer_(context),
        signals_(context, signals) {
    accept();
    wait();
    signals_.async_wait(net::posix::stream_descriptor::wait_read, [this](beast::error_code) { context_.stop(); });
  }

 private:
  void accept() {
    acceptor_.async_accept([this](beast::error_code error, Tcp::socket socket) {
      if (error) {  // out of descriptors: accept again at the next period
        retry_ = true;
        return;
      }
      if (shared_.connections < kConnectionsMax) std::make_shared<HttpConnection>(std::move(socket), shared_)->read();
      accept();
    });
  }

  void wait() {
    timer_.expires_after(kStatePeriod);
    timer_.async_wait([this](beast::error_code error) {
      if (error) return;
      if (std::exchange(retry_, false)) accept();
      std::optional<LivePicture> picture;
      if (!shared_.sockets.empty() && shared_.source.number() != number_) {
        picture = shared_.source.newest();
        number_ = picture->number;
      }
      const auto now = std::chrono::steady_clock::now();
      std::vector<std::shared_ptr<LiveSocket>> sockets;  // a call may end a socket
      for (LiveSocket* socket : shared_.sockets)
        if (auto held = socket->weak_from_this().lock()) sockets.push_back(std::move(held));
      for (const auto& socket : sockets) socket->on_period(now, picture ? &*picture : nullptr);
      wait();
    });
  }

  net::io_context& context_;
  Tcp::acceptor acceptor_;
  Shared& shared_;
  net::steady_timer timer_;
  net::posix::stream_descriptor signals_;
  std::uint64_t number_ = 0;
  bool retry_ = false;
};

}  // namespace

std::expected<void, std::string> run_web_server(const WebOptions& options, LiveSource& source,
                                                const std::function<void(const std::string& url)>& started) {
  const std::string secret = random_secret();
  Shared shared{source, options.release, 0, OneTimeToken{secret, io::monotonic_now() + kTokenLife}};
  {
    net::io_context context{1};
    Tcp::endpoint endpoint;
    std::memcpy(endpoint.data(), options.listen.get(), options.listen.size);
    endpoint.resize(options.listen.size);
    beast::error_code error;
    Tcp::acceptor acceptor{context};
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(net::socket_base::reuse_address{true}, error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(net::socket_base::max_listen_connections, error);
    if (error)
      return std::unexpected("--listen: " + io::to_text(options.listen) + " cannot be opened: " + error.message() +
                             "; choose another port, or 0 for a free one");
    shared.port = acceptor.local_endpoint().port();
    const std::string host = endpoint.protocol() == Tcp::v6() ? "[::1]" : "127.0.0.1";
    WebServer server(context, std::move(acceptor), shared, ::dup(options.signals));
    started("http://" + host + ":" + std::to_string(shared.port) + "/?token=" + secret);
    context.run();
  }
  return {};
}

}  // namespace tandem::console
