#include "netsim/app/lesson_loader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>

#include "common/base/csv.h"
#include "common/base/raw_bytes.h"
#include "common/io/whole_file.h"
#include "netsim/score/motion_lesson.h"
#include "netsim/score/trace_lesson.h"
#include "proto/io/scene_file.h"
#include "proto/recording/lesson_reader.h"
#include "proto/spec/input_error.h"
#include "server/archive/io/part_files.h"
#include "server/export/io/hdf5_import.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
constexpr std::size_t kRecordingMax = std::size_t{1} << 32;  // [bytes]
constexpr std::array<std::string_view, 4> kEndings{".csv", ".h5", ".hdf5", ".mcap"};
constexpr std::string_view kMcap = "\x89MCAP";
constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";

struct Closing {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

/// Pieces of a file; `error` is empty unless a read failed.
class Pieces {
 public:
  explicit Pieces(const std::string& name) : file_(std::fopen(name.c_str(), "rb")), buffer_(kPieceBytes) {
    if (file_ == nullptr) error_ = name + ": " + std::strerror(errno);
  }
  /// Returns the next bytes; empty at the end, or after an error.
  std::string_view next(const std::string& name) {
    if (file_ == nullptr) return {};
    errno = 0;
    const std::size_t count = std::fread(buffer_.data(), 1, buffer_.size(), file_.get());
    if (count == 0 && std::ferror(file_.get()) != 0) error_ = name + ": " + std::strerror(errno);
    return {buffer_.data(), count};
  }
  [[nodiscard]] const std::string& error() const noexcept { return error_; }

 private:
  std::unique_ptr<std::FILE, Closing> file_;
  std::vector<char> buffer_;
  std::string error_;
};

std::expected<Lesson, std::string> read_trace(Pieces& pieces, std::string_view piece, const std::string& file,
                                              const std::string& scene_name) {
  if (scene_name.empty())
    return std::unexpected(file + ": a trace does not contain its scene; name it with --scene SCENE");
  auto scene = load_scene(scene_name);
  if (!scene) return std::unexpected(to_text(scene.error()));
  score::TraceReader reader(std::move(*scene), file);
  for (; !piece.empty(); piece = pieces.next(file))
    if (const auto read = reader.append(piece); !read) return std::unexpected(read.error());
  if (!pieces.error().empty()) return std::unexpected(pieces.error());
  return reader.finish();
}

/// Returns why a file is none of those that scores are computed from; empty: it may be a table.
std::string foreign_problem(std::string_view begin) {
  constexpr std::string_view kKinds =
      "; scores are computed from a recording (MCAP), its export (HDF5), rows of --trace, or a table of recorded "
      "motion (CSV, whose first line begins with t_s[s])";
  const std::string_view line = begin.substr(0, begin.find_first_of("\r\n"));
  const char* const why = begin.empty()                                ? "is empty"
                          : begin.find('\0') != std::string_view::npos ? "is a binary file of another kind"
                          : line.find('[') == std::string_view::npos   ? "is no table: its first line has no name[unit]"
                                                                       : "";
  return *why == '\0' ? std::string() : why + std::string(kKinds);
}

std::expected<Lesson, std::string> read_recording(const LessonFile& named) {
  LessonReader reader;
  const auto add = [&reader](const std::string& file) -> std::string {
    const auto bytes = io::read_whole_file(file, kRecordingMax);
    if (!bytes) return bytes.error();
    const auto added = reader.add(bytes_of(*bytes));
    return added ? std::string{} : file + ": " + added.error();
  };
  if (std::string problem = add(named.name); !problem.empty()) return std::unexpected(std::move(problem));
  for (const std::string& file : named.more)
    if (std::string problem = add(file); !problem.empty()) return std::unexpected(std::move(problem));
  return reader.take();
}

/// Adds the other parts of a long recording to the file.
void find_more(LessonFile& file) {
  if (std::error_code error; !std::filesystem::is_regular_file(file.name, error)) return;  // a pipe is read once
  if (Pieces pieces(file.name); !pieces.next(file.name).starts_with(kMcap)) return;
  const auto parts = server::find_parts({file.name});
  if (!parts) {
    file.note = parts.error();
    return;
  }
  file.name = parts->front().file;
  for (std::size_t k = 1; k < parts->size(); ++k) file.more.push_back((*parts)[k].file);
}

}  // namespace

std::expected<Lesson, std::string> load_lesson(const LessonFile& named, const std::string& scene) {
  const std::string& file = named.name;
  Pieces pieces(file);
  std::string_view piece = pieces.next(file);
  if (!pieces.error().empty()) return std::unexpected(pieces.error());
  if (score::TraceReader::is_trace(piece)) return read_trace(pieces, piece, file, scene);
  if (piece.starts_with(kHdf5)) return server::import_hdf5(file);
  if (piece.starts_with(kMcap)) return read_recording(named);
  if (const std::string problem = foreign_problem(piece); !problem.empty())
    return std::unexpected(file + ": " + problem);
  std::string bytes;
  for (; !piece.empty(); piece = pieces.next(file)) {
    if (bytes.size() + piece.size() > CsvTable::kBytesMax)
      return std::unexpected(file + ": more than " + std::to_string(CsvTable::kBytesMax >> 30) + " GiB; cut the table");
    bytes += piece;
  }
  if (!pieces.error().empty()) return std::unexpected(pieces.error());
  return score::read_motion(bytes, file);
}

std::expected<std::vector<LessonFile>, std::string> lesson_files(const std::vector<std::string>& paths) {
  std::vector<LessonFile> out;
  std::set<std::filesystem::path> parts;  // of the lessons so far
  const auto add = [&](std::string name, bool of_folder) {
    if (parts.contains(absolute(std::filesystem::path(name)))) return;
    LessonFile& file = out.emplace_back(std::move(name), of_folder);
    find_more(file);
    for (const std::string& more : file.more) parts.insert(absolute(std::filesystem::path(more)));
    if (!file.more.empty()) parts.insert(absolute(std::filesystem::path(file.name)));
  };
  for (const std::string& path : paths) {
    std::error_code error;
    if (!std::filesystem::is_directory(path, error)) {
      add(path, false);
      continue;
    }
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path, error)) {
      const std::string name = entry.path().string();
      if (std::ranges::any_of(kEndings, [&](std::string_view ending) { return name.ends_with(ending); }))
        found.push_back(name);
    }
    if (error) return std::unexpected(path + ": " + error.message());
    if (found.empty()) return std::unexpected(path + ": the folder has no recording");
    std::ranges::sort(found);
    for (std::string& name : found) add(std::move(name), true);
  }
  return out;
}

}  // namespace tandem::netsim
