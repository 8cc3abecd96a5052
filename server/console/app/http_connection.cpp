#include "server/console/app/http_connection.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/io/clock.h"
#include "server/console/app/page_files.h"
#include "server/console/app/sign_in_page.h"
#include "server/console/join_body.h"
#include "server/console/recording_json.h"
#include "server/console/recording_request.h"
#include "server/console/request_rules.h"

namespace tandem::console {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using Response = http::response<http::string_body>;

constexpr std::uint32_t kHeaderMax = 8192;
constexpr std::chrono::seconds kTimeout{10};
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'self'; frame-ancestors 'none'";

// Browsers ask for /favicon.ico where a page names no icon, as the plain texts of refusals.
constexpr std::string_view kIcon = "/assets/icon.svg";

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }
beast::string_view boosted(std::string_view text) { return {text.data(), text.size()}; }

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(WebStream stream, WebState& state, const auth::Origin& from)
      : stream_(std::move(stream)),
        state_(state),
        from_(from),
        slot_(state.http.arrive(from, io::monotonic_now(), [this] { stream_.close(); })) {}
  ~HttpConnection() { state_.http.leave(slot_); }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void start() {
    stream_.lowest().expires_after(kTimeout);
    if (stream_.tls() == nullptr) return read();
    stream_.tls()->async_handshake(boost::asio::ssl::stream_base::server,
                                   [self = shared_from_this()](beast::error_code error) {
                                     if (!error) self->read();
                                   });
  }

 private:
  void read() {
    parser_.emplace();
    parser_->body_limit(kJoinBodyMax);
    parser_->header_limit(kHeaderMax);
    stream_.lowest().expires_after(kTimeout);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error == http::error::body_limit) return self->too_large();
      if (error) return;
      self->request_ = self->parser_->release();
      self->on_request();
    });
  }

  [[nodiscard]] bool host_allowed(std::string_view host) const {
    const HostName split = split_host(host, state_.tls != nullptr ? 443 : 80);
    if (split.name.empty() || split.port != state_.port) return false;
    return is_loopback_name(split.name) || (state_.tls != nullptr && state_.tls->covers(split.name));
  }

  void on_request() {
    state_.http.on_request(slot_);
    const std::string_view host = view(request_[http::field::host]), target = view(request_.target());
    if (!host_allowed(host))
      return answer(http::status::misdirected_request, "open the address that tandem-console printed\n");
    const std::string cookie(cookie_value(view(request_[http::field::cookie]), "tandem"));
    const bool own_origin = origin_allowed(view(request_[http::field::origin]), host, state_.tls != nullptr);
    auto person = state_.gateway.browsers().find(cookie);
    if (person && !person->audience) state_.http.note(from_, io::monotonic_now());
    if (is_upgrade()) return upgrade(target, own_origin, std::move(person), cookie);
    if (request_.method() == http::verb::post) {
      if (target != "/join") return answer(http::status::not_found, "no such address\n");
      if (!own_origin) return answer(http::status::forbidden, "only the page of this gateway may sign in\n");
      return join();
    }
    if (request_.method() != http::verb::get)
      return answer(http::status::method_not_allowed, "only GET, and POST of /join, are supported\n");
    if (target == "/healthz") return health();
    if (target == "/join") return send_sign_in(http::status::ok, {});
    if (target == "/watch") return admit_audience(person != nullptr);
    if (const std::string_view token = token_of(target); !token.empty()) return redeem(token);
    if (is_recording_target(target)) return recordings(person.get(), target);
    // The page has no secret: without a cookie it shows the form for a ticket.
    const std::string_view path = target == "/favicon.ico" ? kIcon : target;
    for (const PageFile& file : page_files())
      if (file.path == path) return send_file(file);
    answer(http::status::not_found, "no such file\n");
  }

  void health() {
    const Gateway::Reach reach = state_.gateway.reach();
    if (reach.kind == Gateway::Reach::Kind::kReached) return answer(http::status::ok, "ok\n");
    answer(http::status::service_unavailable,
           "no connection to a server: " + reach.why +
               (reach.kind == Gateway::Reach::Kind::kGone ? "; a new ticket is needed\n" : "; trying again\n"));
  }

  /// As websocket::is_upgrade, whose header compiles all of WebSocket.
  [[nodiscard]] bool is_upgrade() const {
    return request_.method() == http::verb::get && request_.version() >= 11 &&
           http::token_list{request_[http::field::connection]}.exists("upgrade") &&
           http::token_list{request_[http::field::upgrade]}.exists("websocket");
  }

  void upgrade(std::string_view target, bool own_origin, std::shared_ptr<Person> person, const std::string& cookie) {
    if (target != "/live") return answer(http::status::not_found, "the WebSocket is /live\n");
    if (!own_origin) return answer(http::status::forbidden, "only the page of this gateway may open it\n");
    std::size_t& open = !person ? state_.strangers : person->audience ? state_.audience : state_.live;
    const std::size_t most = !person ? kStrangersMax : person->audience ? state_.gateway.audience_max() : kLiveMax;
    if (open >= most) return answer(http::status::service_unavailable, "too many pages are open already\n");
    stream_.lowest().expires_never();
    state_.http.leave(slot_);
    open_live_socket(std::move(stream_), request_, state_.gateway, state_.sockets, std::move(person), cookie,
                     ConnectionSlot(open));
  }

  /// @param known  the browser has the cookie of a person already, and keeps it
  void admit_audience(bool known) {
    const std::string& secret = state_.gateway.audience_secret();
    if (secret.empty())
      return answer(http::status::not_found, "this gateway has no audience; start it with --audience N\n");
    if (state_.gateway.audience_lost())
      return answer(http::status::service_unavailable,
                    "this gateway has lost its connection to the server; its operator must start it again with a new "
                    "ticket\n");
    if (!known && state_.audience >= state_.gateway.audience_max())
      return answer(http::status::service_unavailable, "the audience is full; try again later\n");
    redirect("/", known ? std::string{} : secret);
  }

  void redeem(std::string_view token) {
    const std::string secret = state_.gateway.redeem(token, io::monotonic_now());
    if (secret.empty())
      return answer(http::status::forbidden,
                    "the token is wrong, used or expired; start tandem-console again and open the URL that it prints, "
                    "or sign in with a ticket at /join\n");
    redirect("/", secret);
  }

  void join() {
    const std::string_view type = view(request_[http::field::content_type]);
    const bool form = !type.starts_with("application/json");
    const auto body = parse_join_body(type, request_.body());
    request_.body().clear();  // it has the ticket
    if (!body) return refuse_join(http::status::bad_request, form, body.error());
    const auto begun = state_.gateway.join(*body, auth::Source::of(from_), io::monotonic_now(),
                                           [self = shared_from_this(), form](const auto& secret) {
                                             if (!secret)
                                               return self->refuse_join(http::status::forbidden, form, secret.error());
                                             if (form) return self->redirect("/", *secret);
                                             self->answer_json(http::status::ok, true, "", *secret);
                                           });
    if (!begun)
      refuse_join(begun.error().busy ? http::status::too_many_requests : http::status::bad_request, form,
                  begun.error().why);
  }

  void recordings(const Person* person, std::string_view target) {
    if (person == nullptr) return answer_problem(http::status::unauthorized, "sign in first");
    if (!Gateway::may_review(*person))
      return answer_problem(http::status::forbidden, "only instructors, evaluators and operators see recordings");
    if (!state_.gateway.has_recordings())
      return answer_problem(http::status::not_found,
                            "this gateway shows no recordings; start it with --recordings DIR, the folder of the "
                            "recordings");
    auto request = parse_recording_request(target);
    if (!request) return answer_problem(http::status::not_found, "there is no such recording");
    const bool asked = state_.gateway.ask_recording(
        std::move(*request), [self = shared_from_this()](const RecordingReply& reply) { self->send_recording(reply); });
    if (!asked)
      answer_problem(http::status::service_unavailable, "too many pages read recordings; try again in a few seconds");
  }

  void send_recording(const RecordingReply& reply) {
    Response response{static_cast<http::status>(reply.status), request_.version()};
    response.set(http::field::content_type, "application/json");
    response.set(http::field::content_encoding, "gzip");
    response.body() = *reply.gzip;
    send(std::move(response));
  }

  void answer_problem(http::status status, std::string_view text) {
    Response response{status, request_.version()};
    response.set(http::field::content_type, "application/json");
    response.body() = problem_json(text);
    send(std::move(response));
  }

  void refuse_join(http::status status, bool form, const std::string& why) {
    if (form) return send_sign_in(status, why);
    answer_json(status, false, why, {});
  }

  void answer_json(http::status status, bool ok, const std::string& text, const std::string& secret) {
    Response response{status, request_.version()};
    response.set(http::field::content_type, "application/json");
    const nlohmann::json body{{"ok", ok}, {"text", text}};
    response.body() = body.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    set_cookie(response, secret);
    send(std::move(response));
  }

  void send_sign_in(http::status status, const std::string& why) {
    Response response{status, request_.version()};
    response.set(http::field::content_type, "text/html; charset=utf-8");
    response.body() = sign_in_page(why);
    send(std::move(response));
  }

  void redirect(const char* target, const std::string& secret) {
    Response response{http::status::see_other, request_.version()};
    response.set(http::field::location, target);
    set_cookie(response, secret);
    send(std::move(response));
  }

  void set_cookie(Response& response, const std::string& secret) const {
    if (secret.empty()) return;
    const char* const secure = state_.tls != nullptr ? "; Secure" : "";
    response.set(http::field::set_cookie, "tandem=" + secret + "; Path=/; HttpOnly; SameSite=Strict" + secure);
  }

  void send_file(const PageFile& file) {
    const bool same = view(request_[http::field::if_none_match]) == file.etag;
    Response response{same ? http::status::not_modified : http::status::ok, request_.version()};
    response.set(http::field::etag, boosted(file.etag));
    response.set(http::field::content_type, boosted(file.type));
    response.set(http::field::content_encoding, "gzip");
    if (!same) response.body() = std::string(file.gzip);
    send(std::move(response));
  }

  void answer(http::status status, std::string_view text) {
    Response response{status, request_.version()};
    response.set(http::field::content_type, "text/plain; charset=utf-8");
    response.body() = text;
    send(std::move(response));
  }

  void too_large() {
    request_ = {};
    request_.version(11);
    request_.keep_alive(false);
    answer(http::status::payload_too_large, "the body must have at most 2048 bytes\n");
  }

  void send(Response response) {
    response.set("Content-Security-Policy", kPolicy);
    response.set("X-Content-Type-Options", "nosniff");
    // `no-referrer` would make browsers send the form of /join with `Origin: null`.
    response.set("Referrer-Policy", "same-origin");
    const bool asset = request_.target().starts_with("/assets/") && response.result() == http::status::ok;
    response.set(http::field::cache_control, asset ? "private, no-cache" : "no-store");
    response.keep_alive(request_.keep_alive());
    response.prepare_payload();
    response_ = std::move(response);
    stream_.lowest().expires_after(kTimeout);
    http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error && self->response_.keep_alive()) return self->read();
      beast::error_code ignored;
      static_cast<void>(self->stream_.lowest().socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored));
    });
  }

  WebStream stream_;
  WebState& state_;
  auth::Origin from_;
  HttpSlots::Id slot_;
  beast::flat_buffer buffer_{kHeaderMax + kJoinBodyMax};
  std::optional<http::request_parser<http::string_body>> parser_;
  Request request_;
  Response response_;
};

}  // namespace

void serve_http(WebStream stream, WebState& state, const auth::Origin& from) {
  std::make_shared<HttpConnection>(std::move(stream), state, from)->start();
}

}  // namespace tandem::console
