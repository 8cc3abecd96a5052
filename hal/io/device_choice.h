#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/device.h"

namespace tandem::hal {

/// What a person means by `--device BACKEND[:NAME][,KEY=VALUE]...`, for all devices but simulated ones.
struct DeviceChoice {
  struct Option {
    std::string key, value;
  };
  std::string backend;
  std::string name;  ///< which of several: what `doctor` prints; empty: the only one
  std::vector<Option> options;
  std::vector<std::string> mistakes;  ///< words that are no NAME and no KEY=VALUE, or are there twice; told by ChoiceJudge

  [[nodiscard]] std::optional<std::string> find(std::string_view key) const;
};

/// Error: the kind is missing. All else that is wrong with the words is kept in `mistakes`, so that the backend, which knows
/// its options, tells everything together.
[[nodiscard]] Result<DeviceChoice> parse_choice(std::string_view spec);

/// Looks at the words of one choice and keeps every mistake, so that a person learns all of them at once.
class ChoiceJudge {
 public:
  /// Options a backend does not have are mistakes: the wrong one, its value, the nearest and all there are.
  ChoiceJudge(const DeviceChoice& choice, const std::vector<std::string>& known);

  /// The value of `key`, if it is there and one of `allowed`; else the first of them.
  [[nodiscard]] std::string one_of(std::string_view key, std::initializer_list<std::string_view> allowed);
  [[nodiscard]] bool yes_or_no(std::string_view key, bool otherwise);
  /// A finite decimal number in [lo, hi]; nullopt if it is not there or wrong.
  [[nodiscard]] std::optional<double> number(std::string_view key, double lo, double hi, std::string_view unit);

  /// One more, about the words. @param what  such as "needs preset=NAME"
  void mistake(std::string what);
  /// One more as it stands: of a file, with its place. May be several lines.
  void told(std::string lines);

  [[nodiscard]] bool good() const noexcept { return mistakes_.empty(); }
  /// Error kUnsupported: every mistake, a line each.
  [[nodiscard]] Result<> verdict() const;

 private:
  const DeviceChoice* choice_;
  std::vector<std::string> mistakes_;
};

}  // namespace tandem::hal
