#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/score/interventions.h"
#include "netsim/score/metrics.h"
#include "netsim/score/parts.h"
#include "netsim/score/quality.h"
#include "netsim/score/score_options.h"

/// All scores of one lesson. Pure: the same lesson and options give the same numbers, whatever file it came from.
namespace tandem::netsim::score {

/// Scores of one hand in one part.
struct PartScore {
  Part::Kind kind = Part::Kind::kWhole;
  std::string key;  ///< of the Part
  std::string title;
  MetricValues values{};
  Quality quality;
};

struct SeatScore {
  std::size_t seat = 0;
  std::string name, person;
  Role role = Role::kTrainee;
  std::string tool;              ///< name of the tool that it follows first
  std::vector<PartScore> parts;  ///< the whole lesson first

  [[nodiscard]] const PartScore* part(std::string_view key) const noexcept;
};

/// An Intervention with names.
struct NamedIntervention {
  std::string seat, from_seat, tool;
  double from_s = 0, to_s = 0;
  std::string cause;
  double opposition = kUnknown;
};

struct NamedPair {
  std::string first, second;
  PairScore score;
};

struct LessonScores {
  std::string file;  ///< as the user named it
  std::string session;
  double begin_s = 0, end_s = 0;  ///< session time of the first and after the last tick [s]
  double rate_hz = 0;
  std::int64_t start_unix_ns = 0;  ///< 0: unknown
  bool complete = true;
  ScoreOptions options;
  std::vector<SeatScore> seats;  ///< MASTER seats with samples
  std::vector<NamedIntervention> interventions;
  std::vector<NamedPair> pairs;  ///< of MASTER seats at the same tool, and hands of one person
  std::vector<LessonSheet> sheets;
  std::vector<LessonMark> marks;
  std::vector<std::string> notes;  ///< data that the file lacks

  [[nodiscard]] const SeatScore* seat(std::string_view name) const noexcept;
};

/// @param one_person  pairs of seats, names in the scene, which are the two hands of one person, in addition to seats
///                    with the same person; the name of a workstation is no person
/// @return error: the reason why the lesson cannot be scored
[[nodiscard]] std::expected<LessonScores, std::string> score_lesson(
    const Lesson& lesson, const ScoreOptions& options = {},
    const std::vector<std::pair<std::string, std::string>>& one_person = {});

/// Lines that state filters, cut-offs and thresholds.
[[nodiscard]] std::vector<std::string> conditions_of(const ScoreOptions& options);

}  // namespace tandem::netsim::score
