#include "tests/server/service/service_model.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "server/service/service_member.h"
#include "tests/server/directory/simulated_service.h"

namespace tandem::server::test {

namespace {

using namespace std::chrono_literals;
using directory::Reply;
using directory::Request;
using directory::test::Node;
using directory::test::Schedule;
using directory::test::server_name;
using directory::test::session_name;
using directory::test::Verdict;

/// The directory as a process reaches it.
class RemoteDirectory final : public directory::Directory {
 public:
  std::function<void(directory::OperationId, const Request&)> send;
  void begin(directory::OperationId operation, const Request& request) override { send(operation, request); }
  std::optional<Reply> poll() override {
    if (replies.empty()) return std::nullopt;
    Reply reply = std::move(replies.front());
    replies.pop_front();
    return reply;
  }
  std::deque<Reply> replies;
};

struct Process {
  RemoteDirectory directory;
  std::unique_ptr<ServiceMember> member;
  std::map<std::string, std::int64_t, std::less<>> serves;  ///< sessions that it serves, with their epochs
  std::map<std::string, ServiceSession> specs;              ///< as opened
  Time limit{};                                             ///< as ActLimit
  Time still_until{};                                       ///< of the main loop
};

class ServiceRun final : public directory::test::SimulatedService {
 public:
  explicit ServiceRun(const Schedule& schedule)
      : SimulatedService(schedule, directory::test::Guard::kNone), processes_(nodes_.size()), stored_(nodes_.size()) {
    // The service has run before, so that its servers know the directory.
    const Reply marked =
        store_.execute(0, directory::Transaction{{}, {directory::Put{"/tandem/v1/registry/.mark", "mark", 0}}, {}});
    for (RegistryAgreement& stored : stored_) stored = {"mark", {}, marked.revision, marked.revision, 0, false};
    begin();
  }
  /// Losses of data that servers have noticed.
  [[nodiscard]] std::uint64_t noticed() const {
    std::uint64_t sum = noticed_;
    for (const auto& process : processes_) sum += process ? process->member->status(now()).losses : 0;
    return sum;
  }

 private:
  void start(std::size_t n) override {
    auto process = std::make_unique<Process>();
    process->directory.send = [this, n](directory::OperationId id, const Request& request) {
      send(n, id, request, delay(n), delay(n));
    };
    ServiceMemberOptions options{.server = server_name(n),
                                 .times = times_,
                                 .key = RandomKey{schedule_.seed}.derive(n),
                                 .agreed = stored_[n],
                                 .registry_mark = format("mark-%zu-%d", n, ++marks_)};
    for (std::size_t s = 0; s < schedule_.sessions; ++s) {
      ServiceSession& spec = options.configured[session_name(s)];
      spec.id[0] = static_cast<std::byte>(s + 1);
      spec.scene = "scene";
      spec.scene_name = "contact";
    }
    process->member = std::make_unique<ServiceMember>(std::move(options), process->directory);
    process->member->describe({.address = server_name(n), .key = "k", .version = "1", .zone = {}, .capacity = 4});
    process->member->registry().set_local({});
    processes_[n] = std::move(process);
  }
  void stop(std::size_t n) override {
    if (processes_[n]) noticed_ += processes_[n]->member->status(now()).losses;
    processes_[n].reset();
  }
  void lose_disk(std::size_t n) override { stored_[n] = {}; }

  void pump(std::size_t n) override {
    Process& process = *processes_[n];
    ServiceMember& member = *process.member;
    member.step(clock(nodes_[n]));
    if (const auto until = member.served_until()) process.limit = *until;
    const bool calm = now() >= Time{} + schedule_.calm;
    if (!calm && now() >= process.still_until && !process.serves.empty() && chance(0.002)) end_run(n);
    // The main loop may be late at each event, and stand still for longer than a takeover takes.
    if (!calm && chance(0.0005)) process.still_until = now() + 8s;
    while (calm || (now() >= process.still_until && !chance(0.1))) {
      const auto event = member.sessions().poll_event();
      if (!event) break;
      on_event(n, *event);
    }
    while (const auto result = member.tickets().poll_result())
      if (result->outcome == ServiceTickets::Outcome::kAccepted) {
        const auto& [session, ticket] = presented_.at(result->order);
        accept(session, ticket);
      }
    if (RegistryAgreement agreed = member.agreement(clock(nodes_[n])); !agreed.mark.empty())
      stored_[n] = std::move(agreed);
  }
  /// A session of the configuration is over, and its next run replaces it.
  void end_run(std::size_t n) {
    Process& process = *processes_[n];
    const std::string session = process.serves.begin()->first;
    process.serves.erase(session);
    ServiceSession next = process.specs.at(session);
    next.id[1] = static_cast<std::byte>(++runs_);
    process.member->replace(session, next);
  }
  void on_event(std::size_t n, const ServiceEvent& event) {
    Process& process = *processes_[n];
    mix(n, static_cast<std::uint64_t>(event.kind), static_cast<std::uint64_t>(event.revision));
    switch (event.kind) {
      case ServiceEvent::Kind::kOpen:
        ++verdict_.owners;
        if (now() + MemberSessions::kRefusalPause < Time{} + schedule_.calm && chance(0.05))
          return process.member->sessions().on_open_failed(clock(nodes_[n]), event.session);
        process.serves[event.session] = event.revision;
        process.specs[event.session] = event.spec;
        return process.member->sessions().on_opened(event.session);
      case ServiceEvent::Kind::kGiveUp:
        process.serves.erase(event.session);
        return process.member->sessions().on_given_up(event.session);
      case ServiceEvent::Kind::kHandOver:
        if (process.serves.erase(event.session) == 0) return;  // its run is over
        process.member->sessions().set_snapshot(event.session, "state at the hand-over");
        return process.member->moves().on_handed_over(clock(nodes_[n]), event.session);
      case ServiceEvent::Kind::kRefused:
      case ServiceEvent::Kind::kUnreadable:
        return;
    }
  }
  void take(std::size_t n, Reply reply) override { processes_[n]->directory.replies.push_back(std::move(reply)); }
  void move(std::size_t session, std::size_t to) override {
    const std::string key = ServiceKeys("/tandem/v1/").move(session_name(session));
    static_cast<void>(store_.execute(0, directory::Transaction{{}, {directory::Put{key, server_name(to), 0}}, {}}));
  }

  bool acts(const Node& node, std::size_t s) const override {
    if (!runs(node)) return false;
    const Process& process = *processes_[index(node)];
    return process.serves.contains(session_name(s)) && clock(node) < process.limit + times_.ramp;
  }
  directory::Revision acting_revision(std::size_t n, std::size_t s) const override {
    return processes_[n]->serves.at(session_name(s));
  }
  std::size_t index(const Node& node) const { return static_cast<std::size_t>(&node - nodes_.data()); }

  void on_asked(std::size_t c, std::size_t n) override {
    Process& process = *processes_[n];
    const std::string session = session_name(session_of(c));
    const SessionPlace place = process.member->locate({session});
    if (place.kind == SessionPlace::Kind::kHere && acts(nodes_[n], session_of(c))) {
      process.member->sessions().set_snapshot(session, "state");
      return force(c, n, process.serves.at(session));
    }
    if (place.kind != SessionPlace::Kind::kElsewhere) return;
    ++verdict_.elsewhere;
    refer(c, n, place.server);
  }
  void use_ticket(std::size_t n, std::size_t s, const std::string& ticket) override {
    presented_[++presentations_] = {session_name(s), ticket};
    processes_[n]->member->tickets().use(clock(nodes_[n]), session_name(s), ticket, 1h, presentations_, false);
  }
  /// A server that has not had the sessions of a lost directory waits for the leases of that, and for the servers that
  /// have.
  Duration calm_limit() const override {
    const bool loses = std::ranges::any_of(schedule_.faults, [](const directory::test::Fault& fault) {
      return fault.kind >= directory::test::Fault::Kind::kEmptied;
    });
    return directory::test::kCalmLimit +
           (loses ? times_.ttl + directory::DirectoryLoss::kOthersLater : Duration::zero());
  }

  std::vector<std::unique_ptr<Process>> processes_;
  std::vector<RegistryAgreement> stored_;  ///< files of each server
  std::map<std::uint64_t, std::pair<std::string, std::string>> presented_;
  std::uint64_t presentations_ = 0, noticed_ = 0;
  int marks_ = 0, runs_ = 0;
};

}  // namespace

Verdict run_service_schedule(const Schedule& schedule) {
  ServiceRun run(schedule);
  Verdict verdict = run.run();
  verdict.losses = run.noticed();
  return verdict;
}

}  // namespace tandem::server::test
