// Builds tests/examples with an installation of this build and runs each program. The head comment of an example says
// what the program prints; this test compares the program's output with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/install/installed_package.h"

namespace tandem::test {
namespace {

const fs::path kSource = fs::path{TANDEM_SOURCE_DIR} / "tests/examples";
const fs::path kPlace = package_folder("examples");
constexpr std::size_t kLinesMax = 60;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Output that the head comment of an example announces.
struct Announced {
  std::vector<std::string> lines;
  bool complete = true;  ///< false: among other lines
};

Announced announced(const std::vector<std::string>& source) {
  Announced out;
  bool prints = false;
  for (const std::string& line : source) {
    if (!line.starts_with("//")) break;
    if (prints) out.lines.push_back(line.substr(std::min<std::size_t>(5, line.size())));
    prints = prints || line.starts_with("// Prints");
    if (line == "// Prints, among other lines:") out.complete = false;
  }
  return out;
}

/// Checks the output of one example against its head comment.
void check_output(const std::string& example, const std::string& output) {
  const Announced wanted = announced(lines_of(content_of(kSource / (example + ".cpp"))));
  ASSERT_FALSE(wanted.lines.empty()) << example << ": the head comment does not say what the program prints";
  const std::vector<std::string> printed = lines_of(output);
  if (wanted.complete) {
    EXPECT_EQ(printed, wanted.lines) << example;
    return;
  }
  auto from = printed.begin();
  for (const std::string& line : wanted.lines) {
    from = std::find_if(from, printed.end(), [&](const std::string& p) { return p.starts_with(line); });
    ASSERT_NE(from, printed.end()) << example << " does not print '" << line << "'\n" << output;
  }
}

TEST(Examples, PrintWhatTheirHeadCommentsSay) {
  if (std::string_view{TANDEM_SANITIZE} != "") GTEST_SKIP() << "a build with sanitizers is not for installing";
  const fs::path prefix = installed_and_moved(kPlace), build = kPlace / "build";
  ASSERT_FALSE(HasFailure());
  ASSERT_NO_FATAL_FAILURE(build_project(kSource, build, prefix));
  std::size_t examples = 0;
  for (const auto& entry : fs::directory_iterator(kSource)) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string example = entry.path().stem().string();
    SCOPED_TRACE(example);
    ++examples;
    EXPECT_LE(lines_of(content_of(entry.path())).size(), kLinesMax);
    if (example == "03_client_seat") continue;
    Process run({(build / example).string()});
    EXPECT_EQ(run.wait(), 0) << run.out() << run.err();
    check_output(example, run.out());
  }
  EXPECT_EQ(examples, 5U);

  // The client needs a server. Its report then shows that the device of the example moved the tool.
  const fs::path report = kPlace / "report.json";
  Process server(
      {(prefix / "bin/tandem-server").string(), "run", "one_axis", "--duration", "2", "--json", report.string()});
  ASSERT_TRUE(server.wait_for("Ctrl-C ends")) << server.err();
  Process client({(build / "03_client_seat").string(), server.after("listening on ")});
  EXPECT_EQ(client.wait(), 0) << client.out() << client.err();
  check_output("03_client_seat", client.out());
  EXPECT_EQ(server.wait(), 0) << server.out() << server.err();
  EXPECT_NE(content_of(report).find("\"verdict\": \"pass\""), std::string::npos) << content_of(report);

  Process alone({(build / "03_client_seat").string(), "127.0.0.1:1"});
  EXPECT_EQ(alone.wait(), 1) << alone.out();
  EXPECT_NE(alone.err().find("no server at 127.0.0.1:1"), std::string::npos) << alone.err();
}

}  // namespace
}  // namespace tandem::test
