#include "tests/tidy/documents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace tandem::tidy {
namespace {

const std::filesystem::path kRoot{TANDEM_SOURCE_DIR};

/// Returns the document with this path below the root; if it is missing or empty, the test fails.
const SourceFile* find_document(const std::vector<SourceFile>& files, const std::string& path) {
  const auto found = std::ranges::find(files, path, &SourceFile::path);
  if (found == files.end()) ADD_FAILURE() << path << " is missing";
  if (found == files.end() || !found->text.empty()) return found == files.end() ? nullptr : &*found;
  ADD_FAILURE() << path << " is empty";
  return nullptr;
}

Known small_project() {
  const std::vector<SourceFile> files{
      make_source("tests/common/transport/secure_channel_test.cpp",
                  "TEST(Link, Works) {}\nTEST_P(Gate,\n       Ramps) {}\n// TEST(Not, This)\n"),
      make_source("server/CMakeLists.txt", "tandem_program(tandem-server SOURCES app/main.cpp)\n"),
      make_source("server/app/main.cpp", "app.add_option(\"--listen\", x);\n"),
      make_source("demo", "--quick\n"),
  };
  return known_things(files);
}

/// Checks that the manual exists, shows commands, and names only commands, files and tests that exist.
void check_manual(const std::string& path) {
  const auto files = read_repository(kRoot);
  const SourceFile* const document = find_document(files, path);
  ASSERT_NE(document, nullptr);
  const Known known = known_things(files);
  EXPECT_FALSE(lines_with(document->text, "```").empty()) << path << " shows no command";
  EXPECT_TRUE(check_commands(*document, known).empty()) << to_string(check_commands(*document, known));
  EXPECT_TRUE(check_references(*document, known, kRoot).empty())
      << to_string(check_references(*document, known, kRoot));
}

TEST(Architecture, EveryInvariantNamesItsCodeAndItsTest) {
  const auto files = read_repository(kRoot);
  const SourceFile* document = find_document(files, "ARCHITECTURE.md");
  ASSERT_NE(document, nullptr);
  const auto findings = check_invariants(*document, known_things(files), kRoot);
  EXPECT_TRUE(findings.empty()) << to_string(findings);
}

TEST(Architecture, EveryTestAndFileItNamesExists) {
  const auto files = read_repository(kRoot);
  const SourceFile* document = find_document(files, "ARCHITECTURE.md");
  ASSERT_NE(document, nullptr);
  const auto findings = check_references(*document, known_things(files), kRoot);
  EXPECT_TRUE(findings.empty()) << to_string(findings);
}

TEST(Readme, EveryCommandFileAndTestItNamesExists) { check_manual("README.md"); }

TEST(Security, EveryClaimNamesATestThatExists) {
  const auto files = read_repository(kRoot);
  const SourceFile* document = find_document(files, "SECURITY.md");
  ASSERT_NE(document, nullptr);
  const Known known = known_things(files);
  EXPECT_TRUE(check_rows(*document, known).empty()) << to_string(check_rows(*document, known));
  EXPECT_TRUE(check_references(*document, known, kRoot).empty())
      << to_string(check_references(*document, known, kRoot));
}

TEST(ExtremesTable, NamesATestInEveryRowAndEveryTestOfExtremes) {
  const auto files = read_repository(kRoot);
  const SourceFile* document = find_document(files, "tests/EXTREMES.md");
  ASSERT_NE(document, nullptr);
  const Known known = known_things(files);
  const auto findings = check_references(*document, known, kRoot);
  EXPECT_TRUE(findings.empty()) << to_string(findings);
  EXPECT_TRUE(check_rows(*document, known).empty()) << to_string(check_rows(*document, known));
  for (const std::string& test : known.tests) {
    if (!test.starts_with("Extremes") || test.starts_with("ExtremesTable")) continue;
    EXPECT_NE(document->text.find("`" + test + "`"), std::string::npos) << test << " has no row";
  }
}

TEST(NetsimManual, EveryCommandFileAndTestItNamesExists) { check_manual("netsim/README.md"); }

TEST(ClientManual, EveryCommandFileAndTestItNamesExists) { check_manual("client/README.md"); }

TEST(ServerManual, EveryCommandFileAndTestItNamesExists) { check_manual("server/README.md"); }

TEST(HalManual, EveryCommandFileAndTestItNamesExists) { check_manual("hal/README.md"); }

TEST(Contributing, EveryCommandFileAndTestItNamesExists) { check_manual("CONTRIBUTING.md"); }

TEST(Examples, ReadmeNamesCommandsFilesAndTestsThatExist) { check_manual("tests/examples/README.md"); }

TEST(ValidationMatrix, EveryRowNamesTestsThatExist) {
  const auto files = read_repository(kRoot);
  const SourceFile* document = find_document(files, "tests/netsim/validation/MATRIX.md");
  ASSERT_NE(document, nullptr);
  const Known known = known_things(files);
  EXPECT_GE(lines_with(document->text, "exact").size(), 10u) << "the table is not there";
  EXPECT_TRUE(check_rows(*document, known).empty()) << to_string(check_rows(*document, known));
  EXPECT_TRUE(check_references(*document, known, kRoot).empty())
      << to_string(check_references(*document, known, kRoot));
}

TEST(FailureTable, EveryRowNamesTestsThatExist) {
  const auto files = read_repository(kRoot);
  const SourceFile* document = find_document(files, "tests/FAILURES.md");
  ASSERT_NE(document, nullptr);
  const Known known = known_things(files);
  EXPECT_GE(lines_with(document->text, "| `").size(), 10u) << "the tables are not there";
  EXPECT_TRUE(check_rows(*document, known).empty()) << to_string(check_rows(*document, known));
  EXPECT_TRUE(check_references(*document, known, kRoot).empty())
      << to_string(check_references(*document, known, kRoot));
}

TEST(Documents, KnowsTestsAndPrograms) {
  const Known known = small_project();
  EXPECT_EQ(known.tests, (std::set<std::string, std::less<>>{"Link.Works", "Gate.Ramps"}));
  EXPECT_EQ(known.programs, (std::set<std::string, std::less<>>{"tandem-server", "./demo"}));
}

TEST(Documents, InvariantsWithoutTestCodeOrOrderAreReported) {
  std::string good = "# SessionRegistry\n1. not an invariant\n## Invariants\n";
  for (int i = 1; i <= 9; ++i) good += std::to_string(i) + ". holds: `tests/tidy/documents.h`,\n   test `Link.Works`\n";
  const std::string row = "| 10 | holds | `tests/tidy/documents.h` | `Gate.Ramps` |\n";
  const auto trouble = [&](const std::string& text) {
    return check_invariants(make_source("ARCHITECTURE.md", text), small_project(), kRoot).size();
  };
  EXPECT_EQ(trouble(good + row + "## More\n5. something else\n"), 0u);
  EXPECT_EQ(trouble(good), 1u) << "one too few";
  EXPECT_EQ(trouble(good + "| 11 | holds | `tests/tidy/documents.h` | `Gate.Ramps` |\n"), 1u) << "a gap";
  EXPECT_EQ(trouble(good + "10. holds: `tests/tidy/documents.h`, `Gate.Falls`\n"), 1u) << "no such test";
  EXPECT_EQ(trouble(good + "10. holds: `tests/tidy/nothing.h`, `Gate.Ramps`\n"), 1u) << "no such file";
}

TEST(Documents, ReportNamesThatDoNotExist) {
  const auto trouble = [](const std::string& text) {
    return check_references(make_source("README.md", text), small_project(), kRoot).size();
  };
  EXPECT_EQ(trouble("`Link.Works` `README.md` `tests/tidy` `server/<name>` `a.b`\n```\n`Not.Here`\n```\n"), 0u);
  EXPECT_EQ(trouble("text `Link.Breaks`\n`tests/tidy/nothing.h`\n"), 2u);
}

TEST(Documents, RowsWithoutATestAreReported) {
  const auto trouble = [](const std::string& rows) {
    return check_rows(make_source("M.md", "| a | b |\n|---|---|\n" + rows), small_project()).size();
  };
  EXPECT_EQ(trouble("| x | `Link.Works`, more |\n| y | `Gate.Ramps` |\ntext\n| no table |\n"), 0u);
  EXPECT_EQ(trouble("| x | `Link.Breaks` |\n| y | nothing |\n| z | `Link.Works` |\n"), 2u);
}

TEST(Documents, CommandsThatDoNotExistAreReported) {
  const auto trouble = [](const std::string& lines) {
    return check_commands(make_source("README.md", "text\n```sh\n" + lines + "```\n./none\n"), small_project()).size();
  };
  EXPECT_EQ(trouble("./demo --quick\n$ A=1 tandem-server run --listen=x --help  # --not here\n"), 0u);
  EXPECT_EQ(trouble("build/release/bin/tandem-server run \\\n  --listen x\ngit clone --depth 1 x\n"), 0u);
  EXPECT_EQ(trouble("tandem-servant run\n"), 1u);
  EXPECT_EQ(trouble("./none\n"), 1u);
  EXPECT_EQ(trouble("tandem-server run \\\n  --lissen x\n"), 1u);
}

}  // namespace
}  // namespace tandem::tidy
