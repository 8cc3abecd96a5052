#include "netsim/proxy/app/proxy_sender.h"

namespace tandem::netsim {

static_assert(SendQueue::kMax == io::SendBatch::kMax);

void ProxySender::add(const ProxyCore::Egress& egress) noexcept {
  const ProxySource through = socket_of(egress);
  queue_.add(egress, through);
}

ProxySource ProxySender::socket_of(const ProxyCore::Egress& egress) noexcept {
  using Kind = ProxySource::Kind;
  if (egress.direction == Direction::kDown) return {Kind::kDownside, egress.client};
  const ProxyClients::Client& client = clients_[egress.client];
  if (egress.address > client.address_number) {
    flush();  // queued datagrams leave from the previous address
    if (!clients_.change_address(egress.client, egress.address)) ++errors_.other;
  }
  const bool former = egress.address < client.address_number && client.former.open();
  return {former ? Kind::kFormer : Kind::kUpside, egress.client};
}

void ProxySender::flush() noexcept {
  queue_.flush([this](const SendQueue::Group& group) {
    group.for_each([this](const ProxyCore::Egress& egress) { out_.add(egress.bytes, nullptr, nullptr); });
    const io::SendBatch::Result result = out_.send(clients_.fd_of(group.through));
    errors_.refused += result.refused;
    errors_.no_room += result.no_room;
    errors_.other += result.other;
    last_sent_ = clock_.now();
    const auto direction = group.through.kind == ProxySource::Kind::kDownside ? Direction::kDown : Direction::kUp;
    LiveDelayHistogram& delays = delays_.of(group.through.place, direction);
    group.for_each([&](const ProxyCore::Egress& egress) {
      const Duration late = last_sent_ - egress.item.at.time_since_epoch();
      lateness_.add(late.count());
      live_lateness_.add(late);
      late_ += late > late_limit_ ? 1 : 0;
      ++released_;
      delays.add(last_sent_ - egress.item.sent.time_since_epoch());
      core_.done(egress);
    });
  });
}

}  // namespace tandem::netsim
