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
  const auto ms = [](double value) { return Duration{std::llround(value * 1e6)}; };
  const LinkSpec numbers = link_from({.delay = ms(request.delay_ms.value_or(0)),
                                      .jitter = ms(request.jitter_ms.value_or(0)),
                                      .loss = request.loss_percent.value_or(0) / 100,
                                      .duplicate = request.duplicate_percent.value_or(0) / 100,
                                      .reorder = request.reorder_percent.value_or(0) / 100,
                                      .outages = {}});
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    if (request.direction && *request.direction != direction) continue;
    PathSpec& path = link[direction];
    if (network) path = (*network)[direction];
    const PathSpec& wanted = numbers[direction];
    if (request.delay_ms) path.floor = wanted.floor;
    if (request.jitter_ms) path.body = wanted.body;
    if (request.loss_percent) path.loss.probability = wanted.loss.probability;
    if (request.duplicate_percent) path.duplicate = wanted.duplicate;
    if (request.reorder_percent) path.reorder = wanted.reorder;
  }
}

}  // namespace

ProxyControl::ProxyControl(Proxy& proxy, const LinkSpec& start, FindNetwork find)
    : proxy_(proxy), start_(start), find_network_(std::move(find)), common_link_(start) {}

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
  std::erase_if(own_links_, [&](const auto& entry) { return !present.contains(entry.first); });

  // Works on copies, which are discarded if the change fails.
  LinkSpec all = common_link_;
  std::map<std::uint64_t, LinkSpec> own = own_links_;
  std::vector<Outage> outages = outages_;
  const Duration now = proxy_.now();
  std::erase_if(outages, [&](const Outage& o) { return o.spec.start + o.spec.length + Duration{1'000'000'000} < now; });
  if (request.outage) {
    outages.push_back(
        {{.start = now, .length = *request.outage, .mode = request.outage_mode}, request.direction, request.clients});
  }
  const bool numbers = network || request.delay_ms || request.jitter_ms || request.loss_percent ||
                       request.duplicate_percent || request.reorder_percent;
  if (numbers && request.clients.empty()) {
    apply(request, network, all);
    for (auto& [number, link] : own) apply(request, network, link);
    if (reset && !request.direction) own.clear();
  } else if (numbers) {
    for (const std::uint64_t number : request.clients)
      apply(request, network, own.try_emplace(number, all).first->second);
  }
  std::swap(common_link_, all);
  std::swap(own_links_, own);
  std::swap(outages_, outages);
  const auto undo = [&] {
    std::swap(common_link_, all);
    std::swap(own_links_, own);
    std::swap(outages_, outages);
  };

  ProxyRequest& posted = requests_.emplace_back();
  try {
    if (request.clients.empty()) {
      std::vector<std::uint64_t> all_clients;
      for (const std::uint64_t number : present) all_clients.push_back(number - 1);
      posted.changes.push_back(proxy_.links().prepare_change(with_outages(common_link_, 0), all_clients, true));
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
    undo();
    return wrong(problem.what());
  }
  if (std::string error = post(posted); !error.empty()) {
    undo();
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
  if (request.clients.empty()) {
    for (const std::uint64_t number : present) posted.rebinds.push_back(number - 1);
  } else {
    for (const std::uint64_t number : request.clients) posted.rebinds.push_back(number - 1);
  }
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
  return own_links_.contains(number) || std::ranges::any_of(outages_, names);
}

LinkSpec ProxyControl::link_of(std::uint64_t number) const {
  const auto own = own_links_.find(number);
  return own == own_links_.end() ? common_link_ : own->second;
}

LinkSpec ProxyControl::with_outages(LinkSpec link, std::uint64_t number) const {
  for (const Outage& outage : outages_) {
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
