#include "netsim/proxy/app/proxy_control.h"

#include <poll.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "common/base/format.h"
#include "netsim/proxy/app/proxy_report.h"

namespace tandem::netsim {
namespace {

constexpr int kAnswerTimeoutMs = 2'000;
constexpr std::size_t kNotesMax = 1'000;

ProxyControl::Answer wrong(std::string text) {
  return {.understood = false, .done = false, .text = std::move(text) + "\n"};
}
ProxyControl::Answer trouble(std::string text) { return {.done = false, .text = std::move(text) + "\n"}; }

std::set<std::uint64_t> present_of(const ProxyStatus& status) {
  std::set<std::uint64_t> numbers;
  for (std::size_t i = 0; i < status.clients; ++i) numbers.insert(status.client[i].number);
  return numbers;
}

std::string missing(const std::vector<std::uint64_t>& asked, const std::set<std::uint64_t>& present) {
  for (const std::uint64_t number : asked) {
    if (present.contains(number)) continue;
    std::string there;
    for (const std::uint64_t n : present) there += (there.empty() ? "" : ", ") + std::to_string(n);
    return "there is no client " + std::to_string(number) + "; present: " + (there.empty() ? "none" : there);
  }
  return {};
}

void apply(const ControlRequest& request, const std::optional<LinkSpec>& network, LinkSpec& link) {
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    if (request.direction && *request.direction != direction) continue;
    if (network) link[direction] = (*network)[direction];
    request.numbers.apply(link[direction]);
  }
}

}  // namespace

ProxyControl::ProxyControl(Proxy& proxy, const LinkSpec& start, FindNetwork find)
    : proxy_(proxy), start_(start), find_network_(std::move(find)), links_{.common = start} {}

ProxyControl::Answer ProxyControl::execute(const std::string& line) {
  const auto request = parse_control_request(line);
  if (!request) return wrong(request.error());
  switch (request->kind) {
    case ControlRequest::Kind::kHelp:
      return {.text = control_help()};
    case ControlRequest::Kind::kStop:
      return {.stop = true, .text = "the proxy ends\n"};
    case ControlRequest::Kind::kStatus:
      return {.text = request->json ? status_json(proxy_.status(), changes_) : status_text(proxy_.status())};
    case ControlRequest::Kind::kRebind:
      return rebind(*request, line);
    case ControlRequest::Kind::kChange:
    case ControlRequest::Kind::kReset:
      break;
  }
  return change(*request, line);
}

ProxyControl::Answer ProxyControl::change(const ControlRequest& request, const std::string& line) {
  const bool reset = request.kind == ControlRequest::Kind::kReset;
  std::optional<LinkSpec> network;
  if (reset) network = start_;
  std::vector<std::string> notes;
  if (request.network) {
    auto found = find_network_(*request.network);
    if (!found) return wrong(found.error());
    network = std::move(found->link);
    notes = std::move(found->notes);
  }
  const std::set<std::uint64_t> present = present_of(proxy_.status());
  if (std::string error = missing(request.clients, present); !error.empty()) return wrong(std::move(error));
  std::erase_if(links_.own, [&](const auto& entry) { return !present.contains(entry.first); });

  // Works on a copy, which is discarded if the change fails.
  Links next = links_;
  const Duration now = proxy_.now();
  std::erase_if(next.outages,
                [&](const Outage& o) { return o.spec.start + o.spec.length + Duration{1'000'000'000} < now; });
  if (request.outage) {
    next.outages.push_back(
        {{.start = now, .length = *request.outage, .mode = request.outage_mode}, request.direction, request.clients});
  }
  const bool changed = network || request.numbers.any();
  if (changed && request.clients.empty()) {
    apply(request, network, next.common);
    for (auto& [number, link] : next.own) apply(request, network, link);
    if (reset && !request.direction) next.own.clear();
  } else if (changed) {
    for (const std::uint64_t number : request.clients)
      apply(request, network, next.own.try_emplace(number, next.common).first->second);
  }
  std::swap(links_, next);

  ProxyRequest& posted = requests_.emplace_back();
  try {
    if (request.clients.empty()) {
      std::vector<std::uint64_t> all_clients;
      for (const std::uint64_t number : present) all_clients.push_back(number - 1);
      posted.changes.push_back(proxy_.links().prepare_change(with_outages(links_.common, 0), all_clients, true));
    }
    for (const std::uint64_t number : present) {
      const bool asked = std::ranges::find(request.clients, number) != request.clients.end();
      const bool meant = request.clients.empty() ? has_own(number) : asked;
      if (!meant) continue;
      const std::uint64_t by_arrival[] = {number - 1};
      posted.changes.push_back(proxy_.links().prepare_change(with_outages(link_of(number), number), by_arrival, false));
    }
  } catch (const std::invalid_argument& problem) {
    requests_.pop_back();
    std::swap(links_, next);
    return wrong(problem.what());
  }
  if (std::string error = post(posted); !error.empty()) {
    std::swap(links_, next);
    return trouble(std::move(error));
  }
  std::string text = format("done at %.3f s\n", seconds(posted.at));
  for (const std::string& one : notes) text += "note: " + one + "\n";
  record_change(posted.at, line, std::move(notes));
  posted.changes.clear();
  return {.text = std::move(text)};
}

ProxyControl::Answer ProxyControl::rebind(const ControlRequest& request, const std::string& line) {
  const std::set<std::uint64_t> present = present_of(proxy_.status());
  if (std::string error = missing(request.clients, present); !error.empty()) return wrong(std::move(error));
  if (present.empty()) return trouble("no client is present whose address could change");
  ProxyRequest& posted = requests_.emplace_back();
  posted.rebind.dead_after = request.dead_after;
  posted.rebinds = request.clients;
  if (request.clients.empty()) posted.rebinds.assign(present.begin(), present.end());
  for (std::uint64_t& number : posted.rebinds) --number;
  if (std::string error = post(posted); !error.empty()) return trouble(std::move(error));
  if (!posted.succeeded) return trouble("a client left meanwhile, or changed its address a thousand times already");
  record_change(posted.at, line);
  return {.text = format("done at %.3f s\n", seconds(posted.at))};
}

std::string ProxyControl::post(ProxyRequest& posted) {
  // Completed requests can be freed; the caller still reads the newest one.
  std::erase_if(requests_,
                [&](const ProxyRequest& old) { return &old != &posted && old.done.load(std::memory_order_acquire); });
  if (!proxy_.post(posted)) return "the proxy is overloaded; repeat the command";
  for (int waited = 0; waited < kAnswerTimeoutMs; ++waited) {
    if (posted.done.load(std::memory_order_acquire)) return {};
    ::poll(nullptr, 0, 1);
  }
  return "the proxy did not answer within 2 s; it may have ended";
}

bool ProxyControl::has_own(std::uint64_t number) const {
  const auto names = [&](const Outage& outage) {
    return std::ranges::find(outage.clients, number) != outage.clients.end();
  };
  return links_.own.contains(number) || std::ranges::any_of(links_.outages, names);
}

LinkSpec ProxyControl::link_of(std::uint64_t number) const {
  const auto own = links_.own.find(number);
  return own == links_.own.end() ? links_.common : own->second;
}

LinkSpec ProxyControl::with_outages(LinkSpec link, std::uint64_t number) const {
  for (const Outage& outage : links_.outages) {
    const bool meant = outage.clients.empty() || std::ranges::find(outage.clients, number) != outage.clients.end();
    if (!meant) continue;
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      if (!outage.direction || *outage.direction == direction) link[direction].outages.push_back(outage.spec);
    }
  }
  return link;
}

void ProxyControl::record_change(Duration at, const std::string& line, std::vector<std::string> notes) {
  if (changes_.size() == kNotesMax) return;
  const std::size_t begin = line.find_first_not_of(" \t\r\n");
  const std::size_t end = line.find_last_not_of(" \t\r\n");
  changes_.push_back({at, line.substr(begin, end - begin + 1), std::move(notes)});
}

}  // namespace tandem::netsim
