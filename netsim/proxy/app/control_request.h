#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "netsim/models/path_spec.h"
#include "netsim/profiles/app/network_numbers.h"

namespace tandem::netsim {

/// Command line sent to a running proxy.
struct ControlRequest {
  enum class Kind : std::uint8_t { kChange, kRebind, kReset, kStatus, kHelp, kStop };
  Kind kind = Kind::kChange;
  // kChange: the given members change, all at the same time.
  std::optional<std::string> network = {};  ///< name of a profile or file
  NetworkNumbers numbers = {};
  std::optional<Duration> outage = {};  ///< length of an outage that begins at once
  OutageSpec::Mode outage_mode = OutageSpec::Mode::kDrop;
  Duration dead_after{};                    ///< kRebind: time for which the old address stays valid
  std::vector<std::uint64_t> clients = {};  ///< by order of arrival from 1; empty: all, including later ones
  std::optional<Direction> direction = {};  ///< empty: both
  bool json = false;                        ///< kStatus
};

/// Parses a command such as `profile wifi-busy`, `delay 20 loss 2 client 2 up`, `outage 400ms`, `status --json`.
/// @return request, or an error with the rejected word and the allowed ones
[[nodiscard]] std::expected<ControlRequest, std::string> parse_control_request(std::string_view line);

/// Returns the help text of the commands.
[[nodiscard]] const char* control_help() noexcept;

/// Parses `400ms`, `0.4s`, `2min`, `1h`. Returns empty if the text is not a duration.
[[nodiscard]] std::optional<Duration> parse_length(std::string_view text) noexcept;

}  // namespace tandem::netsim
