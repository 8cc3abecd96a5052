#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "tests/io/programs.h"
#include "tests/io/web_client.h"

namespace tandem::test {

/// A running gateway, and the browser that opened its URL.
struct WebGateway {
  Process process;
  WebAddress at;
  std::string token;   ///< of the printed URL
  std::string cookie;  ///< after `open_url`

  /// @param server  its address
  explicit WebGateway(const std::string& server, Words more = {}, bool tls = false)
      : WebGateway(started(server, std::move(more)), "/join\n", tls) {}
  /// @param last  end of the line with the URL
  WebGateway(Process running, const std::string& last, bool tls) : process(std::move(running)) {
    process.wait_for(last);
    const std::string mark = tls ? "https://" : "http://";
    std::string url = process.after("once: " + mark);
    if (url.empty()) url = process.after("sign in with a ticket: " + mark);
    const auto colon = url.rfind(':'), slash = url.find('/');
    if (colon == std::string::npos || slash == std::string::npos || slash < colon) return;
    at = {static_cast<std::uint16_t>(std::stoul(url.substr(colon + 1, slash - colon - 1))), tls, url.substr(0, colon)};
    if (const auto found = url.find("token="); found != std::string::npos) token = url.substr(found + 6);
  }
  static Process started(const std::string& server, Words more) {
    Words command{TANDEM_CONSOLE, "--server", server};
    if (std::ranges::find(more, "--listen") == more.end()) command.insert(command.end(), {"--listen", "127.0.0.1:0"});
    command.insert(command.end(), more.begin(), more.end());
    return Process(std::move(command));
  }
  void open_url() {
    const HttpReply reply = http_get(at, "/?token=" + token);
    EXPECT_EQ(reply.status, 303U) << process.err();
    cookie = cookie_of(reply);
    EXPECT_FALSE(cookie.empty());
  }
  [[nodiscard]] WebPage page() const { return WebPage(at, cookie); }
};

/// A state in which a condition holds; null: none came.
template <class Condition>
WebPage::Json state_where(WebPage& page, Condition condition) {
  return page.until([&](const Json& message) { return message["type"] == "state" && condition(message); });
}

}  // namespace tandem::test
