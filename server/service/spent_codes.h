#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace tandem::server {

/// Enrolment codes that were used, replaced or withdrawn, until they would have expired. A directory that is put back
/// to an older state has them again; they must not enrol a second time.
class SpentCodes {
 public:
  static constexpr std::size_t kMax = 1000;  ///< of more, those that expire first are forgotten

  /// Codes as NAME/HASH, the hash in hexadecimal, with the last second in which each would be valid. The name counts:
  /// of several names with one code, all but one lose it.
  using Codes = std::map<std::string, std::int64_t, std::less<>>;

  SpentCodes() = default;
  explicit SpentCodes(Codes codes) : codes_(std::move(codes)) {}

  /// Both sides agree on `after` instead of `before`, texts of one name (RegistryEntries).
  void note(const std::string& name, std::string_view before, std::string_view after);
  /// Returns the text of a name without its code, if that is spent.
  [[nodiscard]] std::string without(const std::string& name, const std::string& text) const;
  /// @param now_s  wall clock [s since 1970, UTC]
  void forget_expired(std::int64_t now_s);
  [[nodiscard]] const Codes& codes() const noexcept { return codes_; }

 private:
  Codes codes_;
};

}  // namespace tandem::server
