#include "server/recording/io/recording_files.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/base/format.h"
#include "common/io/output_file.h"
#include "proto/recording/recording_format.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr double kBurstS = 10;         // [s] over which the rate is judged
constexpr unsigned kNumberMax = 9999;  // of the files of one name
constexpr Duration kRetryOpen = 10s;
constexpr Duration kQuiet = 500ms;  // without a whole chunk, until an open one is ended
constexpr Duration kIdle = 30s;     // likewise, while it has inputs only: nothing happens in the session
constexpr const char* kSuffix = ".mcap";

std::string disk_text(int error) {
  return error == ENOSPC || error == EDQUOT ? "the disk is full; free some space there" : io::write_error_text(error);
}

double mib(double bytes) { return bytes / (1 << 20); }

std::string base_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

std::expected<std::unique_ptr<RecordingFiles>, std::string> RecordingFiles::open(const std::string& path,
                                                                                 const SceneSpec& scene,
                                                                                 const RecordingInfo& info,
                                                                                 const RecordingLimits& limits,
                                                                                 Time now) {
  std::unique_ptr<RecordingFiles> made{new RecordingFiles(path, scene, info, limits)};
  made->now_ = now;
  if (std::string problem = made->open_next(); !problem.empty()) return std::unexpected(std::move(problem));
  return made;
}

RecordingFiles::RecordingFiles(std::string path, const SceneSpec& scene, RecordingInfo info,
                               const RecordingLimits& limits)
    : stem_(path.ends_with(kSuffix) ? path.substr(0, path.size() - 5) : std::move(path)),
      scene_(&scene),
      info_(std::move(info)),
      limits_(limits),
      budget_(limits.bytes_per_s * kBurstS) {}

std::string RecordingFiles::open_next() {
  unsigned number = number_ + 1;
  std::string path;
  // The name of the first file was free when it was chosen; later ones may meet files of earlier recordings.
  for (; number <= kNumberMax; ++number) {
    path = number == 1 ? stem_ + kSuffix : stem_ + format("-%u", number) + kSuffix;
    if (number_ == 0 || (::access(path.c_str(), F_OK) != 0 && ::access((path + ".part").c_str(), F_OK) != 0)) break;
  }
  auto file = io::AppendFile::create(path);
  if (!file) return file.error();
  if (file_) {
    info_.metadata[rec::kPreviousKey] = base_name(file_->path());
    end_file(false);
  }
  file_ = std::move(*file);
  number_ = number;
  info_.metadata[rec::kRecordingKey] = base_name(stem_);
  info_.metadata[rec::kPartKey] = std::to_string(++part_);
  file_began_.reset();
  if (begun()) writer_ = std::make_unique<RecordingWriter>(*scene_, info_);
  return {};
}

void RecordingFiles::end_file(bool last) {
  if (!begun()) begin(0);
  empty_ = last && part_ == 1 && !writer_->has_content() && lost() == 0;
  writer_->finish(last);
  static_cast<void>(pass_on());
  file_->begin_close();
  total_bytes_ += std::exchange(file_bytes_, 0);
  ending_.push_back({std::move(file_), std::exchange(unsynced_, 0)});
}

void RecordingFiles::begin(std::int64_t start_unix_ns) {
  info_.start_unix_ns = start_unix_ns;
  writer_ = std::make_unique<RecordingWriter>(*scene_, info_);
}

void RecordingFiles::set_persons(std::vector<std::string> persons, std::vector<bool> workstations) {
  if (info_.persons == persons && info_.workstations == workstations) return;
  info_.persons = std::move(persons);
  info_.workstations = std::move(workstations);
  if (begun()) writer_->set_persons(info_.persons, info_.workstations);
}

void RecordingFiles::add(const TickRecord& record) {
  if (any_ ? record.tick <= last_tick_ : !record.running) return;  // the session clock stands still
  if (!std::exchange(any_, true)) first_tick_ = record.tick;
  last_tick_ = record.tick;
  time_ns_ = record.time_ns;
  if (!trouble_.empty() || closing_) {
    ++gap_;
    return writer_->count_dropped(1);
  }
  if (full()) change_file();
  if (gap_ > 0) note_gap();
  writer_->add(record);
  if (!file_began_) file_began_ = now_;
  ++recorded_;
}

bool RecordingFiles::full() const {
  return file_bytes_ >= limits_.file_bytes || (file_began_ && seconds(now_ - *file_began_) >= limits_.file_s);
}

void RecordingFiles::change_file() {
  if (now_ < retry_at_) return;
  std::string error = open_next();
  if (error.empty()) {
    open_error_.clear();
    return;
  }
  retry_at_ = now_ + kRetryOpen;  // the present file goes on meanwhile
  if (error != open_error_) problems_.push_back("no further file can be made, so this one goes on: " + error);
  open_error_ = std::move(error);
}

void RecordingFiles::add_inputs(std::span<const std::byte> piece) {
  if (trouble_.empty() && !closing_) {
    if (file_bytes_ >= limits_.file_bytes) change_file();
    writer_->add_inputs(piece);
  } else {
    lost_inputs_ += piece.size();
  }
}

void RecordingFiles::add_input_block(std::string_view block, std::size_t stored) {
  if (file_bytes_ >= limits_.file_bytes) change_file();
  writer_->add_input_block(block);
  exempt_ += stored;
}

bool RecordingFiles::pass_on() {
  std::string bytes = writer_->take();
  if (bytes.empty()) return false;
  file_bytes_ += bytes.size();
  const std::uint64_t exempt = std::min<std::uint64_t>(exempt_, bytes.size());
  exempt_ -= exempt;
  budget_ -= static_cast<double>(bytes.size() - exempt);
  file_->append(std::move(bytes));
  return true;
}

void RecordingFiles::step(Time now) {
  if (closing_ || !begun()) return;
  now_ = now;
  // The writer ends a chunk with the first message behind it. While none comes, its last chunk ends here.
  if (pass_on()) {
    passed_on_ = now;
  } else if (now - passed_on_ > (writer_->has_open_messages() ? kQuiet : kIdle)) {
    writer_->flush();
    static_cast<void>(pass_on());
    passed_on_ = now;
  }
  budget_ =
      std::min(budget_ + limits_.bytes_per_s * std::max(0.0, seconds(now - budget_at_)), limits_.bytes_per_s * kBurstS);
  budget_at_ = now;
  update_trouble();
  if (bytes() >= limits_.total_bytes) {
    problems_.push_back(format("the recording has reached its limit of %.0f MiB and ends",
                               mib(static_cast<double>(limits_.total_bytes))));
    return begin_close();
  }
}

void RecordingFiles::update_trouble() {
  const io::AppendFile::State disk = file_->state();
  trouble_ = disk.error != 0     ? disk_text(disk.error)
             : !file_->accepts() ? "the disk is too slow"
             : budget_ <= 0      ? format("more than %.3g MiB per minute", mib(60 * limits_.bytes_per_s))
                                 : "";
  if (!trouble_.empty()) gap_reason_ = trouble_;
  if (disk.unsynced > unsynced_)
    problems_.push_back("the disk did not confirm a write: up to a second of the recording may be missing");
  unsynced_ = disk.unsynced;
}

void RecordingFiles::note_gap() {
  writer_->add_event({last_tick_, time_ns_, "recording-gap", "",
                      format("%llu ticks dropped: ", static_cast<unsigned long long>(gap_)) + gap_reason_});
  gap_ = 0;
}

void RecordingFiles::begin_close() {
  if (std::exchange(closing_, true)) return;
  if (gap_ > 0) note_gap();
  end_file(true);
}

bool RecordingFiles::closed() {
  std::erase_if(ending_, [this](const EndingFile& ending) {
    const auto& [file, unsynced] = ending;
    const io::AppendFile::State state = file->state();
    if (!state.closed) return false;
    if (!state.close_error.empty()) {
      problems_.push_back(state.close_error);
    } else if (!empty_ && state.unsynced > unsynced) {
      problems_.push_back(file->path() +
                          ": the disk did not confirm the end of this file, so some of it may be missing; copy it to "
                          "another disk and check this one");
    } else if (!empty_) {
      completed_.push_back(file->path());
    } else if (::unlink(file->path().c_str()) == 0) {
      removed_.push_back(file->path());
    } else {
      problems_.push_back(file->path() + " has no tick and cannot be removed: " + std::strerror(errno));
    }
    disk_cpu_ += Duration{state.cpu};
    return true;
  });
  return closing_ && ending_.empty();
}

void RecordingFiles::abandon() {
  for (const auto& [file, unsynced] : ending_)
    if (std::string problem = file->close(0ms); !problem.empty()) problems_.push_back(std::move(problem));
  ending_.clear();
}

std::vector<std::string> RecordingFiles::take_completed() { return std::exchange(completed_, {}); }
std::vector<std::string> RecordingFiles::take_removed() { return std::exchange(removed_, {}); }
std::vector<std::string> RecordingFiles::take_problems() { return std::exchange(problems_, {}); }

Duration RecordingFiles::disk_cpu() const {
  Duration all = disk_cpu_;
  if (file_) all += Duration{file_->state().cpu};
  for (const auto& [file, unsynced] : ending_) all += Duration{file->state().cpu};
  return all;
}

}  // namespace tandem::server
