#include "server/app/front_door.h"

#include <sys/resource.h>

#include <algorithm>
#include <asio/post.hpp>
#include <future>
#include <utility>

#include "common/base/format.h"
#include "common/io/log.h"
#include "common/trust/io/key_choice.h"
#include "server/app/metrics.h"

namespace tandem::server {
namespace {

constexpr auto kRefresh = std::chrono::seconds(1);  // of what is written down for the commands beside
constexpr auto kLookForRevoked = std::chrono::milliseconds(250);  // with a seat's farewell of 0.2 s: within a second
constexpr int kPortsTried = 20;  // until one is free for UDP and TCP

/// Keys of a folder that `init` made; on a network somebody must be able to come.
std::expected<trust::ServerTrust, std::string> keys_of(const io::SocketAddress& listen, const std::string& state) {
  const std::int64_t now = trust::wall_seconds();
  if (state.empty() && listen.loopback()) return trust::ServerTrust::throw_away(now);
  const auto path = trust::server_state_path(state);
  if (!path) return std::unexpected("--state: " + path.error());
  auto trust = trust::ServerTrust::open(*path);
  if (!trust) return std::unexpected(trust.error());
  const auto book = trust->workstations();
  if (!book) return std::unexpected(book.error());
  const auto codes = trust->open_codes(now);
  if (!codes) return std::unexpected(codes.error());
  if (!listen.loopback() && book->empty() && *codes == 0)
    return std::unexpected("nobody could join: no workstation is enrolled in " + *path + ". Run `tandem-server enroll" + trust::server_state_option(*path) + " NAME --address HOST:PORT` for each, then start again");
  return trust;
}

/// Room for every connection the limits allow, beside the program's own files: a login shell often permits 1024 only.
void permit_descriptors(const ControlLimits& limits) {
  constexpr rlim_t kOwn = 512;
  const rlim_t wanted = kMostPerPending * limits.pending + limits.connections + kOwn;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted) return;
  limit.rlim_cur = std::min(limit.rlim_max, wanted);
  setrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur < wanted)
    io::tell(io::Level::kWarn, {.event = "descriptors", .text = format("the system permits %llu open files, and all connections that the limits allow need %llu: raise it (`ulimit -n`, LimitNOFILE), or lower "
                                                                       "`limits { pending, connections }`",
                                                                       static_cast<unsigned long long>(limit.rlim_cur), static_cast<unsigned long long>(wanted))});
}

}  // namespace

FrontDoor::FrontDoor(trust::ServerTrust trust, const Plan& plan)
    : trust_(std::move(trust)),
      tell_(plan.tell),
      say_(plan.say),
      house_(thread_.context(), trust_, plan.load),
      plane_(thread_.context(), trust_, house_, plan.limits, {}, [this](const ControlNews& news) {
        if (note(news) && tell_) tell_(news);
      }),
      refresh_(thread_.context()),
      revoked_(thread_.context()) {
  house_.tell_people(plan.say);
}

FrontDoor::~FrontDoor() { stop(); }

std::string FrontDoor::problem_with_keys(const io::SocketAddress& listen, const std::string& state) {
  const auto trust = keys_of(listen, state);
  return trust ? std::string() : trust.error();
}

std::vector<std::string> FrontDoor::problems_with_keys(const io::SocketAddress& listen, const std::string& state) {
  if (state.empty() && listen.loopback()) return {};
  const auto path = trust::server_state_path(state);
  if (!path) return {path.error()};
  auto wrong = trust::ServerTrust::mistakes(*path);
  if (!wrong.empty()) return wrong;
  std::string who = problem_with_keys(listen, state);
  return who.empty() ? std::vector<std::string>{} : std::vector{std::move(who)};
}

/// With a free port: a server that runs has the other.
std::string FrontDoor::problem_with_address(const io::SocketAddress& listen) {
  const std::string host = io::to_text(listen);
  const auto free = io::parse_address(host.substr(0, host.rfind(':')) + ":0", 0);
  if (!free) return free.error();
  const auto socket = io::bind_udp(*free);
  return socket ? std::string() : "this computer cannot listen there: " + socket.error() + "; use one of its own addresses (`ip address`), 0.0.0.0 for all, or 127.0.0.1";
}

std::expected<std::unique_ptr<FrontDoor>, std::string> FrontDoor::open(const Plan& plan) {
  auto trust = keys_of(plan.listen, plan.state);
  if (!trust) return std::unexpected(trust.error());
  if (trust->on_disk())
    if (std::string problem = trust->begin_serving(trust::wall_seconds()); !problem.empty()) return std::unexpected(std::move(problem));
  trust->keep_audit(plan.audit);
  permit_descriptors(plan.limits);
  std::unique_ptr<FrontDoor> door{new FrontDoor(std::move(*trust), plan)};
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
    if (plan.listen.port() != 0) break;  // a port that was chosen for us may be taken for TCP: the next one
  }
  if (door->sockets_.empty()) return std::unexpected(problem);
  if (plan.metrics) {
    door->metrics_.emplace(door->thread_.context(), [d = door.get()](std::string_view path) {
      const trust::AuditLog& log = d->trust_.audit_log();
      return monitoring_page(path, d->house_, d->plane_, {log.trouble(), log.lost(), d->throttle_.left_out()});
    }, plan.metrics_hosts);
    if (std::string trouble = door->metrics_->listen(*plan.metrics); !trouble.empty()) return std::unexpected("metrics: " + trouble + "; choose another address or port for them, or end what uses it");
  }
  if (door->throw_away()) {
    auto local = trust::let_local_in(door->trust_, trust::runtime_path(), trust::wall_seconds());
    if (!local) return std::unexpected("clients on this machine could not be told how to join: " + local.error());
    door->local_.emplace(std::move(*local));
  }
  return door;
}

std::string FrontDoor::folder() const { return trust_.on_disk() ? trust_.folder()->path() : trust::runtime_path(); }

void FrontDoor::add(House::Opening opening) { house_.open(std::move(opening)); }

void FrontDoor::on_thread(const std::function<void()>& what) {
  std::promise<void> done;
  asio::post(thread_.context(), [&] {
    what();
    done.set_value();
  });
  done.get_future().wait();
}

void FrontDoor::close(const trust::Id16& id) {
  std::promise<void> gone;
  asio::post(thread_.context(), [&] { house_.close(id, [&] { gone.set_value(); }); });
  gone.get_future().wait();
}

void FrontDoor::open_late(House::Opening opening) {
  on_thread([&] { house_.open_late(std::move(opening)); });
}

void FrontDoor::end(const trust::Id16& id) {
  on_thread([&] { house_.end(id); });
}

void FrontDoor::drain() {
  on_thread([&] { house_.drain(); });
}

std::string FrontDoor::write_down() {
  ServingSpec now = house_.serving();
  now.address = io::to_text(address_);
  if (now == serving_) return {};
  std::string problem = trust_.write_serving(now);
  if (problem.empty()) serving_ = std::move(now);  // else it is tried again
  return problem;
}

void FrontDoor::write_down_now_and_then() {
  refresh_.expires_after(kRefresh);
  refresh_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled) return;
    const std::string problem = write_down();
    if (!std::exchange(serving_fails_, !problem.empty()) && !problem.empty() && tell_) tell_({ControlEvent::kTrouble, "", "", problem + "; `tandem-server sessions" + trust::server_state_option(folder()) + "` shows what was so before"});
    look_after_audit();
    write_down_now_and_then();
  });
}

void FrontDoor::look_for_revoked_now_and_then() {
  revoked_.expires_after(kLookForRevoked);
  revoked_.async_wait([this](const asio::error_code& cancelled) {
    if (cancelled) return;
    house_.look_for_revoked();
    plane_.look_for_revoked();
    if (const auto grace = trust_.asked_to_end()) house_.drain_in(*grace, "`tandem-server stop` on this computer");
    look_for_revoked_now_and_then();
  });
}

std::string FrontDoor::start() {
  if (trust_.on_disk()) {
    if (std::string problem = write_down(); !problem.empty()) return problem;
    write_down_now_and_then();
    look_for_revoked_now_and_then();
  }
  started_ = true;
  thread_.start();
  return {};
}

void FrontDoor::stop() {
  if (!std::exchange(started_, false)) return;
  thread_.stop([this] {
    refresh_.cancel();
    revoked_.cancel();
    if (metrics_) metrics_->stop();
    plane_.stop();
    house_.stop_watching();
    end_audit();
  });
}

}  // namespace tandem::server
