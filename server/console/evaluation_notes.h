#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "server/console/evaluation_sheets.h"

namespace tandem::console {

/// Marks and sheets of one session, as the persons of this gateway wrote them. It decides who sees what: raters must
/// not influence each other, so that a sheet of another person is hidden until one's own sheet of that form about that
/// seat is closed. The server stores them (`Note`); these are the copies for pages.
class EvaluationNotes {
 public:
  static constexpr std::size_t kMarksMax = 500, kSheetsMax = 200;

  struct Author {
    std::uint64_t id = 0;  ///< of the person: names can be chosen freely
    std::string name;      ///< for display
  };
  struct Mark {
    Author by;
    std::optional<double> t_s;  ///< session time [s]; nullopt: unknown
    std::string text;
  };
  struct Sheet {
    Author by;
    EvaluationSheet sheet;
  };

  /// Whether a sheet may be written. @return error: the reason, without scores of others
  [[nodiscard]] std::expected<void, std::string> may_write(const Author& by, const EvaluationSheet& sheet) const;
  /// Keeps a mark. Beyond kMarksMax the oldest is forgotten.
  void add(Mark mark);
  /// Keeps a sheet in place of the author's earlier one. @pre may_write
  void put(const Author& by, EvaluationSheet sheet);

  /// Message `notes` of what this person may see.
  [[nodiscard]] std::string json_for(std::uint64_t person) const;
  /// Increases with every change.
  [[nodiscard]] std::uint64_t version() const noexcept { return version_; }

 private:
  [[nodiscard]] const Sheet* find(std::uint64_t person, const EvaluationSheet& like) const;

  std::vector<Mark> marks_;
  std::vector<Sheet> sheets_;
  std::uint64_t version_ = 0;
};

/// Contents of the `Note` that the server stores.
[[nodiscard]] std::string mark_json(const EvaluationNotes::Mark& mark);
[[nodiscard]] std::string sheet_json(const EvaluationNotes::Author& by, const EvaluationSheet& sheet);

}  // namespace tandem::console
