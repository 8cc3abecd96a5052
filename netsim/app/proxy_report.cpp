#include "netsim/app/proxy_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

double count(std::uint64_t n) { return static_cast<double>(n); }

/// Share of what went in that the network dropped, for whatever reason.
double lost_percent(const PathCounters& c) { return c.in > 0 ? 100 * count(c.dropped()) / count(c.in) : 0; }

double delay_mean_ms(const PathCounters& c) {
  return c.out > 0 ? static_cast<double>(c.delay_sum_ns) / count(c.out) / 1e6 : 0;
}

Json path_json(const PathCounters& c) {
  Json json;
  json["in"] = c.in;
  json["out"] = c.out;
  json["copies"] = c.copies;
  json["dropped"] = c.dropped();
  json["in_flight"] = c.in_flight();
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    const auto outcome = static_cast<Outcome>(i);
    if (!dropped(outcome)) continue;
    std::string key = std::string("dropped_") + name(outcome);
    for (char& letter : key) letter = letter == ' ' ? '_' : letter;
    json[key] = c.of(outcome);
  }
  json["reordered"] = c.of(Outcome::kHeldBack);
  json["bytes_in"] = c.bytes_in;
  json["bytes_out"] = c.bytes_out;
  json["lost_percent"] = lost_percent(c);
  json["delay_mean_ms"] = delay_mean_ms(c);
  return json;
}

std::string direction_text(const char* title, const PathCounters& c, double duration_s) {
  std::string text = format("%s: %llu in (%.0f/s), %llu out, %.2f %% lost, mean delay %.3f ms\n", title,
                            static_cast<unsigned long long>(c.in), duration_s > 0 ? count(c.in) / duration_s : 0,
                            static_cast<unsigned long long>(c.out), lost_percent(c), delay_mean_ms(c));
  std::string causes;
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    const auto outcome = static_cast<Outcome>(i);
    if (outcome == Outcome::kDeliver || c.of(outcome) == 0) continue;
    causes += format("%s%llu %s", causes.empty() ? "    " : ", ", static_cast<unsigned long long>(c.of(outcome)),
                     name(outcome));
  }
  if (c.copies > 0) {
    causes += format("%s%llu duplicated", causes.empty() ? "    " : ", ", static_cast<unsigned long long>(c.copies));
  }
  if (c.in_flight() > 0) {
    causes += format("%s%llu under way at the end", causes.empty() ? "    " : ", ",
                     static_cast<unsigned long long>(c.in_flight()));
  }
  return causes.empty() ? text : text + causes + "\n";
}

}  // namespace

std::string status_line(const ProxyStatus& now, const ProxyStatus& before) {
  const double s = seconds(now.since_start - before.since_start);
  const auto rate = [s](const PathCounters& new_, const PathCounters& old) {
    return s > 0 ? count(new_.in - old.in) / s : 0;
  };
  // Counters that end, as clients leave, never go back: totals keep those who left.
  const auto window = [](const PathCounters& new_, const PathCounters& old) {
    PathCounters c;
    c.in = new_.in - old.in;
    c.out = new_.out - old.out;
    c.delay_sum_ns = new_.delay_sum_ns - old.delay_sum_ns;
    for (std::size_t i = 0; i < kOutcomes; ++i) c.by_outcome[i] = new_.by_outcome[i] - old.by_outcome[i];
    return c;
  };
  const PathCounters up = window(now.total[0], before.total[0]);
  const PathCounters down = window(now.total[1], before.total[1]);
  // Short enough for 80 columns.
  return format("%.0f s, %llu client%s; up %.0f/s lost %.1f %% %.1f ms; down %.0f/s lost %.1f %% %.1f ms",
                seconds(now.since_start), static_cast<unsigned long long>(now.clients), now.clients == 1 ? "" : "s",
                rate(now.total[0], before.total[0]), lost_percent(up), delay_mean_ms(up),
                rate(now.total[1], before.total[1]), lost_percent(down), delay_mean_ms(down));
}

std::string summary_text(const Proxy& proxy) {
  const ProxyStatus status = proxy.final_status();
  const double duration_s = seconds(status.since_start);
  std::string text = format("%.1f s, %llu client%s\n", duration_s, static_cast<unsigned long long>(status.clients_seen),
                            status.clients_seen == 1 ? "" : "s");
  text += direction_text("  up  ", status.total[0], duration_s);
  text += direction_text("  down", status.total[1], duration_s);
  const Histogram& late = proxy.lateness();
  if (late.count() > 0) {
    text += format("  sent later than scheduled by p50 %.1f us, p99 %.1f us, at most %.1f us\n",
                   static_cast<double>(late.quantile(0.5)) / 1e3, static_cast<double>(late.quantile(0.99)) / 1e3,
                   static_cast<double>(late.max()) / 1e3);
  }
  const ProxyTroubles& t = status.troubles;
  const std::pair<std::uint64_t, const char*> troubles[] = {
      {t.too_many_clients, "datagrams of clients beyond the 64th were dropped"},
      {t.too_long, "datagrams above 1500 bytes were dropped"},
      {t.kernel_drops, "datagrams were dropped by the kernel before the proxy saw them: this computer was too slow"},
      {t.no_room, "datagrams found no room in the kernel's send buffer"},
      {t.refused, "times nobody listened at the other end"},
      {t.other, "other socket errors"},
  };
  for (const auto& [times, what] : troubles) {
    if (times > 0) text += format("  %llu %s\n", static_cast<unsigned long long>(times), what);
  }
  return text;
}

std::string summary_json(const Proxy& proxy, const ProxyOptions& options, const NetworkChoice& network) {
  const ProxyStatus status = proxy.final_status();
  Json json;
  json["program"] = "tandem-netsim proxy";
  json["listen"] = io::to_text(proxy.listening());
  json["to"] = io::to_text(options.to);
  json["network"] = network.name;
  json["description"] = network.description;
  json["notes"] = network.notes;
  json["seed"] = options.seed;
  json["duration_s"] = seconds(status.since_start);
  json["clients_seen"] = status.clients_seen;
  json["up"] = path_json(status.total[0]);
  json["down"] = path_json(status.total[1]);
  json["clients"] = Json::array();
  for (const ProxyClientStatus& client : proxy.client_reports()) {
    json["clients"].push_back({{"address", io::to_text(client.address)},
                               {"present", client.present},
                               {"up", path_json(client.counters[0])},
                               {"down", path_json(client.counters[1])}});
  }
  const Histogram& late = proxy.lateness();
  json["lateness"] = {{"count", late.count()},
                      {"p50_us", static_cast<double>(late.quantile(0.5)) / 1e3},
                      {"p99_us", static_cast<double>(late.quantile(0.99)) / 1e3},
                      {"max_us", static_cast<double>(late.max()) / 1e3}};
  const ProxyTroubles& t = status.troubles;
  json["troubles"] = {{"too_many_clients", t.too_many_clients},
                      {"too_long", t.too_long},
                      {"kernel_drops", t.kernel_drops},
                      {"no_room", t.no_room},
                      {"refused", t.refused},
                      {"other", t.other}};
  return json.dump(2) + "\n";
}

}  // namespace tandem::netsim
