#include "client/app/plot_stream.h"

#include <sys/socket.h>

#include <utility>

namespace tandem::client {

std::expected<PlotStream, std::string> PlotStream::open(const io::SocketAddress& to, Time now, Duration unix_now) {
  auto socket = io::connect_udp(to);
  if (!socket) return std::unexpected(socket.error());
  return PlotStream(std::move(*socket), to, now, unix_now);
}

double PlotStream::timestamp(Time now) const noexcept {
  return std::chrono::duration<double>(unix_began_ + (now - began_)).count();
}

void PlotStream::send(Time now, std::string_view json) noexcept {
  last_ = now;
  if (::send(socket_.fd.get(), json.data(), json.size(), MSG_NOSIGNAL | MSG_DONTWAIT) ==
      static_cast<ssize_t>(json.size())) {
    ++sent_;
  } else {
    ++dropped_;
  }
}

}  // namespace tandem::client
