#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

/// A small browser for tests: HTTP and WebSocket to a gateway on loopback. Only web_client.cpp compiles Boost.Beast.
/// Waits are bounded, so that a silent gateway fails the test instead of hanging it.
namespace tandem::test {

using Fields = std::map<std::string, std::string>;  ///< of a header, names in lower case

struct HttpReply {
  unsigned status = 0;  ///< 0: no reply
  Fields fields;
  std::string body;
};

/// Where a gateway listens, and how the browser names it.
struct WebAddress {
  std::uint16_t port = 0;
  bool tls = false;
  std::string host = "127.0.0.1";  ///< in the Host header

  [[nodiscard]] std::string host_header() const { return host + ":" + std::to_string(port); }
  [[nodiscard]] std::string origin() const { return (tls ? "https://" : "http://") + host_header(); }
};

[[nodiscard]] HttpReply http_get(const WebAddress& at, const std::string& target, const Fields& fields = {});
/// @param origin  header Origin; nullopt: none
[[nodiscard]] HttpReply http_post(const WebAddress& at, const std::string& target, const std::string& type,
                                  const std::string& body, const std::optional<std::string>& origin);
/// The cookie that a reply sets, as `tandem=...`; empty: none.
[[nodiscard]] std::string cookie_of(const HttpReply& reply);

/// An open page.
class WebPage {
 public:
  using Json = nlohmann::json;

  /// @param origin       header Origin; empty: that of the page
  /// @param small_buffer  receives at most a few kilobytes that it does not read
  WebPage(const WebAddress& at, const std::string& cookie, const std::string& origin = {}, bool small_buffer = false);
  ~WebPage();
  WebPage(WebPage&&) noexcept;

  /// Status of the upgrade: 101 if the WebSocket is open.
  [[nodiscard]] unsigned status() const;
  /// @return false: the connection is closed
  bool send(const std::string& text);
  bool send(const Json& message) { return send(message.dump()); }
  /// Returns the next message and acknowledges it if it is a state; null: the connection was closed, or 30 s passed.
  [[nodiscard]] Json read();
  static constexpr std::chrono::seconds kTimeout{60};
  /// Reads until a message fulfils the condition, for kTimeout at most. @return it; null: none
  template <class Condition>
  [[nodiscard]] Json until(Condition condition) {
    for (const auto end = std::chrono::steady_clock::now() + kTimeout; std::chrono::steady_clock::now() < end;) {
      Json message = read();
      if (message.is_null() || condition(message)) return message;
    }
    return nullptr;
  }
  /// Reads until a message has this type.
  [[nodiscard]] Json next(const std::string& type) {
    return until([&type](const Json& message) { return message["type"] == type; });
  }
  /// Sends an order and returns its reply.
  [[nodiscard]] Json order(Json message);
  /// Code and reason of the close frame; 0: none came.
  [[nodiscard]] unsigned close_code() const;
  [[nodiscard]] std::string close_reason() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  int next_id_ = 1000;
};

/// Writes a self-signed certificate for `name` (DNS) and 127.0.0.1 with its key.
void write_certificate(const std::string& name, const std::string& certificate, const std::string& key);

}  // namespace tandem::test
