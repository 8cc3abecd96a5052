#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/rpc/rpc_notes.h"
#include "server/console/evaluation_sheets.h"

namespace tandem::console {

/// Marks and sheets of one session that one person may see, as the server listed them: the server decides who may read
/// which (server/app/control/session_notes.h) and keeps them.
class EvaluationNotes {
 public:
  static constexpr std::size_t kMarksMax = 500, kSheetsMax = 200;

  /// Takes a note of the server's list; one that it has already, or that is no mark or sheet of this program, changes
  /// nothing. Beyond the limits the oldest is forgotten.
  /// @return true: the person closed a sheet, so that sheets of others may be readable that were not before
  bool put(const rpc::StoredNote& note);
  /// Message `notes`.
  [[nodiscard]] std::string message() const;

 private:
  struct Author {
    std::string name;     ///< for display
    bool proved = false;  ///< the name is that of the ticket
  };
  struct Mark {
    std::uint32_t number = 0;
    Author by;
    std::optional<double> t_s;  ///< session time [s]; nullopt: unknown
    std::string text;
  };
  struct Sheet {
    std::uint32_t number = 0;
    Author by;
    bool yours = false;
    EvaluationSheet sheet;
  };

  std::vector<Mark> marks_;
  std::vector<Sheet> sheets_;
};

/// Contents of a Note. @param person  name for display
[[nodiscard]] std::string mark_json(const std::string& person, std::optional<double> t_s, const std::string& text);
[[nodiscard]] std::string sheet_json(const std::string& person, const EvaluationSheet& sheet);

}  // namespace tandem::console
