#pragma once

#include <deque>
#include <map>
#include <set>

#include "server/directory/directory.h"

namespace tandem::directory {

/// The store in memory, with the semantics of etcd v3: revisions, transactions, leases, watches, compaction and
/// elections. Tests and simulations use it; `EtcdConformance` compares its answers with those of etcd.
///
/// Pure: the caller passes the time of the store's own clock, which must not go back.
class ModelStore {
 public:
  /// Shortest time of a lease: etcd's default, 1.5 times its election timeout of 1 s, in whole seconds.
  static constexpr Duration kTtlMin = std::chrono::seconds(2);
  /// Changes that are kept for watches; older ones are compacted.
  static constexpr std::size_t kHistoryMax = 100'000;

  ModelStore() = default;
  /// @param leases_from  number after which leases are numbered, as two stores have no lease id in common
  explicit ModelStore(LeaseId leases_from) : newest_lease_(leases_from) {}

  /// Ends the leases whose time is over, in the order of their ends.
  void advance(Time now);
  /// Executes a request at the present time. A Watch opens a stream whose changes `take_changes` returns.
  [[nodiscard]] Reply execute(OperationId operation, const Request& request);
  /// Returns the changes of an open watch since the last call, or its end.
  [[nodiscard]] std::optional<Reply> take_changes(OperationId watch);
  void close(OperationId watch) { watches_.erase(watch); }
  /// Returns a number to add to the caller's operations, so that several callers have different ones.
  [[nodiscard]] OperationId connect() noexcept { return ++connections_ << 40; }

  /// Elects a new leader. As in etcd, it gives every lease its whole time again.
  void elect();
  /// Goes on at `now` from an older copy, as etcd does when it is restored: it elects a leader, and each lease of the
  /// copy has its whole time.
  /// @param leases_from  number after which new leases are numbered, as in the constructor
  void resume(Time now, LeaseId leases_from);
  /// Answers a request as the leader before the newest election does until it learns of it. That leader knows the
  /// leases of its time and answers renewals by itself, without effect; it can complete no other request.
  [[nodiscard]] std::optional<Reply> execute_deposed(OperationId operation, const Request& request) const;

  [[nodiscard]] Revision revision() const noexcept { return revision_; }
  [[nodiscard]] std::uint64_t term() const noexcept { return term_; }
  [[nodiscard]] const std::map<std::string, KeyValue>& entries() const noexcept { return entries_; }
  [[nodiscard]] std::size_t leases() const noexcept { return leases_.size(); }
  /// Transactions that wrote, and ends of leases: the entries that the store has to put on its disk.
  [[nodiscard]] std::uint64_t writes() const noexcept { return writes_; }

 private:
  struct Lease {
    Duration ttl{};
    Time end{};
    std::set<std::string> keys;
  };
  struct OpenWatch {
    std::string prefix;
    Revision next = 0;
  };

  [[nodiscard]] Reply answer(OperationId operation, Outcome outcome = Outcome::kDone) const;
  [[nodiscard]] Reply grant(OperationId operation, const Grant& wanted);
  [[nodiscard]] Reply renew(OperationId operation, LeaseId lease);
  [[nodiscard]] Reply remaining(OperationId operation, LeaseId lease) const;
  [[nodiscard]] Reply run(OperationId operation, const Transaction& transaction);
  [[nodiscard]] Reply watch(OperationId operation, const Watch& wanted);
  [[nodiscard]] Reply compact(OperationId operation, Revision until);
  [[nodiscard]] bool holds(const Condition& condition) const;
  [[nodiscard]] Outcome problem(const std::vector<Step>& steps) const;
  void put(const Put& step, Revision at);
  bool erase(const std::string& key, Revision at);
  void end_lease(std::map<LeaseId, Lease>::iterator lease);
  void record(Change change);
  void forget(Revision until);
  [[nodiscard]] std::vector<KeyValue> read(const Read& step) const;

  Time now_{};
  Revision revision_ = 1;          ///< as in etcd, of the empty store
  Revision compact_revision_ = 0;  ///< of the newest Compact
  Revision compacted_ = 0;         ///< changes up to this revision are forgotten
  std::uint64_t term_ = 1, writes_ = 0;
  LeaseId newest_lease_ = 0;
  OperationId connections_ = 0;
  std::map<std::string, KeyValue> entries_;
  std::map<LeaseId, Lease> leases_;
  std::map<LeaseId, Duration> leases_before_election_;
  std::deque<Change> history_;
  std::map<OperationId, OpenWatch> watches_;
};

/// A `Directory` whose store answers at once, in this process: for one server alone, and for tests.
class ModelDirectory final : public Directory {
 public:
  explicit ModelDirectory(ModelStore& store) : store_(store), connection_(store.connect()) {}
  void begin(OperationId operation, const Request& request) override;
  [[nodiscard]] std::optional<Reply> poll() override;

 private:
  ModelStore& store_;
  OperationId connection_;
  std::deque<Reply> replies_;
  std::vector<OperationId> watches_;  ///< of the caller
};

}  // namespace tandem::directory
