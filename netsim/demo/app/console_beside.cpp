#include "netsim/demo/app/console_beside.h"

#include <utility>

namespace tandem::netsim::demo {

ConsoleBeside::~ConsoleBeside() {
  if (console_) end_all({&*console_, 1});
}

void ConsoleBeside::on_server(const std::string& address) {
  if (server_.empty()) server_ = address;
}

std::optional<std::string> ConsoleBeside::give_up(const std::string& what) {
  over_ = true;
  return "The runs cannot be watched in a browser: " + what + "; see " + (places_.output / kLog).string();
}

std::optional<std::string> ConsoleBeside::start() {
  auto child = ChildProcess::start("tandem-console",
                                   {(places_.programs / "tandem-console").string(), "--server", server_, "--role",
                                    "operator", "--listen", "127.0.0.1:0"},
                                   (places_.output / kLog).string());
  if (!child) return give_up(child.error());
  console_ = std::move(*child);
  return std::nullopt;
}

std::optional<std::string> ConsoleBeside::poll() {
  if (over_ || server_.empty()) return std::nullopt;
  if (!console_) return start();
  if (const std::string url = console_url(console_->output()); !url.empty()) {
    over_ = true;
    return "Watch the runs in a browser, once: " + url;
  }
  if (!console_->running()) return give_up("tandem-console ended");
  return std::nullopt;
}

std::string console_url(const std::string& output) {
  const std::size_t at = output.find("http");
  const std::size_t end = at == std::string::npos ? at : output.find_first_of(" \r\n", at);
  return end == std::string::npos ? "" : output.substr(at, end - at);
}

}  // namespace tandem::netsim::demo
