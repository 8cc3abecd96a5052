#pragma once

#include <expected>
#include <span>
#include <string>
#include <vector>

#include "common/base/axes.h"
#include "common/control/authority.h"

namespace tandem::client {

/// Authority over time, read from a CSV `t_s[s],SEAT[1],...`: one row per change, ascending in time, each row with
/// sum 1. Seats without a column have no authority.
class AuthorityScript {
 public:
  struct Row {
    double at = 0;                  ///< session time [s]
    std::vector<double> weights{};  ///< authority of each named seat [0, 1]
    std::size_t line = 0;           ///< line of the file
  };
  /// Parses the text of a script. @param file  name for messages  @return the script, or all errors as `FILE:LINE: ...`
  [[nodiscard]] static std::expected<AuthorityScript, std::vector<std::string>> parse(const std::string& text,
                                                                                      const std::string& file);
  /// Reads and parses a file.
  [[nodiscard]] static std::expected<AuthorityScript, std::vector<std::string>> load(const std::string& file);

  [[nodiscard]] const std::vector<std::string>& seats() const noexcept { return seats_; }
  [[nodiscard]] const std::vector<Row>& rows() const noexcept { return rows_; }

  /// One authority change for the servo thread.
  struct Change {
    double at = 0;  ///< session time [s]
    control::MasterArray alpha{};
  };
  /// Maps the rows to the masters of a session.
  /// @param masters  names of the masters in their order
  /// @param drivers  bit i: master i may have authority
  /// @return the changes, or the reason why the script does not fit this session
  [[nodiscard]] std::expected<std::vector<Change>, std::string> for_session(std::span<const std::string> masters,
                                                                            std::uint32_t drivers) const;

 private:
  std::string file_;
  std::vector<std::string> seats_;
  std::vector<Row> rows_;
};

}  // namespace tandem::client
