#pragma once

#include <deque>

#include "server/directory/model_store.h"
#include "tests/server/directory/simulated_world.h"

namespace tandem::directory::test {

/// The store of a run, and the network between it and the servers: messages are lost, late, doubled and reordered; the
/// store stops, elects, answers slowly, forgets its history, or loses its data.
class SimulatedStore : protected SimulatedWorld {
 protected:
  SimulatedStore(const Schedule& schedule, Guard removed) : SimulatedWorld(schedule, removed) {
    store_rate_ = 1 + schedule.drift[0];
  }
  virtual ~SimulatedStore() = default;

  /// Begins the process of a server, and ends it.
  virtual void start(std::size_t n) = 0;
  virtual void stop(std::size_t n) = 0;
  /// Lets a server do what it can do now.
  virtual void pump(std::size_t n) = 0;
  /// Gives a server a reply, which may be changed on its way.
  virtual void take(std::size_t n, Reply reply) = 0;
  /// Called at the begin and end of a pause.
  virtual void on_pause(std::size_t) {}
  virtual void on_pause_end(std::size_t) {}
  /// An operator moves a session.
  virtual void move(std::size_t session, std::size_t to) = 0;
  /// The process of a server has ended together with its disk.
  virtual void lose_disk(std::size_t) {}

  void start_process(std::size_t n) {
    Node& node = nodes_[n];
    ++node.incarnation;
    node.up = true;
    node.watches.clear();
    start(n);
  }
  /// Lets each server do something every 20 to 60 ms, and the store every 10 to 500 ms.
  void begin_ticks();
  void begin_faults() {
    for (const Fault& fault : schedule_.faults) at(Time{} + fault.at, [this, fault] { begin(fault); });
  }
  /// Delivers to a process: never to a later one, and after a pause to a paused one.
  void deliver(std::size_t n, std::uint64_t incarnation, std::function<void()> what);
  void send(std::size_t n, OperationId id, const Request& request, Duration out, Duration back);
  /// Delivers a reply, unless the network loses it.
  void reply(std::size_t n, std::uint64_t incarnation, Reply answer, Duration back);
  /// Number of times at which the store has lost its data.
  int losses() const { return losses_; }

  ModelStore store_;

 private:
  Time store_clock() const {
    return Time{} +
           Duration{static_cast<std::int64_t>(static_cast<double>(now().time_since_epoch().count()) * store_rate_)};
  }
  bool store_up() const { return now() >= store_down_until_; }
  static Reply broken(OperationId id) {
    Reply reply;
    reply.operation = id;
    reply.outcome = Outcome::kUnknown;
    return reply;
  }
  void tick(std::size_t n);
  void store_tick();
  void execute(std::size_t n, std::uint64_t incarnation, OperationId id, const Request& request, Duration back);
  void send_changes();
  void begin(const Fault& fault);
  void break_watches();
  void lose_data(Duration age);

  /// Fewest changes that a copy lacks. Servers that register themselves soon reach the revisions of before, and notice
  /// nothing if it lacks only some.
  static constexpr Revision kRevisionsLost = 20;

  double store_rate_ = 1;
  Time store_down_until_{}, slow_until_{};
  OperationId watch_ids_ = 0;
  int losses_ = 0;
  std::deque<std::pair<Time, ModelStore>> copies_;  ///< for a store that is put back; one each second
};

}  // namespace tandem::directory::test
