#include "hal/io/openhaptics_library.h"

#include <dlfcn.h>

#include <vector>

namespace tandem::hal {

Result<std::shared_ptr<OpenHapticsLibrary>> OpenHapticsLibrary::load(const std::string& file) {
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* why = dlerror();
    return std::unexpected(DeviceError{
        Errc::kLibraryMissing,
        "openhaptics: " + file + " cannot be loaded: " + (why == nullptr ? "no reason was given" : why) +
            ". Install the vendor's OpenHaptics and the driver of your device (they belong to 3D Systems and "
            "need a licence); versions before 3.4 need libncurses5 as well. Not in the loader's path? "
            "openhaptics:NAME,library=/path/to/libHD.so"});
  }
  std::shared_ptr<OpenHapticsLibrary> library{new OpenHapticsLibrary};
  openhaptics::Api& api = library->api_;
  std::string missing;
  const auto find = [&](auto& function, const char* name) {
    void* symbol = dlsym(handle, name);
    if (symbol == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(name);
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(symbol);
  };
  find(api.init_device, "hdInitDevice");
  find(api.disable_device, "hdDisableDevice");
  find(api.make_current, "hdMakeCurrentDevice");
  find(api.begin_frame, "hdBeginFrame");
  find(api.end_frame, "hdEndFrame");
  find(api.get_error, "hdGetError");
  find(api.error_text, "hdGetErrorString");
  find(api.enable, "hdEnable");
  find(api.get_int, "hdGetIntegerv");
  find(api.get_double, "hdGetDoublev");
  find(api.set_double, "hdSetDoublev");
  find(api.get_string, "hdGetString");
  find(api.start_scheduler, "hdStartScheduler");
  find(api.stop_scheduler, "hdStopScheduler");
  find(api.set_scheduler_rate, "hdSetSchedulerRate");
  find(api.schedule, "hdScheduleAsynchronous");
  find(api.unschedule, "hdUnschedule");
  find(api.check_calibration, "hdCheckCalibration");
  find(api.update_calibration, "hdUpdateCalibration");
  if (!missing.empty())
    return std::unexpected(DeviceError{
        Errc::kUnsupported, "openhaptics: " + file + " is too old, or another library of that name: it lacks " +
                                missing + ". Version 3.0 and later have them"});
  return library;
}

}  // namespace tandem::hal
