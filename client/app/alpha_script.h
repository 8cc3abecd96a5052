#pragma once

#include <expected>
#include <span>
#include <string>
#include <vector>

#include "common/base/axes.h"
#include "common/control/authority.h"

namespace tandem::client {

/// Authority over time, from a CSV: `t_s[s],SEAT[1],...`, one row per change, ascending in time, each row of sum 1.
/// Seats that are not named have no authority.
class AlphaScript {
 public:
  struct Row {
    double at = 0;                ///< session time [s]
    std::vector<double> weights;  ///< one per seat named
    std::size_t line = 0;         ///< of the file
  };
  /// @return the script, or every mistake as `FILE:LINE: ...`
  [[nodiscard]] static std::expected<AlphaScript, std::vector<std::string>> parse(const std::string& text,
                                                                                  const std::string& file);
  /// The same, of a file.
  [[nodiscard]] static std::expected<AlphaScript, std::vector<std::string>> load(const std::string& file);

  [[nodiscard]] const std::vector<std::string>& seats() const noexcept { return seats_; }
  [[nodiscard]] const std::vector<Row>& rows() const noexcept { return rows_; }

  /// A change for the servo thread.
  struct Change {
    double at = 0;
    control::Weights alpha{};
  };
  /// Puts the weights at the places of a session's masters.
  /// @param drivers  bit i: master i may be given authority
  /// @return the changes, or what does not fit this session
  [[nodiscard]] std::expected<std::vector<Change>, std::string> for_session(std::span<const std::string> masters,
                                                                            std::uint32_t drivers) const;

 private:
  std::string file_;
  std::vector<std::string> seats_;
  std::vector<Row> rows_;
};

}  // namespace tandem::client
