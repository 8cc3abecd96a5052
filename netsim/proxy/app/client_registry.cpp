#include "netsim/proxy/app/client_registry.h"

#include <utility>

namespace tandem::netsim {
namespace {

/// Silence after which a new port of the same host counts as a reconnect. A client sends hundreds of datagrams per
/// second, so a longer silence means that it closed its socket. A server frees a seat after the same time.
constexpr Duration kReconnects{2'000'000'000};
constexpr std::size_t kReportsMax = 1024;

}  // namespace

ClientRegistry::ClientRegistry(ProxyCore& core, ProxyClients& clients, ClientDelays& delays, ProxyErrors& errors,
                               const ProxyOptions& options)
    : core_(core),
      clients_(clients),
      delays_(delays),
      errors_(errors),
      idle_limit_(options.idle_limit),
      pool_(core, options.link, options.monitor_quality) {
  departed_.reserve(kReportsMax);
  if (options.monitor_quality) monitored_.reserve(ProxyCore::kClientsMax);
}

std::optional<std::uint32_t> ClientRegistry::identify(const sockaddr_storage& from, const io::LocalAddress& local,
                                                      Duration now) noexcept {
  const io::PeerKey key = io::PeerKey::of(from);
  auto found = clients_.find(key);
  if (!found) found = admit(key, from, local, now);
  if (found) clients_[*found].last_seen = clients_[*found].last_heard = now;
  return found;
}

std::optional<std::uint32_t> ClientRegistry::admit(const io::PeerKey& key, const sockaddr_storage& from,
                                                   const io::LocalAddress& local, Duration now) noexcept {
  // A reconnecting client uses a new port; it keeps the number that commands and reports use.
  if (const auto back = clients_.find_silent(from, now - kReconnects); back && clients_.move(*back, key, from, local))
    return back;
  if (core_.clients().size() == ProxyCore::kClientsMax) {
    ++errors_.too_many_clients;
    return std::nullopt;
  }
  // Prepared by an ordinary thread, which also frees it.
  ClientPool::PreparedClient* const prepared = pool_.next();
  const auto place = core_.add_client(prepared != nullptr ? &prepared->link : nullptr);
  std::unique_ptr<LinkMonitor> monitor = prepared != nullptr ? std::move(prepared->monitor) : nullptr;
  if (prepared != nullptr) pool_.give_back(prepared);
  const std::uint64_t number = core_.clients().seen();
  if (!clients_.add(*place, number, key, from, local)) {
    core_.remove_client(*place);
    ++errors_.other;
    return std::nullopt;
  }
  clients_[*place].arrived = now;
  if (monitored_.size() < monitored_.capacity()) {
    monitored_.push_back({number, monitor ? std::move(monitor) : std::make_unique<LinkMonitor>()});
    core_.attach_monitor(*place, monitored_.back().monitor.get());
  }
  delays_.clear(*place);
  return place;
}

void ClientRegistry::maintain(Duration now) noexcept {
  for (std::uint32_t place = 0; place < ProxyClients::kMax; ++place) {
    const ProxyClients::Client& client = clients_[place];
    const std::uint64_t in_flight =
        core_.counters(place, Direction::kUp).in_flight() + core_.counters(place, Direction::kDown).in_flight();
    if (client.present && now - client.last_seen >= idle_limit_ && in_flight == 0) remove(place, now);
    if (client.former.open() && core_.clients().dead(Time{now}, place, client.former_number))
      clients_.close_former(place);
  }
}

void ClientRegistry::remove(std::uint32_t place, Duration now) noexcept {
  if (departed_.size() < kReportsMax) {
    departed_.push_back(status_of(place, now));
    departed_.back().present = false;
  }
  departed_drops_ += clients_.kernel_drops(place);
  core_.remove_client(place);
  clients_.remove(place);
}

ProxyClientStatus ClientRegistry::status_of(std::uint32_t place, Duration now) const noexcept {
  const ProxyClients::Client& client = clients_[place];
  return {client.number,
          place,
          client.address.storage,
          client.present,
          client.arrived,
          clients_.kernel_drops(place),
          {core_.counters(place, Direction::kUp), core_.counters(place, Direction::kDown)},
          {core_.queue_wait(Time{now}, place, Direction::kUp), core_.queue_wait(Time{now}, place, Direction::kDown)}};
}

void ClientRegistry::fill(ProxyStatus& status, Duration now) const noexcept {
  status.clients = 0;
  status.clients_seen = core_.clients().seen();
  status.errors.kernel_drops = clients_.kernel_drops() + departed_drops_;
  for (std::uint32_t place = 0; place < ProxyClients::kMax; ++place) {
    if (!clients_[place].present) continue;
    ProxyClientStatus& client = status.client[status.clients++];
    client = status_of(place, now);
    status.errors.kernel_drops += client.kernel_drops;
  }
}

std::vector<ProxyClientStatus> ClientRegistry::reports(Duration now) const {
  std::vector<ProxyClientStatus> reports = departed_;
  for (std::uint32_t place = 0; place < ProxyClients::kMax; ++place) {
    if (clients_[place].present) reports.push_back(status_of(place, now));
  }
  return reports;
}

std::vector<ProxyClientQuality> ClientRegistry::qualities() const {
  std::vector<ProxyClientQuality> qualities;
  for (const MonitoredClient& client : monitored_) qualities.push_back({client.number, client.monitor->summary()});
  return qualities;
}

}  // namespace tandem::netsim
