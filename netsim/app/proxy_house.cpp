#include <sys/eventfd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "netsim/app/proxy.h"

namespace tandem::netsim {
namespace {

constexpr Duration kHousekeeping{200'000'000};
/// Reading later than the moment of arrival is free as long as nothing can be due before; but the kernel's buffers hold
/// a limited number: 2 ms of a flood of half a million datagrams a second are a thousand.
constexpr Duration kReadingMax{2'000'000};
constexpr Duration kReadingMin{100'000};
constexpr std::size_t kReportsMax = 1024;
constexpr std::size_t kOrdersMax = 64;

}  // namespace

std::expected<std::unique_ptr<Proxy>, std::string> Proxy::open(const ProxyOptions& options) {
  auto clients = ProxyClients::open(options.listen, options.to);
  if (!clients) return std::unexpected(clients.error());
  io::Fd wake{eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
  if (!wake.open() || !clients->watch(wake.get(), {ProxySource::Kind::kWake, 0})) {
    return std::unexpected(std::string("the system gives no file descriptors: ") + std::strerror(errno));
  }
  return std::unique_ptr<Proxy>(new Proxy(options, std::move(*clients), std::move(wake)));
}

Proxy::Proxy(const ProxyOptions& options, ProxyClients clients, io::Fd wake)
    : options_(options),
      clients_(std::move(clients)),
      wake_(std::move(wake)),
      orders_(kOrdersMax),
      core_(options.link, options.seed, options.events),
      newcomers_(core_, options.link, options.watch_quality),
      delays_(std::make_unique<LiveDelays[]>(ProxyCore::kClientsMax * kDirections)),
      least_delay_(std::min(options.link.up.floor, options.link.down.floor)) {
  left_.reserve(kReportsMax);
  watched_.reserve(ProxyCore::kClientsMax);
  core_.log_to(options.sink);
  plan_reading(options.link);
  for (const NetworkEvent& event : options.events) {
    if (event.link) plan_reading(*event.link);
  }
}

void Proxy::stop() noexcept {
  stopping_.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

bool Proxy::post(ProxyOrder& order) noexcept {
  std::vector<LinkSpec> for_new;  // read now: once it is posted, the order is the packet thread's
  for (const LinkChange& links : order.links) {
    if (links.for_new) for_new.push_back(*links.for_new);
  }
  if (!orders_.push(&order)) return false;
  for (const LinkSpec& link : for_new) newcomers_.link_will_be(link);
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
  return true;
}

void Proxy::carry_out_orders() noexcept {
  if (orders_.front() == nullptr) return;
  // What came before the order still meets the network that was.
  [[maybe_unused]] const std::size_t count = read_ready(Duration{});
  while (ProxyOrder* const* waiting = orders_.front()) {
    ProxyOrder& order = **waiting;
    orders_.pop();
    order.at = now_;
    for (LinkChange& links : order.links) {
      core_.change(Time{now_}, links);
      plan_reading(links.link);
    }
    newcomers_.drop_outdated();
    for (const std::uint64_t number : order.rebinds) {
      bool found = false;
      for (std::uint32_t place = 0; place < ProxyClients::kMax; ++place) {
        if (core_.number(place) == number) found = core_.rebind(Time{now_}, place, order.rebind);
      }
      order.carried_out = order.carried_out && found;
    }
    order.done.store(true, std::memory_order_release);
  }
}

void Proxy::plan_reading(const LinkSpec& link) noexcept {
  least_delay_ = std::min({least_delay_, link.up.floor, link.down.floor});
  const Duration interval = std::min(least_delay_ / 2, kReadingMax);
  // Clients on one link must be read in the order of their datagrams, so soon; and so must those that others wait for.
  at_once_ = at_once_ || link.shared || waits_for_others(link.up) || waits_for_others(link.down);
  reading_interval_ = interval < kReadingMin || at_once_ ? Duration{} : interval;
}

void Proxy::housekeeping(Duration now) noexcept {
  forget_idle();
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    const ProxyClients::Client& client = clients_[i];
    if (client.former.open() && core_.dead(Time{now}, i, client.former_number)) clients_.close_former(i);
  }
  publish();
  next_housekeeping_ = now + kHousekeeping;
}

void Proxy::forget_idle() noexcept {
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (!clients_[i].present || now_ - clients_[i].last_seen < options_.idle_limit) continue;
    const bool under_way =
        core_.counters(i, Direction::kUp).in_flight() + core_.counters(i, Direction::kDown).in_flight() > 0;
    if (!under_way) forget(i);
  }
}

void Proxy::forget(std::uint32_t place) noexcept {
  if (left_.size() < kReportsMax) {
    left_.push_back(picture_of(place));
    left_.back().present = false;
  }
  drops_of_left_ += clients_.kernel_drops(place);
  core_.remove_client(place);
  clients_.forget(place);
}

ProxyClientStatus Proxy::picture_of(std::uint32_t place) const noexcept {
  const ProxyClients::Client& client = clients_[place];
  return {client.number,
          place,
          client.address.storage,
          client.present,
          client.came,
          clients_.kernel_drops(place),
          {core_.counters(place, Direction::kUp), core_.counters(place, Direction::kDown)},
          {core_.queue_wait(Time{now_}, place, Direction::kUp), core_.queue_wait(Time{now_}, place, Direction::kDown)}};
}

void Proxy::fill(ProxyStatus& status) const noexcept {
  status.since_start = now_;
  status.clients = 0;
  status.clients_seen = core_.clients_seen();
  status.total = {core_.total(Direction::kUp), core_.total(Direction::kDown)};
  status.troubles = troubles_;
  status.troubles.kernel_drops = clients_.kernel_drops() + drops_of_left_;
  status.released = released_;
  status.late = late_;
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (!clients_[i].present) continue;
    ProxyClientStatus& client = status.client[status.clients++];
    client = picture_of(i);
    status.troubles.kernel_drops += client.kernel_drops;
  }
}

ProxyStatus Proxy::final_status() const {
  ProxyStatus status;
  fill(status);
  return status;
}

void Proxy::publish() noexcept {
  // Whoever looks must not hold up the packets: then the next picture is the one they get.
  const std::unique_lock lock{published_lock_, std::try_to_lock};
  if (lock) fill(published_);
}

ProxyStatus Proxy::status() const {
  const std::lock_guard lock{published_lock_};
  return published_;
}

std::vector<ProxyClientStatus> Proxy::client_reports() const {
  std::vector<ProxyClientStatus> reports = left_;
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (clients_[i].present) reports.push_back(picture_of(i));
  }
  return reports;
}

std::vector<ProxyClientQuality> Proxy::qualities() const {
  std::vector<ProxyClientQuality> qualities;
  for (const Watched& watched : watched_) qualities.push_back({watched.number, watched.watch->summary()});
  return qualities;
}

}  // namespace tandem::netsim
