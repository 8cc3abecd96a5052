#include "hal/io/recording_motion.h"

#include <utility>

#include "common/base/raw_bytes.h"
#include "common/io/whole_file.h"
#include "hal/sim/hand.h"
#include "hal/sim/lesson_motion.h"
#include "proto/recording/lesson_reader.h"

namespace tandem::hal {
namespace {

constexpr std::uintmax_t kRecordingBytesMax = std::uintmax_t{1} << 32;

}  // namespace

std::expected<std::shared_ptr<const sim::RecordedMotion>, std::string> load_recording_motion(const std::string& file,
                                                                                             const std::string& name,
                                                                                             const HandSpec& hand) {
  const auto bytes = io::read_whole_file(file, kRecordingBytesMax);
  if (!bytes) return std::unexpected(bytes.error());
  const auto lesson = read_lesson(bytes_of(*bytes));
  if (!lesson) return std::unexpected(file + ": " + lesson.error());
  const double k =
      hand.model == HandModel::kRecorded && hand.k > 0 ? hand.k : sim::impedance_of(HandModel::kRecorded).k;
  auto motion = sim::motion_of_seat(*lesson, name, hand.trajectory.center, k);
  if (!motion) return std::unexpected(file + ": seat=" + name + ": " + motion.error());
  return motion;
}

RecordingMotionReader recording_motion_reader(std::string own_seat) {
  return [own = std::move(own_seat)](const std::string& file, const std::string& seat, const HandSpec& hand) {
    return load_recording_motion(file, seat.empty() ? own : seat, hand);
  };
}

}  // namespace tandem::hal
