// Restarts itself with umockdev's library preloaded: sysfs, /dev and udev's netlink then belong to the test bed.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <string>

#include "tests/hal/emulation/testbed.h"

namespace {

constexpr const char* kPreload = "libumockdev-preload.so.0";

/// Returns the sanitizer's library, which must be loaded first.
std::string sanitizers() {
  std::string names;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* out) {
        const std::string name = info->dlpi_name;
        for (const char* one : {"/libasan.so", "/libtsan.so", "/libubsan.so"}) {
          if (name.find(one) != std::string::npos) *static_cast<std::string*>(out) += name + ":";
        }
        return 0;
      },
      &names);
  return names;
}

}  // namespace

/// Suppressions: umockdev, GLib and libudev are built without the sanitizer, which cannot see their synchronisation.
/// One example: libudev keeps one random seed for all its contexts. libusb, hidapi and all Tandem code are checked.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "race:libumockdev\nrace:libglib-2.0\nrace:libgobject-2.0\nrace:libgio-2.0\nrace:libudev.so\n"
         "called_from_lib:libumockdev.so\ndeadlock:libglib-2.0\ndeadlock:libgobject-2.0\nmutex:libglib-2.0\n";
}

int main(int argc, char** argv) {
  // A pseudo terminal that hangs up may be the controlling one of this process.
  std::signal(SIGHUP, SIG_IGN);
  const bool listing =
      std::any_of(argv, argv + argc, [](const char* a) { return std::string(a) == "--gtest_list_tests"; });
  const bool loaded = dlopen(kPreload, RTLD_NOW | RTLD_NOLOAD) != nullptr;
  if (!listing && !loaded) {
    std::string libraries = sanitizers() + kPreload;
    if (const char* others = std::getenv("LD_PRELOAD"); others != nullptr && libraries != others)
      libraries += std::string(":") + others;
    if (dlopen("libumockdev.so.0", RTLD_NOW) != nullptr && std::getenv("TANDEM_EMULATION") == nullptr) {
      setenv("LD_PRELOAD", libraries.c_str(), 1);
      setenv("TANDEM_EMULATION", "once", 1);  // never twice, whatever the loader does with it
      execv("/proc/self/exe", argv);
    }
    // Same text as gtest's, so that ctest counts the test as skipped.
    std::printf(
        "main.cpp: Skipped\numockdev is not installed or does not load; it emulates devices for libusb, hidapi and "
        "libudev\n\n[  SKIPPED ]\n");
    return 0;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
