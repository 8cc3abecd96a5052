#include "server/app/control/control_server.h"

#include <sys/resource.h>

#include <algorithm>
#include <asio/post.hpp>
#include <future>
#include <utility>

#include "common/auth/io/identity_selector.h"
#include "common/base/format.h"
#include "common/io/log.h"
#include "server/app/monitor/metrics.h"

namespace tandem::server {
namespace {

constexpr auto kServingFileInterval = std::chrono::seconds(1);  // between two writes of the list of sessions
// With the close-out of a seat (0.2 s) a revocation acts within a second.
constexpr auto kRevocationCheckInterval = std::chrono::milliseconds(250);
constexpr int kPortsTried = 20;  // ports that are tried until one is free for UDP and TCP

/// Keys of a directory made by `init`, or ephemeral keys. Beyond loopback at least one workstation must be able to
/// join.
std::expected<auth::ServerKeystore, std::string> keys_of(const io::SocketAddress& listen, const std::string& state) {
  const std::int64_t now = auth::wall_seconds();
  if (state.empty() && listen.loopback()) return auth::ServerKeystore::ephemeral(now);
  const auto path = auth::server_state_path(state);
  if (!path) return std::unexpected("--state: " + path.error());
  auto trust = auth::ServerKeystore::open(*path);
  if (!trust) return std::unexpected(trust.error());
  const auto book = trust->workstations();
  if (!book) return std::unexpected(book.error());
  const auto codes = trust->pending_codes(now);
  if (!codes) return std::unexpected(codes.error());
  if (!listen.loopback() && book->empty() && *codes == 0)
    return std::unexpected("no client could join: no workstation is enrolled in " + *path +
                           ". Run `tandem-server enroll" + auth::server_state_option(*path) +
                           " NAME --address HOST:PORT` for each, then start again");
  return trust;
}

/// Raises the limit of open files to all connections that the limits allow and the program's own files. A login shell
/// often permits 1024 only.
void permit_descriptors(const ControlLimits& limits) {
  constexpr rlim_t kOwn = 512;
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

ControlServer::ControlServer(auth::ServerKeystore trust, const Options& plan)
    : trust_(std::move(trust)),
      on_event_(plan.on_event),
      on_message_(plan.on_message),
      registry_(thread_.context()),
      commands_(registry_, trust_, plan.on_message),
      joins_(registry_, commands_, trust_, plan.load_limits, plan.on_message),
      plane_(thread_.context(), trust_, joins_, plan.limits, {},
             [this](const ControlEventRecord& news) {
               if (record_event(news) && on_event_) on_event_(news);
             }),
      serving_timer_(thread_.context()),
      revocation_timer_(thread_.context()) {}

ControlServer::~ControlServer() { stop(); }

std::string ControlServer::problem_with_keys(const io::SocketAddress& listen, const std::string& state) {
  const auto trust = keys_of(listen, state);
  return trust ? std::string() : trust.error();
}

std::vector<std::string> ControlServer::problems_with_keys(const io::SocketAddress& listen, const std::string& state) {
  if (state.empty() && listen.loopback()) return {};
  const auto path = auth::server_state_path(state);
  if (!path) return {path.error()};
  auto wrong = auth::ServerKeystore::find_errors(*path);
  if (!wrong.empty()) return wrong;
  std::string who = problem_with_keys(listen, state);
  return who.empty() ? std::vector<std::string>{} : std::vector{std::move(who)};
}

/// Tries a free port, because a running server may use the configured one.
std::string ControlServer::problem_with_address(const io::SocketAddress& listen) {
  const std::string host = io::to_text(listen);
  const auto free = io::parse_address(host.substr(0, host.rfind(':')) + ":0", 0);
  if (!free) return free.error();
  const auto socket = io::bind_udp(*free);
  return socket ? std::string()
                : "this computer cannot listen there: " + socket.error() +
                      "; use one of its own addresses (`ip address`), 0.0.0.0 for all, or 127.0.0.1";
}

std::expected<std::unique_ptr<ControlServer>, std::string> ControlServer::open(const Options& plan) {
  auto trust = keys_of(plan.listen, plan.state);
  if (!trust) return std::unexpected(trust.error());
  if (trust->on_disk())
    if (std::string problem = trust->begin_serving(auth::wall_seconds()); !problem.empty())
      return std::unexpected(std::move(problem));
  trust->enable_audit_rotation(plan.audit);
  permit_descriptors(plan.limits);
  std::unique_ptr<ControlServer> door{new ControlServer(std::move(*trust), plan)};
  std::string problem;
  for (int attempt = 0; attempt < kPortsTried; ++attempt) {
    auto sockets = io::bind_udp_steered(plan.listen, plan.steering);
    if (!sockets) return std::unexpected("--listen: " + sockets.error());
    auto listening = door->plane_.listen(sockets->front().local);
    if (listening) {
      door->address_ = *listening;
      door->sockets_ = std::move(*sockets);
      break;
    }
    problem = "--listen: " + listening.error();
    if (plan.listen.port() != 0) break;  // a chosen port may be in use for TCP: try the next one
  }
  if (door->sockets_.empty()) return std::unexpected(problem);
  if (plan.metrics) {
    door->metrics_.emplace(
        door->thread_.context(),
        [d = door.get()](std::string_view path) {
          const auth::AuditLog& log = d->trust_.audit_log();
          return monitoring_page(path, d->registry_, d->plane_, {log.error(), log.lost(), d->throttle_.suppressed()});
        },
        plan.metrics_hosts);
    if (std::string trouble = door->metrics_->listen(*plan.metrics); !trouble.empty())
      return std::unexpected("metrics: " + trouble +
                             "; choose another address or port for them, or end the program that uses it");
  }
  if (door->ephemeral_keys()) {
    auto local = auth::publish_local_keys(door->trust_, auth::runtime_path(), auth::wall_seconds());
    if (!local) return std::unexpected("the keys for clients on this machine could not be published: " + local.error());
    door->local_.emplace(std::move(*local));
  }
  return door;
}

std::string ControlServer::folder() const { return trust_.on_disk() ? trust_.folder()->path() : auth::runtime_path(); }

void ControlServer::add_session(SessionRegistration opening) { registry_.add(std::move(opening)); }

void ControlServer::on_thread(const std::function<void()>& what) {
  std::promise<void> done;
  asio::post(thread_.context(), [&] {
    what();
    done.set_value();
  });
  done.get_future().wait();
}

void ControlServer::close_session(const auth::Id16& id) {
  std::promise<void> gone;
  asio::post(thread_.context(), [&] { registry_.remove(id, [&] { gone.set_value(); }); });
  gone.get_future().wait();
}

void ControlServer::add_running_session(SessionRegistration opening) {
  on_thread([&] { registry_.add_running(std::move(opening)); });
}

void ControlServer::end_session(const auth::Id16& id) {
  on_thread([&] { registry_.end(id); });
}

void ControlServer::drain() {
  on_thread([&] { registry_.drain().begin(); });
}

std::string ControlServer::write_serving_file() {
  ServingSpec now = registry_.serving();
  now.address = io::to_text(address_);
  if (now == serving_) return {};
  std::string problem = trust_.write_serving(now);
  if (problem.empty()) serving_ = std::move(now);  // on an error the next round tries again
  return problem;
}

void ControlServer::schedule_serving_file() {
  serving_timer_.expires_after(kServingFileInterval);
  serving_timer_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled) return;
    const std::string problem = write_serving_file();
    if (!std::exchange(serving_fails_, !problem.empty()) && !problem.empty() && on_event_)
      on_event_(
          {ControlEvent::kTrouble, "", "",
           problem + "; `tandem-server sessions" + auth::server_state_option(folder()) + "` shows the previous state"});
    service_audit_log();
    schedule_serving_file();
  });
}

void ControlServer::schedule_revocation_check() {
  revocation_timer_.expires_after(kRevocationCheckInterval);
  revocation_timer_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled) return;
    commands_.disconnect_revoked();
    plane_.disconnect_revoked();
    if (const auto grace = trust_.requested_shutdown())
      commands_.drain(*grace, "`tandem-server stop` on this computer");
    schedule_revocation_check();
  });
}

std::string ControlServer::start() {
  if (trust_.on_disk()) {
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
    serving_timer_.cancel();
    revocation_timer_.cancel();
    if (metrics_) metrics_->stop();
    plane_.stop();
    registry_.requests().stop_watching();
    close_audit_log();
  });
}

}  // namespace tandem::server
