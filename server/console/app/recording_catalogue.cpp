#include "server/console/app/recording_catalogue.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <span>
#include <utility>

#include "common/base/hex.h"
#include "common/transport/digest.h"
#include "server/archive/app/lesson_file.h"
#include "server/archive/app/recording_scan.h"
#include "server/archive/recording_group.h"
#include "server/console/recording_request.h"

namespace tandem::console {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kScanTime{2};

std::string id_of(const std::string& name) {
  const auto digest = transport::sha256(std::as_bytes(std::span(name)));
  return to_hex(std::span(digest).first(RecordingRequest::kIdLength / 2));
}

ListedRecording listed(const std::vector<server::RecordingRow>& rows, const server::RecordingGroup& group) {
  const server::RecordingRow row = joined_row(rows, group);
  ListedRecording out;
  out.files = group.rows.size();
  out.parts_problem = group.problem;
  out.id = id_of(row.file);
  out.file = row.file;
  out.bytes = row.bytes;
  out.problem = row.problem;
  out.session = row.summary.session;
  out.scene = row.summary.scene;
  out.start_s = 1e-9 * static_cast<double>(row.begun_ns());
  out.duration_s = row.summary.duration_s;
  out.missing_ticks = row.summary.missing_ticks;
  out.complete = row.summary.complete;
  for (const server::RecordedPerson& person : row.summary.persons)
    if (std::ranges::find(out.persons, person.name) == out.persons.end()) out.persons.push_back(person.name);
  return out;
}

}  // namespace

RecordingCatalogue::RecordingCatalogue(std::string folder, std::vector<std::string> files)
    : folder_(std::move(folder)), files_(std::move(files)) {
  for (const std::string& file : files_) known_.emplace(id_of(file), Found{{.file = file}, {file}});
}

RecordingList RecordingCatalogue::list() {
  RecordingList list;
  if (folder_.empty()) {
    list_files(list);
  } else {
    scan(list);
  }
  return list;
}

void RecordingCatalogue::scan(RecordingList& list) {
  auto index = server::RecordingIndex::open(folder_);
  if (!index) {
    list.problem = index.error();
    return;
  }
  const auto begin = Clock::now();
  const auto progress = [&](std::size_t done, std::size_t total) {
    list.read = done;
    list.to_read = total;
    return done == 0 || Clock::now() - begin < kScanTime;  // one file at least, so that each call goes on
  };
  const auto report = server::scan_recordings(folder_, *index, server::load_summary, progress);
  if (!report) {
    list.problem = report.error();
    return;
  }
  if (!report->interrupted) list.read = list.to_read = 0;
  list.unfinished = report->unfinished.size();
  auto rows = index->rows();
  if (!rows) {
    list.problem = rows.error();
    return;
  }
  keep(list, *rows, report->unfinished);
}

void RecordingCatalogue::list_files(RecordingList& list) {
  for (std::size_t i = file_rows_.size(); i < files_.size(); ++i) {
    server::RecordingRow row;
    row.file = files_[i];
    std::error_code ignored;
    row.bytes = std::filesystem::file_size(files_[i], ignored);
    if (auto summary = server::load_summary(files_[i])) {
      row.summary = std::move(*summary);
    } else {
      row.problem = summary.error();
    }
    file_rows_.push_back(std::move(row));
  }
  keep(list, file_rows_, {});
}

void RecordingCatalogue::keep(RecordingList& list, const std::vector<server::RecordingRow>& rows,
                              const std::vector<std::string>& unfinished) {
  std::vector<server::RecordingGroup> groups = group_recordings(rows, unfinished);
  known_.clear();
  for (const server::RecordingGroup& group : groups) {
    const std::string& first = rows[group.rows.front()].file;
    Found found{{first, group.rows.size(), group.problem}, {}};
    for (const std::size_t k : group.rows)
      found.paths.push_back(folder_.empty() ? rows[k].file : folder_ + "/" + rows[k].file);
    known_.emplace(id_of(first), std::move(found));
  }
  if (!folder_.empty())
    std::ranges::stable_sort(groups, std::ranges::greater{},
                             [&](const server::RecordingGroup& group) { return rows[group.rows.front()].begun_ns(); });
  list.left_out = groups.size() - std::min(groups.size(), kListedMax);
  groups.resize(std::min(groups.size(), kListedMax));
  for (const server::RecordingGroup& group : groups) list.recordings.push_back(listed(rows, group));
}

std::optional<RecordingCatalogue::Found> RecordingCatalogue::find(const std::string& id) const {
  const auto found = known_.find(id);
  return found == known_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace tandem::console
