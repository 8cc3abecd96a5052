#include "tests/server/directory/model_check.h"

#include <memory>

#include "server/directory/ownership.h"
#include "tests/server/directory/guard_removal.h"
#include "tests/server/directory/simulated_service.h"

namespace tandem::directory::test {

namespace {

/// Servers that are `Ownership` cores and nothing else.
class OwnershipRun final : public SimulatedService {
 public:
  OwnershipRun(const Schedule& schedule, Guard removed) : SimulatedService(schedule, removed) {
    cores_.resize(nodes_.size());
    begin();
  }
  [[nodiscard]] std::uint64_t doubtful() const {
    std::uint64_t sum = 0;
    for (const auto& core : cores_) sum += core ? core->keeper().doubtful_renewals() : 0;
    return sum;
  }

 private:
  void start(std::size_t n) override { cores_[n] = std::make_unique<Ownership>(server_name(n), "text", times_); }
  void stop(std::size_t n) override { cores_[n].reset(); }
  void pump(std::size_t n) override {
    Node& node = nodes_[n];
    while (true) {
      const Duration out = delay(n), back = delay(n);
      // Counted from the arrival of the answer: the core gets that time as the time of sending.
      const Duration lie = removed_ == Guard::kSendingTime ? out + back : Duration{};
      auto operation = cores_[n]->poll_operation(clock(node) + lie);
      if (!operation) break;
      Request& request = operation->request;
      if (const auto own =
              answer_without_store(removed_, server_name(n), cores_[n]->keeper().lease(), operation->id, request)) {
        reply(n, node.incarnation, *own, back);
        continue;
      }
      weaken(removed_, immortal_, request);
      send(n, operation->id, request, out, back);
    }
    while (auto notice = cores_[n]->poll_notice()) on_notice(n, *notice);
  }
  void take(std::size_t n, Reply reply) override {
    weaken(removed_, server_name(n), cores_[n]->keeper().lease(), reply);
    cores_[n]->on_reply(clock(nodes_[n]), reply);
  }
  void on_notice(std::size_t n, const Notice& notice) {
    mix(n, static_cast<std::uint64_t>(notice.kind), static_cast<std::uint64_t>(notice.revision));
    if (notice.kind == Notice::Kind::kOwned) {
      ++verdict_.owners;
      const std::size_t standby = draws_.below(nodes_.size());
      if (chance(0.7)) cores_[n]->set_standby(notice.session, server_name(standby));
    } else if (notice.kind == Notice::Kind::kElsewhere) {
      ++verdict_.elsewhere;
      for (std::size_t c = 0; c < clients(); ++c)
        if (session_name(session_of(c)) == notice.session) refer(c, n, notice.other);
    } else if (notice.kind == Notice::Kind::kTicketAccepted) {
      accept(notice.session, notice.other);
    }
  }
  void move(std::size_t session, std::size_t to) override {
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      if (runs(nodes_[n])) cores_[n]->move(session_name(session), server_name(to));
  }
  bool acts(const Node& node, std::size_t s) const override {
    const auto& core = cores_[static_cast<std::size_t>(&node - nodes_.data())];
    return runs(node) && core->may_act(session_name(s), clock(node));
  }
  Revision acting_revision(std::size_t n, std::size_t s) const override { return cores_[n]->revision(session_name(s)); }
  void on_asked(std::size_t c, std::size_t n) override {
    Ownership& core = *cores_[n];
    const std::string session = session_name(session_of(c));
    const SessionState state = core.state(session, clock(nodes_[n]));
    if (state == SessionState::kServing) return force(c, n, core.revision(session));
    if (state == SessionState::kLost) core.forget(session);
    if (state == SessionState::kLost || state == SessionState::kNone) core.claim(session);
  }
  void use_ticket(std::size_t n, std::size_t s, const std::string& ticket) override {
    cores_[n]->use_ticket(session_name(s), ticket);
  }

  LeaseId immortal_ = store_.execute(0, Grant{24h}).lease;
  std::vector<std::unique_ptr<Ownership>> cores_;
};

}  // namespace

Verdict run_schedule(const Schedule& schedule, Guard removed) {
  OwnershipRun run(schedule, removed);
  Verdict verdict = run.run();
  verdict.doubtful = run.doubtful();
  return verdict;
}

}  // namespace tandem::directory::test
