#include "tests/server/directory/simulated_service.h"

#include <algorithm>

namespace tandem::directory::test {

void SimulatedService::begin() {
  for (std::size_t n = 0; n < nodes_.size(); ++n) start_process(n);
  begin_ticks();
  clients_.resize(schedule_.sessions * kClientsPerSession);
  for (std::size_t c = 0; c < clients_.size(); ++c) ask_around(c);
  for (std::size_t s = 0; s < schedule_.sessions; ++s) present_tickets(s);
  begin_faults();
}

Verdict SimulatedService::run() {
  const Time calm_from = Time{} + schedule_.calm;
  while (verdict_.violation.empty()) {
    events_.step();
    ++verdict_.events;
    check_owners();
    if (now() <= calm_from) continue;
    if (not_served().empty()) {
      verdict_.recovered = now() - calm_from;
      break;
    }
    if (now() > calm_from + calm_limit()) fail(not_served());
  }
  return verdict_;
}

void SimulatedService::on_pause(std::size_t n) {
  for (std::size_t s = 0; s < schedule_.sessions; ++s)
    nodes_[n].acted_as[s] = acts(nodes_[n], s) ? acting_revision(n, s) : 0;
}

// A datagram that was almost sent when the pause began.
void SimulatedService::on_pause_end(std::size_t n) {
  for (std::size_t c = 0; c < clients_.size(); ++c)
    if (const Revision revision = nodes_[n].acted_as[session_of(c)]; revision != 0) force(c, n, revision);
}

void SimulatedService::to_server(std::size_t n, std::function<void()> what) {
  if (clients_cut(n) || lost()) return;
  after(delay(n), [this, n, what = std::move(what)] { deliver(n, nodes_[n].incarnation, what); });
}

void SimulatedService::ask_around(std::size_t c) {
  after(draw(100ms, 400ms), [this, c] {
    Client& client = clients_[c];
    // A server without its disk knows no revision of a store that is lost: a person starts the client again.
    const bool stranger =
        std::ranges::any_of(schedule_.faults, [](const Fault& fault) { return fault.kind == Fault::Kind::kDiskLost; });
    if (stranger && now() - client.last_force > kPatience) client.highest = client.obeyed = 0;
    if (!client.server || now() - client.last_force > 1s) client.server = draws_.below(nodes_.size());
    ask(c);
    ask_around(c);
  });
}

void SimulatedService::ask(std::size_t c) {
  const std::size_t n = *clients_[c].server;
  to_server(n, [this, c, n] { on_asked(c, n); });
}

void SimulatedService::force(std::size_t c, std::size_t n, Revision revision) {
  if (clients_cut(n) || lost()) return;
  after(delay(n), [this, c, n, revision] {
    Client& client = clients_[c];
    if (revision < client.highest && removed_ != Guard::kHighestRevision) {
      ++verdict_.rejected;
      return;
    }
    if (revision < client.obeyed)
      fail(format("client %zu obeys revision %lld after a higher one", c, static_cast<long long>(revision)));
    client.highest = client.obeyed = std::max(client.obeyed, revision);
    client.last_force = now();
    client.server = n;
  });
}

void SimulatedService::refer(std::size_t c, std::size_t n, const std::string& other) {
  if (clients_cut(n) || lost()) return;
  after(delay(n), [this, c, other] {
    if (now() - clients_[c].last_force < 1s) return;
    for (std::size_t to = 0; to < nodes_.size(); ++to)
      if (server_name(to) == other) clients_[c].server = to;
    ask(c);
  });
}

/// Presents tickets at random servers; each of them often, as a thief and a broken client do.
void SimulatedService::present_tickets(std::size_t s) {
  after(draw(50ms, 600ms), [this, s] {
    std::size_t n = draws_.below(nodes_.size());
    // An honest client in the calm phase goes to the owner.
    for (std::size_t owner = 0; calm() && owner < nodes_.size(); ++owner)
      if (acts(nodes_[owner], s)) n = owner;
    const std::string ticket = calm() ? format("calm-%llu", static_cast<unsigned long long>(++calm_ticket_))
                                      : format("ticket-%llu", static_cast<unsigned long long>(draws_.below(12)));
    to_server(n, [this, n, s, ticket] { use_ticket(n, s, ticket); });
    present_tickets(s);
  });
}

void SimulatedService::accept(const std::string& session, const std::string& ticket) {
  ++verdict_.tickets;
  // A store that has lost its data knows no use of before.
  if (++accepted_[ticket] > 1 + losses()) fail("ticket " + ticket + " was accepted twice");
  if (ticket.starts_with("calm")) calm_tickets_.insert(session);
}

void SimulatedService::check_owners() {
  for (std::size_t s = 0; s < schedule_.sessions; ++s) {
    int acting = 0;
    for (Node& node : nodes_) {
      const bool really = acts(node, s);
      if (really) node.last_acted[s] = now();
      // The hands take kRamp, whatever the server was given.
      if (really || (runs(node) && now() - node.last_acted[s] < kRamp - times_.ramp)) ++acting;
    }
    if (acting > 1) fail(format("%d servers act for session %zu", acting, s));
  }
}

/// Says what is missing in the calm phase; empty: nothing.
std::string SimulatedService::not_served() const {
  for (std::size_t s = 0; s < schedule_.sessions; ++s) {
    if (std::ranges::none_of(nodes_, [&](const Node& node) { return acts(node, s); }))
      return format("session %zu has no owner in the calm phase", s);
    if (!calm_tickets_.contains(session_name(s))) return format("session %zu takes no ticket in the calm phase", s);
  }
  for (std::size_t c = 0; c < clients_.size(); ++c)
    if (clients_[c].last_force <= Time{} + schedule_.calm || now() - clients_[c].last_force >= 1s)
      return format("client %zu gets no force in the calm phase", c);
  return {};
}

}  // namespace tandem::directory::test
