#include "tests/io/web_client.h"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "server/console/app/web_stream.h"

namespace tandem::test {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;
namespace websocket = beast::websocket;
using console::WebStream;
using nlohmann::json;

constexpr std::chrono::seconds kLimit{30};

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// One connection with its own loop.
struct Line {
  net::io_context context;
  net::ssl::context tls{net::ssl::context::tls_client};
  std::optional<WebStream> stream;

  explicit Line(const WebAddress& at, bool small_buffer = false) {
    beast::tcp_stream plain(context);
    net::ip::tcp::socket& socket = plain.socket();
    beast::error_code error;
    socket.open(net::ip::tcp::v4(), error);
    if (small_buffer) socket.set_option(net::socket_base::receive_buffer_size{2048}, error);
    socket.connect({net::ip::address_v4::loopback(), at.port}, error);
    if (error) return;
    if (!at.tls) {
      stream.emplace(std::move(plain));
      return;
    }
    stream.emplace(std::move(plain), tls);
    SSL_ctrl(stream->tls()->native_handle(), SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name,
             const_cast<char*>(at.host.c_str()));
    bool good = false;
    stream->tls()->async_handshake(net::ssl::stream_base::client, [&good](beast::error_code e) { good = !e; });
    run();
    if (!good) stream.reset();
  }
  /// Runs until all operations are done, at most for the limit. @return whether they are
  bool run() {
    context.restart();
    context.run_for(kLimit);
    return context.stopped();
  }
};

HttpReply exchange(const WebAddress& at, http::request<http::string_body> request, const Fields& fields) {
  Line line(at);
  HttpReply reply;
  if (!line.stream) return reply;
  request.version(11);
  request.set(http::field::host, at.host_header());
  request.keep_alive(false);
  for (const auto& [name, value] : fields) request.set(name, value);
  request.prepare_payload();
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  bool good = false;
  http::async_write(*line.stream, request, [&](beast::error_code error, std::size_t) {
    if (error) return;
    http::async_read(*line.stream, buffer, response, [&](beast::error_code e, std::size_t) { good = !e; });
  });
  if (!line.run() || !good) return reply;
  reply.status = response.result_int();
  for (const auto& field : response) reply.fields[lower(std::string(field.name_string()))] = std::string(field.value());
  reply.body = response.body();
  return reply;
}

}  // namespace

HttpReply http_get(const WebAddress& at, const std::string& target, const Fields& fields) {
  return exchange(at, {http::verb::get, target, 11}, fields);
}

HttpReply http_post(const WebAddress& at, const std::string& target, const std::string& type, const std::string& body,
                    const std::optional<std::string>& origin) {
  http::request<http::string_body> request{http::verb::post, target, 11};
  request.body() = body;
  Fields fields{{"Content-Type", type}};
  if (origin) fields["Origin"] = *origin;
  return exchange(at, std::move(request), fields);
}

std::string cookie_of(const HttpReply& reply) {
  const auto found = reply.fields.find("set-cookie");
  return found == reply.fields.end() ? std::string{} : found->second.substr(0, found->second.find(';'));
}

struct WebPage::State {
  std::unique_ptr<Line> line;
  std::optional<websocket::stream<WebStream>> socket;
  beast::flat_buffer buffer;
  unsigned status = 0;
  bool open = false;
};

WebPage::WebPage(const WebAddress& at, const std::string& cookie, const std::string& origin, bool small_buffer)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.line = std::make_unique<Line>(at, small_buffer);
  if (!state.line->stream) return;
  state.socket.emplace(std::move(*state.line->stream));
  state.socket->set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    request.set(http::field::origin, origin.empty() ? at.origin() : origin);
    if (!cookie.empty()) request.set(http::field::cookie, cookie);
  }));
  websocket::response_type response;
  state.socket->async_handshake(response, at.host_header(), "/live",
                                [&state](beast::error_code error) { state.open = !error; });
  state.line->run();
  state.status = response.result_int();
}

WebPage::~WebPage() = default;
WebPage::WebPage(WebPage&&) noexcept = default;

unsigned WebPage::status() const { return state_->status; }

bool WebPage::send(const std::string& text) {
  State& state = *state_;
  if (!state.open) return false;
  bool good = false;
  state.socket->text(true);
  state.socket->async_write(net::buffer(text), [&good](beast::error_code error, std::size_t) { good = !error; });
  if (!state.line->run() || !good) state.open = false;
  return state.open;
}

WebPage::Json WebPage::read() {
  State& state = *state_;
  if (!state.open) return nullptr;
  bool good = false;
  state.buffer.clear();
  state.socket->async_read(state.buffer, [&good](beast::error_code error, std::size_t) { good = !error; });
  if (!state.line->run() || !good) {
    state.open = false;
    return nullptr;
  }
  json message = json::parse(beast::buffers_to_string(state.buffer.data()), nullptr, false);
  if (message.is_discarded()) return nullptr;
  if (message["type"] == "state") send(json{{"type", "ack"}, {"n", message["n"]}});
  return message;
}

WebPage::Json WebPage::order(Json message) {
  const int id = next_id_++;
  message["type"] = "order";
  message["id"] = id;
  send(message);
  return until([id](const Json& said) { return said["type"] == "reply" && said["id"] == id; });
}

unsigned WebPage::close_code() const { return state_->socket ? state_->socket->reason().code : 0; }
std::string WebPage::close_reason() const {
  return state_->socket ? std::string(state_->socket->reason().reason.c_str()) : std::string{};
}

void write_certificate(const std::string& name, const std::string& certificate, const std::string& key) {
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> pair{EVP_EC_gen("P-256"), &EVP_PKEY_free};
  const std::unique_ptr<X509, decltype(&X509_free)> x509{X509_new(), &X509_free};
  ASN1_INTEGER_set(X509_get_serialNumber(x509.get()), 1);
  X509_set_version(x509.get(), 2);
  X509_gmtime_adj(X509_getm_notBefore(x509.get()), -60);
  X509_gmtime_adj(X509_getm_notAfter(x509.get()), 3600);
  X509_set_pubkey(x509.get(), pair.get());
  X509_NAME_add_entry_by_txt(X509_get_subject_name(x509.get()), "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>("tandem"), -1, -1, 0);
  X509_set_issuer_name(x509.get(), X509_get_subject_name(x509.get()));
  const std::string names = "DNS:" + name + ",IP:127.0.0.1";
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, names.c_str());
  X509_add_ext(x509.get(), extension, -1);
  X509_EXTENSION_free(extension);
  X509_sign(x509.get(), pair.get(), EVP_sha256());
  const auto write = [](const std::string& path, auto put) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{std::fopen(path.c_str(), "w"), &std::fclose};
    if (!file || put(file.get()) != 1) throw std::runtime_error("cannot write " + path);
  };
  write(certificate, [&](std::FILE* file) { return PEM_write_X509(file, x509.get()); });
  write(key,
        [&](std::FILE* file) { return PEM_write_PrivateKey(file, pair.get(), nullptr, nullptr, 0, nullptr, nullptr); });
}

}  // namespace tandem::test
