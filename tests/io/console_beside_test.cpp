// tandem-console beside the runs of the demo: shell scripts stand for it, so that every ending can be tried.
#include "netsim/demo/app/console_beside.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/io/programs.h"

namespace tandem::netsim::demo {
namespace {

using namespace std::chrono_literals;

/// Folders of a demo in which tandem-console is this shell script.
struct Demo {
  explicit Demo(const std::string& script) {
    if (script.empty()) return;
    const auto path = places.programs / "tandem-console";
    std::ofstream(path) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
  test::Folder folder;
  DemoPaths places{folder.file(""), folder.file("")};
};

std::string line_of(ConsoleBeside& console) {
  for (int n = 0; n < 1000; ++n, std::this_thread::sleep_for(10ms))
    if (const auto line = console.poll()) return *line;
  return "no line within 10 s";
}

TEST(ConsoleBeside, GivesItsUrlOnce) {
  const Demo demo("echo \"open within 10 minutes, once: http://127.0.0.1:1/?token=$2$4\"; exec sleep 60\n");
  ConsoleBeside console(demo.places);
  EXPECT_FALSE(console.poll()) << "no server listens yet";
  console.on_server("127.0.0.1:7");
  EXPECT_EQ(line_of(console), "Watch the runs in a browser, once: http://127.0.0.1:1/?token=127.0.0.1:7operator");
  console.on_server("127.0.0.1:8");
  EXPECT_FALSE(console.poll()) << "the servers of later runs listen at the same address";
}

TEST(ConsoleBeside, EndsItsProgramWithTheDemo) {
  const Demo demo("echo $$ > \"$0.pid\"; echo http://x/; exec sleep 60\n");
  pid_t pid = 0;
  {
    ConsoleBeside console(demo.places);
    console.on_server("127.0.0.1:7");
    ASSERT_NE(line_of(console).find("http://x/"), std::string::npos);
    std::ifstream(demo.places.programs / "tandem-console.pid") >> pid;
    ASSERT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_NE(::kill(pid, 0), 0);
}

TEST(ConsoleBeside, ReportsWhyThereIsNone) {
  const Demo missing(""), ends("exit 3\n");
  ConsoleBeside absent(missing.places), ended(ends.places);
  for (ConsoleBeside* console : {&absent, &ended}) console->on_server("127.0.0.1:7");
  EXPECT_NE(line_of(absent).find("cannot be started"), std::string::npos);
  EXPECT_NE(line_of(ended).find("tandem-console ended"), std::string::npos);
}

TEST(ConsoleUrl, NeedsACompleteLine) {
  EXPECT_EQ(console_url("open: http://127.0.0.1:1/?to"), "");
  EXPECT_EQ(console_url("open: https://h/?token=1\n"), "https://h/?token=1");
  EXPECT_EQ(console_url(""), "");
}

}  // namespace
}  // namespace tandem::netsim::demo
