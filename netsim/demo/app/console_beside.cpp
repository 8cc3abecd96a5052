#include "netsim/demo/app/console_beside.h"

#include <utility>

namespace tandem::netsim::demo {

ConsoleBeside::~ConsoleBeside() {
  for (auto* child : {&builder_, &console_})
    if (*child) end_all({&**child, 1});
}

void ConsoleBeside::on_server(const std::string& address) {
  if (!server_.empty()) return;
  server_ = address;
  if (build_.empty()) return;
  auto child = ChildProcess::start(
      "ninja", {"/usr/bin/env", "nice", "-n", "19", "ninja", "-C", build_, "-j", "1", "tandem-console"},
      (places_.output / kBuildLog).string());
  if (child) builder_ = std::move(*child);
}

std::optional<std::string> ConsoleBeside::give_up(const std::string& what, const char* log) {
  over_ = true;
  return "The runs cannot be watched in a browser: " + what + "; see " + (places_.output / log).string();
}

std::optional<std::string> ConsoleBeside::start() {
  auto child = ChildProcess::start("tandem-console",
                                   {(places_.programs / "tandem-console").string(), "--server", server_, "--role",
                                    "operator", "--listen", "127.0.0.1:0"},
                                   (places_.output / kLog).string());
  if (!child) return give_up(child.error(), kBuildLog);
  console_ = std::move(*child);
  return std::nullopt;
}

std::optional<std::string> ConsoleBeside::poll() {
  if (over_ || server_.empty()) return std::nullopt;
  if (builder_) {
    if (builder_->running()) return std::nullopt;
    const bool built = builder_->exit_code() == 0;
    builder_.reset();
    if (!built) return give_up("tandem-console was not built", kBuildLog);
  }
  if (!console_) return start();
  if (const std::string url = console_url(console_->output()); !url.empty()) {
    over_ = true;
    return "Watch the runs in a browser, once: " + url;
  }
  if (!console_->running()) return give_up("tandem-console ended", kLog);
  return std::nullopt;
}

std::string console_url(const std::string& output) {
  const std::size_t at = output.find("http");
  const std::size_t end = at == std::string::npos ? at : output.find_first_of(" \r\n", at);
  return end == std::string::npos ? "" : output.substr(at, end - at);
}

}  // namespace tandem::netsim::demo
