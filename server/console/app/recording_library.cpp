#include "server/console/app/recording_library.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <new>

#include "server/console/app/gzip.h"

namespace tandem::console {
namespace {

constexpr int kLeastPriority = 19;  // nice value
constexpr const char* kNoMemory = "it is too large for the memory of this computer";

RecordingReply reply_of(unsigned status, const std::string& json) {
  return {status, std::make_shared<const std::string>(gzip(json))};
}

rpc::Id bytes_of(const std::string& id) {
  rpc::Id out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    unsigned byte = 0;
    std::from_chars(id.data() + 2 * i, id.data() + 2 * i + 2, byte, 16);
    out[i] = static_cast<std::byte>(byte);
  }
  return out;
}

}  // namespace

RecordingLibrary::RecordingLibrary(std::string folder, std::vector<std::string> files)
    : catalogue_(std::move(folder), std::move(files)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

RecordingLibrary::~RecordingLibrary() = default;

bool RecordingLibrary::ask(RecordingRequest request, Done done) {
  {
    const std::lock_guard hold{lock_};
    if (waiting_.size() >= kWaitingMax) return false;
    waiting_.emplace_back(std::move(request), std::move(done));
  }
  wake_.notify_one();
  return true;
}

/// Takes the next request, or none if an outline is to be read meanwhile. @return false: the library ends
bool RecordingLibrary::wait(const std::stop_token& stop, std::optional<std::pair<RecordingRequest, Done>>& next) {
  std::unique_lock hold{lock_};
  if (in_preparation() == nullptr) wake_.wait(hold, stop, [this] { return !waiting_.empty(); });
  if (stop.stop_requested()) return false;
  if (!waiting_.empty()) {
    next = std::move(waiting_.front());
    waiting_.pop_front();
  }
  return true;
}

void RecordingLibrary::work(const std::stop_token& stop) {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kLeastPriority);
  for (;;) {
    std::optional<std::pair<RecordingRequest, Done>> next;
    if (!wait(stop, next)) return;
    if (next) {
      next->second(reply_to(next->first));
    } else if (Open* const open = in_preparation()) {
      prepare(*open);
    }
  }
}

RecordingReply RecordingLibrary::reply_to(const RecordingRequest& request) try {
  using What = RecordingRequest::What;
  if (request.what == What::kList) return reply_of(200, list_json(catalogue_.list()));
  Open* const found = open(request.id);
  if (found == nullptr)
    return reply_of(404, problem_json("there is no such recording; load the list of recordings again"));
  if (!found->recording) return reply_of(422, problem_json(found->found.files.file + ": " + found->problem));
  switch (request.what) {
    case What::kPiece:
      return piece_of(*found, request.piece);
    case What::kScores:
      return scores_of(*found);
    default:
      return outline_of(*found);
  }
} catch (const std::bad_alloc&) {
  return reply_of(422, problem_json(kNoMemory));
}

RecordingLibrary::Open* RecordingLibrary::open(const std::string& id) {
  const auto known = std::ranges::find(open_, id, &Open::id);
  if (known != open_.end() && known->recording && known->recording->unchanged()) {
    open_.splice(open_.begin(), open_, known);
    return &open_.front();
  }
  forget(id);
  auto found = catalogue_.find(id);
  if (!found) {
    static_cast<void>(catalogue_.list());  // a page may keep the id of an earlier run
    found = catalogue_.find(id);
  }
  if (!found) return nullptr;
  Open fresh{.id = id, .found = std::move(*found), .recording = {}, .problem = {}, .outline = {}};
  const bool whole = fresh.found.files.parts_problem.empty();
  if (auto recording = OpenRecording::open(fresh.found.paths, bytes_of(id), whole)) {
    fresh.recording.emplace(std::move(*recording));
  } else {
    fresh.problem = recording.error();
  }
  open_.push_front(std::move(fresh));
  if (open_.size() > kOpenMax) open_.pop_back();
  return &open_.front();
}

void RecordingLibrary::forget(const std::string& id) {
  std::erase_if(open_, [&](const Open& open) { return open.id == id; });
  std::erase_if(pieces_, [&](const Piece& piece) {
    if (piece.id != id) return false;
    piece_bytes_ -= piece.gzip->size();
    return true;
  });
  scores_.forget(id);
}

RecordingLibrary::Open* RecordingLibrary::in_preparation() {
  const auto found =
      std::ranges::find_if(open_, [](const Open& open) { return open.recording && !open.recording->ready(); });
  return found == open_.end() ? nullptr : &*found;
}

void RecordingLibrary::prepare(Open& open) try { open.recording->advance(); } catch (const std::bad_alloc&) {
  open.recording.reset();
  open.problem = kNoMemory;
}

RecordingReply RecordingLibrary::outline_of(Open& open) {
  const OpenRecording& recording = *open.recording;
  if (!recording.ready()) return reply_of(202, progress_json(recording.progress()));
  if (recording.outline().empty())
    return reply_of(422, problem_json(open.found.files.file + ": it has no tick of a session"));
  if (!open.outline)
    open.outline = std::make_shared<const std::string>(
        gzip(outline_json(recording.outline(), bytes_of(open.id), open.found.files)));
  return {200, open.outline};
}

RecordingReply RecordingLibrary::piece_of(Open& open, std::uint32_t number) {
  const OpenRecording& recording = *open.recording;
  if (!recording.ready() || recording.outline().empty() || number >= recording.pieces())
    return recording.ready() ? reply_of(404, problem_json("the recording has no such piece")) : outline_of(open);
  const auto known =
      std::ranges::find_if(pieces_, [&](const Piece& piece) { return piece.id == open.id && piece.number == number; });
  if (known != pieces_.end()) {
    pieces_.splice(pieces_.begin(), pieces_, known);
    return {200, pieces_.front().gzip};
  }
  pieces_.push_front({open.id, number, std::make_shared<const std::string>(gzip(recording.piece(number)))});
  piece_bytes_ += pieces_.front().gzip->size();
  RecordingReply reply{200, pieces_.front().gzip};
  while (piece_bytes_ > kPieceBytesMax && pieces_.size() > 1) {
    piece_bytes_ -= pieces_.back().gzip->size();
    pieces_.pop_back();
  }
  return reply;
}

RecordingReply RecordingLibrary::scores_of(Open& open) {
  const OpenRecording& recording = *open.recording;
  if (!recording.ready()) return outline_of(open);
  const RecordingScores::Answer answer = scores_.of(open.id, open.found.paths, recording.outline());
  if (answer.pending) return reply_of(202, progress_json(1));
  return reply_of(answer.problem.empty() ? 200 : 422,
                  answer.problem.empty() ? "{" + answer.members + "}" : problem_json(answer.problem));
}

}  // namespace tandem::console
