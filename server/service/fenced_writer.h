#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/directory/directory.h"
#include "server/directory/directory_keys.h"

namespace tandem::server {

/// Writes values that often change to the directory, the newest value of each key only, and only while this server
/// owns the session: each transaction has the condition that the owner key is still the one of this ownership.
///
/// The store may execute a transaction whose answer did not come in time after a later one. So each transaction also
/// writes the order key of this server, under the condition that it is as the newest known transaction left it: a late
/// one changes nothing, and no older value replaces a newer one.
///
/// Several values go into one transaction, in turn by their keys, so that none waits for ever behind others that change
/// faster than the directory stores them. If an ownership does not hold, its values are written one at a time, so that
/// one lost session stops no other.
class FencedWriter {
 public:
  static constexpr std::size_t kBatchMax = 32;  ///< values; etcd allows 128 steps of a transaction
  static constexpr std::size_t kBatchBytesMax = std::size_t{512} << 10;
  static constexpr std::size_t kValueMax = std::size_t{64} << 10;  ///< [bytes] a longer one is not written, and counted
  static constexpr std::size_t kKeysMax = std::size_t{3} * 4096;   ///< keys that wait; further ones are counted

  struct Counters {
    std::uint64_t written = 0, batches = 0, refused = 0, unknown = 0, overflowed = 0;
    std::uint64_t reordered = 0;  ///< the order key was not as expected: an unanswered transaction was executed
  };

  /// @param order_key  of this server; no other writer uses it
  /// @param pause      between two transactions
  FencedWriter(directory::DirectoryKeys keys, std::string order_key, Duration pause)
      : keys_(std::move(keys)), order_key_(std::move(order_key)), pause_(pause) {}

  /// Sets the newest value of a key of a session.
  /// @param revision  of the ownership
  /// @param mark      for `poll_written` once this value is written; 0: none
  void set(const std::string& session, const std::string& key, std::string value, directory::Revision revision,
           std::uint64_t mark = 0);
  /// Has the waiting value of a key written first, without the pause.
  void hurry(const std::string& key);
  /// Forgets the values of a session that are not written.
  void drop(const std::string& session);
  /// Whether a value of the session waits for its write or its answer.
  [[nodiscard]] bool pending(const std::string& session) const;

  /// Returns the request to begin now, if there is one. The caller begins it with this operation's number.
  [[nodiscard]] std::optional<directory::Request> poll_request(Time now, directory::OperationId operation,
                                                               Duration retry_after);
  /// Values wait for their write.
  [[nodiscard]] bool waits() const noexcept { return !waiting_.empty(); }
  /// Takes a reply. Returns whether it belongs to this object.
  bool on_reply(const directory::Reply& reply);
  /// Returns the mark of a value that is in the directory now, each once. A value that lost its session has none.
  [[nodiscard]] std::optional<std::uint64_t> poll_written();
  /// Why the newest transaction is not written: an error of the store, or no answer in time. Empty: it is, or no value
  /// waits.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }

 private:
  struct Value {
    std::string session, value;
    directory::Revision revision = 0;
    bool alone = false;  ///< a transaction with several values did not hold
    std::uint64_t mark = 0;
    bool first = false;  ///< to be written before others
  };

  void again(bool alone);
  void forget_solved_problem();
  void collect(bool first, directory::Transaction& transaction, std::size_t& bytes);

  directory::DirectoryKeys keys_;
  std::string order_key_;
  directory::Revision order_ = 0;  ///< of the newest known write of the order key; 0: none
  Duration pause_;
  std::map<std::string, Value> waiting_, sent_;  ///< by key
  std::string last_, last_first_;                ///< key of the newest value that was sent in its turn, or hurried
  directory::OperationId operation_ = 0;
  Time next_{}, sent_at_{};
  Counters counters_;
  std::deque<std::uint64_t> marks_;  ///< of written values; at most kBatchMax, as each reply is followed by polls
  std::string problem_;
};

}  // namespace tandem::server
