#include "tests/vm/plug.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <thread>

#include "hal/backends/device_files.h"
#include "proto/text/presets_embedded.h"
#include "tests/hal/drivers/falcon/falcon_fixture.h"
#include "tests/hal/drivers/woodenhaptics/confirmed.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;

constexpr Duration kRaster = 250us;  // coarse, so that the programs get enough processor time

constexpr const char* kFalconFile =
    "falcon {\n  force { motor_1_counts_per_nm: 10000 motor_2_counts_per_nm: 10000 motor_3_counts_per_nm: 10000 }\n"
    "  measured: \"the model's own\"\n  peak_n: 6\n}\n";

Order order_of(Time at, const std::array<std::int16_t, 3>& motors) {
  const int strength = std::max({std::abs(motors[0]), std::abs(motors[1]), std::abs(motors[2])});
  return {at, strength > 0, strength};
}

class FalconPlug final : public Plug {
 public:
  FalconPlug(const Folder& folder, Found found)
      : words_("falcon:calibration=" + folder.write("falcon.textproto", kFalconFile)),
        model_(described(found)),
        server_(model_, next_port(), kRaster) {
    if (found == Found::kNoFirmware) {
      const auto image = hal::falcon::some_firmware().image;
      words_ +=
          ",firmware=" + folder.write("firmware.bin", {reinterpret_cast<const char*>(image.data()), image.size()});
    }
    hold(0);
  }
  [[nodiscard]] bool attached() const override { return server_.attached(); }
  [[nodiscard]] std::string words() const override { return words_; }
  void rest() override {}
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
  /// Returns the ports in turn, because a port stays busy for a moment after its device was detached.
  static unsigned next_port() {
    static unsigned used = 0;
    constexpr unsigned kPorts = 8;
    return used++ % kPorts;
  }
  static hal::emulation::FalconModelSpec described(Found found) {
    auto spec = hal::falcon::ready_model();
    spec.running = found != Found::kNoFirmware;
    spec.homed = found == Found::kReady;
    return spec;
  }
  std::uint64_t remembered(std::vector<Order>& newest) override {
    return server_.with_model([&] {
      for (std::size_t back = std::min<std::uint64_t>(model_.frames(), kRemembered); back > 0; --back) {
        const auto& frame = model_.host_frame(back - 1);
        newest.push_back(order_of(frame.at, frame.motor));
      }
      return model_.frames();
    });
  }

  std::string words_;
  hal::emulation::FalconModel model_;
  UsbipServer server_;
};

/// Returns the shipped preset as a user saves it after a check of its force scale.
std::string checked(const char* name) {
  std::string text{find_shipped_preset(name)->text};
  text.insert(text.rfind('}'), "  measured: \"the model's own\"\n");
  return text;
}

class BoardPlug final : public Plug {
 public:
  BoardPlug(const Folder& folder, const char* preset, Found found)
      : file_(folder.write("arm.textproto", checked(preset))),
        state_(confirmed_motors(folder.file("state"), "serial:0001", file_)),
        found_(found),
        model_(WoodenHapticsFixture::at_calibration(*hal::load_device_file(file_)->woodenhaptics, {})),
        from_(model_.tip()) {
    model_.place(from_);
    plug_ = std::make_unique<UhidDevice>(model_, kRaster);
  }
  ~BoardPlug() override { plug_.reset(); }
  [[nodiscard]] bool attached() const override { return plug_->attached(); }
  [[nodiscard]] std::string words() const override {
    return "woodenhaptics:preset=" + file_ + ",enable_motors=yes" + (found_ == Found::kReady ? ",home=here" : "");
  }
  [[nodiscard]] std::string state() const override { return state_; }
  void rest() override {
    plug_->with_model([&] { EXPECT_TRUE(model_.place(from_)); });
  }
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
  [[nodiscard]] Duration watchdog() const override { return hal::emulation::WoodenHapticsModel::kWatchdog; }

 private:
  std::uint64_t remembered(std::vector<Order>& newest) override {
    return plug_->with_model([&] {
      for (std::size_t back = std::min<std::uint64_t>(model_.host_reports(), kRemembered); back > 0; --back) {
        const auto& report = model_.host_report(back - 1);
        newest.push_back(order_of(report.at, report.preset ? std::array<std::int16_t, 3>{} : report.current_ma));
      }
      return model_.host_reports();
    });
  }

  std::string file_, state_;
  Found found_;
  hal::emulation::WoodenHapticsModel model_;
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

std::unique_ptr<Plug> plug_in(Kind kind, const Folder& folder, Found found) {
  if (kind == Kind::kFalcon) return std::make_unique<FalconPlug>(folder, found);
  return std::make_unique<BoardPlug>(folder, kind == Kind::kBoardV1 ? "woodenhaptics-2015" : "woodenhaptics-2019",
                                     found);
}

}  // namespace tandem::test
