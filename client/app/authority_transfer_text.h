#pragma once

#include <optional>
#include <string>

#include "client/app/client_status.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

/// Returns the present authority transfer as text: both parties, authority before and after, begin and duration, or its
/// cancellation; empty without a transfer. Example:
/// `trainer gives the tool to trainee (0 % to 100 %): begins in 50 ms, takes about 1.0 s`
/// @param words  newest status over the control connection; empty: none received
[[nodiscard]] std::string authority_transfer_text(const ClientStatus& status, const SeatSetup& setup,
                                                  const std::optional<rpc::Status>& words);
/// Returns a short form without names for a narrow screen, e.g. `more weight in 50 ms`.
[[nodiscard]] std::string authority_transfer_brief(const ClientStatus& status);

/// Permanent lines about authority transfers, at most one per second. Transfers that follow each other faster, such as
/// those of a repeating key, are combined into one line from the first authority to the last.
class AuthorityTransferNotices {
 public:
  static constexpr double kBetween = 1;  ///< shortest time between two lines [s]

  /// Returns the line that is due; empty if none is. Call at least ten times per second.
  /// @param now_s  time on any monotonic clock [s]
  [[nodiscard]] std::string message(double now_s, const ClientStatus& status, const SeatSetup& setup,
                                    const std::optional<rpc::Status>& words);

 private:
  std::optional<ClientStatus> pending_;
  std::optional<double> shown_at_s_;
  std::uint32_t seen_ = 0;
};

}  // namespace tandem::client
