#include "server/app/control/control_server.h"

#include <sys/resource.h>

#include <algorithm>
#include <asio/post.hpp>
#include <future>
#include <utility>

#include "common/auth/io/identity_selector.h"
#include "common/base/format.h"
#include "common/io/log.h"
#include "server/app/control/note_log.h"
#include "server/app/control/server_keys.h"
#include "server/app/monitor/metrics.h"

namespace tandem::server {
namespace {

constexpr auto kServingFileInterval = std::chrono::seconds(1);  // between two writes of the list of sessions
// With the close-out of a seat (0.2 s) a revocation acts within a second.
constexpr auto kRevocationCheckInterval = std::chrono::milliseconds(250);
constexpr int kPortsTried = 20;  // ports that are tried until one is free for UDP and TCP

/// Raises the limit of open files to all connections that the limits allow and the program's own files. A login shell
/// often permits 1024 only.
void permit_descriptors(const ControlLimits& limits) {
  constexpr rlim_t kOwn = 512 + 4 * rpc::kSessionsMax;  // an event, a recording, a report and a trace of each
  const rlim_t wanted = kMostPerPending * limits.pending + limits.connections + kOwn;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted) return;
  limit.rlim_cur = std::min(limit.rlim_max, wanted);
  setrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur < wanted)
    io::log_event(
        io::Level::kWarn,
        {.event = "descriptors",
         .text = format("the system permits %llu open files, and all connections that the "
                        "limits allow need %llu: raise it (`ulimit -n`, LimitNOFILE), or lower "
                        "`limits { pending, connections }`",
                        static_cast<unsigned long long>(limit.rlim_cur), static_cast<unsigned long long>(wanted))});
}

}  // namespace

ControlServer::ControlServer(auth::ServerKeystore trust, const ControlOptions& options, const Handlers& handlers)
    : trust_(std::move(trust)),
      notes_(options.notes),
      on_event_(handlers.on_event),
      audit_(thread_.context(), trust_, handlers.on_event, handlers.on_message),
      registry_(thread_.context()),
      commands_(registry_, trust_, handlers.on_message),
      joins_(registry_, commands_, trust_, options.load_limits, handlers.on_message),
      plane_(thread_.context(), trust_, joins_, options.limits, {},
             [this](const ControlEventRecord& news) {
               if (audit_.record(news) && on_event_) on_event_(news);
             }),
      serving_timer_(thread_.context()),
      revocation_timer_(thread_.context()) {
  commands_.set_orders(orders_);
  commands_.set_on_note(
      [log = NoteLog(notes_folder())](const SessionNote& note) { return log.append(note, auth::wall_seconds()); });
}

ControlServer::~ControlServer() { stop(); }

std::expected<std::unique_ptr<ControlServer>, std::string> ControlServer::open(const ControlOptions& options,
                                                                               const io::Steering& steering,
                                                                               const Handlers& handlers) {
  auto trust = open_server_keys(options.listen, options.state);
  if (!trust) return std::unexpected(trust.error());
  if (trust->on_disk())
    if (std::string problem = trust->begin_serving(auth::wall_seconds()); !problem.empty())
      return std::unexpected(std::move(problem));
  trust->enable_audit_rotation(options.audit);
  permit_descriptors(options.limits);
  std::unique_ptr<ControlServer> server{new ControlServer(std::move(*trust), options, handlers)};
  std::string problem;
  for (int attempt = 0; attempt < kPortsTried; ++attempt) {
    auto sockets = io::bind_udp_steered(options.listen, steering);
    if (!sockets) return std::unexpected(sockets.error());
    auto listening = server->plane_.listen(sockets->front().local);
    if (listening) {
      server->address_ = *listening;
      server->sockets_ = std::move(*sockets);
      break;
    }
    problem = listening.error();
    if (options.listen.port() != 0) break;  // a chosen port may be in use for TCP: try the next one
  }
  if (server->sockets_.empty()) return std::unexpected(problem);
  if (options.metrics) {
    server->metrics_.emplace(
        server->thread_.context(),
        [s = server.get()](std::string_view path) {
          const auto service = s->service_status_ ? std::optional(s->service_status_()) : std::nullopt;
          return monitoring_page(path, s->registry_, s->plane_, s->audit_.state(), service ? &*service : nullptr);
        },
        options.metrics_hosts);
    if (std::string trouble = server->metrics_->listen(*options.metrics); !trouble.empty())
      return std::unexpected("metrics: " + trouble +
                             "; choose another address or port for them, or end the program that uses it");
  }
  if (server->ephemeral_keys()) {
    auto local = auth::publish_local_keys(server->trust_, auth::runtime_path(), auth::wall_seconds());
    if (!local) return std::unexpected("the keys for clients on this machine could not be published: " + local.error());
    server->local_.emplace(std::move(*local));
  }
  return server;
}

std::string ControlServer::folder() const { return trust_.on_disk() ? trust_.folder()->path() : auth::runtime_path(); }

std::string ControlServer::notes_folder() const {
  return notes_.empty() && trust_.on_disk() ? trust_.folder()->path() : notes_;
}

void ControlServer::release_consoles(const std::string& session) {
  change([&](SessionRegistry& registry, const auto& done) {
    for (SessionEntry& entry : registry.entries())
      if (entry.registration.name == session) joins_.release_consoles(entry);
    done();
  });
}

void ControlServer::change(const std::function<void(SessionRegistry&, std::function<void()> done)>& change) {
  std::promise<void> done;
  asio::post(thread_.context(), [&] { change(registry_, [&] { done.set_value(); }); });
  done.get_future().wait();
}

void ControlServer::post(std::function<void()> what) { asio::post(thread_.context(), std::move(what)); }

std::string ControlServer::write_serving_file() {
  ServingSpec now = registry_.serving();
  now.address = io::to_text(address_);
  if (now == serving_) return {};
  std::string problem = trust_.serving().write(now);
  if (problem.empty()) serving_ = std::move(now);  // on an error the next round tries again
  return problem;
}

void ControlServer::schedule_serving_file() {
  serving_timer_.expires_after(kServingFileInterval);
  serving_timer_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled || stopping_) return;
    const std::string problem = write_serving_file();
    if (!std::exchange(serving_fails_, !problem.empty()) && !problem.empty() && on_event_)
      on_event_(
          {ControlEvent::kTrouble, "", "",
           problem + "; `tandem-server sessions" + auth::server_state_option(folder()) + "` shows the previous state"});
    audit_.service();
    schedule_serving_file();
  });
}

void ControlServer::schedule_revocation_check() {
  revocation_timer_.expires_after(kRevocationCheckInterval);
  revocation_timer_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled || stopping_) return;
    commands_.disconnect_revoked();
    plane_.disconnect_revoked();
    if (const auto grace = trust_.serving().requested_shutdown())
      commands_.drain(*grace, "`tandem-server stop` on this computer");
    schedule_revocation_check();
  });
}

std::string ControlServer::start() {
  if (trust_.on_disk()) {
    trust_.write_audit_behind();
    if (std::string problem = write_serving_file(); !problem.empty()) return problem;
    schedule_serving_file();
    schedule_revocation_check();
  }
  started_ = true;
  thread_.start();
  return {};
}

void ControlServer::stop() {
  if (!std::exchange(started_, false)) return;
  thread_.stop([this] {
    stopping_ = true;  // the handler of a timer that has expired already is not cancelled
    serving_timer_.cancel();
    revocation_timer_.cancel();
    if (metrics_) metrics_->stop();
    plane_.stop();
    registry_.requests().stop_watching();
    commands_.give_replies();
    audit_.close();
  });
}

}  // namespace tandem::server
