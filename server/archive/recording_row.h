#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/recording/lesson_source.h"
#include "server/archive/recorded_part.h"

/// Recordings of a school as its index knows them.
namespace tandem::server {

/// A person in a recording: at a seat, or as the author of a mark or of a rating sheet.
struct RecordedPerson {
  std::string name;  ///< as the participant typed it, or a pseudonym
  std::string part;  ///< name of the seat, or `notes`
  friend bool operator==(const RecordedPerson&, const RecordedPerson&) = default;
};

/// Adds a person unless the name is empty or the person is there already.
void add_person(std::vector<RecordedPerson>& persons, const std::string& name, const std::string& part);

/// Content of one recording, as the index keeps it.
struct RecordingSummary {
  std::string session, scene;      ///< names of session and scene
  std::int64_t start_unix_ns = 0;  ///< wall clock at the first row; 0: unknown
  double duration_s = 0;           ///< session time between the first and the last row [s]
  std::uint64_t rows = 0, missing_ticks = 0;
  bool complete = true;  ///< false: the file was cut, damaged or repaired
  std::vector<RecordedPerson> persons;
  RecordedPart part;  ///< place of the file in its recording; `file` is empty
  friend bool operator==(const RecordingSummary&, const RecordingSummary&) = default;
};

/// One file of the folder.
struct RecordingRow {
  std::string file;              ///< path below the folder
  std::uint64_t bytes = 0;       ///< size
  std::int64_t modified_ns = 0;  ///< time of the last change, since 1970
  std::string problem;           ///< why it cannot be read, for users; empty: it can
  RecordingSummary summary;      ///< empty if it cannot be read

  /// Returns whether the index can say what the file contains.
  [[nodiscard]] bool readable() const noexcept { return problem.empty(); }
  /// Begin of the recording, or the last change of a file that does not state it [ns since 1970].
  [[nodiscard]] std::int64_t begun_ns() const noexcept {
    return summary.start_unix_ns != 0 ? summary.start_unix_ns : modified_ns;
  }
  friend bool operator==(const RecordingRow&, const RecordingRow&) = default;
};

/// Returns the ticks of a lesson without a row: those between its rows, and ticks after the last row, as on a full
/// disk, which only the account has.
[[nodiscard]] std::uint64_t missing_ticks_of(const Lesson& head, const LessonExtent& extent);

/// Returns what the index keeps of a lesson. Persons appear once per part, in the order seats, marks, sheets. The place
/// of the file is that in `head.metadata`, so that it is not known whether a file follows.
[[nodiscard]] RecordingSummary summary_of(const Lesson& lesson);

/// Limits of what a school keeps; 0: no limit.
struct RetentionLimits {
  double days = 0;          ///< age of a recording [days]
  std::uint64_t bytes = 0;  ///< size of all recordings together
};

/// Returns the indices of recordings beyond the limits, oldest first: those that are older, then the oldest ones until
/// the rest is small enough. Files that cannot be read are neither counted nor chosen.
/// @param now_ns  wall clock, since 1970
[[nodiscard]] std::vector<std::size_t> beyond_limits(const std::vector<RecordingRow>& rows,
                                                     const RetentionLimits& limits, std::int64_t now_ns);

/// Returns the indices of recordings with a person of exactly this name.
[[nodiscard]] std::vector<std::size_t> recordings_with(const std::vector<RecordingRow>& rows,
                                                       const std::string& person);

}  // namespace tandem::server
