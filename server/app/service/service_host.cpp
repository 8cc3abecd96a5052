#include "server/app/service/service_host.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/auth/io/state_directory.h"
#include "common/base/format.h"
#include "common/base/hex.h"
#include "common/io/clock.h"
#include "common/io/processors.h"
#include "proto/text/scene_text.h"
#include "server/app/control/session_registry.h"
#include "server/app/service/service_config.h"
#include "server/app/service/service_specs.h"
#include "server/directory/io/etcd_directory.h"
#include "server/service/published_load.h"
#include "server/service/service_consoles.h"

namespace tandem::server {
namespace {

constexpr Duration kPublishInterval = std::chrono::seconds(1);
constexpr Duration kFormerRunMax = std::chrono::seconds(5);  // to end here before the next one opens
constexpr Duration kLeaveMax = std::chrono::milliseconds(800);
constexpr double kExpectedStep = 0.01;  // [cores] of the expected load, which changes with the sessions only

std::uint64_t drawn_seed() {
  std::uint64_t seed = 0;
  for (const std::byte b : auth::random_bytes<std::array<std::byte, 8>>())
    seed = seed << 8 | std::to_integer<unsigned>(b);
  return seed;
}

}  // namespace

std::expected<std::unique_ptr<ServiceHost>, std::string> ServiceHost::open(const Parts& parts) {
  const ServiceOptions& in = *parts.options.directory;
  if (std::string problem = membership_error(in, parts.control.trust()); !problem.empty())
    return std::unexpected(std::move(problem));
  const auth::ServiceMembership* const membership = parts.control.trust().membership();
  std::string server = membership->name;
  auto keys = auth::ServerKeystore::open(parts.control.folder());
  if (!keys) return std::unexpected(keys.error());
  directory::ServerRecord record;
  record.voucher = to_hex(membership->credential());
  record.address = in.address.empty() ? io::to_text(parts.control.address()) : in.address;
  record.key = to_hex(parts.control.trust().identity().fingerprint().sha256);
  record.version = parts.options.version;
  record.zone = in.zone;
  return std::unique_ptr<ServiceHost>(new ServiceHost(parts, std::move(server), std::move(record), std::move(*keys)));
}

ServiceHost::ServiceHost(const Parts& parts, std::string server, directory::ServerRecord record,
                         auth::ServerKeystore keys)
    : parts_(parts),
      server_(std::move(server)),
      voucher_ends_(parts.control.trust().membership()->not_after),
      record_(std::move(record)),
      news_(server_, joined_endpoints(parts.options.directory->etcd), parts.options.directory->times,
            parts.options.directory->tls_options) {
  const ServiceOptions& in = *parts.options.directory;
  ServiceMemberOptions options{.server = server_,
                               .prefix = in.prefix,
                               .times = in.times,
                               .key = RandomKey{drawn_seed()},
                               .configured = {},
                               .agreed = RegistryMirror::read_agreement(*keys.folder()),
                               .registry_mark = to_hex(auth::random_bytes<auth::Id16>()),
                               .balance = in.balance};
  for (const SessionOptions& session : parts.options.sessions)
    options.configured.emplace(session.name, spec_of(session));
  differences_.emplace(server_, options.configured);
  thread_ = std::make_unique<ServiceThread>(std::move(options), std::make_unique<directory::EtcdDirectory>(in.etcd),
                                            snapshots_);
  list_file_ =
      std::make_unique<ServiceListFile>(*parts_.control.trust().folder(), *thread_, [this](const std::string& what) {
        parts_.output.post_message("list of the service's sessions for commands: " + what);
      });
  registry_ = std::make_unique<RegistryMirror>(std::move(keys), *thread_, [this](const std::string& what) {
    parts_.output.post_message("workstations of the service: " + what);
  });
  locator_ = std::make_unique<ServiceLocator>(server_, *thread_);
  ticket_uses_ = std::make_unique<ServiceTicketUses>(*thread_, parts_.control);
  publish_load();
  parts_.control.registry().drain().let_sessions_move();
  parts_.control.set_service_status([this] { return status(); });
  parts_.control.set_locator(*locator_);
  parts_.control.set_ticket_uses(*ticket_uses_);
}

void ServiceHost::start() {
  auto& trust = parts_.control.trust();
  if (const std::string text =
          voucher_warning(*trust.membership(), trust.identity().fingerprint(), auth::wall_seconds());
      !text.empty())
    parts_.output.report(io::Level::kWarn, {.event = "service_voucher_expires", .text = text}, text);
  thread_->start([this](const ServiceTickets::Result& result) { ticket_uses_->on_result(result); });
  registry_->start();
  list_file_->start();
}

void ServiceHost::step(Time now) {
  if (leaving_) return;
  thread_->clear_fd();
  while (auto event = thread_->take_event()) execute(std::move(*event), now);
  for (std::size_t n = waiting_.size(); n > 0; --n) {
    Waiting next = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    if (!serves(parts_.sessions, next.event.session))
      open_session(next.event);
    else if (now < next.until)
      waiting_.push_back(std::move(next));
    else
      open_failed(next.event, "its former run on this server does not end");
  }
  ended_.step(now, *thread_, parts_.sessions);
  report(thread_->quietly([this](const ServiceMember& member, Time t) { return news_.update(t, member.status(t)); }));
  if (published_ && now - *published_ < kPublishInterval) return;
  published_ = now;
  publish_lists();
  publish_load();
  report_differences();
  forget_moved();
  locator_->remember_members();
}

void ServiceHost::execute(ServiceEvent event, Time now) {
  switch (event.kind) {
    case ServiceEvent::Kind::kOpen:
      if (!serves(parts_.sessions, event.session)) return open_session(event);
      waiting_.push_back({std::move(event), now + kFormerRunMax});
      return;
    case ServiceEvent::Kind::kGiveUp:
      std::erase_if(waiting_, [&](const Waiting& w) { return w.event.session == event.session; });
      snapshots_.remove(event.session);
      parts_.sessions.give_up(event.session);
      thread_->with([&](ServiceMember& member, Time) { member.sessions().on_given_up(event.session); });
      return;
    case ServiceEvent::Kind::kHandOver:
      if (event.waits && in_use(event.session)) {
        listed_.erase(event.session);  // the member took no list meanwhile
        return thread_->with([&](ServiceMember& member, Time) { member.moves().on_kept(event.session); });
      }
      // A session that ends just now does not go on elsewhere: `on_over` ends it in the directory.
      if (!parts_.sessions.hand_over(event.session, event.text + "; its clients join there")) return;
      handing_over_.insert(event.session);
      parts_.control.release_consoles(event.session);
      return;
    case ServiceEvent::Kind::kUnreadable: {
      const std::string text = "session " + event.session +
                               " is not served here: the directory has it in a form that this release does not read. "
                               "Another release may; to end it, erase its keys with etcdctl";
      parts_.output.report(io::Level::kWarn, {.event = "service_unreadable", .session = event.session, .text = text},
                           text);
      return;
    }
    case ServiceEvent::Kind::kRefused:
      reply(event.order, rpc::ErrorReply{rpc::ErrorCode::kNotAllowed, event.text, 0});
      return;
  }
}

bool ServiceHost::in_use(const std::string& session) {
  bool used = false;
  parts_.control.change([&](const SessionRegistry& registry, const auto& done) {
    used = std::ranges::any_of(registry.entries(), [&](const SessionEntry& entry) {
      return entry.open() && entry.registration.name == session && entry.in_use(io::monotonic_now());
    });
    done();
  });
  return used;
}

std::expected<std::shared_ptr<const SessionOptions>, std::string> ServiceHost::options_of(
    const std::string& session, const ServiceSession& spec) const {
  SessionOptions options{.name = session, .reports = parts_.options.reports, .record = parts_.options.record};
  const auto configured = std::ranges::find(parts_.options.sessions, session, &SessionOptions::name);
  if (configured != parts_.options.sessions.end()) options = *configured;
  if (const std::string problem = read_spec(spec, options); !problem.empty()) return std::unexpected(problem);
  return std::make_shared<const SessionOptions>(std::move(options));
}

void ServiceHost::open_session(const ServiceEvent& event) {
  const auto options = options_of(event.session, event.spec);
  if (!options) return open_failed(event, options.error());
  OwnedSession owned{
      .options = *options,
      .id = event.spec.id,
      .code = event.spec.code,
      .revision = static_cast<std::uint64_t>(event.revision),
      .act_limit = thread_->act_limit(),
      .keeper = &snapshots_,
      .on_over = [this, name = event.session, spec = event.spec](bool given_up) { on_over(name, spec, given_up); }};
  if (event.spec.ends_s > 0)
    owned.ends_at = io::monotonic_now() + std::chrono::seconds(event.spec.ends_s - auth::wall_seconds());
  if (!event.snapshot.empty()) {
    if (auto snapshot = decode_snapshot(std::as_bytes(std::span(event.snapshot))))
      owned.snapshot = std::move(*snapshot);
    else
      parts_.output.error("session " + event.session + " starts from the beginning: its snapshot in the directory " +
                          snapshot.error());
  }
  owned.consoles =
      tickets_for_next_owner(event.consoles, event.spec.id, owned.snapshot ? owned.snapshot->checkpoint.epoch : 0);
  if (const std::string why = parts_.sessions.open_owned(std::move(owned)); !why.empty())
    return open_failed(event, why);
  thread_->with([&](ServiceMember& member, Time) { member.sessions().on_opened(event.session); });
  published_.reset();
  if (event.order == 0) return;
  rpc::SessionCreated created{.session = {}, .code = event.spec.code, .tickets = {}};
  parts_.control.change([&](const SessionRegistry& registry, const auto& done) {
    if (const SessionEntry* const entry = registry.find(event.spec.id))
      created.session = SessionRegistry::listed(*entry);
    done();
  });
  reply(event.order, std::move(created));
}

void ServiceHost::open_failed(const ServiceEvent& event, const std::string& why) {
  const std::string text = "session " + event.session + " of the service cannot be opened here: " + why;
  parts_.output.report(io::Level::kWarn, {.event = "service_open_failed", .session = event.session, .text = text},
                       text);
  thread_->with([&](ServiceMember& member, Time now) {
    if (event.order == 0) return member.sessions().on_open_failed(now, event.session);
    member.sessions().on_opened(event.session);  // a session that was never open has to leave nothing
    member.sessions().end(event.session);
  });
  reply(event.order, rpc::ErrorReply{rpc::ErrorCode::kNotNow, why, 1});
}

void ServiceHost::on_over(const std::string& session, const ServiceSession& spec, bool given_up) {
  listed_.erase(session);
  if (handing_over_.erase(session) > 0) {
    handed_over_.insert(session);
    return thread_->with([&](ServiceMember& member, Time now) { member.moves().on_handed_over(now, session); });
  }
  if (leaving_ || given_up) return;
  ended_.add(session, spec.id, parts_.sessions.take_endings(spec.id), io::monotonic_now());
  thread_->with([&](ServiceMember& member, Time) {
    if (!spec.restart) return member.end(session);
    ServiceSession next = spec;
    next.id = auth::random_bytes<auth::Id16>();
    if (!next.code.empty()) next.code = make_session_code();
    member.replace(session, next);
  });
}

void ServiceHost::reply(std::uint64_t order, rpc::Body body) {
  const auto found = orders_.find(order);
  if (found == orders_.end()) return;
  const SessionOrder answered = std::move(found->second);
  orders_.erase(found);
  parts_.sessions.reply(answered, std::move(body));
}

/// A session that has moved leaves nothing here, unless it has come back.
void ServiceHost::forget_moved() {
  std::erase_if(handed_over_, [this](const std::string& session) {
    const auto phase =
        thread_->quietly([&](const ServiceMember& member, Time) { return member.sessions().phase(session); });
    if (phase == MemberSession::Phase::kMoving) return false;
    if (!phase) snapshots_.remove(session);
    return true;
  });
}

std::optional<rpc::ErrorReply> ServiceHost::creation_problem(const rpc::CreateSession& wanted) const {
  const auto taken = [&](const SessionOptions& session) { return session.name == wanted.name; };
  if (std::ranges::any_of(parts_.options.sessions, taken) || serves(parts_.sessions, wanted.name))
    return rpc::ErrorReply{
        rpc::ErrorCode::kNotAllowed,
        "a session " + wanted.name + " exists already; choose another name, or end that session first", 0};
  return parts_.sessions.creation_problem();
}

bool ServiceHost::take(SessionOrder& order) {
  const auto* const wanted = std::get_if<rpc::CreateSession>(&order.body);
  if (wanted == nullptr) return false;
  const std::uint64_t number = ++newest_order_;
  const std::string name = wanted->name;
  std::optional<rpc::ErrorReply> problem = creation_problem(*wanted);
  std::optional<ServiceSession> spec;
  if (!problem) {
    const auto options = created_session_options(*wanted, parts_.options.scenes);
    if (options) {
      spec = spec_of(*options);
      spec->created = true;
      if (wanted->life_s > 0) spec->ends_s = auth::wall_seconds() + wanted->life_s;
      problem = parts_.sessions.load_problem(options->scene.tick_hz);
    } else {
      problem = options.error();
    }
  }
  orders_.emplace(number, std::move(order));
  if (!problem && !thread_->with([&](ServiceMember& member, Time now) {
        return member.create(now, name, std::move(*spec), number);
      }))
    problem =
        rpc::ErrorReply{rpc::ErrorCode::kNotAllowed,
                        "a session " + name + " exists already; choose another name, or end that session first", 0};
  if (problem) reply(number, std::move(*problem));
  return true;
}

void ServiceHost::publish_load() {
  double used = 0;
  for (const auto& shard : parts_.shards.all()) used += shard->load().cpu_share();
  record_.used = published_load(record_.used, used);
  std::vector<SessionLoad> loads;
  double expected = 0;
  for (SessionUse& use : parts_.sessions.uses()) {
    expected += use.expected;
    const bool waiting = use.waiting && !watched_.contains(use.name);
    loads.push_back({std::move(use.name), use.measured, use.expected, waiting});
  }
  record_.expected = kExpectedStep * std::round(expected / kExpectedStep);
  record_.capacity = published_capacity(parts_.options.control.load_limits.busy, io::available_processors(),
                                        parts_.shards.rates().size());
  record_.drains = parts_.control.registry().drain().due().has_value();
  thread_->quietly([&](ServiceMember& member, Time) {
    member.describe(record_);
    member.moves().set_loads(loads);
  });
}

void ServiceHost::publish_lists() {
  std::vector<std::pair<std::string, std::string>> lists;
  watched_.clear();
  parts_.control.change([&](const SessionRegistry& registry, const auto& done) {
    for (const SessionEntry& entry : registry.entries()) {
      if (!entry.open()) continue;
      lists.emplace_back(entry.registration.name, listed_text(SessionRegistry::listed(entry)));
      if (!entry.consoles.empty()) watched_.insert(entry.registration.name);
    }
    done();
  });
  thread_->quietly([&](ServiceMember& member, Time) {
    for (auto& [session, text] : lists)
      if (std::string& before = listed_[session]; before != text)
        member.sessions().set_listed(session, before = std::move(text));
  });
}

void ServiceHost::report(const std::vector<ServiceNews::Line>& lines) {
  for (const ServiceNews::Line& line : lines)
    parts_.output.report(line.warning ? io::Level::kWarn : io::Level::kInfo, {.event = line.event, .text = line.text},
                         line.text);
}

void ServiceHost::release_consoles() {
  for (const auto& session : parts_.sessions.all()) parts_.control.release_consoles(session->options().name);
}

bool ServiceHost::left_by_all() const {
  return record_.drains && parts_.sessions.all().empty() &&
         thread_->quietly([](const ServiceMember& member, Time) { return member.empty(); });
}

void ServiceHost::report_differences() {
  const auto found =
      thread_->quietly([this](const ServiceMember& member, Time) { return differences_->update(member); });
  for (const ServiceDifferences::Difference& difference : found)
    parts_.output.report(io::Level::kWarn,
                         {.event = "service_config_differs", .session = difference.session, .text = difference.text},
                         difference.text);
}

void ServiceHost::leave() {
  leaving_ = true;
  const ServiceStatus before = status();
  if (before.follows && before.members == 1 && before.sessions > 0) {
    const std::string text = format(
        "this was the last server of the service: %zu session%s without a server now, and begin%s again from the state "
        "in the directory when one starts",
        before.sessions, before.sessions == 1 ? " is" : "s are", before.sessions == 1 ? "s" : "");
    parts_.output.report(io::Level::kInfo, {.event = "service_left_last", .text = text}, text);
  }
  if (!thread_->leave(kLeaveMax)) {
    const std::string text =
        "the directory did not confirm the end of this server; other servers begin its sessions when "
        "its lease has ended";
    parts_.output.report(io::Level::kWarn, {.event = "service_left", .text = text}, text);
  }
  // A disk that is stuck delays these, and must not delay the other servers.
  registry_->stop();
  list_file_->stop();
  thread_->stop();
}

}  // namespace tandem::server
