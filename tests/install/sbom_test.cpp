// Checks that the SBOMs of the packages conform to SPDX 2.3 (https://spdx.github.io/spdx-spec/v2.3) and match the
// programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "tests/install/elf_file.h"
#include "tests/install/shell.h"

namespace tandem::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Sbom : testing::TestWithParam<const char*> {
  void SetUp() override {
    if (std::string_view{TANDEM_SANITIZE} != "") GTEST_SKIP() << "a build with sanitizers is not for installing";
    std::ifstream file(fs::path{TANDEM_BINARY_DIR} / "server/package" / (std::string{GetParam()} + ".spdx.json"));
    ASSERT_TRUE(file);
    document = Json::parse(file, nullptr, false);
    ASSERT_FALSE(document.is_discarded());
  }
  /// Returns the entry of a package by its name; null if there is none.
  [[nodiscard]] Json package(const std::string& name) const {
    for (const Json& p : document["packages"])
      if (p["name"] == name) return p;
    return {};
  }
  Json document;
};

/// Returns whether `expression` is a licence expression of known identifiers. These are the identifiers of the SPDX
/// licence list that Debian's copyright files of the linked libraries lead to.
bool is_licence(const std::string& expression) {
  static const std::set<std::string> kKnown{
      "Apache-2.0", "BSD-3-Clause",     "BSL-1.0", "GPL-2.0-only", "GPL-3.0-only",      "GPL-3.0-or-later",
      "Zlib",       "blessing",         "Qhull",   "ISC",          "LGPL-2.1-or-later", "MIT",
      "MPL-2.0",    "GCC-exception-3.1"};
  std::istringstream words(expression);
  bool operand = true;
  for (std::string word; words >> word; operand = !operand)
    if (operand ? !kKnown.contains(word) : word != "OR" && word != "AND" && word != "WITH") return false;
  return !operand;
}

TEST_P(Sbom, HoldsEveryFieldThatSpdxRequires) {
  EXPECT_EQ(document["spdxVersion"], "SPDX-2.3");
  EXPECT_EQ(document["dataLicense"], "CC0-1.0");
  EXPECT_EQ(document["SPDXID"], "SPDXRef-DOCUMENT");
  EXPECT_NE(document["name"].get<std::string>(), "");
  const std::string space = document["documentNamespace"];
  EXPECT_TRUE(space.starts_with("https://") && space.find('#') == std::string::npos)
      << space << ": a unique absolute URI without '#'";
  EXPECT_TRUE(std::regex_match(document["creationInfo"]["created"].get<std::string>(),
                               std::regex{R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)"}));
  ASSERT_FALSE(document["creationInfo"]["creators"].empty());
  for (const Json& who : document["creationInfo"]["creators"])
    EXPECT_TRUE(std::regex_search(who.get<std::string>(), std::regex{"^(Person|Organization|Tool): ."}));

  std::set<std::string> ids{"SPDXRef-DOCUMENT"};
  for (const Json& p : document["packages"]) {
    SCOPED_TRACE(p.dump());
    const std::string id = p["SPDXID"];
    EXPECT_TRUE(std::regex_match(id, std::regex{"SPDXRef-[A-Za-z0-9.-]+"}));
    EXPECT_TRUE(ids.insert(id).second) << "an identifier twice";
    for (const char* field :
         {"name", "downloadLocation", "versionInfo", "licenseConcluded", "licenseDeclared", "copyrightText"})
      EXPECT_NE(p.value(field, ""), "") << field;
    EXPECT_EQ(p["filesAnalyzed"], false) << "else the package needs a verification code";
    EXPECT_TRUE(is_licence(p["licenseConcluded"])) << "no SPDX licence expression";
    EXPECT_TRUE(is_licence(p["licenseDeclared"])) << "no SPDX licence expression";
    for (const Json& reference : p.value("externalRefs", Json::array())) {
      EXPECT_EQ(reference["referenceCategory"], "PACKAGE-MANAGER");
      EXPECT_EQ(reference["referenceType"], "purl");
      EXPECT_TRUE(reference["referenceLocator"].get<std::string>().starts_with("pkg:deb/debian/"));
    }
  }
  std::set<std::string> described;
  for (const Json& r : document["relationships"]) {
    EXPECT_TRUE(ids.contains(r["spdxElementId"])) << r;
    EXPECT_TRUE(ids.contains(r["relatedSpdxElement"])) << r;
    const std::string type = r["relationshipType"];
    EXPECT_TRUE(type == "DESCRIBES" || type == "DYNAMIC_LINK" || type == "STATIC_LINK") << type;
    if (type == "DESCRIBES") described.insert(r["relatedSpdxElement"]);
  }
  EXPECT_EQ(described, std::set<std::string>{"SPDXRef-Package-" + std::string{GetParam()}});
  EXPECT_EQ(document["relationships"].size(), document["packages"].size()) << "every package is related to once";
}

TEST_P(Sbom, NamesThePackageOfEveryLibraryTheProgramNeeds) {
  const ElfFile program{fs::path{TANDEM_BINARY_DIR} / "bin" / GetParam()};
  std::set<std::string> dynamic;
  for (const Json& r : document["relationships"])
    if (r["relationshipType"] == "DYNAMIC_LINK") dynamic.insert(r["relatedSpdxElement"].get<std::string>().substr(16));
  std::set<std::string> owners;
  ASSERT_FALSE(program.libraries().empty());
  // Output of the loader: "libc.so.6 => /lib/x86_64-linux-gnu/libc.so.6 (0x7f...)". Packages list some files under /lib
  // and some under /usr/lib.
  std::string names, installed;
  std::istringstream loaded(shell("ldd " + quoted(fs::path{TANDEM_BINARY_DIR} / "bin" / GetParam())).text);
  for (std::string line; std::getline(loaded, line);) {
    std::string name, arrow, path;
    if (std::istringstream words{line}; !(words >> name >> arrow >> path) || arrow != "=>") continue;
    // Exact names: with patterns dpkg-query takes ten times as long.
    const std::string below = path.starts_with("/usr/") ? path.substr(4) : path;
    for (const char* usr : {"", "/usr"}) names += " " + quoted(fs::path{usr + below});
  }
  std::map<std::string, std::string> owner_of, version_of;  // "libc6:amd64: /lib/x86_64-linux-gnu/libc.so.6"
  std::istringstream owned(shell("dpkg-query -S" + names + " 2>/dev/null").text);
  for (std::string line; std::getline(owned, line);) {
    if (line.starts_with("dpkg-query:")) continue;  // of a path that no package has
    owner_of[line.substr(line.rfind('/') + 1)] = line.substr(0, line.find(':'));
    installed += " " + line.substr(0, line.find(':'));
  }
  std::istringstream versions(shell("dpkg-query -W -f '${Package} ${Version}\\n'" + installed).text);
  for (std::string name, version; versions >> name >> version;) version_of[name] = version;
  for (const std::string& library : program.libraries()) {
    SCOPED_TRACE(library);
    const std::string owner = owner_of[library];
    const Json p = package(owner);
    ASSERT_FALSE(p.is_null()) << owner << " is not in the SBOM";
    EXPECT_EQ(p["versionInfo"], version_of[owner]);
    EXPECT_NE((", " + p["comment"].get<std::string>() + ",").find(", " + library + ","), std::string::npos)
        << p["comment"];
    owners.insert(p["SPDXID"].get<std::string>().substr(16));
  }
  EXPECT_EQ(dynamic, owners) << "and no other";
}

/// Checks that the SBOM names the package of each header of another project that the programs' sources include.
TEST_P(Sbom, NamesThePackageOfEveryHeaderThatIsCompiledIn) {
  const std::map<std::string, std::string> kHeadersOnly{{"Eigen", "libeigen3-dev"}, {"unsupported", "libeigen3-dev"},
                                                        {"asio", "libasio-dev"},    {"asio.hpp", "libasio-dev"},
                                                        {"CLI", "libcli11-dev"},    {"nlohmann", "nlohmann-json3-dev"}};
  const std::string_view program{GetParam()};
  const bool with_boost = program != "tandem-client";
  bool boost = false;
  const std::set<std::string> kOfLibrariesAbove{"spdlog",     "fmt",       "google",     "openssl",  "prometheus",
                                                "libusb-1.0", "hidapi",    "libqhull_r", "sodium.h", "intel-ipsec-mb.h",
                                                "ipsec-mb.h", "libudev.h", "sys",        "linux",    "net",
                                                "netinet",    "arpa",      "bits",       "grpc",     "grpcpp"};
  const std::regex include{R"(^\s*#\s*include <([^/>]+)(/?)[^>]*>)"};
  std::set<std::string> met;
  for (const char* folder : {"client", "common", "hal", "netsim", "proto", "server"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path{TANDEM_SOURCE_DIR} / folder)) {
      if (entry.path().string().find("/testing/") != std::string::npos) continue;  // code for tests, part of no program
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream file(entry.path());
      std::smatch found;
      for (std::string line; std::getline(file, line);) {
        if (!std::regex_search(line, found, include)) continue;
        const std::string first = found[1];
        if (const auto known = kHeadersOnly.find(first); known != kHeadersOnly.end()) {
          met.insert(known->second);
        } else if (first == "boost") {  // the package's name has the version
          boost = true;
          const std::string path = entry.path();
          EXPECT_TRUE(path.find("/server/console/app/") != path.npos || path.find("/netsim/score/") != path.npos)
              << path << ": this part of the program has no Boost in the list of its package";
        } else if (found[2].length() > 0) {
          EXPECT_TRUE(kOfLibrariesAbove.contains(first))
              << entry.path() << ": which package is <" << first << "/...> of?";
        }
      }
    }
  EXPECT_EQ(met.size(), 4U);
  for (const std::string& name : met) EXPECT_FALSE(package(name).is_null()) << name;
  EXPECT_TRUE(boost);
  const bool named = std::ranges::any_of(
      document["packages"], [](const Json& p) { return p["name"].get<std::string>().starts_with("libboost"); });
  EXPECT_EQ(named, with_boost);
}

TEST_P(Sbom, NamesOurOwnLicenceAsTheLicenceFileDoes) {
  std::ifstream file(fs::path{TANDEM_SOURCE_DIR} / "LICENSE");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(text.find("Apache License"), std::string::npos);
  EXPECT_NE(text.find("Version 2.0"), std::string::npos);
  const Json own = package(GetParam());
  EXPECT_EQ(own["licenseDeclared"], "Apache-2.0");
  EXPECT_EQ(own["versionInfo"], TANDEM_VERSION);
}

INSTANTIATE_TEST_SUITE_P(Of, Sbom, testing::Values("tandem-server", "tandem-client", "tandem-netsim", "tandem-console"),
                         [](const auto& program) {
                           std::string name{program.param + 7};
                           name[0] = static_cast<char>(name[0] - 'a' + 'A');
                           return name;
                         });

}  // namespace
}  // namespace tandem::test
