#include "netsim/proxy/app/control_socket.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>

namespace tandem::netsim {
namespace {

constexpr std::size_t kRequestBytesMax = 8192;
constexpr std::size_t kAnswerMax = 1 << 20;
constexpr int kAskerMs = 1'000;
constexpr int kAnswerMs = 10'000;

std::expected<sockaddr_un, std::string> address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path) {
    return std::unexpected(path + ": the name of a control socket has 1 to " +
                           std::to_string(sizeof address.sun_path - 1) + " characters");
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

bool connect_to(const io::Fd& fd, const sockaddr_un& address) noexcept {
  return fd.open() && ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

io::Fd stream() noexcept { return io::Fd{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)}; }

/// Reads until `end`, end of stream, or `most` bytes. Returns empty if nothing arrived for `patience_ms` or `stop_fd`
/// became readable.
std::optional<std::string> read_until(int fd, char end, std::size_t most, int patience_ms, int stop_fd = -1) {
  std::string text;
  while (text.size() < most) {
    std::array<pollfd, 2> ready{{{fd, POLLIN, 0}, {stop_fd, POLLIN, 0}}};
    if (::poll(ready.data(), ready.size(), patience_ms) <= 0 || ready[1].revents != 0) return std::nullopt;
    char buffer[4096];
    const auto n = ::read(fd, buffer, sizeof buffer);
    if (n <= 0) break;
    text.append(buffer, static_cast<std::size_t>(n));
    if (const auto at = text.find(end); at != std::string::npos) return text.substr(0, at);
  }
  return text;
}

void write_all(int fd, std::string_view text) noexcept {
  while (!text.empty()) {
    pollfd ready{fd, POLLOUT, 0};
    if (::poll(&ready, 1, kAskerMs) <= 0) return;
    const auto n = ::send(fd, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace

ControlSocket::~ControlSocket() {
  if (fd_.open()) ::unlink(path_.c_str());
}

std::string ControlSocket::open(const std::string& path) {
  const auto address = address_of(path);
  if (!address) return address.error();
  struct stat there{};
  if (::lstat(path.c_str(), &there) == 0) {
    if (!S_ISSOCK(there.st_mode)) return path + ": exists and is not a control socket; choose another name";
    if (connect_to(stream(), *address)) return path + ": another proxy is controlled by it; choose another name";
    ::unlink(path.c_str());  // left behind by an earlier proxy
  }
  io::Fd fd{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)};
  const mode_t before = ::umask(0177);
  const bool bound = fd.open() && ::bind(fd.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) == 0;
  const int error = errno;
  ::umask(before);
  if (!bound || ::listen(fd.get(), 16) != 0) return path + ": " + std::strerror(bound ? errno : error);
  path_ = path;
  fd_ = std::move(fd);
  return {};
}

void ControlSocket::serve(const std::function<std::string(const std::string& line)>& answer) {
  while (true) {
    const io::Fd asker{::accept4(fd_.get(), nullptr, nullptr, SOCK_CLOEXEC)};
    if (!asker.open()) return;
    const auto line = read_until(asker.get(), '\n', kRequestBytesMax, kAskerMs);
    if (line) write_all(asker.get(), answer(*line));
  }
}

std::expected<std::string, std::string> send_control_request(const std::string& path, const std::string& line,
                                                             int stop_fd) {
  const auto address = address_of(path);
  if (!address) return std::unexpected(address.error());
  const io::Fd fd = stream();
  if (!connect_to(fd, *address)) {
    return std::unexpected(path + ": " + std::strerror(errno) + "; start the proxy with --control " + path);
  }
  write_all(fd.get(), line + "\n");
  auto answer = read_until(fd.get(), '\0', kAnswerMax, kAnswerMs, stop_fd);
  pollfd stop{stop_fd, POLLIN, 0};
  if (!answer && ::poll(&stop, 1, 0) > 0) return std::string{};
  if (!answer || answer->empty()) return std::unexpected(path + ": the proxy gave no answer");
  return std::move(*answer);
}

}  // namespace tandem::netsim
