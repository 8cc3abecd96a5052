#include "netsim/proxy/app/proxy_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/base/format.h"
#include "netsim/quality/quality_json.h"
#include "netsim/quality/quality_text.h"

namespace tandem::netsim {
namespace {

using Json = nlohmann::ordered_json;

double count(std::uint64_t n) { return static_cast<double>(n); }

/// Returns the percentage of entered datagrams that the network dropped for any reason.
double lost_percent(const PathCounters& c) { return c.in > 0 ? 100 * count(c.dropped()) / count(c.in) : 0; }

double delay_mean_ms(const PathCounters& c) {
  return c.out > 0 ? static_cast<double>(c.delay_sum_ns) / count(c.out) / 1e6 : 0;
}

Json path_json(const PathCounters& c) {
  Json json{{"in", c.in}, {"out", c.out}, {"copies", c.copies}, {"dropped", c.dropped()}, {"in_flight", c.in_flight()}};
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    const auto outcome = static_cast<Outcome>(i);
    if (!dropped(outcome)) continue;
    std::string key = std::string("dropped_") + name(outcome);
    for (char& letter : key) letter = letter == ' ' ? '_' : letter;
    json[key] = c.of(outcome);
  }
  json.update(Json{{"bits_flipped", c.flipped},
                   {"truncated", c.truncated},
                   {"reordered", c.of(Outcome::kHeldBack)},
                   {"bytes_in", c.bytes_in},
                   {"bytes_out", c.bytes_out},
                   {"lost_percent", lost_percent(c)},
                   {"delay_mean_ms", delay_mean_ms(c)}});
  return json;
}

/// Returns the text about one direction.
/// @param duration_s  0: omit the rate
/// @param ended       whether the proxy has ended
std::string direction_text(const char* title, const PathCounters& c, double duration_s, bool ended) {
  const std::string rate = duration_s > 0 ? format(" (%.0f/s)", count(c.in) / duration_s) : "";
  std::string text = format("%s: %llu in%s, %llu out, %.2f %% lost, mean delay %.3f ms\n", title,
                            static_cast<unsigned long long>(c.in), rate.c_str(), static_cast<unsigned long long>(c.out),
                            lost_percent(c), delay_mean_ms(c));
  std::string causes;
  const auto add = [&causes](std::uint64_t number, const std::string& what) {
    if (number > 0)
      causes += format("%s%llu ", causes.empty() ? "    " : ", ", static_cast<unsigned long long>(number)) + what;
  };
  for (std::size_t i = 0; i < kOutcomes; ++i)
    if (const auto outcome = static_cast<Outcome>(i); outcome != Outcome::kDeliver) add(c.of(outcome), name(outcome));
  add(c.flipped, "with wrong bits");
  add(c.truncated, "truncated");
  add(c.copies, "duplicated");
  add(c.in_flight(), ended ? "under way at the end" : "under way");
  return causes.empty() ? text : text + causes + "\n";
}

std::string troubles_text(const ProxyErrors& t) {
  const std::pair<std::uint64_t, const char*> troubles[] = {
      {t.too_many_clients, "datagrams of clients beyond the 64th were dropped"},
      {t.too_long, "datagrams above 1500 bytes were dropped"},
      {t.kernel_drops,
       "datagrams were dropped by the kernel before the proxy saw them: more arrived than this computer can handle"},
      {t.no_room, "datagrams did not fit into the kernel's send buffer"},
      {t.refused, "times no program listened at the other end"},
      {t.other, "other socket errors"},
  };
  std::string text;
  for (const auto& [times, what] : troubles) {
    if (times > 0) text += format("  %llu %s\n", static_cast<unsigned long long>(times), what);
  }
  return text;
}

Json troubles_json(const ProxyErrors& t) {
  return {{"too_many_clients", t.too_many_clients},
          {"too_long", t.too_long},
          {"kernel_drops", t.kernel_drops},
          {"no_room", t.no_room},
          {"refused", t.refused},
          {"other", t.other}};
}

Json client_json(const ProxyClientStatus& client) {
  Json json{{"number", client.number},
            {"address", io::to_text(client.address)},
            {"present", client.present},
            {"came_s", seconds(client.arrived)},
            {"kernel_drops", client.kernel_drops},
            {"up", path_json(client.counters[0])},
            {"down", path_json(client.counters[1])}};
  json["up"]["queue_ms"] = 1e3 * seconds(client.queue[0]);
  json["down"]["queue_ms"] = 1e3 * seconds(client.queue[1]);
  return json;
}

std::vector<NamedLink> named(std::span<const ProxyClientQuality> qualities) {
  std::vector<NamedLink> links;
  for (const ProxyClientQuality& client : qualities)
    links.push_back({"client " + std::to_string(client.number), client.link});
  return links;
}

Json changes_json(std::span<const ProxyControl::Change> changes) {
  Json json = Json::array();
  for (const ProxyControl::Change& change : changes) {
    json.push_back({{"at_s", seconds(change.at)}, {"command", change.command}, {"notes", change.notes}});
  }
  return json;
}

Json events_json(std::span<const ProxyEvent> events) {
  Json json = Json::array();
  for (const ProxyEvent& one : events) {
    const bool stays = one.event.until == Duration::max();
    json.push_back({{"at_s", seconds(one.event.at)},
                    {"until_s", stays ? Json(nullptr) : Json(seconds(one.event.until))},
                    {"event", one.event.description},
                    {"fate", name(one.fate)},
                    {"why", one.reason}});
  }
  return json;
}

}  // namespace

bool judged(const Proxy& proxy, const ProxyReportNotes& notes) {
  return notes.lateness_max && proxy.sender().lateness().count() > 0;
}

bool in_time(const Proxy& proxy, const ProxyReportNotes& notes) {
  return !notes.lateness_max ||
         (judged(proxy, notes) && proxy.sender().lateness().quantile(0.99) <= notes.lateness_max->count());
}

std::string status_text(const ProxyStatus& status) {
  std::string text = format("%.1f s, %llu client%s present, %llu seen\n", seconds(status.since_start),
                            static_cast<unsigned long long>(status.clients), status.clients == 1 ? "" : "s",
                            static_cast<unsigned long long>(status.clients_seen));
  for (std::size_t i = 0; i < status.clients; ++i) {
    const ProxyClientStatus& client = status.client[i];
    text += format("client %llu at %s\n", static_cast<unsigned long long>(client.number),
                   io::to_text(client.address).c_str());
    text += direction_text("  up  ", client.counters[0], 0, false);
    text += direction_text("  down", client.counters[1], 0, false);
    if (client.queue[0] + client.queue[1] > Duration{})
      text += format("    waiting in the queue now: up %.3f ms, down %.3f ms\n", 1e3 * seconds(client.queue[0]),
                     1e3 * seconds(client.queue[1]));
  }
  return text + troubles_text(status.errors);
}

std::string status_json(const ProxyStatus& status, std::span<const ProxyControl::Change> changes) {
  Json clients = Json::array();
  for (std::size_t i = 0; i < status.clients; ++i) clients.push_back(client_json(status.client[i]));
  const Json json{{"time_s", seconds(status.since_start)},
                  {"clients_seen", status.clients_seen},
                  {"up", path_json(status.total[0])},
                  {"down", path_json(status.total[1])},
                  {"clients", clients},
                  {"changes", changes_json(changes)},
                  {"released", status.released},
                  {"released_late", status.late},
                  {"troubles", troubles_json(status.errors)}};
  return json.dump() + "\n";
}

std::string summary_text(const Proxy& proxy, const ProxyReportNotes& notes) {
  const ProxyStatus status = proxy.final_status();
  const double duration_s = seconds(status.since_start);
  std::string text = format("%.1f s, %llu client%s\n", duration_s, static_cast<unsigned long long>(status.clients_seen),
                            status.clients_seen == 1 ? "" : "s");
  text += direction_text("  up  ", status.total[0], duration_s, true);
  text += direction_text("  down", status.total[1], duration_s, true);
  if (!notes.qualities.empty()) text += quality_report(named(notes.qualities), false);
  text += events_text(notes.events);
  for (const ProxyControl::Change& change : notes.changes) {
    text += format("  at %.3f s: %s\n", seconds(change.at), change.command.c_str());
    for (const std::string& note : change.notes) text += "    note: " + note + "\n";
  }
  const Histogram& late = proxy.sender().lateness();
  const auto us = [&late](double q) { return static_cast<double>(late.quantile(q)) / 1e3; };
  if (late.count() > 0) {
    text += format("  own error: sent later than scheduled by p50 %.1f us, p99 %.1f us, at most %.1f us;\n", us(0.5),
                   us(0.99), static_cast<double>(late.max()) / 1e3);
    text += format("    %llu of %llu datagrams more than %.0f us late (%.2f %%)\n",
                   static_cast<unsigned long long>(status.late), static_cast<unsigned long long>(status.released),
                   static_cast<double>(proxy.late_limit().count()) / 1e3,
                   100 * count(status.late) / count(status.released));
  }
  if (notes.lateness_max && !judged(proxy, notes)) {
    text +=
        "  NOTHING WAS JUDGED: no client sent a datagram that the proxy could have passed on late; --max-lateness is "
        "not met\n";
  } else if (!in_time(proxy, notes)) {
    text += format(
        "  TOO LATE: p99 %.1f us is above --max-lateness %.0f us. This computer was too busy:\n"
        "    measurements over this network are not reliable. Remedy: --realtime, fewer programs, --coalesce 0\n",
        us(0.99), static_cast<double>(notes.lateness_max->count()) / 1e3);
  }
  if (notes.log_missed > 0) {
    text += format("  %llu decisions are missing in the log: the disk was too slow; packets did not wait for it\n",
                   static_cast<unsigned long long>(notes.log_missed));
  }
  return text + troubles_text(status.errors);
}

std::string summary_json(const Proxy& proxy, const ProxyOptions& options, const NetworkChoice& network,
                         const ProxyReportNotes& notes) {
  const ProxyStatus status = proxy.final_status();
  Json clients = Json::array(), quality = Json::object();
  for (const ProxyClientStatus& client : proxy.client_reports()) clients.push_back(client_json(client));
  for (const NamedLink& one : named(notes.qualities)) quality[one.name] = quality_json(one.link);
  const Histogram& late = proxy.sender().lateness();
  const Json json{{"program", "tandem-netsim proxy"},
                  {"listen", io::to_text(proxy.listening())},
                  {"to", io::to_text(options.to)},
                  {"network", network.name},
                  {"description", network.description},
                  {"notes", network.notes},
                  {"seed", options.seed},
                  {"duration_s", seconds(status.since_start)},
                  {"clients_seen", status.clients_seen},
                  {"up", path_json(status.total[0])},
                  {"down", path_json(status.total[1])},
                  {"clients", clients},
                  {"quality", quality},
                  {"interrupted", notes.interrupted},
                  {"events", events_json(notes.events)},
                  {"changes", changes_json(notes.changes)},
                  {"lateness",
                   {{"count", late.count()},
                    {"p50_us", static_cast<double>(late.quantile(0.5)) / 1e3},
                    {"p99_us", static_cast<double>(late.quantile(0.99)) / 1e3},
                    {"max_us", static_cast<double>(late.max()) / 1e3},
                    {"late_limit_us", static_cast<double>(proxy.late_limit().count()) / 1e3},
                    {"late", status.late},
                    {"judged", judged(proxy, notes)},
                    {"in_time", in_time(proxy, notes)}}},
                  {"log", {{"rows", notes.log_rows}, {"missed", notes.log_missed}}},
                  {"troubles", troubles_json(status.errors)}};
  return json.dump(2) + "\n";
}

}  // namespace tandem::netsim
