#pragma once

#include <span>
#include <string>
#include <vector>

#include "netsim/demo/comparison.h"
#include "netsim/demo/run_numbers.h"

/// Summary of the demo: one sentence and key numbers. Pure functions.
namespace tandem::netsim::demo {

/// A number for the top of the page.
struct KeyNumber {
  std::string value;   ///< "1.4 mm"
  std::string what;    ///< description of the value
  std::string beside;  ///< "paper 8.2 mm; bad network 5.4 mm"
};
struct Headline {
  std::string sentence;
  std::vector<std::string> missed;  ///< each missed limit: row, setting, value, limit
  std::vector<KeyNumber> numbers;   ///< of the runs in this report
};

[[nodiscard]] Headline headline_of(std::span<const RunResult> runs, const Comparison& comparison);

/// Returns the name of a setting, for example "Defaults on the bad network".
[[nodiscard]] std::string_view name_of(Setting setting) noexcept;

}  // namespace tandem::netsim::demo
