#include "server/app/control/server_keys.h"

#include "common/io/udp_socket.h"

namespace tandem::server {

std::expected<auth::ServerKeystore, std::string> open_server_keys(const io::SocketAddress& listen,
                                                                  const std::string& state) {
  const std::int64_t now = auth::wall_seconds();
  if (state.empty() && listen.loopback()) return auth::ServerKeystore::ephemeral(now);
  const auto path = auth::server_state_path(state);
  if (!path) return std::unexpected("--state: " + path.error());
  auto trust = auth::ServerKeystore::open(*path);
  if (!trust) return std::unexpected(trust.error());
  const auto book = trust->registry().workstations();
  if (!book) return std::unexpected(book.error());
  const auto codes = trust->registry().pending_codes(now);
  if (!codes) return std::unexpected(codes.error());
  // A member of a service gets the lists from the others.
  if (!listen.loopback() && book->empty() && *codes == 0 && trust->membership() == nullptr)
    return std::unexpected("no client could join: no workstation is enrolled in " + *path +
                           ". Run `tandem-server enroll" + auth::server_state_option(*path) +
                           " NAME --address HOST:PORT` for each, then start again");
  return trust;
}

std::vector<std::string> problems_with_keys(const io::SocketAddress& listen, const std::string& state) {
  if (state.empty() && listen.loopback()) return {};
  const auto path = auth::server_state_path(state);
  if (!path) return {path.error()};
  auto wrong = auth::ServerKeystore::find_errors(*path);
  if (!wrong.empty()) return wrong;
  const auto trust = open_server_keys(listen, state);
  return trust ? std::vector<std::string>{} : std::vector{trust.error()};
}

/// Tries a free port, because a running server may use the configured one.
std::string problem_with_address(const io::SocketAddress& listen) {
  const std::string host = io::to_text(listen);
  const auto free = io::parse_address(host.substr(0, host.rfind(':')) + ":0", 0);
  if (!free) return free.error();
  const auto socket = io::bind_udp(*free);
  return socket ? std::string()
                : "this computer cannot listen there: " + socket.error() +
                      "; use one of its own addresses (`ip address`), 0.0.0.0 for all, or 127.0.0.1";
}

}  // namespace tandem::server
