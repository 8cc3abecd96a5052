
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "netsim/proxy/app/proxy.h"

namespace tandem::netsim {
namespace {

constexpr Duration kHousekeeping{200'000'000};
/// Maximum reading interval. Reading after the arrival has no effect as long as no datagram can be due earlier. The
/// kernel's buffers limit the interval: a flood of 500 000 datagrams/s yields a thousand in 2 ms.
constexpr Duration kReadingMax{2'000'000};
constexpr Duration kReadingMin{100'000};
constexpr std::size_t kReportsMax = 1024;
constexpr std::size_t kOrdersMax = 64;

}  // namespace

std::expected<std::unique_ptr<Proxy>, std::string> Proxy::open(const ProxyOptions& options) {
  auto clients = ProxyClients::open(options.listen, options.to);
  if (!clients) return std::unexpected(clients.error());
  io::EventFd wake;
  if (!wake.open() || !clients->watch(wake.get(), {ProxySource::Kind::kWake, 0})) {
    return std::unexpected(std::string("the system gives no file descriptors: ") + std::strerror(errno));
  }
  return std::unique_ptr<Proxy>(new Proxy(options, std::move(*clients), std::move(wake)));
}

Proxy::Proxy(const ProxyOptions& options, ProxyClients clients, io::EventFd wake)
    : options_(options),
      clients_(std::move(clients)),
      wake_(std::move(wake)),
      requests_(kOrdersMax),
      core_(options.link, options.seed, options.events),
      client_pool_(core_, options.link, options.monitor_quality),
      delays_(std::make_unique<LiveDelayHistogram[]>(ProxyCore::kClientsMax * kDirections)),
      least_delay_(std::min(options.link.up.floor, options.link.down.floor)) {
  departed_.reserve(kReportsMax);
  monitored_.reserve(ProxyCore::kClientsMax);
  core_.log_to(options.sink);
  update_reading_interval(options.link);
  for (const NetworkEvent& event : options.events) {
    if (event.link) update_reading_interval(*event.link);
  }
}

void Proxy::stop() noexcept {
  stopping_.store(true, std::memory_order_release);
  wake_.signal();
}

bool Proxy::post(ProxyRequest& order) noexcept {
  std::vector<LinkSpec> for_new;  // copied before posting; afterwards the packet thread owns the request
  for (const LinkChange& links : order.links) {
    if (links.for_new) for_new.push_back(*links.for_new);
  }
  if (!requests_.push(&order)) return false;
  for (const LinkSpec& link : for_new) client_pool_.set_next_link(link);
  wake_.signal();
  return true;
}

void Proxy::process_requests() noexcept {
  if (requests_.front() == nullptr) return;
  // Datagrams that arrived before the request still use the previous network.
  [[maybe_unused]] const std::size_t count = read_ready(Duration{});
  while (ProxyRequest* const* waiting = requests_.front()) {
    ProxyRequest& order = **waiting;
    requests_.pop();
    order.at = now_;
    for (LinkChange& links : order.links) {
      core_.change(Time{now_}, links);
      update_reading_interval(links.link);
    }
    client_pool_.drop_outdated();
    for (const std::uint64_t number : order.rebinds) {
      bool found = false;
      for (std::uint32_t place = 0; place < ProxyClients::kMax; ++place) {
        if (core_.number(place) == number) found = core_.rebind(Time{now_}, place, order.rebind);
      }
      order.succeeded = order.succeeded && found;
    }
    order.done.store(true, std::memory_order_release);
  }
}

void Proxy::update_reading_interval(const LinkSpec& link) noexcept {
  least_delay_ = std::min({least_delay_, link.up.floor, link.down.floor});
  const Duration interval = std::min(least_delay_ / 2, kReadingMax);
  // Two cases require reading in order of arrival, without interval: a shared link, and verdicts that wait for later
  // datagrams.
  read_immediately_ = read_immediately_ || link.shared || waits_for_others(link.up) || waits_for_others(link.down);
  reading_interval_ = interval < kReadingMin || read_immediately_ ? Duration{} : interval;
}

void Proxy::maintain(Duration now) noexcept {
  remove_idle_clients();
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    const ProxyClients::Client& client = clients_[i];
    if (client.former.open() && core_.dead(Time{now}, i, client.former_number)) clients_.close_former(i);
  }
  publish();
  next_maintenance_ = now + kHousekeeping;
}

void Proxy::remove_idle_clients() noexcept {
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (!clients_[i].present || now_ - clients_[i].last_seen < options_.idle_limit) continue;
    const bool under_way =
        core_.counters(i, Direction::kUp).in_flight() + core_.counters(i, Direction::kDown).in_flight() > 0;
    if (!under_way) remove_client(i);
  }
}

void Proxy::remove_client(std::uint32_t place) noexcept {
  if (departed_.size() < kReportsMax) {
    departed_.push_back(client_status(place));
    departed_.back().present = false;
  }
  departed_drops_ += clients_.kernel_drops(place);
  core_.remove_client(place);
  clients_.remove(place);
}

ProxyClientStatus Proxy::client_status(std::uint32_t place) const noexcept {
  const ProxyClients::Client& client = clients_[place];
  return {client.number,
          place,
          client.address.storage,
          client.present,
          client.arrived,
          clients_.kernel_drops(place),
          {core_.counters(place, Direction::kUp), core_.counters(place, Direction::kDown)},
          {core_.queue_wait(Time{now_}, place, Direction::kUp), core_.queue_wait(Time{now_}, place, Direction::kDown)}};
}

void Proxy::fill(ProxyStatus& status) const noexcept {
  status.since_start = now_;
  status.clients = 0;
  status.clients_seen = core_.clients_seen();
  status.total = {core_.total(Direction::kUp), core_.total(Direction::kDown)};
  status.errors = errors_;
  status.errors.kernel_drops = clients_.kernel_drops() + departed_drops_;
  status.released = released_;
  status.late = late_;
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (!clients_[i].present) continue;
    ProxyClientStatus& client = status.client[status.clients++];
    client = client_status(i);
    status.errors.kernel_drops += client.kernel_drops;
  }
}

ProxyStatus Proxy::final_status() const {
  ProxyStatus status;
  fill(status);
  return status;
}

void Proxy::publish() noexcept {
  // A reading thread must not delay packets. If the lock is taken, this update is skipped.
  published_.update([this](ProxyStatus& status) { fill(status); });
}

ProxyStatus Proxy::status() const { return published_.read(); }

std::vector<ProxyClientStatus> Proxy::client_reports() const {
  std::vector<ProxyClientStatus> reports = departed_;
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (clients_[i].present) reports.push_back(client_status(i));
  }
  return reports;
}

std::vector<ProxyClientQuality> Proxy::qualities() const {
  std::vector<ProxyClientQuality> qualities;
  for (const MonitoredClient& watched : monitored_) qualities.push_back({watched.number, watched.monitor->summary()});
  return qualities;
}

}  // namespace tandem::netsim
