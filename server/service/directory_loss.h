#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "server/directory/directory.h"
#include "server/service/shared_registry.h"

namespace tandem::server {

/// Notices that the directory is not the one of before: it was begun from nothing, or put back to an older state.
///
/// Two signs: an answer of a lower revision than a former one, and another mark than the agreed one (SharedRegistry).
/// The mark is asked for at the start and after each loss of a lease or session; no session is claimed before.
///
/// The lost directory granted leases that no server can see now. A server that cannot reach the new one acts by its
/// lease until that ends, so no session is claimed for the time of a lease. Then former owners claim the sessions that
/// they have kept, and later the other servers those of their configuration. A server in its first start waits for the
/// time of a lease, too.
class DirectoryLoss {
 public:
  static constexpr Duration kOthersLater = std::chrono::seconds(5);  ///< than the former owners

  /// @param prefix  of the directory's keys
  /// @param agreed  from before a restart
  DirectoryLoss(const std::string& prefix, Duration ttl, const RegistryAgreement& agreed)
      : mark_(prefix + "registry/.mark"),
        ttl_(ttl),
        newest_(agreed.revision),
        stranger_(agreed.mark.empty() || agreed.waits) {}

  /// Notes that a request begins now.
  void on_begin(directory::OperationId operation, const directory::Request& request);
  /// Takes any reply. Returns whether the store has lost changes that it has told before.
  [[nodiscard]] bool went_back(const directory::Reply& reply);

  /// Has the mark asked for, because the directory may be another one.
  void doubt() noexcept {
    known_ = false;
    operation_ = 0;  // an answer of before does not count
    asked_.reset();
  }
  /// @param agreed  at present: the answer counts against it
  [[nodiscard]] std::optional<directory::Request> poll_request(Time now, directory::OperationId operation,
                                                               Duration retry_after, const RegistryAgreement& agreed);
  enum class Found : std::uint8_t { kNothing, kSame, kOther };
  /// Takes a reply, kNothing: it belongs to another object.
  [[nodiscard]] Found on_reply(Time now, const directory::Reply& reply);

  /// The directory is another one.
  void on_loss(Time now);

  /// The directory is the one that this server knows.
  [[nodiscard]] bool known() const noexcept { return known_; }
  /// Whether sessions may be claimed: those that this server has kept, and any.
  [[nodiscard]] bool kept_may_begin(Time now) const noexcept { return known_ && now >= wait_until_; }
  [[nodiscard]] bool all_may_begin(Time now) const noexcept {
    return known_ && now >= wait_until_ + (losses_ == 0 ? Duration::zero() : kOthersLater);
  }
  [[nodiscard]] bool waits_for_leases(Time now) const noexcept { return stranger_ || now < wait_until_; }
  [[nodiscard]] bool waits(Time now) const noexcept { return losses_ > 0 && !all_may_begin(now); }
  [[nodiscard]] std::uint64_t losses() const noexcept { return losses_; }
  /// Newest revision that this server knows; 0: none.
  [[nodiscard]] directory::Revision newest() const noexcept { return newest_; }

 private:
  static constexpr std::size_t kSentMax = 4096;
  static constexpr Duration kAskAgain = std::chrono::milliseconds(100);  ///< after an error

  std::string mark_;
  Duration ttl_;
  std::map<directory::OperationId, directory::Revision> sent_;  ///< transactions, with the newest revision at that time
  directory::Revision newest_ = 0;
  directory::OperationId operation_ = 0;  ///< asks for the mark; 0: none
  std::string expected_;                  ///< mark, as it was agreed when it was asked for; empty: none was
  directory::Revision expected_created_ = 0;
  std::optional<Time> asked_;
  Time wait_until_{};
  bool known_ = false;
  bool stranger_;  ///< in its first start, or after a restart within a wait: it waits once it knows the directory
  std::uint64_t losses_ = 0;
};

}  // namespace tandem::server
