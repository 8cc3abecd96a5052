#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "netsim/path_spec.h"

namespace tandem::netsim {

/// What a person asked a running proxy for, in one line.
struct ControlRequest {
  enum class What : std::uint8_t { kChange, kRebind, kReset, kStatus, kHelp, kStop };
  What what = What::kChange;
  // kChange: what is given changes, all of it at one moment.
  std::optional<std::string> network = {};  ///< profile or file
  std::optional<double> delay_ms = {}, jitter_ms = {};
  std::optional<double> loss_percent = {}, duplicate_percent = {}, reorder_percent = {};
  std::optional<Duration> outage = {};  ///< from now on, so long
  OutageSpec::Mode outage_mode = OutageSpec::Mode::kDrop;
  Duration dead_after{};                    ///< kRebind: so long the old address is still heard
  std::vector<std::uint64_t> clients = {};  ///< by order of arrival from 1; empty: all, also those to come
  std::optional<Direction> direction = {};  ///< empty: both
  bool json = false;                        ///< kStatus
};

/// Reads a command such as `profile wifi-busy`, `delay 20 loss 2 client 2 up`, `outage 400ms`, `status --json`.
/// @return the request, or what is wrong: the word, and what may stand there
[[nodiscard]] std::expected<ControlRequest, std::string> parse_control(std::string_view line);

/// The commands, for people.
[[nodiscard]] const char* control_help() noexcept;

/// Reads `400ms`, `0.4s`, `2min`, `1h`. @return empty: it is not a length of time
[[nodiscard]] std::optional<Duration> parse_length(std::string_view text) noexcept;

}  // namespace tandem::netsim
