#include "server/app/commands/recordings_actions.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common/base/sanitize.h"
#include "common/io/clock.h"
#include "common/io/print.h"
#include "server/app/commands/long_work.h"
#include "server/app/commands/state_option.h"
#include "server/archive/app/lesson_file.h"
#include "server/archive/app/recording_deletion.h"
#include "server/archive/app/recording_scan.h"
#include "server/archive/recording_group.h"
#include "server/archive/recording_text.h"

namespace tandem::server {
namespace {

constexpr const char* kCommand = "recordings";

/// The index of a folder, brought up to date.
struct OpenIndex {
  RecordingIndex index;
  std::vector<RecordingRow> rows;
  std::vector<std::string> unfinished;  ///< files that are being written, or that a killed server left
};

/// Opens and scans; prints files that are being written. @return the index, or the error
std::expected<OpenIndex, std::string> open_index(const std::string& folder) {
  auto index = RecordingIndex::open(folder);
  if (!index) return std::unexpected(index.error());
  LongWork work("reading recordings");
  const auto scan = scan_recordings(folder, *index, load_summary, [&work](std::size_t done, std::size_t total) {
    return work.advance(static_cast<double>(done) / static_cast<double>(total));
  });
  work.clear();
  if (!scan) return std::unexpected(scan.error());
  if (scan->interrupted) return std::unexpected("interrupted; the next command reads the remaining files");
  for (const std::string& file : scan->unfinished)
    io::print_formatted(stderr,
                        "%s is being recorded, or a killed server left it: `tandem-server repair FILE` closes it\n",
                        sanitize(file).c_str());
  auto rows = index->rows();
  if (!rows) return std::unexpected(rows.error());
  return OpenIndex{std::move(*index), std::move(*rows), scan->unfinished};
}

int printed(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  return std::fflush(stdout) == 0 ? io::kExitDone : io::kExitTrouble;
}

/// Finds the rows of the named files; adds an error for each unknown name.
std::vector<std::size_t> find_named(const std::vector<RecordingRow>& rows, const std::vector<std::string>& names,
                                    io::UsageErrors& errors) {
  std::vector<std::string> files;
  for (const RecordingRow& row : rows) files.push_back(row.file);
  std::vector<std::size_t> found;
  for (const std::string& name : names) {
    const auto at = std::ranges::find(files, name);
    if (at == files.end()) {
      errors.add("NAME", "there is no recording \"" + sanitize(name) + "\"; " + suggest(name, files));
    } else if (const auto k = static_cast<std::size_t>(at - files.begin());
               std::ranges::find(found, k) == found.end()) {
      found.push_back(k);
    }
  }
  return found;
}

std::vector<RecordingRow> picked(const std::vector<RecordingRow>& rows, const std::vector<std::size_t>& chosen) {
  std::vector<RecordingRow> out;
  for (const std::size_t k : chosen) out.push_back(rows[k]);
  return out;
}

/// Prints what is or would be deleted.
int print_chosen(const std::vector<RecordingRow>& rows, bool deleted, bool json) {
  if (json)
    return printed(std::string("{\"deleted\": ") + (deleted ? "true" : "false") +
                   ", \"recordings\": " + recordings_json(rows) + "}\n");
  if (rows.empty()) return printed("no recording is to be deleted\n");
  return printed((deleted ? "deleted:\n" : "would be deleted:\n") + recordings_text(rows, false) +
                 (deleted ? "" : "nothing was deleted: repeat with --yes to delete\n"));
}

/// Names the files that stay of recordings of which some files are chosen.
void print_remaining(const std::vector<RecordingRow>& rows, const std::vector<std::size_t>& chosen, bool delete_now) {
  for (const RecordingGroup& group : group_recordings(rows)) {
    std::string gone, rest;
    for (const std::size_t k : group.rows) {
      std::string& text = std::ranges::find(chosen, k) != chosen.end() ? gone : rest;
      text += (text.empty() ? "" : ", ") + sanitize(rows[k].file);
    }
    if (gone.empty() || rest.empty()) continue;
    io::print_formatted(stderr,
                        "%s: only a part of a recording of %zu files. The others %s: %s; name them too to delete the "
                        "whole recording\n",
                        gone.c_str(), group.rows.size(), delete_now ? "stay" : "would stay", rest.c_str());
  }
}

/// Deletes the chosen recordings with --yes, otherwise prints them. @param reason  of the audit lines
int delete_chosen(const RecordingsTask& task, OpenIndex& open, const std::vector<std::size_t>& chosen,
                  const char* reason) {
  print_remaining(open.rows, chosen, task.yes);
  if (!task.yes || chosen.empty()) return print_chosen(picked(open.rows, chosen), false, task.json);
  const std::string why = "nothing was deleted: each deletion needs a line in the audit log of a state folder";
  if (const auto path = auth::server_state_path(task.state); path)
    if (std::error_code error; !std::filesystem::exists(*path, error) && !error)
      return print_error(kCommand, why + ", and there is none at " + *path +
                                       ". Repeat with --state DIR, the folder of the server that recorded. If that " +
                                       "server has none (loopback, started without --state), make one: " +
                                       "`tandem-server init --state DIR`");
  auto state = open_state(task.state);
  if (!state) return print_error(kCommand, why + ": " + state.error());
  const AuditLine audit = [&state](const char* event, const std::string& name, const std::string& detail) {
    return state->audit(auth::wall_seconds(), event, name, detail);
  };
  std::vector<RecordingRow> deleted;
  int code = io::kExitDone;
  bool interrupted = false;
  for (const std::vector<std::size_t>& files : deletion_order(open.rows, chosen)) {
    for (const std::size_t k : files) {
      interrupted = !io::pending_signal().empty();
      const std::string problem = interrupted ? "interrupted; the files that are not listed are kept"
                                              : delete_recording(task.folder, open.index, open.rows[k], reason, audit);
      if (problem.empty()) {
        deleted.push_back(open.rows[k]);
        continue;
      }
      code = print_error(kCommand, problem);
      break;  // the earlier files of this recording stay
    }
    if (interrupted) break;
  }
  const int shown = print_chosen(deleted, true, task.json);
  return code == io::kExitDone ? shown : code;
}

}  // namespace

int list_recordings(const RecordingsTask& task) {
  const auto open = open_index(task.folder);
  if (!open) return print_error(kCommand, open.error());
  return printed(task.json ? recordings_json(open->rows) : recordings_text(open->rows, true, open->unfinished));
}

int show_recordings(const RecordingsTask& task) {
  const auto open = open_index(task.folder);
  if (!open) return print_error(kCommand, open.error());
  io::UsageErrors errors;
  const std::vector<std::size_t> named = find_named(open->rows, task.names, errors);
  if (!errors.empty()) return print_usage_errors(kCommand, errors);
  if (task.json) return printed(recordings_json(picked(open->rows, named)));
  const std::vector<RecordingGroup> groups = group_recordings(open->rows, open->unfinished);
  std::string text;
  for (const std::size_t k : named) {
    const auto group = std::ranges::find_if(
        groups, [k](const RecordingGroup& g) { return std::ranges::find(g.rows, k) != g.rows.end(); });
    std::vector<std::string> files;
    for (const std::size_t other : group->rows) files.push_back(open->rows[other].file);
    text += (text.empty() ? "" : "\n") + recording_text(open->rows[k], files, group->problem);
  }
  return printed(text);
}

int delete_recordings(const RecordingsTask& task) {
  auto open = open_index(task.folder);
  if (!open) return print_error(kCommand, open.error());
  io::UsageErrors errors;
  const std::vector<std::size_t> chosen = find_named(open->rows, task.names, errors);
  if (!errors.empty()) return print_usage_errors(kCommand, errors);
  return delete_chosen(task, *open, chosen, "on request");
}

int retain_recordings(const RecordingsTask& task) {
  auto open = open_index(task.folder);
  if (!open) return print_error(kCommand, open.error());
  const std::int64_t now = std::chrono::duration_cast<std::chrono::nanoseconds>(io::read_clock(CLOCK_REALTIME)).count();
  return delete_chosen(task, *open, files_beyond_limits(open->rows, open->unfinished, task.limits, now), "retention");
}

int forget_person(const RecordingsTask& task) {
  auto open = open_index(task.folder);
  if (!open) return print_error(kCommand, open.error());
  const std::string& person = task.names.front();
  const std::vector<std::size_t> chosen = recordings_with(open->rows, person);
  for (const RecordingRow& row : open->rows)
    if (!row.readable())
      io::print_formatted(stderr, "%s cannot be read, so that it is unknown whether this person is in it: %s\n",
                          sanitize(row.file).c_str(), sanitize(row.problem).c_str());
  if (chosen.empty()) {
    std::vector<std::string> known;
    for (const RecordingRow& row : open->rows)
      for (const RecordedPerson& other : row.summary.persons)
        if (std::ranges::find(known, other.name) == known.end()) known.push_back(other.name);
    const std::string* const nearest = nearest_match(person, known);
    io::print_formatted(stderr, "no recording has a person \"%s\"%s\n", sanitize(person).c_str(),
                        nearest == nullptr ? "" : ("; did you mean " + sanitize(*nearest) + "?").c_str());
  }
  return delete_chosen(task, *open, chosen, "a person's request");
}

}  // namespace tandem::server
