#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/recording/io/recording_files.h"
#include "tests/io/programs.h"
#include "tests/io/recording_samples.h"

/// Recordings of virtual time on a real disk.
namespace tandem::server::test {

inline constexpr std::chrono::seconds kLimit{30};  // against hanging

inline bool comes_true(const std::function<bool()>& so) {
  for (const auto until = std::chrono::steady_clock::now() + kLimit; std::chrono::steady_clock::now() < until;) {
    if (so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// A recording of virtual time: 250 ticks, then a step, as the thread of a server does.
class Recording {
 public:
  explicit Recording(const tandem::test::Folder& folder, const RecordingLimits& limits = {},
                     const std::string& scene = "contact")
      : scene_(scene_named(scene)),
        files_(std::move(*RecordingFiles::open(folder.file("a.mcap"), scene_, info_of(scene_), limits, now_))) {
    files_->begin(1'700'000'000'000'000'000);
  }
  /// Adds ticks of `s` quarters of a second.
  void run(int quarters) {
    for (int q = 0; q < quarters; ++q) {
      for (int k = 0; k < 250; ++k) files_->add(record_at(scene_, ++tick_));
      now_ += std::chrono::milliseconds(250);
      files_->step(now_);
    }
  }
  /// A quarter of a second in which the session does not run.
  void run_nothing() {
    now_ += std::chrono::milliseconds(250);
    files_->step(now_);
  }
  /// Steps without ticks until the disk has followed.
  void settle(const std::function<bool()>& so) {
    EXPECT_TRUE(comes_true([&] {
      files_->step(now_);
      return so();
    }));
  }
  std::vector<std::string> close() {
    files_->begin_close();
    EXPECT_TRUE(comes_true([&] { return files_->closed(); }));
    return files_->take_completed();
  }
  RecordingFiles& files() { return *files_; }
  [[nodiscard]] std::uint32_t tick() const { return tick_; }
  void skip(std::uint32_t ticks) { tick_ += ticks; }

 private:
  Time now_{};
  SceneSpec scene_;
  std::unique_ptr<RecordingFiles> files_;
  std::uint32_t tick_ = 0;
};

/// Size of a file without ticks [bytes].
inline std::size_t head_bytes() {
  const SceneSpec scene = scene_named("contact");
  RecordingWriter empty{scene, info_of(scene)};
  empty.finish();
  return empty.take().size();
}

inline Lesson read(const tandem::test::Folder& folder, const std::string& name) {
  auto lesson = lesson_of(folder.read(name));
  EXPECT_TRUE(lesson) << name << ": " << lesson.error();
  return lesson ? std::move(*lesson) : Lesson{};
}

}  // namespace tandem::server::test
