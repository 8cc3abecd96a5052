#include "client/app/authority_script.h"

#include <algorithm>
#include <cmath>

#include "common/base/csv.h"
#include "common/base/format.h"
#include "proto/io/scene_file.h"

namespace tandem::client {
namespace {

constexpr double kSumTolerance = 1e-6;  // the server's tolerance for a sum of 1

std::string short_number(double v) { return format("%.9g", v); }

}  // namespace

std::expected<AuthorityScript, std::vector<std::string>> AuthorityScript::parse(const std::string& text,
                                                                                const std::string& file) {
  std::vector<std::string> mistakes;
  const auto table = CsvTable::parse(text);
  if (!table) return std::unexpected(std::vector{table.error().text(file)});
  const auto& columns = table->columns();
  if (columns.front().name != "t_s" || columns.front().unit != "s")
    mistakes.push_back(file + ":1: column 1: must be t_s[s], the session time");
  if (columns.size() < 2) mistakes.push_back(file + ":1: needs a column SEAT[1] for each seat that gets authority");
  AuthorityScript script;
  script.file_ = file;
  for (std::size_t c = 1; c < columns.size(); ++c) {
    if (columns[c].unit != "1")
      mistakes.push_back(file + ":1: column " + std::to_string(c + 1) + ": " + columns[c].name + "[" + columns[c].unit +
                         "]: authorities have the unit 1, as in " + columns[c].name + "[1]");
    script.seats_.push_back(columns[c].name);
  }
  if (table->rows() == 0) mistakes.push_back(file + ": has no rows");
  for (std::size_t r = 0; r < table->rows(); ++r) {
    const std::string place = file + ":" + std::to_string(table->line(r)) + ": ";
    Row row{.line = table->line(r)};
    double sum = 0;
    bool readable = true;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto value = table->number(r, c);
      if (!value) {
        mistakes.push_back(value.error().text(file));
        readable = false;
        continue;
      }
      if (c == 0) {
        row.at = *value;
        continue;
      }
      if (*value < 0 || *value > 1) {
        mistakes.push_back(place + columns[c].name + " = " + short_number(*value) + ": must be in [0, 1]");
        readable = false;
      }
      row.weights.push_back(*value);
      sum += *value;
    }
    if (!readable) continue;
    if (row.at < 0) mistakes.push_back(place + "t_s = " + short_number(row.at) + ": must not be negative");
    if (!script.rows_.empty() && !(row.at > script.rows_.back().at))
      mistakes.push_back(place + "t_s = " + short_number(row.at) + ": must be later than the row before");
    if (columns.size() > 1 && !(std::abs(sum - 1) <= kSumTolerance))
      mistakes.push_back(place + "the authorities sum to " + short_number(sum) + ", not to 1");
    script.rows_.push_back(std::move(row));
  }
  if (!mistakes.empty()) return std::unexpected(std::move(mistakes));
  return script;
}

std::expected<AuthorityScript, std::vector<std::string>> AuthorityScript::load(const std::string& file) {
  const auto text = read_text_file(file);
  if (text) return parse(*text, file);
  std::vector<std::string> mistakes;
  for (const InputError& error : text.error()) mistakes.push_back(to_text(error));
  return std::unexpected(std::move(mistakes));
}

std::expected<std::vector<AuthorityScript::Change>, std::string> AuthorityScript::for_session(
    std::span<const std::string> masters, std::uint32_t drivers) const {
  std::vector<std::size_t> place;
  for (const std::string& seat : seats_) {
    const auto found = std::ranges::find(masters, seat);
    if (found == masters.end()) {
      std::string text = file_ + ":1: " + seat + " is not a MASTER seat of this session; seats:";
      for (const std::string& m : masters) text += " " + m;
      return std::unexpected(text);
    }
    place.push_back(static_cast<std::size_t>(found - masters.begin()));
  }
  std::vector<Change> changes;
  for (const Row& row : rows_) {
    Change change{.at = row.at};
    for (std::size_t c = 0; c < row.weights.size(); ++c) {
      if (row.weights[c] > 0 && (drivers >> place[c] & 1) == 0)
        return std::unexpected(file_ + ":" + std::to_string(row.line) + ": " + seats_[c] +
                               " is an evaluator or observer and cannot have authority");
      change.alpha[place[c]] = row.weights[c];
    }
    changes.push_back(change);
  }
  return changes;
}

}  // namespace tandem::client
