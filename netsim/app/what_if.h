#pragma once

#include <expected>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "netsim/profiles/app/network_numbers.h"
#include "proto/spec/lesson.h"

namespace tandem::netsim {

/// Other law or network under which the hands of a recording are played again:
/// `law=NAME,delay=MS,jitter=MS,loss=PERCENT`.
struct WhatIf {
  std::string law;         ///< empty: that of the recording
  NetworkNumbers network;  ///< one way; a number that is not given is 0
};
/// Error: the part of the text that is wrong, and what it must be.
[[nodiscard]] std::expected<WhatIf, std::string> parse_what_if(const std::string& text);
/// Help text: all keys with their values.
[[nodiscard]] std::string what_if_help();

/// One number of both. NaN where a run has no such motion.
struct WhatIfNumber {
  std::string key;
  double recorded = 0, played = 0;
};
struct WhatIfResult {
  std::string words;  ///< law and network of the played session
  std::vector<WhatIfNumber> numbers;
};
/// Plays the recorded motions of all hands in the recording's scene, with the impedances of simulated hands, and
/// measures both sessions in the same way.
/// @return why it cannot be played
[[nodiscard]] std::expected<WhatIfResult, std::string> play_what_if(const Lesson& lesson, const WhatIf& other);

}  // namespace tandem::netsim
