#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tandem::test {

/// The file of a program for 64-bit Linux: its settings for the loader and the processor, and its code.
/// The constructor throws std::runtime_error if the file is no such program or if its tables are inconsistent.
class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& path);

  [[nodiscard]] bool x86_64() const { return x86_64_; }
  /// The loader places the program at a random address.
  [[nodiscard]] bool position_independent() const { return position_independent_; }
  /// The loader makes its tables read-only after it has run.
  [[nodiscard]] bool relro() const { return relro_; }
  /// The loader binds all symbols at the start, so that those tables are complete before they become read-only.
  [[nodiscard]] bool bind_now() const { return bind_now_; }
  [[nodiscard]] bool executable_stack() const { return executable_stack_; }
  /// A segment is both writable and executable.
  [[nodiscard]] bool writable_code() const { return writable_code_; }
  /// Note of the program to the kernel: indirect jumps may target only endbr64; a shadow stack checks returns.
  [[nodiscard]] bool ibt() const { return ibt_; }
  [[nodiscard]] bool shadow_stack() const { return shadow_stack_; }

  /// Names of the needed libraries (DT_NEEDED), in the order of the file.
  [[nodiscard]] const std::vector<std::string>& libraries() const { return libraries_; }
  /// Symbols that the program imports from libraries.
  [[nodiscard]] const std::set<std::string>& imports() const { return imports_; }
  /// Returns whether the code contains these bytes.
  [[nodiscard]] bool code_holds(const std::string& bytes) const;

  /// A code address in the program's data: of a constructor, a virtual function or a table of functions. The entry
  /// point is not included.
  struct Target {
    std::uint64_t address = 0;
    bool endbr64 = false;
  };
  [[nodiscard]] const std::vector<Target>& targets() const { return targets_; }

 private:
  template <class T>
  [[nodiscard]] T at(std::uint64_t offset) const;
  [[nodiscard]] std::string text_at(std::uint64_t offset) const;
  /// Returns the offset of an address in the file.
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
  bool x86_64_ = false, position_independent_ = false, relro_ = false, bind_now_ = false, executable_stack_ = true,
       writable_code_ = false, ibt_ = false, shadow_stack_ = false;
  std::vector<std::string> libraries_;
  std::set<std::string> imports_;
  std::vector<Target> targets_;
};

}  // namespace tandem::test
