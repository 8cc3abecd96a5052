#include "server/archive/recording_group.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

namespace tandem::server {
namespace {

std::string folder_of(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? std::string() : file.substr(0, slash);
}

/// Number in the name of a file of a recording: 1 for STEM + ending, N for STEM-N + ending, 0 for other names.
unsigned number_in(std::string_view file, std::string_view stem, std::string_view ending) {
  if (!file.starts_with(stem) || !file.ends_with(ending) || file.size() < stem.size() + ending.size()) return 0;
  const std::string_view text = file.substr(stem.size(), file.size() - stem.size() - ending.size());
  if (text.empty()) return 1;
  unsigned number = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data() + 1, end, number);
  return text.front() == '-' && parsed.ec == std::errc{} && parsed.ptr == end ? number : 0;
}

/// Whether a part behind the last one is being written. Its number in its name is higher, but not always by one: a
/// recording leaves out names that other files have.
bool grows(const std::vector<RecordingRow>& rows, const RecordingGroup& group,
           const std::vector<std::string>& unfinished) {
  const RecordingRow& last = rows[group.rows.back()];
  const RecordedPart& part = last.summary.part;
  if (part.recording.empty() || part.last.value_or(false)) return false;
  const std::string folder = folder_of(last.file);
  const std::string stem = folder + (folder.empty() ? "" : "/") + part.recording;
  const unsigned number = std::max(part.number, number_in(last.file, stem, ".mcap"));
  return std::ranges::any_of(unfinished,
                             [&](const std::string& file) { return number_in(file, stem, ".mcap.part") > number; });
}

/// Orders the rows of a group and finds what is missing.
void order_group(const std::vector<RecordingRow>& rows, const std::vector<std::string>& unfinished,
                 RecordingGroup& group) {
  std::ranges::stable_sort(group.rows, {}, [&](std::size_t k) { return rows[k].summary.part.number; });
  std::vector<RecordedPart> parts;
  for (const std::size_t k : group.rows) {
    parts.push_back(rows[k].summary.part);
    parts.back().file = rows[k].file;
  }
  group.grows = grows(rows, group, unfinished);
  if (group.grows) parts.back().last.reset();
  group.problem = order_parts(parts);
}

}  // namespace

std::vector<RecordingGroup> group_recordings(const std::vector<RecordingRow>& rows,
                                             const std::vector<std::string>& unfinished) {
  std::vector<RecordingGroup> groups;
  std::map<std::tuple<std::string, std::string, std::string, std::string>, std::vector<std::size_t>> known;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const RecordedPart& part = rows[k].summary.part;
    if (!rows[k].readable() || part.recording.empty()) {
      groups.push_back({.rows = {k}, .problem = {}});
      continue;
    }
    std::vector<std::size_t>& copies = known[{folder_of(rows[k].file), part.session_id, part.epoch, part.recording}];
    const auto place = std::ranges::find_if(copies, [&](std::size_t group) {
      return std::ranges::none_of(groups[group].rows,
                                  [&](std::size_t other) { return rows[other].summary.part.number == part.number; });
    });
    if (place != copies.end()) {
      groups[*place].rows.push_back(k);
    } else {
      copies.push_back(groups.size());
      groups.push_back({.rows = {k}, .problem = {}});
    }
  }
  for (const auto& [key, copies] : known)
    for (const std::size_t copy : copies) order_group(rows, unfinished, groups[copy]);
  return groups;
}

RecordingRow joined_row(const std::vector<RecordingRow>& rows, const RecordingGroup& group) {
  RecordingRow joined = rows[group.rows.front()];
  RecordingSummary& all = joined.summary;
  for (std::size_t i = 1; i < group.rows.size(); ++i) {
    const RecordingRow& row = rows[group.rows[i]];
    const RecordingSummary& s = row.summary;
    joined.bytes += row.bytes;
    joined.modified_ns = std::max(joined.modified_ns, row.modified_ns);
    // From the begin of the first row; recordings in virtual time do not state it.
    const bool dated = all.start_unix_ns != 0 && s.start_unix_ns >= all.start_unix_ns && s.rows > 0;
    all.duration_s =
        dated ? std::max(all.duration_s, 1e-9 * static_cast<double>(s.start_unix_ns - all.start_unix_ns) + s.duration_s)
              : all.duration_s + s.duration_s;
    all.rows += s.rows;
    all.missing_ticks += s.missing_ticks;
    all.complete = all.complete && s.complete;
    for (const RecordedPerson& person : s.persons) add_person(all.persons, person.name, person.part);
  }
  all.complete = all.complete && group.problem.empty();
  return joined;
}

std::vector<std::size_t> files_beyond_limits(const std::vector<RecordingRow>& rows,
                                             const std::vector<std::string>& unfinished, const RetentionLimits& limits,
                                             std::int64_t now_ns) {
  const std::vector<RecordingGroup> groups = group_recordings(rows, unfinished);
  std::vector<RecordingRow> recordings;
  for (const RecordingGroup& group : groups) {
    recordings.push_back(joined_row(rows, group));
    if (grows(rows, group, unfinished)) recordings.back().problem = "it is being recorded";
  }
  std::vector<std::size_t> files;
  for (const std::size_t k : beyond_limits(recordings, limits, now_ns))
    files.insert(files.end(), groups[k].rows.begin(), groups[k].rows.end());
  return files;
}

std::vector<std::vector<std::size_t>> deletion_order(const std::vector<RecordingRow>& rows,
                                                     const std::vector<std::size_t>& chosen) {
  const std::vector<RecordingGroup> groups = group_recordings(rows);
  std::vector<std::vector<std::size_t>> order;
  std::vector<bool> ordered(groups.size(), false);
  for (const std::size_t k : chosen) {
    const auto group = std::ranges::find_if(
        groups, [k](const RecordingGroup& g) { return std::ranges::find(g.rows, k) != g.rows.end(); });
    const auto place = static_cast<std::size_t>(group - groups.begin());
    if (ordered[place]) continue;
    ordered[place] = true;
    order.emplace_back();
    for (auto row = group->rows.rbegin(); row != group->rows.rend(); ++row)
      if (std::ranges::find(chosen, *row) != chosen.end()) order.back().push_back(*row);
  }
  return order;
}

}  // namespace tandem::server
