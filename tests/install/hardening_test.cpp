// Checks the hardening of the shipped programs against memory errors, read from their files (SECURITY.md, "Build").
#include <gtest/gtest.h>

#include <cstdio>
#include <string_view>

#include "tests/install/elf_file.h"

namespace tandem::test {
namespace {

struct Hardening : testing::TestWithParam<const char*> {
  void SetUp() override {
    if (std::string_view{TANDEM_SANITIZE} != "") GTEST_SKIP() << "a build with sanitizers is not shipped";
  }
};

TEST_P(Hardening, EnablesTheProtectionsOfLoaderAndKernel) {
  const ElfFile program{GetParam()};
  EXPECT_TRUE(program.position_independent()) << "-pie";
  EXPECT_TRUE(program.relro()) << "-z relro";
  EXPECT_TRUE(program.bind_now()) << "-z now";
  EXPECT_FALSE(program.executable_stack());
  EXPECT_FALSE(program.writable_code());
  if (!program.x86_64()) return;
  EXPECT_TRUE(program.ibt()) << "-z ibt; mold 1.10 does not write this note, so build without -fuse-ld=mold";
  EXPECT_TRUE(program.shadow_stack()) << "-z shstk";
}

TEST_P(Hardening, IsCompiledIntoTheCode) {
  const ElfFile program{GetParam()};
  EXPECT_TRUE(program.imports().contains("__stack_chk_fail")) << "-fstack-protector-strong";
  EXPECT_TRUE(program.imports().contains("_ZSt21__glibcxx_assert_failPKciS0_S0_")) << "-D_GLIBCXX_ASSERTIONS";
  std::string checked;
  for (const std::string& name : program.imports())
    if (name.ends_with("_chk")) checked += name + " ";
  EXPECT_NE(checked, "") << "-D_FORTIFY_SOURCE=2";
  std::printf("[ imports  ] %s\n", checked.c_str());
  if (program.x86_64()) {
    EXPECT_TRUE(program.code_holds({"\x48\x83\x0c\x24\x00", 5}))
        << "-fstack-clash-protection: no probe `orq $0, (%rsp)`";
  }
}

// The note alone proves nothing: with -z ibt the linker writes it for any code. So every code address that indirect
// jumps can take from the program's data must hold endbr64. The entry point is excluded, because it is in Debian's
// start file, which lacks endbr64.
TEST_P(Hardening, MarksEveryTargetOfIndirectJumps) {
  const ElfFile program{GetParam()};
  if (!program.x86_64()) GTEST_SKIP() << "endbr64 is an instruction of x86-64";
  std::size_t without = 0;
  for (const ElfFile::Target& t : program.targets()) {
    if (t.endbr64) continue;
    ++without;
    if (without < 10) std::printf("no endbr64 at %#llx\n", static_cast<unsigned long long>(t.address));
  }
  EXPECT_GT(program.targets().size(), 100U) << "constructors, virtual functions";
  EXPECT_EQ(without, 0U);
  std::printf("[ targets  ] %zu addresses of code in data, %zu without endbr64\n", program.targets().size(), without);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Hardening,
                         testing::Values(TANDEM_SERVER, TANDEM_CLIENT, TANDEM_NETSIM, TANDEM_CONSOLE, TANDEM_DEMO),
                         [](const auto& program) {
                           const std::string_view path = program.param;
                           std::string name{path.substr(path.rfind("tandem-") + 7)};
                           name[0] = static_cast<char>(name[0] - 'a' + 'A');
                           return name;
                         });

}  // namespace
}  // namespace tandem::test
