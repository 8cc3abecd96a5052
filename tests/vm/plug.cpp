#include "tests/vm/plug.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <thread>

#include "hal/app/device_files.h"
#include "proto/presets_embedded.h"
#include "tests/hal/falcon/bench.h"
#include "tests/hal/woodenhaptics/bench.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

constexpr const char* kFalconFile =
    "falcon {\n  force { motor_1_counts_per_nm: 10000 motor_2_counts_per_nm: 10000 motor_3_counts_per_nm: 10000 }\n"
    "  measured: \"the model's own\"\n  peak_n: 6\n}\n";

bool pushes(const std::array<std::int16_t, 3>& motors) { return motors != std::array<std::int16_t, 3>{}; }

class FalconPlug final : public Plug {
 public:
  FalconPlug(const Folder& folder, bool homed)
      : file_(folder.write("falcon.textproto", kFalconFile)), model_(described(homed)), server_(model_, 0) {
    hold(0);
  }
  [[nodiscard]] bool attached() const override { return server_.attached(); }
  [[nodiscard]] std::string words() const override { return "falcon:calibration=" + file_; }
  [[nodiscard]] std::string unhomed_words() const override { return words(); }
  void carry() override {}
  void hold(double x) override {
    server_.with_model([&] { model_.mechanics().set_pull({.k = 800, .b = 10, .m = 0.2, .x = hal::Vec3(x, 0, 0)}); });
  }
  [[nodiscard]] double force() override {
    return server_.with_model([&] { return model_.mechanics().motor_force().norm(); });
  }
  [[nodiscard]] Time now() override {
    return server_.with_model([&] { return model_.now(); });
  }
  [[nodiscard]] Duration watchdog() const override { return {}; }

 private:
  static hal::wire::FalconModelSpec described(bool homed) {
    auto spec = hal::falcon::ready_model();
    spec.homed = homed;
    return spec;
  }
  std::uint64_t remembered(std::vector<Order>& newest) override {
    return server_.with_model([&] {
      for (std::size_t back = std::min<std::uint64_t>(model_.frames(), kRemembered); back > 0; --back) {
        const auto& frame = model_.host_frame(back - 1);
        newest.push_back({frame.at, pushes(frame.motor)});
      }
      return model_.frames();
    });
  }

  std::string file_;
  hal::wire::FalconModel model_;
  UsbipServer server_;
};

/// The shipped preset, as somebody would keep it who checked its force scale.
std::string checked(const char* name) {
  std::string text{find_shipped_preset(name)->text};
  text.insert(text.rfind('}'), "  measured: \"the model's own\"\n");
  return text;
}

class BoardPlug final : public Plug {
 public:
  BoardPlug(const Folder& folder, const char* preset)
      : file_(folder.write("arm.textproto", checked(preset))),
        model_(WoodenBench::at_calibration(*hal::load_device_file(file_)->woodenhaptics, {})),
        from_(model_.tip()) {
    model_.place(from_);
    plug_ = std::make_unique<UhidDevice>(model_);
  }
  ~BoardPlug() override { plug_.reset(); }
  [[nodiscard]] bool attached() const override { return plug_->attached(); }
  [[nodiscard]] std::string words() const override { return unhomed_words() + ",home=here"; }
  [[nodiscard]] std::string unhomed_words() const override { return "woodenhaptics:preset=" + file_ + ",energise=yes"; }
  void carry() override {
    constexpr double kStep = 0.0005;  // [m] per millisecond
    const int steps = static_cast<int>(from_.norm() / kStep) + 1;
    for (int i = 0; i <= steps; ++i) {
      plug_->with_model([&] { EXPECT_TRUE(model_.place(from_ * (1 - static_cast<double>(i) / steps))); });
      std::this_thread::sleep_for(1ms);
    }
  }
  void hold(double x) override {
    plug_->with_model([&] { EXPECT_TRUE(model_.place({x, 0, 0})); });
  }
  [[nodiscard]] double force() override {
    return plug_->with_model([&] { return model_.motor_force().norm(); });
  }
  [[nodiscard]] Time now() override {
    return plug_->with_model([&] { return model_.now(); });
  }
  [[nodiscard]] Duration watchdog() const override { return hal::wire::WoodenHapticsModel::kWatchdog; }

 private:
  std::uint64_t remembered(std::vector<Order>& newest) override {
    return plug_->with_model([&] {
      for (std::size_t back = std::min<std::uint64_t>(model_.host_reports(), kRemembered); back > 0; --back) {
        const auto& report = model_.host_report(back - 1);
        newest.push_back({report.at, !report.preset && pushes(report.current_ma)});
      }
      return model_.host_reports();
    });
  }

  std::string file_;
  hal::wire::WoodenHapticsModel model_;
  hal::Vec3 from_;
  std::unique_ptr<UhidDevice> plug_;
};

}  // namespace

std::vector<Order> Plug::take() {
  std::vector<Order> newest;
  const std::uint64_t all = remembered(newest);
  const std::uint64_t fresh = all - std::exchange(taken_, all);
  EXPECT_LE(fresh, kRemembered) << "orders went by unseen";
  if (newest.size() > fresh) newest.erase(newest.begin(), newest.end() - static_cast<std::ptrdiff_t>(fresh));
  return newest;
}

std::unique_ptr<Plug> plug_in(Kind kind, const Folder& folder, bool homed) {
  if (kind == Kind::kFalcon) return std::make_unique<FalconPlug>(folder, homed);
  return std::make_unique<BoardPlug>(folder, kind == Kind::kBoardV1 ? "woodenhaptics-2015" : "woodenhaptics-2019");
}

}  // namespace tandem::test
