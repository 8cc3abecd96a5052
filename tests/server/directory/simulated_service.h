#pragma once

#include <map>
#include <optional>
#include <set>

#include "tests/server/directory/simulated_store.h"

namespace tandem::directory::test {

/// A service with its clients, and what must hold for it: no two servers act for one session, no ticket is accepted
/// twice, no client obeys an older owner after a newer one, and in the calm phase every client is served.
class SimulatedService : protected SimulatedStore {
 public:
  [[nodiscard]] Verdict run();

 protected:
  SimulatedService(const Schedule& schedule, Guard removed) : SimulatedStore(schedule, removed) {}

  /// Whether a server may put effort on the hands of a session now.
  [[nodiscard]] virtual bool acts(const Node& node, std::size_t session) const = 0;
  /// Revision as which a server acts for a session.
  [[nodiscard]] virtual Revision acting_revision(std::size_t n, std::size_t session) const = 0;
  /// A client asks a server for its session. It answers by `force` or `refer`.
  virtual void on_asked(std::size_t client, std::size_t n) = 0;
  virtual void use_ticket(std::size_t n, std::size_t session, const std::string& ticket) = 0;
  [[nodiscard]] virtual Duration calm_limit() const { return kCalmLimit; }

  /// Begins all processes, clients and faults.
  void begin();
  [[nodiscard]] std::size_t session_of(std::size_t client) const { return client / kClientsPerSession; }
  [[nodiscard]] std::size_t clients() const { return clients_.size(); }
  /// A server moves a client's hand.
  void force(std::size_t client, std::size_t n, Revision revision);
  /// A server names another one to a client.
  void refer(std::size_t client, std::size_t n, const std::string& other);
  void accept(const std::string& session, const std::string& ticket);

 private:
  static constexpr std::size_t kClientsPerSession = 2;
  static constexpr Duration kPatience = 10s;
  /// It obeys the server with the highest revision, and asks around when it gets no force.
  struct Client {
    std::optional<std::size_t> server;
    Time last_force{};
    Revision highest = 0, obeyed = 0;
  };

  void on_pause(std::size_t n) final;
  void on_pause_end(std::size_t n) final;
  void to_server(std::size_t n, std::function<void()> what);
  void ask_around(std::size_t c);
  void ask(std::size_t c);
  void present_tickets(std::size_t s);
  void check_owners();
  [[nodiscard]] std::string not_served() const;

  std::vector<Client> clients_;
  std::uint64_t calm_ticket_ = 0;
  std::map<std::string, int> accepted_;
  std::set<std::string> calm_tickets_;
};

}  // namespace tandem::directory::test
