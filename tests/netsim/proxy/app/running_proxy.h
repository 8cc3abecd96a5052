#pragma once

#include <poll.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "netsim/proxy/app/proxy.h"
#include "tests/netsim/proxy/app/udp_peer.h"

namespace tandem::netsim::test {

/// Proxy that runs in its own thread.
class Running {
 public:
  explicit Running(const ProxyOptions& options) {
    auto opened = Proxy::open(options);
    if (!opened) throw std::runtime_error(opened.error());
    proxy_ = std::move(*opened);
    thread_ = std::thread([this] { proxy_->run(); });
  }
  Running(const io::SocketAddress& to, const LinkSpec& link, const std::string& listen = "127.0.0.1:0",
          Duration idle_limit = std::chrono::seconds(60))
      : Running(options(to, link, listen, idle_limit)) {}
  ~Running() { end(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  static ProxyOptions options(const io::SocketAddress& to, const LinkSpec& link,
                              const std::string& listen = "127.0.0.1:0",
                              Duration idle_limit = std::chrono::seconds(60)) {
    ProxyOptions options;
    options.listen = *io::parse_address(listen, 0);
    options.to = to;
    options.link = link;
    options.idle_limit = idle_limit;
    return options;
  }
  void end() {
    if (!thread_.joinable()) return;
    proxy_->stop();
    thread_.join();
  }
  Proxy& operator*() { return *proxy_; }
  Proxy* operator->() { return proxy_.get(); }

  /// Waits until the published status fulfils `condition`.
  /// @return whether it did
  bool wait_until(const std::function<bool(const ProxyStatus&)>& condition) {
    for (int i = 0; i < UdpPeer::kPatienceMs / 10; ++i) {
      if (condition(proxy_->status())) return true;
      ::poll(nullptr, 0, 10);
    }
    return false;
  }
  /// @return whether the packet thread executed the request
  bool carry_out(ProxyRequest& order) {
    if (!proxy_->post(order)) return false;
    for (int i = 0; i < UdpPeer::kPatienceMs && !order.done; ++i) ::poll(nullptr, 0, 1);
    return order.done;
  }

 private:
  std::unique_ptr<Proxy> proxy_;
  std::thread thread_;
};

}  // namespace tandem::netsim::test
