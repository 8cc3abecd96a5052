#include "server/console/recording_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tandem::console {
namespace {

constexpr std::uint64_t kBytesPerRowAndPart = 410;  // of a seat or tool (proto/recording/lesson_reader.h)
constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

float length_of(const LessonTriple& v) { return static_cast<float>(std::hypot(v[0], v[1], v[2])); }

template <class Note>
void keep(const std::vector<Note>& from, std::vector<Note>& to, std::uint64_t& left_out) {
  for (const Note& note : from) {
    if (to.size() < RecordingOutline::kNotesMax) {
      to.push_back(note);
    } else {
      ++left_out;
    }
  }
}

}  // namespace

RecordingCurves::RecordingCurves(const SceneSpec& scene)
    : seats_(scene.seats.size()),
      tools_(scene.tools.size()),
      masters_(scene.masters()),
      width_(seats_ + tools_ * (4 + masters_)),
      step_(std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::lround(scene.tick_hz / kStepHz)))) {}

void RecordingCurves::add(const Lesson& lesson, std::size_t row, const SeatPresence& presence) {
  const std::uint32_t tick = lesson.tick[row];
  if (points_.empty()) first_ = tick;
  while ((tick - first_) / step_ >= kPointsMax) halve();
  const std::size_t point = (tick - first_) / step_;
  const bool begins = point >= size() && (tick - first_) % step_ <= step_ / 10;  // a later row has another time
  points_.resize(std::max(points_.size(), (point + 1) * width_), kNoValue);
  float* const to = points_.data() + point * width_;
  for (std::size_t i = 0; i < seats_; ++i)
    if (presence.taken(i)) to[i] = std::fmax(to[i], length_of(lesson.seats[i].f[row]));
  for (std::size_t j = 0; j < tools_; ++j) {
    const LessonTool& tool = lesson.tools[j];
    to[seats_ + j] = std::fmax(to[seats_ + j], length_of(tool.f_env[row]));
    if (!begins) continue;
    for (std::size_t a = 0; a < 3; ++a) to[seats_ + tools_ + 3 * j + a] = static_cast<float>(tool.x[row][a]);
    for (std::size_t k = 0; k < masters_; ++k)
      if (presence.taken(k)) to[seats_ + 4 * tools_ + masters_ * j + k] = static_cast<float>(tool.alpha[row][k]);
  }
}

void RecordingCurves::finish(std::uint32_t last) {
  const std::uint64_t ticks = (last - first_) % step_ + std::uint64_t{1};  // of the last step
  if (size() > 1 && 10 * ticks < step_) points_.resize((size() - 1) * width_);
}

/// Doubles the distance of points. Forces are the larger of two, other values those of the first of two.
void RecordingCurves::halve() {
  const std::size_t before = size(), forces = seats_ + tools_;
  for (std::size_t point = 0; 2 * point < before; ++point) {
    const float* const from = points_.data() + 2 * point * width_;
    float* const to = points_.data() + point * width_;
    for (std::size_t i = 0; i < width_; ++i)
      to[i] = i < forces && 2 * point + 1 < before ? std::fmax(from[i], from[width_ + i]) : from[i];
  }
  points_.resize((before + 1) / 2 * width_);
  step_ *= 2;
}

RecordingOutline::RecordingOutline(Lesson head)
    : head_(std::move(head)), presence_(head_.scene), curves_(head_.scene) {}

bool RecordingOutline::add(const Lesson& part) {
  bool ordered = true;
  for (std::size_t row = 0; row < part.rows(); ++row) {
    const std::uint32_t tick = part.tick[row];
    if (rows_ > 0 && tick <= last_) {
      ordered = false;
      continue;
    }
    if (rows_ == 0) first_ = tick;
    if (rows_ > 0 && tick - last_ > 1) {
      gaps_.push_back({last_ + 1, tick});
      ++gap_count_;
      missing_ += gaps_.back().ticks();
      if (gaps_.size() >= 2 * kGapsMax) keep_longest_gaps();
    }
    last_ = tick;
    ++rows_;
    presence_.add(part, row);
    curves_.add(part, row, presence_);
  }
  keep(part.events, events_, left_out_);
  keep(part.marks, marks_, left_out_);
  return ordered;
}

LessonSeatSet RecordingOutline::seats_without_samples() const {
  LessonSeatSet out;
  for (std::size_t i = 0; i < head_.seats.size(); ++i) out[i] = !presence_.has_samples(i);
  return out;
}

std::uint64_t RecordingOutline::lesson_bytes() const {
  return rows_ * kBytesPerRowAndPart * (head_.seats.size() - seats_without_samples().count() + head_.tools.size());
}

void RecordingOutline::keep_longest_gaps() {
  if (gaps_.size() > kGapsMax) {
    const auto middle = gaps_.begin() + static_cast<std::ptrdiff_t>(kGapsMax);
    std::ranges::nth_element(gaps_, middle, std::ranges::greater{}, &RecordingGap::ticks);
    gaps_.erase(middle, gaps_.end());
  }
  std::ranges::sort(gaps_, {}, &RecordingGap::from);
}

void RecordingOutline::finish(bool complete) {
  keep_longest_gaps();
  std::ranges::stable_sort(marks_, {}, &LessonMark::t_s);
  curves_.finish(last_);
  complete_ = complete;
}

}  // namespace tandem::console
