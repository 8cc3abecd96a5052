#include "tests/tidy/layer_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

namespace tandem::tidy {
namespace {

const std::filesystem::path kRoot{TANDEM_SOURCE_DIR};

struct Fake {
  const char* path;
  const char* text;
};

std::vector<Finding> check(const Fake& fake) { return check_layers(make_source(fake.path, fake.text)); }

TEST(Layers, MatchTheTableInAllSources) {
  std::vector<Finding> findings;
  const std::vector<SourceFile> files = read_repository(kRoot);
  ASSERT_GT(files.size(), 20u) << "sources not found in " << kRoot;
  for (const SourceFile& file : files) {
    for (Finding& f : check_layers(file)) findings.push_back(std::move(f));
  }
  for (Finding& f : check_generated(files)) findings.push_back(std::move(f));
  for (const Ban& ban : bans()) {
    for (const std::string_view path : ban.allowed)
      std::cout << "may use " << ban.words.front() << ": " << path << "\n";
  }
  EXPECT_TRUE(findings.empty()) << findings.size() << " to mend:\n" << to_string(findings);
}

TEST(Layers, TopLevelIsThePrescribedOne) {
  const std::vector<Finding> findings = check_top_level(kRoot);
  EXPECT_TRUE(findings.empty()) << to_string(findings);
}

TEST(Layers, FilesThatMayBreakARuleExistAndStillNeedTo) {
  const std::vector<SourceFile> files = read_repository(kRoot);
  for (const Ban& ban : bans()) {
    for (const std::string_view path : ban.allowed) {
      const auto file = std::ranges::find(files, path, &SourceFile::path);
      ASSERT_NE(file, files.end()) << path;
      EXPECT_TRUE(std::ranges::any_of(ban.words, [&](auto word) { return !lines_with(file->code, word).empty(); }))
          << path;
    }
  }
}

TEST(LayerRules, ReportEachViolationOnce) {
  const std::vector<Fake> fakes{
      {"common/base/a.h", "#include <Eigen/Core>\n"},
      {"common/base/a.h", "#include <asio.hpp>\n"},
      {"common/base/a.h", "#include <spdlog/spdlog.h>\n"},
      {"common/base/a.h", "#include \"common/control/esc_hub.h\"\n"},
      {"common/base/a.h", "auto t = std::chrono::steady_clock::now();\n"},
      {"common/base/a.cpp", "int f() { return clock_gettime(0, nullptr); }\n"},
      {"common/control/a.h", "#include \"common/transport/aead.h\"\n"},
      {"common/control/a.h", "#include \"proto/wire/wire_messages.h\"\n"},
      {"common/control/a.cpp", "#include <google/protobuf/message.h>\n"},
      {"common/transport/a.cpp", "#include <sys/socket.h>\n"},
      {"common/transport/a.cpp", "#include <Eigen/Core>\n"},
      {"common/transport/a.cpp", "#include \"server/session/session.h\"\n"},
      {"server/a.cpp", "#include \"proto/schema/scene.pb.h\"\n"},
      {"tests/server/a.cpp", "#include \"proto/schema/scene.pb.h\"\n"},
      {"hal/sim/a.cpp", "#include \"server/session/session.h\"\n"},
      {"hal/sim/a.cpp", "#include <thread>\n"},
      {"hal/touch/a.cpp", "#include <libusb-1.0/libusb.h>\n"},
      {"netsim/models/loss.cpp", "#include \"server/session/session.h\"\n"},
      {"netsim/models/loss.cpp", "#include <Eigen/Core>\n"},
      {"netsim/system/simulation.cpp", "#include \"server/app/run.h\"\n"},
      {"common/setup/a.cpp", "#include \"proto/wire/wire_messages.h\"\n"},
      {"common/auth/a.cpp", "#include \"common/auth/io/state_directory.h\"\n"},
      {"common/auth/a.cpp", "#include <asio/ip/tcp.hpp>\n"},
      {"common/auth/a.cpp", "#include <sys/random.h>\n"},
      {"common/auth/io/a.cpp", "#include \"server/session/session.h\"\n"},
      {"netsim/system/simulation.cpp", "#include <asio/ip/udp.hpp>\n"},
      {"netsim/system/simulation.cpp", "#include <netinet/in.h>\n"},
      {"server/session/session.cpp", "#include \"hal/sim/touch.h\"\n"},
      {"server/session/session.cpp", "#include <mutex>\n"},
      {"server/session/session.cpp", "#include <iostream>\n"},
      {"server/session/session.cpp", "#include \"client/seat/seat.h\"\n"},
      {"server/session/session.cpp", "#include <spdlog/spdlog.h>\n"},
      {"server/app/a.cpp", "#include \"client/app/join.h\"\n"},
      {"server/app/a.cpp", "#include <spdlog/spdlog.h>\n"},
      {"netsim/app/a.cpp", "#include <CLI/CLI.hpp>\n"},
      {"client/seat/seat.cpp", "#include \"seat.h\"\n"},
      {"client/seat/seat.cpp", "#include \"../common/base/time.h\"\n"},
      {"client/seat/seat.cpp", "#include <common/base/time.h>\n"},
      {"client/seat/seat.cpp", "#include \"tests/support/fake.h\"\n"},
      {"client/seat/seat.cpp", "auto* r = reinterpret_cast<const Report*>(bytes);\n"},
      {"client/app/a.cpp", "#include <random>\n"},
      {"client/app/a.cpp", "int f() { return std::rand(); }\n"},
      {"client/a.proto",
       "// TO"
       "DO: mend\n"},
      {"tests/link/a.cpp", "void f() { std::this_thread::sleep_for(t); }\n"},
      {"tests/link/a.cpp", "TEST(Link, DISABLED_Works) {}\n"},
      {"tests/link/a.cpp", "void f() { GTEST_SKIP(); }\n"},
      {"tests/link/a.cpp", "void f() {\n  puts(\"[ NOT RUN ] f: no g\");\n  return;\n}\n"},
      {"elsewhere/a.cpp", "#include <vector>\n"},
  };
  for (const Fake& fake : fakes) {
    const auto findings = check(fake);
    EXPECT_EQ(findings.size(), 1u) << fake.path << ": " << fake.text << to_string(findings);
  }
  EXPECT_EQ(check({"hal/a.cpp", std::string(kLinesMax + 1, '\n').c_str()}).size(), 1u);
}

TEST(LayerRules, AcceptPermittedSources) {
  const std::vector<Fake> fakes{
      {"common/base/a.h", "// no steady_clock, no <mutex> here\n/* reinterpret_cast */\n#include <cstdint>\n"},
      {"common/base/a.h",
       "const char* s = \"steady_clock \\\" sleep_for\";\nchar c = '\"'; int n = 1'000'000; // \"\n"},
      {"common/base/a.h", "const char* s = R\"x(#include <mutex>\n#include <thread>\nsteady_clock )\" )x\";\n"},
      {"common/base/a.h", "int steady_clocks, my_steady_clock;\n"},
      {"tests/link/a.cpp", "void f() { if (no_g) GTEST_SKIP() << \"no g\"; }\n"},
      {"common/control/a.cpp", "#include <Eigen/Core>\n#include \"common/base/time.h\"\n"},
      {"common/transport/a.cpp", "#include <openssl/evp.h>\n#include \"proto/wire/wire_messages.h\"\n"},
      {"proto/a.cpp", "#include <google/protobuf/text_format.h>\n#include \"proto/schema/scene.pb.h\"\n"},
      {"proto/convert.h", "#include \"proto/schema/scene.pb.h\"\n"},
      {"hal/io/live.cpp", "#include <thread>\n#include <sys/timerfd.h>\n#include \"hal/core/device.h\"\n"},
      {"server/app/a.cpp", "#include <asio.hpp>\n#include <nlohmann/json.hpp>\n#include \"hal/sim/touch.h\"\n"},
      {"client/app/a.cpp", "#include \"common/app/terminal.h\"\nauto t = std::chrono::steady_clock::now();\n"},
      {"netsim/system/simulation.cpp",
       "#include \"server/session/session.h\"\n#include \"client/seat/seat.h\"\n#include \"hal/sim/touch.h\"\n"},
      {"tests/io/a.cpp", "#include <thread>\nvoid f() { std::this_thread::sleep_for(t); }\n"},
      {"tests/link/a.cpp", "#include \"server/app/run.h\"\n#include <sys/socket.h>\n"},
      {"tests/proto/a.cpp", "#include \"proto/schema/scene.pb.h\"\n"},
  };
  for (const Fake& fake : fakes) {
    const auto findings = check(fake);
    EXPECT_TRUE(findings.empty()) << fake.path << ": " << fake.text << to_string(findings);
  }
}

TEST(LayerRules, HeadersThatShowGeneratedCodeStayInProto) {
  const std::vector<SourceFile> files{
      make_source("proto/reader.h", "#include \"proto/convert.h\"\n"),
      make_source("proto/convert.h", "#include \"proto/schema/scene.pb.h\"\n"),
      make_source("proto/message.h", "#include <google/protobuf/message.h>\n"),
      make_source("proto/plain.h", "#include <vector>\n"),
      make_source("proto/reader.cpp", "#include \"proto/reader.h\"\n"),
      make_source("tests/proto/a.cpp", "#include \"proto/reader.h\"\n"),
      make_source("server/a.cpp", "#include \"proto/plain.h\"\n\n#include \"proto/reader.h\"\n"),
      make_source("tests/server/a.cpp", "#include \"proto/message.h\"\n"),
  };
  const auto findings = check_generated(files);
  ASSERT_EQ(findings.size(), 2u) << to_string(findings);
  EXPECT_EQ(findings[0].path, "server/a.cpp");
  EXPECT_EQ(findings[0].line, 3u);
  EXPECT_EQ(findings[1].path, "tests/server/a.cpp");
}

TEST(LayerRules, NameTheLineOfTheViolation) {
  const auto findings = check({"common/base/a.h", "#include <array>\n\n// x\n#include <Eigen/Core>\n"});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].line, 4u);
  EXPECT_EQ(lines_with("a\nmutex\nmutexes mutex mutex\n", "mutex"), (std::vector<std::size_t>{2, 3}));
}

TEST(SourceText, BlankingKeepsEveryOffset) {
  for (const SourceFile& file : read_repository(kRoot)) {
    ASSERT_EQ(file.text.size(), file.code.size()) << file.path;
    for (std::size_t i = 0; i < file.text.size(); ++i) {
      ASSERT_EQ(file.text[i] == '\n', file.code[i] == '\n') << file.path << " at " << i;
    }
  }
  EXPECT_EQ(blank_comments_and_literals("a /* b \" */ \"c\" 'd' 1'0 // e"), "a           \" \" ' ' 1'0     ");
}

}  // namespace
}  // namespace tandem::tidy
