#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tandem::test {

/// A program for 64-bit Linux as a file: what the loader and the processor are told about it, and its code.
/// A file that is not one, or that lies about its own tables, throws std::runtime_error.
class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& path);

  [[nodiscard]] bool x86_64() const { return x86_64_; }
  /// Loaded at a random address.
  [[nodiscard]] bool position_independent() const { return position_independent_; }
  /// The tables of the loader are made read-only after it has run.
  [[nodiscard]] bool relro() const { return relro_; }
  /// All symbols are bound at the start, so that those tables are complete before they become read-only.
  [[nodiscard]] bool bind_now() const { return bind_now_; }
  [[nodiscard]] bool executable_stack() const { return executable_stack_; }
  /// A segment that may be written and executed.
  [[nodiscard]] bool writable_code() const { return writable_code_; }
  /// The program's note to the kernel: jumps land on endbr64 only; returns are checked by a shadow stack.
  [[nodiscard]] bool ibt() const { return ibt_; }
  [[nodiscard]] bool shadow_stack() const { return shadow_stack_; }

  /// DT_NEEDED, in their order.
  [[nodiscard]] const std::vector<std::string>& libraries() const { return libraries_; }
  /// Names that libraries provide.
  [[nodiscard]] const std::set<std::string>& imports() const { return imports_; }
  /// Whether the code holds these bytes.
  [[nodiscard]] bool code_holds(const std::string& bytes) const;

  /// Addresses in the code that the program's data hold: constructors, virtual functions, tables of functions. Not the entry point.
  struct Target {
    std::uint64_t address = 0;
    bool endbr64 = false;
  };
  [[nodiscard]] const std::vector<Target>& targets() const { return targets_; }

 private:
  template <class T>
  [[nodiscard]] T at(std::uint64_t offset) const;
  [[nodiscard]] std::string text_at(std::uint64_t offset) const;
  /// Where an address lies in the file.
  [[nodiscard]] std::uint64_t offset_of(std::uint64_t address) const;
  void read_segments();
  void read_dynamic(std::uint64_t offset, std::uint64_t size);
  void read_notes(std::uint64_t offset, std::uint64_t size);
  void add_target(std::uint64_t address);

  struct Segment {
    std::uint64_t address = 0, offset = 0, size = 0;
    bool code = false;
  };
  std::string bytes_;
  std::vector<Segment> segments_;
  bool x86_64_ = false, position_independent_ = false, relro_ = false, bind_now_ = false, executable_stack_ = true, writable_code_ = false, ibt_ = false,
       shadow_stack_ = false;
  std::vector<std::string> libraries_;
  std::set<std::string> imports_;
  std::vector<Target> targets_;
};

}  // namespace tandem::test
