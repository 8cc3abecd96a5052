#include "netsim/proxy/link_factory.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "netsim/proxy/client_table.h"

namespace tandem::netsim {
namespace {

constexpr LinkTimeline::Shared kAllClients{.flows = ClientTable::kMax};

/// Returns the name of a client in events.
std::string client_name(std::uint64_t number) { return std::to_string(number + 1); }

}  // namespace

LinkFactory::LinkFactory(const LinkSpec& spec, std::uint64_t seed, std::vector<NetworkEvent> events)
    : shared_(spec.shared), seed_(seed), events_(std::move(events)) {
  std::ranges::copy_if(events_, std::back_inserter(outages_),
                       [](const NetworkEvent& e) { return e.outage.has_value(); });
}

std::shared_ptr<LinkTimeline> LinkFactory::shared_link(const LinkSpec& link, Direction direction) const {
  return std::make_shared<LinkTimeline>(schedule_for(link, events_, ""), direction, seed_, kAllClients);
}

PreparedLink LinkFactory::prepare_client(const LinkSpec& link, std::uint64_t version, std::uint64_t number) const {
  const LinkSchedule schedule = schedule_for(link, events_, client_name(number));
  PreparedLink prepared{version, number, Addresses{schedule.rebinds}};
  if (shared_) return prepared;
  for (const Direction direction : {Direction::kUp, Direction::kDown})
    prepared.directions[static_cast<std::size_t>(direction)].emplace(schedule, direction, seed_, number);
  return prepared;
}

LinkChange LinkFactory::prepare_change(const LinkSpec& link, std::span<const std::uint64_t> numbers, bool all) const {
  LinkChange change{.for_new = all ? std::optional{link} : std::nullopt, .link = link};
  const auto paths = [&](const std::string& client, const auto& key) {
    const LinkSpec with_outages = schedule_for(link, outages_, client).initial;
    return std::array{make_path(with_outages, Direction::kUp, seed_, key),
                      make_path(with_outages, Direction::kDown, seed_, key)};
  };
  if (shared_) {
    if (!all) throw std::invalid_argument("all clients share this link: it can be changed for all of them only");
    change.shared = paths("", kAllClients);
    return change;
  }
  for (const std::uint64_t number : numbers) change.clients.push_back({number, paths(client_name(number), number)});
  return change;
}

}  // namespace tandem::netsim
