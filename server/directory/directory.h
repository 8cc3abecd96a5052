#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/time.h"

/// The directory: a small store of keys with leases, transactions, revisions and watches, shared by all servers of one
/// service. Its semantics are those of etcd v3. `ModelStore` is the same in memory; `EtcdDirectory` talks to etcd.
namespace tandem::directory {

using LeaseId = std::int64_t;       ///< 0: no lease
using Revision = std::int64_t;      ///< of the whole store; rises by one with each transaction that writes
using OperationId = std::uint64_t;  ///< chosen by the caller, unique for the life of a `Directory`

/// A key as the store has it.
struct KeyValue {
  std::string key, value;
  Revision created = 0;   ///< revision of the write that created the key
  Revision modified = 0;  ///< revision of the newest write
  LeaseId lease = 0;      ///< the key is erased when this lease ends; 0: never
  friend bool operator==(const KeyValue&, const KeyValue&) = default;
};

/// A write that a watch reports.
struct Change {
  KeyValue entry;  ///< of an erased key: its name, and the revision of the erasure in `modified`
  bool erased = false;
  friend bool operator==(const Change&, const Change&) = default;
};

/// Asks for a new lease; the store chooses its id.
struct Grant {
  Duration ttl{};  ///< whole seconds; etcd raises a `ttl` below its minimum (2 s by default)
};
/// Extends a lease by its whole time.
struct Renew {
  LeaseId lease = 0;
};
/// Asks for the time for which a lease still holds, without extending it.
struct Remaining {
  LeaseId lease = 0;
};
/// Ends a lease and erases its keys.
struct Revoke {
  LeaseId lease = 0;
};

/// A condition of a transaction. A key that does not exist has the number 0.
struct Condition {
  enum class Of : std::uint8_t { kCreated, kModified, kLease };
  std::string key;
  Of of = Of::kCreated;
  std::int64_t equals = 0;
};
struct Put {
  std::string key, value;
  LeaseId lease = 0;
};
struct Erase {
  std::string key;
};
struct Read {
  std::string key;
  bool prefix = false;  ///< every key that begins with `key`, sorted by name
};
using Step = std::variant<Put, Erase, Read>;

/// Runs `then` if all conditions hold and `otherwise` if not, at one moment. No Put may meet another write of its key
/// in the same branch; a Read sees the writes before it.
struct Transaction {
  std::vector<Condition> conditions;
  std::vector<Step> then, otherwise;
};

/// Asks for all changes of keys with this prefix, beginning with revision `from`. The operation stays open: each reply
/// has changes, until one has another outcome than kDone.
struct Watch {
  std::string prefix;
  Revision from = 0;
};
/// Forgets the changes before revision `until`.
struct Compact {
  Revision until = 0;
};
using Request = std::variant<Grant, Renew, Remaining, Revoke, Transaction, Watch, Compact>;

enum class Outcome : std::uint8_t {
  kDone,
  kUnknown,    ///< no answer in time, or a broken connection: the store has executed the request, or will, or will not
  kNoLease,    ///< the lease does not exist; nothing was written
  kCompacted,  ///< the revision has been forgotten
  kRefused,    ///< the request is not valid; nothing was written
};
[[nodiscard]] const char* to_text(Outcome outcome) noexcept;

struct Reply {
  OperationId operation = 0;
  Outcome outcome = Outcome::kDone;
  Revision revision = 0;   ///< of the store after the request
  std::uint64_t term = 0;  ///< number of elections that the answering member of the store knows of
  LeaseId lease = 0;       ///< Grant: the new lease
  Duration ttl{};          ///< Grant, Renew, Remaining: time for which the lease holds from the moment of execution;
                           ///< Remaining: whole seconds, rounded down
  bool held = false;       ///< Transaction: all conditions held
  std::vector<std::vector<KeyValue>> found;  ///< Transaction: entries of each Read of the executed branch
  std::vector<Change> changes;               ///< Watch
  std::string reason;                        ///< kUnknown, kRefused: in words of the store, or of the network library
  bool unreachable = false;                  ///< kUnknown: the connection failed, and `reason` says how
};

/// Access to the store. The caller begins operations and polls replies; no call waits, and none calls back.
class Directory {
 public:
  virtual ~Directory() = default;
  /// Begins an operation. Its reply may come in any order, and late. A full queue gives a reply kUnknown.
  virtual void begin(OperationId operation, const Request& request) = 0;
  /// Returns the next reply, if there is one.
  [[nodiscard]] virtual std::optional<Reply> poll() = 0;
  /// Sets what is called when a reply was added, from any thread; it must not call this object. Without effect if
  /// replies are added by calls of this object only.
  virtual void notify_by([[maybe_unused]] const std::function<void()>& told) {}
};

}  // namespace tandem::directory
