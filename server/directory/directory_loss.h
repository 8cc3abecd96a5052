#pragma once

#include <cstdint>
#include <map>

#include "server/directory/directory.h"
#include "server/directory/directory_mark.h"

namespace tandem::directory {

/// Notices that the directory is not the one of before: it was begun from nothing, or put back to an older state.
/// Two signs tell it: an answer of a lower revision than a former one, and another mark than the known one.
///
/// The lost directory granted leases that no server can see now. A server that cannot reach the new one acts by its
/// lease until that ends, so no session is claimed for the time of a lease. Then former owners claim the sessions that
/// they have kept, and later the other servers those of their configuration. A server in its first start waits for the
/// time of a lease, too. No session is claimed while the mark is asked for.
class DirectoryLoss {
 public:
  static constexpr Duration kOthersLater = std::chrono::seconds(5);  ///< than the former owners

  /// @param mark      must outlive this
  /// @param newest    a revision that the directory had before a restart; 0: unknown
  /// @param stranger  this is the first start, or a restart within a wait
  DirectoryLoss(DirectoryMark& mark, Duration ttl, Revision newest, bool stranger)
      : mark_(mark), ttl_(ttl), newest_(newest), stranger_(stranger) {}

  /// Notes that a request begins now.
  void on_begin(OperationId operation, const Request& request);
  /// Takes any reply. Returns whether the store has lost changes that it has told before.
  [[nodiscard]] bool went_back(const Reply& reply);
  /// Takes any reply, on behalf of the mark.
  [[nodiscard]] DirectoryMark::Found on_reply(Time now, const Reply& reply);
  /// The directory is another one.
  void on_loss(Time now);

  /// The directory is the one that this server knows.
  [[nodiscard]] bool known() const noexcept { return mark_.answered(); }
  /// Whether sessions may be claimed: those that this server has kept, and any.
  [[nodiscard]] bool kept_may_begin(Time now) const noexcept { return known() && now >= wait_until_; }
  [[nodiscard]] bool all_may_begin(Time now) const noexcept {
    return known() && now >= wait_until_ + (losses_ == 0 ? Duration::zero() : kOthersLater);
  }
  [[nodiscard]] bool waits_for_leases(Time now) const noexcept { return stranger_ || now < wait_until_; }
  [[nodiscard]] bool waits(Time now) const noexcept { return losses_ > 0 && !all_may_begin(now); }
  [[nodiscard]] std::uint64_t losses() const noexcept { return losses_; }
  /// Newest revision that this server knows; 0: none.
  [[nodiscard]] Revision newest() const noexcept { return newest_; }

 private:
  static constexpr std::size_t kSentMax = 4096;

  DirectoryMark& mark_;
  Duration ttl_;
  std::map<OperationId, Revision> sent_;  ///< transactions, with the newest revision at that time
  Revision newest_ = 0;
  Time wait_until_{};
  bool stranger_;  ///< it waits once it knows the directory
  std::uint64_t losses_ = 0;
};

}  // namespace tandem::directory
